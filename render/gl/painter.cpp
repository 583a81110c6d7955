#include "render/gl/painter.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <new>
#include <optional>
#include <set>

#include "render/batches.h"
#include "render/camera.h"
#include "render/gl/mesh_store.h"
#include "render/gl/program.h"
#include "render/gl/target.h"
#include "render/gl/texture_store.h"
#include "render/sampling.h"

namespace farol::render::gl {
namespace {

constexpr std::size_t kMeshBytes = std::size_t{256} << 20;
constexpr std::size_t kTextureBytes = std::size_t{384} << 20;
constexpr std::size_t kMostAhead = 32;  // programs with textures of one kind each

double sinceMs(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

/// Alpha was blended towards a transparent black: divides it out again.
void unpremultiply(Image& image) {
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        const unsigned alpha = image.pixels[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t c = 0; c < 3; ++c)
            image.pixels[i + c] = static_cast<std::uint8_t>(
                std::min(255U, (image.pixels[i + c] * 255U + alpha / 2) / alpha));
    }
}

void defineSurface(const generator::Surface& surface, std::string& defines) {
    using Kind = generator::Surface::Kind;
    defines += "#define SURFACE\n";
    defines += surface.kind == Kind::ellipsoid ? "#define SURFACE_ELLIPSOID\n"
               : surface.kind == Kind::frustum ? "#define SURFACE_FRUSTUM\n"
               : surface.kind == Kind::torus   ? "#define SURFACE_TORUS\n"
               : surface.kind == Kind::turned  ? "#define SURFACE_TURNED\n"
                                               : "#define SURFACE_RING\n";
    if (surface.turnFromX) defines += "#define SURFACE_TURN_FROM_X\n";
    if (surface.discUv) defines += "#define SURFACE_DISC_UV\n";
}

void setSurface(const Api& api, const DrawItem& item, const LinkedProgram& program) {
    const generator::Surface& surface = *item.surface;
    const glm::vec3 lengths(surface.lengths);
    const glm::vec2 form(surface.form);
    const glm::vec4 uv(surface.uv);
    api.Uniform3fv(program.unitFromObject, 1, glm::value_ptr(item.unitFromObject));
    api.Uniform3fv(program.surfaceLengths, 1, glm::value_ptr(lengths));
    api.Uniform2f(program.surfaceForm, form.x, form.y);
    api.Uniform4fv(program.surfaceUv, 1, glm::value_ptr(uv));
    const glm::vec4 discs(surface.discs);
    api.Uniform4fv(program.surfaceDiscs, 1, glm::value_ptr(discs));
    // A polar layout (uv.y < 0) has no middle to grow from.
    api.Uniform1f(program.balance, uv.y > 0.0F ? item.unitFromObject.x * lengths.x : 1.0F);
    api.Uniform1f(program.seenFrom, item.inside ? -1.0F : 1.0F);
}

/// `image` of the plan's size becomes sum / whole, rounded.
void takeMean(const std::vector<std::uint32_t>& sum, std::uint32_t whole, Image& image) {
    image.pixels.resize(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i)
        image.pixels[i] = static_cast<std::uint8_t>((sum[i] + whole / 2) / whole);
}

bool hasBackdrop(const FramePlan& plan) {
    return plan.skyboxTexture >= 0 || plan.backgroundTexture >= 0;
}

}  // namespace

struct Painter::State {
    std::unique_ptr<Context> context = createOsMesaContext();
    const Api& api = context->api();
    ProgramCache programs{api};
    Buffer placeBuffer{api};
    MeshStore meshes{api, placeBuffer, kMeshBytes};
    TextureStore textures{api, kTextureBytes};
    std::optional<Target> target;
    VertexArray lineArray{api}, emptyArray{api};
    Buffer lineBuffer{api};
    std::vector<Buffer> lightBuffers;
    std::vector<GLuint> textureNames;
    Batches batches;
    GLint mostSamples = 1;

    State() {
        api.GetIntegerv(GL_MAX_SAMPLES, &mostSamples);
        mostSamples = std::min(mostSamples, kGlSamples);
        api.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        api.Enable(GL_DEPTH_TEST);
        api.DepthFunc(GL_GREATER);
        api.Enable(GL_CULL_FACE);
        api.CullFace(GL_BACK);
        api.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
        api.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        api.MinSampleShading(1.0F);
    }

    void prepareTextures(const FramePlan& plan, const OpenTexture& open);
    void compileAhead(const FramePlan& plan);
    void prepare(const FramePlan& plan, const OpenTexture& open);
    void drawPass(const FramePlan& plan, const glm::dvec2& offset, int& drawCalls);
    void drawBackdrop(const FramePlan& plan, int& drawCalls);
    void drawItems(const FramePlan& plan, const glm::mat4& clip, int& drawCalls);
    void drawLines(const std::vector<LineVertex>& lines, const glm::mat4& clip, int& drawCalls);
    void drawOne(const DrawItem& item, const GpuMesh& mesh, const LinkedProgram& program);
    void preparePlaces(const FramePlan& plan);
    Target::Resolver resolver(int samples);
    ProgramKey keyOf(const FramePlan& plan, const DrawItem& item, bool instanced) const;
    void setLights(const std::vector<EyeLight>& lights, GLuint buffer,
                   const LinkedProgram& program);
    void setMaterial(const FramePlan& plan, const DrawItem& item, const LinkedProgram& program);
};

Painter::Painter() : state_(std::make_unique<State>()) {}
Painter::~Painter() = default;
const std::string& Painter::description() const { return state_->context->description(); }

void Painter::State::prepareTextures(const FramePlan& plan, const OpenTexture& open) {
    textureNames.clear();
    std::vector<const TextureRef*> missing;
    for (const TextureRef& ref : plan.textures) {
        textureNames.push_back(textures.find(ref));
        if (textureNames.back() == 0) missing.push_back(&ref);
    }
    if (missing.empty()) return;
    std::vector<TextureStore::Reserved> reserved(plan.textures.size());
    const auto indexOf = [&](const TextureRef& ref) {
        return static_cast<std::size_t>(&ref - plan.textures.data());
    };
    const auto expect = [&](const TextureRef& ref, const UndecodedTexture& coming) {
        if (ref.cube || coming.width == 0) return;
        const std::size_t i = indexOf(ref);
        reserved[i] = textures.reserve(ref, coming.width, coming.height);
        textureNames[i] = reserved[i].texture.name();
    };
    const auto take = [&](const TextureRef& ref, const TextureLevels& levels) {
        const std::size_t i = indexOf(ref);
        textureNames[i] = textures.put(ref, std::move(reserved[i]), levels, plan.textures.size());
    };
    loadTextures(missing, open, {expect, [&] { compileAhead(plan); }, take});
}

/// Makes the GL compile its code for this frame, by draws of which no pixel is let through: the
/// code depends on programs, textures and target, not on what is in them.
void Painter::State::compileAhead(const FramePlan& plan) {
    const bool flat = plan.lit && plan.shading == scene::Shading::flat;
    std::set<std::pair<const LinkedProgram*, GLuint>> done;
    target->bind();
    api.Enable(GL_SCISSOR_TEST);
    api.Scissor(0, 0, 0, 0);
    for (const Batch& batch : batches.batches) {
        const DrawItem& first = plan.items[batches.order[batch.first]];
        const GLuint texture =
            first.texture < 0 ? 0 : textureNames[static_cast<std::size_t>(first.texture)];
        if (first.texture >= 0 && texture == 0) continue;  // not even its size is known
        const LinkedProgram& program = programs.get(keyOf(plan, first, batch.instanced));
        if (!done.emplace(&program, texture).second) continue;
        api.UseProgram(program.program.name());
        if (texture != 0) api.BindTexture(GL_TEXTURE_2D, texture);
        const auto set = static_cast<std::size_t>(first.lightSet);
        if (plan.lit && !plan.lightSets[set].empty())
            setLights(plan.lightSets[set], lightBuffers[set].name(), program);
        api.BindVertexArray(meshes.get(*first.mesh, flat).array.name());
        api.DrawArrays(GL_TRIANGLES, 0, 3);
        if (done.size() >= kMostAhead) break;
    }
    target->resolve(resolver(target->samples()));
    api.Disable(GL_SCISSOR_TEST);
}

void Painter::State::prepare(const FramePlan& plan, const OpenTexture& open) {
    const Sampling sampled = chooseSampling(plan.samples, mostSamples);
    const auto channels = sampled.passes > 1 ? Target::Channels::bits16 : Target::Channels::bits8;
    if (!target || !target->fits(plan.width, plan.height, sampled.samples, channels)) {
        target.reset();  // the old one first: two large ones need not fit
        target.emplace(api, plan.width, plan.height, sampled.samples, channels);
    }
    // With passes of their own, each sample is shaded: what changes within a pixel is averaged.
    (sampled.passes > 1 ? api.Enable : api.Disable)(GL_SAMPLE_SHADING);
    batches = batchesOf(plan);
    preparePlaces(plan);
    while (lightBuffers.size() < plan.lightSets.size()) lightBuffers.emplace_back(api);
    for (std::size_t i = 0; i < plan.lightSets.size(); ++i) {
        if (plan.lightSets[i].empty()) continue;
        api.BindBuffer(GL_UNIFORM_BUFFER, lightBuffers[i].name());
        api.BufferData(GL_UNIFORM_BUFFER,
                       static_cast<GLsizeiptr>(plan.lightSets[i].size() * sizeof(EyeLight)),
                       plan.lightSets[i].data(), GL_STREAM_DRAW);
    }
    prepareTextures(plan, open);
}

/// The places of all instanced batches, one behind the other.
void Painter::State::preparePlaces(const FramePlan& plan) {
    std::vector<PlaceVertex> places;
    for (const Batch& batch : batches.batches) {
        if (!batch.instanced) continue;
        for (std::size_t i = batch.first; i < batch.first + batch.count; ++i) {
            const DrawItem& item = plan.items[batches.order[i]];
            places.push_back({item.viewFromObject, item.normalFromObject, item.surfaceEye});
        }
    }
    if (places.empty()) return;
    api.BindBuffer(GL_ARRAY_BUFFER, placeBuffer.name());
    api.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(places.size() * sizeof(PlaceVertex)),
                   places.data(), GL_STREAM_DRAW);
}

ProgramKey Painter::State::keyOf(const FramePlan& plan, const DrawItem& item,
                                 bool instanced) const {
    std::string defines;
    const auto define = [&](const char* text) { defines += std::string("#define ") + text + '\n'; };
    switch (plan.layer) {
        case Layer::id:
            define("LAYER_ID");
            break;
        case Layer::normal:
            define("LAYER_NORMAL");
            break;
        case Layer::depth:
            define("LAYER_DEPTH");
            break;
        case Layer::color:
            break;
    }
    const std::vector<EyeLight>& lights = plan.lightSets[static_cast<std::size_t>(item.lightSet)];
    defines += "#define LIGHT_COUNT " + std::to_string(plan.lit ? lights.size() : 0) + '\n';
    // What shows neither light nor a texture needs its outline only.
    const bool plain =
        plan.layer == Layer::id || (plan.layer == Layer::color && !plan.lit && item.texture < 0);
    if (item.surface && !plain) defineSurface(*item.surface, defines);
    if (instanced) define("INSTANCED");
    if (plan.layer != Layer::color) return {"model", defines};
    if (item.texture >= 0) {
        const auto filter = plan.textures[static_cast<std::size_t>(item.texture)].filter;
        define("TEXTURED");
        if (filter == scene::Filter::mipmap) define("FILTER_MIPMAP");
        if (filter == scene::Filter::anisotropic) define("FILTER_ANISOTROPIC");
    }
    if (item.texture >= 0 && item.mapping == scene::Mapping::sphere) define("MAPPING_SPHERE");
    if (item.texture >= 0 && item.mapping == scene::Mapping::texgenObject) define("TEXGEN_OBJECT");
    if (item.texture >= 0 && item.mapping == scene::Mapping::texgenEye) define("TEXGEN_EYE");
    if (plan.shading == scene::Shading::chess) define("CHESS");
    if (!plan.lit) {
        define("UNLIT");
        return {"model", defines};
    }
    if (plan.shading == scene::Shading::flat) define("FLAT");
    if (plan.shading == scene::Shading::gouraud) define("GOURAUD");
    if (plan.shading == scene::Shading::phong) define("PHONG");
    const auto any = [&](auto test) { return std::any_of(lights.begin(), lights.end(), test); };
    if (any([](const EyeLight& l) { return l.position.w != 0.0F; })) define("POSITIONAL");
    if (any([](const EyeLight& l) { return l.spot.w > -2.0F; })) define("SPOT");
    const bool shiny = item.specular != glm::vec3(0.0F) && any([](const EyeLight& l) {
                           return glm::vec3(l.specular) != glm::vec3(0.0F);
                       });
    if (shiny) define("SPECULAR");
    if (shiny && plan.viewer == scene::Viewer::local) define("LOCAL_VIEWER");
    if (shiny && plan.specular == scene::Specular::separate && item.texture >= 0)
        define("SEPARATE_SPECULAR");
    return {"model", defines};
}

void Painter::State::setLights(const std::vector<EyeLight>& lights, GLuint buffer,
                               const LinkedProgram& program) {
    api.BindBufferBase(GL_UNIFORM_BUFFER, kLightsBinding, buffer);
    if (program.lightCount >= 0)
        api.Uniform1i(program.lightCount, static_cast<GLint>(lights.size()));
}

void Painter::State::setMaterial(const FramePlan& plan, const DrawItem& item,
                                 const LinkedProgram& program) {
    if (plan.layer == Layer::id) {
        const glm::vec3 color(static_cast<float>((item.id >> 16) & 255U),
                              static_cast<float>((item.id >> 8) & 255U),
                              static_cast<float>(item.id & 255U));
        const glm::vec3 unit = color / 255.0F;
        return api.Uniform3fv(program.plainColor, 1, glm::value_ptr(unit));
    }
    const glm::vec3 base = item.emissive + item.ambient * plan.globalAmbient;
    api.Uniform3fv(program.plainColor, 1, glm::value_ptr(item.diffuse));
    api.Uniform3fv(program.materialDiffuse, 1, glm::value_ptr(item.diffuse));
    api.Uniform3fv(program.materialBase, 1, glm::value_ptr(base));
    api.Uniform3fv(program.materialAmbient, 1, glm::value_ptr(item.ambient));
    api.Uniform3fv(program.materialSpecular, 1, glm::value_ptr(item.specular));
    api.Uniform1f(program.materialShininess, item.shininess);
    if (item.mapping == scene::Mapping::texgenObject || item.mapping == scene::Mapping::texgenEye) {
        api.Uniform4fv(program.planeS, 1, glm::value_ptr(item.planeS));
        api.Uniform4fv(program.planeT, 1, glm::value_ptr(item.planeT));
    }
}

/// A model whose batch is set up.
void Painter::State::drawOne(const DrawItem& item, const GpuMesh& mesh,
                             const LinkedProgram& program) {
    api.UniformMatrix4fv(program.viewFromObject, 1, GL_FALSE, glm::value_ptr(item.viewFromObject));
    if (program.normalFromObject >= 0)
        api.UniformMatrix3fv(program.normalFromObject, 1, GL_FALSE,
                             glm::value_ptr(item.normalFromObject));
    if (item.surface) api.Uniform3fv(program.unitEye, 1, glm::value_ptr(item.surfaceEye));
    if (mesh.indexed)
        api.DrawElements(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT, nullptr);
    else
        api.DrawArrays(GL_TRIANGLES, 0, mesh.count);
}

void Painter::State::drawItems(const FramePlan& plan, const glm::mat4& clip, int& drawCalls) {
    const bool wireframe = plan.layer == Layer::color && plan.shading == scene::Shading::wireframe;
    const bool points = plan.layer == Layer::color && plan.shading == scene::Shading::points;
    const bool flat = plan.lit && plan.shading == scene::Shading::flat;
    if (wireframe) api.PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    if (points) api.PolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    const LinkedProgram* current = nullptr;
    GLuint base = 0;  // of the batch's places
    for (const Batch& batch : batches.batches) {
        const DrawItem& first = plan.items[batches.order[batch.first]];
        const LinkedProgram& program = programs.get(keyOf(plan, first, batch.instanced));
        if (&program != current) {
            current = &program;
            api.UseProgram(program.program.name());
            api.UniformMatrix4fv(program.clipFromView, 1, GL_FALSE, glm::value_ptr(clip));
            if (program.worldFromView >= 0)
                api.UniformMatrix3fv(program.worldFromView, 1, GL_FALSE,
                                     glm::value_ptr(plan.worldFromView));
            if (program.nearest >= 0)
                api.Uniform1f(program.nearest, static_cast<float>(plan.camera.near));
        }
        if (first.surface) setSurface(api, first, program);
        setMaterial(plan, first, program);
        const auto set = static_cast<std::size_t>(first.lightSet);
        if (plan.lit && !plan.lightSets[set].empty())
            setLights(plan.lightSets[set], lightBuffers[set].name(), program);
        if (first.texture >= 0)
            api.BindTexture(GL_TEXTURE_2D, textureNames[static_cast<std::size_t>(first.texture)]);
        api.FrontFace(first.mirrored ? GL_CW : GL_CCW);
        const GpuMesh& mesh = meshes.get(*first.mesh, flat);
        api.BindVertexArray(mesh.array.name());
        if (batch.instanced) {
            const auto count = static_cast<GLsizei>(batch.count);
            if (mesh.indexed)
                api.DrawElementsInstancedBaseInstance(GL_TRIANGLES, mesh.count, GL_UNSIGNED_INT,
                                                      nullptr, count, base);
            else
                api.DrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, mesh.count, count, base);
            base += static_cast<GLuint>(batch.count);
            ++drawCalls;
            continue;
        }
        for (std::size_t i = batch.first; i < batch.first + batch.count; ++i, ++drawCalls)
            drawOne(plan.items[batches.order[i]], mesh, program);
    }
    api.FrontFace(GL_CCW);
    if (wireframe || points) api.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void Painter::State::drawLines(const std::vector<LineVertex>& lines, const glm::mat4& clip,
                               int& drawCalls) {
    if (lines.empty()) return;
    const LinkedProgram& program = programs.get({"line", ""});
    api.UseProgram(program.program.name());
    api.UniformMatrix4fv(program.clipFromView, 1, GL_FALSE, glm::value_ptr(clip));
    api.BindVertexArray(lineArray.name());
    api.BindBuffer(GL_ARRAY_BUFFER, lineBuffer.name());
    api.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lines.size() * sizeof(LineVertex)),
                   lines.data(), GL_STREAM_DRAW);
    for (const GLuint location : {0U, 1U}) {
        api.EnableVertexAttribArray(location);
        api.VertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(LineVertex),
                                reinterpret_cast<const void*>(location * sizeof(glm::vec3)));
    }
    api.DrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines.size()));
    ++drawCalls;
}

/// Where no model is: the depth is still that of the clear, which nothing that is drawn has. The
/// skybox hides the background's picture.
void Painter::State::drawBackdrop(const FramePlan& plan, int& drawCalls) {
    if (!hasBackdrop(plan)) return;
    api.BindVertexArray(emptyArray.name());
    api.DepthFunc(GL_EQUAL);
    api.DepthMask(GL_FALSE);
    if (plan.skyboxTexture >= 0) {
        const LinkedProgram& program = programs.get({"window", "#define SKYBOX\n"});
        api.UseProgram(program.program.name());
        api.UniformMatrix3fv(program.worldFromView, 1, GL_FALSE,
                             glm::value_ptr(plan.worldFromView));
        const double up = std::tan(glm::radians(plan.camera.fovDeg) / 2.0);
        api.Uniform2f(program.tangents, static_cast<float>(up * plan.width / plan.height),
                      static_cast<float>(up));
        api.BindTexture(GL_TEXTURE_CUBE_MAP,
                        textureNames[static_cast<std::size_t>(plan.skyboxTexture)]);
    } else {
        api.UseProgram(programs.get({"window", ""}).program.name());
        api.BindTexture(GL_TEXTURE_2D,
                        textureNames[static_cast<std::size_t>(plan.backgroundTexture)]);
    }
    api.DrawArrays(GL_TRIANGLES, 0, 3);
    ++drawCalls;
    api.DepthMask(GL_TRUE);
    api.DepthFunc(GL_GREATER);
}

Target::Resolver Painter::State::resolver(int samples) {
    if (samples <= 1) return {};
    const ProgramKey key{"window", "#define RESOLVE " + std::to_string(samples) + '\n'};
    return {programs.get(key).program.name(), emptyArray.name()};
}

void Painter::State::drawPass(const FramePlan& plan, const glm::dvec2& offset, int& drawCalls) {
    const glm::dvec2 window(plan.width, plan.height);
    const glm::mat4 clip(clipFromView(plan.camera, window.x / window.y, 2.0 * offset / window));
    target->bind();
    // Before a backdrop every sample is drawn.
    if (!hasBackdrop(plan)) api.ClearBufferfv(GL_COLOR, 0, glm::value_ptr(plan.background));
    constexpr float kFarthest = 0.0F;  // reversed depth
    api.ClearBufferfv(GL_DEPTH, 0, &kFarthest);
    drawLines(plan.lines, clip, drawCalls);
    drawItems(plan, clip, drawCalls);
    drawBackdrop(plan, drawCalls);
    api.Disable(GL_DEPTH_TEST);
    drawLines(plan.overlays, clip, drawCalls);
    api.Enable(GL_DEPTH_TEST);
}

void Painter::draw(const FramePlan& plan, const OpenTexture& open, Image& image, int& drawCalls,
                   Timings& timings) {
    State& s = *state_;
    s.context->makeCurrent();
    s.prepare(plan, open);
    auto begin = std::chrono::steady_clock::now();
    const Sampling sampled = chooseSampling(plan.samples, s.mostSamples);
    const Target::Resolver resolve = s.resolver(sampled.samples);
    std::vector<std::uint16_t> part;
    std::vector<std::uint32_t> sum;
    for (int pass = 0; pass < sampled.passes; ++pass) {
        s.drawPass(plan, passOffset(pass, sampled.passes), drawCalls);
        s.api.Finish();  // else the time of drawing would be counted as reading
        const auto drawn = std::chrono::steady_clock::now();
        if (sampled.passes == 1) {
            s.target->read(resolve, image);
        } else {
            s.target->read(resolve, part);
            sum.resize(part.size());
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
        }
        timings.readbackMs += sinceMs(drawn);
    }
    if (sampled.passes > 1) {
        image.width = plan.width;
        image.height = plan.height;
        takeMean(sum, 257U * static_cast<std::uint32_t>(sampled.passes), image);
    }
    const GLenum error = s.api.GetError();
    if (error == GL_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error != GL_NO_ERROR)
        throw std::runtime_error("GL error " + std::to_string(error) + " while drawing");
    if (plan.background.a < 1.0F) unpremultiply(image);
    timings.drawMs += sinceMs(begin) - timings.readbackMs;
}

}  // namespace farol::render::gl
