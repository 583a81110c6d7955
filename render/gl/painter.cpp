#include "render/gl/painter.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <new>
#include <optional>
#include <set>

#include "render/gl/box_mean.h"
#include "render/gl/mesh_store.h"
#include "render/gl/program.h"
#include "render/gl/target.h"
#include "render/gl/texture_store.h"

namespace farol::render::gl {
namespace {

constexpr std::size_t kMeshBytes = std::size_t{256} << 20;
constexpr std::size_t kTextureBytes = std::size_t{384} << 20;
constexpr std::size_t kMaxAhead = 32;  // programs with textures of one kind each

double sinceMs(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

/// Divides colours by alpha: blending over transparent black has multiplied them by it.
void unpremultiply(image::Image& image) {
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        const unsigned alpha = image.pixels[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t c = 0; c < 3; ++c)
            image.pixels[i + c] = static_cast<std::uint8_t>(
                std::min(255U, (image.pixels[i + c] * 255U + alpha / 2) / alpha));
    }
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
    // A polar layout (uv.y < 0) is not scaled about its centre.
    api.Uniform1f(program.balance, uv.y > 0.0F ? item.unitFromObject.x * lengths.x : 1.0F);
    api.Uniform1f(program.seenFrom, item.inside ? -1.0F : 1.0F);
}

GLsizei countOf(const DrawItem& item) { return static_cast<GLsizei>(item.indices); }

/// Where the item's indices begin in their buffer.
const void* firstOf(const DrawItem& item) {
    return reinterpret_cast<const void*>(item.firstIndex * sizeof(std::uint32_t));
}

GLenum modeOf(Polygons polygons) {
    return polygons == Polygons::outlined   ? GL_LINE
           : polygons == Polygons::cornered ? GL_POINT
                                            : GL_FILL;
}

/// Makes the context current: the painter's objects are created in it.
std::unique_ptr<Context> madeCurrent(std::unique_ptr<Context> context) {
    context->makeCurrent();
    return context;
}

ProgramKey keyOf(const FramePlan& plan, const Pass& pass, const Batch& batch) {
    const DrawItem& first = plan.items[plan.batches.order[batch.first]];
    ProgramKey key;
    key.features = pass.features | (batch.features & pass.itemFeatures);
    if (batch.instanced) key.features.add(Feature::instanced);
    if (!key.features.has(Feature::textured)) key.features.remove(Feature::supersampled);
    if (key.features.has(Feature::surface))
        key.surfaceKind = plan.items[plan.batches.order[batch.first]].surface->kind->glsl;
    const auto set = static_cast<std::size_t>(first.lightSet);
    if (pass.features.hasAny(kLitFeatures))
        key.count = static_cast<int>(plan.lightSets[set].size());
    return key;
}

}  // namespace

struct Painter::State {
    std::unique_ptr<Context> context;
    const Api& api = context->api();
    const GlFacts& facts = context->facts();
    ProgramCache programs{api};
    Buffer placeBuffer{api};
    MeshStore meshes{api, placeBuffer, kMeshBytes};
    TextureStore textures{api, facts, kTextureBytes};
    std::optional<Target> target;
    BoxMean mean;
    VertexArray lineArray{api}, emptyArray{api};
    Buffer lineBuffer{api};
    std::vector<Buffer> lightBuffers;
    std::vector<GLuint> textureNames;
    std::vector<std::vector<TextureNote>> textureNotes;  ///< of each texture of the plan

    explicit State(std::unique_ptr<Context> with) : context(madeCurrent(std::move(with))) {
        api.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        api.Enable(GL_CULL_FACE);
        api.CullFace(GL_BACK);
        api.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
        api.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        restoreState();
    }

    /// Restores the GL state that plans change and expect to find: a plan that failed may have
    /// left it changed.
    void restoreState() {
        clearErrors(api);
        api.Disable(GL_SCISSOR_TEST);
        api.Enable(GL_DEPTH_TEST);
        api.DepthMask(GL_TRUE);
        api.DepthFunc(GL_GREATER);
        api.Disable(GL_POLYGON_OFFSET_FILL);
        api.FrontFace(GL_CCW);
        api.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        mean.drop();
    }

    void prepareTextures(const FramePlan& plan, const OpenTexture& open);
    void compileAhead(const FramePlan& plan);
    void prepare(const FramePlan& plan, const OpenTexture& open);
    void preparePlaces(const FramePlan& plan);
    void begin(const FramePlan& plan, const Pass& pass);
    void read(const FramePlan& plan, std::size_t pass, image::Image& image);
    void drawPass(const FramePlan& plan, const Pass& pass, int& drawCalls);
    void drawModels(const FramePlan& plan, const Pass& pass, const PassItem& models,
                    int& drawCalls);
    void drawLines(const FramePlan& plan, const Pass& pass, const PassItem& lines, int& drawCalls);
    void drawBackdrop(const FramePlan& plan, const Pass& pass, const PassItem& backdrop,
                      int& drawCalls);
    void drawOne(const DrawItem& item, const GpuMesh& mesh, const LinkedProgram& program);
    Target::Resolver resolver(int samples);
    void setDepthRank(int rank);
    void setLights(const DrawItem& item, int count, const LinkedProgram& program);
    void setScale(const Pass& pass, const LinkedProgram& program);
    void setMaterial(const FramePlan& plan, const DrawItem& item, const LinkedProgram& program);
};

Painter::Painter(std::unique_ptr<Context> context)
    : state_(std::make_unique<State>(std::move(context))) {}
Painter::~Painter() = default;
const GlFacts& Painter::facts() const { return state_->facts; }

void Painter::State::prepareTextures(const FramePlan& plan, const OpenTexture& open) {
    textureNames.assign(plan.textures.size(), 0);
    textureNotes.assign(plan.textures.size(), {});
    std::vector<const TextureRef*> missing;
    for (std::size_t i = 0; i < plan.textures.size(); ++i) {
        if (const TextureStore::Entry* known = textures.find(plan.textures[i])) {
            textureNames[i] = known->texture.name();
            textureNotes[i] = known->notes;
        } else {
            missing.push_back(&plan.textures[i]);
        }
    }
    if (missing.empty()) return;
    std::vector<TextureStore::Reserved> reserved(plan.textures.size());
    const auto indexOf = [&](const TextureRef& ref) {
        return static_cast<std::size_t>(&ref - plan.textures.data());
    };
    const auto onReserved = [&](const TextureRef& ref, const UndecodedTexture& coming) {
        if (ref.cube || coming.width == 0) return;
        const std::size_t i = indexOf(ref);
        reserved[i] = textures.reserve(ref, coming.width, coming.height);
        textureNames[i] = reserved[i].texture.name();
    };
    const auto onDecoded = [&](const TextureRef& ref, const TextureLevels& levels) {
        const std::size_t i = indexOf(ref);
        const TextureStore::Entry& entry =
            textures.put(ref, std::move(reserved[i]), levels, plan.textures.size());
        textureNames[i] = entry.texture.name();
        textureNotes[i] = entry.notes;
    };
    loadTextures(missing, open, {onReserved, [&] { compileAhead(plan); }, onDecoded}, facts);
}

/// Makes the GL compile its code for this frame, by draw calls whose pixels are all scissored: the
/// code depends on programs, textures and target, not on their content.
void Painter::State::compileAhead(const FramePlan& plan) {
    std::set<std::pair<const LinkedProgram*, GLuint>> done;
    api.Enable(GL_SCISSOR_TEST);
    api.Scissor(0, 0, 0, 0);
    for (const Pass& pass : plan.passes) {
        begin(plan, pass);
        for (const Batch& batch : plan.batches.batches) {
            if (done.size() >= kMaxAhead) break;
            const DrawItem& first = plan.items[plan.batches.order[batch.first]];
            const GLuint texture =
                first.texture < 0 ? 0 : textureNames[static_cast<std::size_t>(first.texture)];
            if (first.texture >= 0 && texture == 0) continue;  // not even its size is known
            const ProgramKey key = keyOf(plan, pass, batch);
            const LinkedProgram& program = programs.get(key);
            if (!done.emplace(&program, texture).second) continue;
            api.UseProgram(program.program.name());
            if (texture != 0) api.BindTexture(GL_TEXTURE_2D, texture);
            setLights(first, key.count, program);
            api.BindVertexArray(
                meshes.get(*first.mesh, pass.features.has(Feature::flat)).array.name());
            api.DrawArrays(GL_TRIANGLES, 0, 3);
        }
        if (pass.target.output != PassOutput::none) target->resolve(resolver(pass.target.samples));
    }
    api.Disable(GL_SCISSOR_TEST);
}

void Painter::State::prepare(const FramePlan& plan, const OpenTexture& open) {
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
    for (const Batch& batch : plan.batches.batches) {
        if (!batch.instanced) continue;
        for (std::size_t i = batch.first; i < batch.first + batch.count; ++i) {
            const DrawItem& item = plan.items[plan.batches.order[i]];
            places.push_back({item.viewFromObject, item.normalFromObject, item.surfaceEye});
        }
    }
    if (places.empty()) return;
    api.BindBuffer(GL_ARRAY_BUFFER, placeBuffer.name());
    api.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(places.size() * sizeof(PlaceVertex)),
                   places.data(), GL_STREAM_DRAW);
}

void Painter::State::setLights(const DrawItem& item, int count, const LinkedProgram& program) {
    if (count == 0) return;
    const auto set = static_cast<std::size_t>(item.lightSet);
    api.BindBufferBase(GL_UNIFORM_BUFFER, kLightsBinding, lightBuffers[set].name());
    if (program.lightCount >= 0) api.Uniform1i(program.lightCount, count);
}

/// Moves the next draws behind others in their plane, by `rank` steps. A step is the most that
/// vertex snapping along an axis, of either draw, and rounding change the depth.
void Painter::State::setDepthRank(int rank) {
    if (rank == 0) return api.Disable(GL_POLYGON_OFFSET_FILL);
    const auto steps = static_cast<float>(-rank);  // smaller is farther
    api.Enable(GL_POLYGON_OFFSET_FILL);
    api.PolygonOffset(steps * static_cast<float>(4.0 * facts.snapPx), steps * 16.0F);
}

void Painter::State::setScale(const Pass& pass, const LinkedProgram& program) {
    if (program.samplesAcross >= 0)
        api.Uniform1f(program.samplesAcross, static_cast<float>(pass.target.scale));
}

void Painter::State::setMaterial(const FramePlan& plan, const DrawItem& item,
                                 const LinkedProgram& program) {
    const glm::vec3 base = item.emissive + item.ambient * plan.globalAmbient;
    api.Uniform3fv(program.materialDiffuse, 1, glm::value_ptr(item.diffuse));
    api.Uniform3fv(program.materialBase, 1, glm::value_ptr(base));
    api.Uniform3fv(program.materialAmbient, 1, glm::value_ptr(item.ambient));
    api.Uniform3fv(program.materialSpecular, 1, glm::value_ptr(item.specular));
    api.Uniform1f(program.materialShininess, item.shininess);
    if (program.uvFrom >= 0) api.Uniform4fv(program.uvFrom, 1, glm::value_ptr(item.uvFrom));
    if (program.mappedFrom >= 0) {
        const glm::vec3 origin(item.mesh->mesh.origin());
        api.Uniform3fv(program.mappedFrom, 1, glm::value_ptr(origin));
    }
    if (program.planeS >= 0) {
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
        api.DrawElements(GL_TRIANGLES, countOf(item), GL_UNSIGNED_INT, firstOf(item));
    else
        api.DrawArrays(GL_TRIANGLES, static_cast<GLint>(item.firstIndex), countOf(item));
}

void Painter::State::drawModels(const FramePlan& plan, const Pass& pass, const PassItem& models,
                                int& drawCalls) {
    const glm::mat4 clip(pass.clip);
    const glm::mat3 worldFromView(glm::transpose(plan.view.rotation));
    const bool flat = pass.features.has(Feature::flat);
    api.PolygonMode(GL_FRONT_AND_BACK, modeOf(pass.state.polygons));
    const LinkedProgram* current = nullptr;
    GLuint base = 0;  // of the batch's places
    for (std::size_t b = 0; b < models.first + models.count; ++b) {
        const Batch& batch = plan.batches.batches[b];
        const GLuint places = base;
        if (batch.instanced) base += static_cast<GLuint>(batch.count);
        if (b < models.first) continue;
        const DrawItem& first = plan.items[plan.batches.order[batch.first]];
        const ProgramKey key = keyOf(plan, pass, batch);
        const LinkedProgram& program = programs.get(key);
        if (&program != current) {
            current = &program;
            api.UseProgram(program.program.name());
            api.UniformMatrix4fv(program.clipFromView, 1, GL_FALSE, glm::value_ptr(clip));
            if (program.worldFromView >= 0)
                api.UniformMatrix3fv(program.worldFromView, 1, GL_FALSE,
                                     glm::value_ptr(worldFromView));
            if (program.nearest >= 0)
                api.Uniform1f(program.nearest, static_cast<float>(plan.view.near));
            setScale(pass, program);
        }
        if (key.features.has(Feature::surface)) setSurface(api, first, program);
        api.Uniform3fv(program.plainColor, 1, glm::value_ptr(batch.plainColor));
        setMaterial(plan, first, program);
        setLights(first, key.count, program);
        if (first.texture >= 0)
            api.BindTexture(GL_TEXTURE_2D, textureNames[static_cast<std::size_t>(first.texture)]);
        api.FrontFace(first.mirrored ? GL_CW : GL_CCW);
        setDepthRank(first.depthRank);
        const GpuMesh& mesh = meshes.get(*first.mesh, flat);
        api.BindVertexArray(mesh.array.name());
        if (batch.instanced) {
            const auto count = static_cast<GLsizei>(batch.count);
            if (mesh.indexed)
                api.DrawElementsInstancedBaseInstance(GL_TRIANGLES, countOf(first), GL_UNSIGNED_INT,
                                                      firstOf(first), count, places);
            else
                api.DrawArraysInstancedBaseInstance(GL_TRIANGLES,
                                                    static_cast<GLint>(first.firstIndex),
                                                    countOf(first), count, places);
            ++drawCalls;
            continue;
        }
        for (std::size_t i = batch.first; i < batch.first + batch.count; ++i, ++drawCalls)
            drawOne(plan.items[plan.batches.order[i]], mesh, program);
    }
    setDepthRank(0);
    api.FrontFace(GL_CCW);
    api.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void Painter::State::drawLines(const FramePlan& plan, const Pass& pass, const PassItem& lines,
                               int& drawCalls) {
    const glm::mat4 clip(pass.clip);
    const LinkedProgram& program = programs.get({Shaders::line, {}, 0});
    api.UseProgram(program.program.name());
    api.UniformMatrix4fv(program.clipFromView, 1, GL_FALSE, glm::value_ptr(clip));
    api.BindVertexArray(lineArray.name());
    api.BindBuffer(GL_ARRAY_BUFFER, lineBuffer.name());
    api.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lines.count * sizeof(LineVertex)),
                   &plan.lines[lines.first], GL_STREAM_DRAW);
    for (const GLuint location : {0U, 1U}) {
        api.EnableVertexAttribArray(location);
        api.VertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(LineVertex),
                                reinterpret_cast<const void*>(location * sizeof(glm::vec3)));
    }
    api.DrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines.count));
    ++drawCalls;
}

/// Where nothing is drawn yet: the depth is still that of the clear, which nothing that is drawn
/// has.
void Painter::State::drawBackdrop(const FramePlan& plan, const Pass& pass, const PassItem& backdrop,
                                  int& drawCalls) {
    FeatureSet features = pass.features & FeatureSet{Feature::supersampled};
    const GLuint texture = textureNames[static_cast<std::size_t>(backdrop.texture)];
    api.BindVertexArray(emptyArray.name());
    api.DepthFunc(GL_EQUAL);
    api.DepthMask(GL_FALSE);
    if (backdrop.kind == PassItem::Kind::skybox) {
        features.add(Feature::skybox);
        const LinkedProgram& program = programs.get({Shaders::window, features, 0});
        const glm::mat3 worldFromView(glm::transpose(plan.view.rotation));
        const glm::vec2 tangents(plan.view.tanHalfFov);
        api.UseProgram(program.program.name());
        api.UniformMatrix3fv(program.worldFromView, 1, GL_FALSE, glm::value_ptr(worldFromView));
        api.Uniform2f(program.tangents, tangents.x, tangents.y);
        setScale(pass, program);
        api.BindTexture(GL_TEXTURE_CUBE_MAP, texture);
    } else {
        const LinkedProgram& program = programs.get({Shaders::window, features, 0});
        api.UseProgram(program.program.name());
        setScale(pass, program);
        api.BindTexture(GL_TEXTURE_2D, texture);
    }
    api.DrawArrays(GL_TRIANGLES, 0, 3);
    ++drawCalls;
    api.DepthMask(GL_TRUE);
    api.DepthFunc(GL_GREATER);
}

Target::Resolver Painter::State::resolver(int samples) {
    if (samples <= 1) return {};
    const ProgramKey key{Shaders::window, {Feature::resolve}, samples};
    return {programs.get(key).program.name(), emptyArray.name()};
}

/// Binds the pass's target; creates it if the last pass had another format.
void Painter::State::begin(const FramePlan& plan, const Pass& pass) {
    const PassTarget& wanted = pass.target;
    const glm::ivec2 whole = plan.view.size * wanted.scale;
    const Target::Format format{whole.x, wanted.rows * wanted.scale, wanted.samples};
    if (!target || target->format() != format) {
        target.reset();  // the old one first: two large ones need not fit
        target.emplace(api, format, facts.packInvert);
    }
    // The viewport is the whole image, of which the target shows a band.
    const int below = plan.view.size.y - wanted.firstRow - wanted.rows;
    target->bind({0, -below * wanted.scale, whole.x, whole.y});
    api.LineWidth(static_cast<float>(wanted.scale));
    api.PointSize(static_cast<float>(wanted.scale));
}

void Painter::State::drawPass(const FramePlan& plan, const Pass& pass, int& drawCalls) {
    begin(plan, pass);
    if (pass.target.clearColor)
        api.ClearBufferfv(GL_COLOR, 0, glm::value_ptr(*pass.target.clearColor));
    constexpr float kFarthest = 0.0F;  // reversed depth
    if (pass.target.clearDepth) api.ClearBufferfv(GL_DEPTH, 0, &kFarthest);
    (pass.state.depthTest ? api.Enable : api.Disable)(GL_DEPTH_TEST);
    for (const PassItem& item : pass.items) {
        switch (item.kind) {
            case PassItem::Kind::models:
                drawModels(plan, pass, item, drawCalls);
                break;
            case PassItem::Kind::lines:
                drawLines(plan, pass, item, drawCalls);
                break;
            case PassItem::Kind::skybox:
            case PassItem::Kind::picture:
                drawBackdrop(plan, pass, item, drawCalls);
                break;
        }
    }
    api.Enable(GL_DEPTH_TEST);
}

/// Reads back the result of a pass: the image, or a part of the mean of its band of rows.
void Painter::State::read(const FramePlan& plan, std::size_t pass, image::Image& image) {
    const PassTarget& drawn = plan.passes[pass].target;
    target->resolve(resolver(drawn.samples));
    if (plan.passes.size() == 1 && drawn.scale == 1) {
        target->read(0, drawn.rows, image.pixels.data());
        return;
    }
    if (!mean.begun()) mean.begin(plan.view.size.x, drawn.rows);
    mean.add(*target, drawn.scale);
    const bool isLast =
        pass + 1 == plan.passes.size() || plan.passes[pass + 1].target.firstRow != drawn.firstRow;
    if (isLast) mean.finish(drawn.firstRow, image);
}

void Painter::draw(const FramePlan& plan, const OpenTexture& open, image::Image& image,
                   int& drawCalls, Timings& timings, Diagnostics& warnings) {
    State& s = *state_;
    s.context->makeCurrent();
    s.restoreState();
    s.prepare(plan, open);
    throwOnError(s.api, "preparing");
    for (std::size_t i = 0; i < plan.textures.size(); ++i)
        for (const TextureNote& note : s.textureNotes[i])
            warnings.push_back(warningOf(note, plan.textures[i]));
    const auto start = std::chrono::steady_clock::now();
    bool transparent = false;
    image.width = plan.view.size.x;
    image.height = plan.view.size.y;
    image.pixels.resize(static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height) * 4);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const Pass& pass = plan.passes[i];
        s.drawPass(plan, pass, drawCalls);
        transparent |= pass.target.clearColor && pass.target.clearColor->a < 1.0F;
        if (pass.target.output == PassOutput::none) continue;
        s.api.Finish();  // else the time of drawing would be counted as reading
        const auto drawn = std::chrono::steady_clock::now();
        s.read(plan, i, image);
        timings.readbackMs += sinceMs(drawn);
    }
    throwOnError(s.api, "drawing");
    if (transparent) unpremultiply(image);
    timings.drawMs += sinceMs(start) - timings.readbackMs;
}

}  // namespace farol::render::gl
