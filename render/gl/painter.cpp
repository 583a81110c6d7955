#include "render/gl/painter.h"

#include <algorithm>
#include <chrono>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <set>

#include "render/gl/painter_state.h"
#include "render/plan/cost.h"
#include "render/plan/messages.h"
#include "render/plan/passes.h"

namespace farol::render::gl {
namespace {

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

/// Makes the context current: the painter's objects are created in it.
std::unique_ptr<Context> madeCurrent(std::unique_ptr<Context> context) {
    context->makeCurrent();
    return context;
}

}  // namespace

Painter::State::State(std::unique_ptr<Context> with) : context(madeCurrent(std::move(with))) {
    api.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api.Enable(GL_CULL_FACE);
    api.CullFace(GL_BACK);
    api.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    api.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    restoreState();
}

void Painter::State::restoreState() {
    clearErrors(api);
    api.Disable(GL_SCISSOR_TEST);
    api.Disable(GL_BLEND);
    api.ActiveTexture(GL_TEXTURE0 + kPictureUnit);
    api.Enable(GL_DEPTH_TEST);
    api.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api.DepthMask(GL_TRUE);
    api.DepthFunc(GL_GREATER);
    api.Disable(GL_POLYGON_OFFSET_FILL);
    api.FrontFace(GL_CCW);
    api.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    mean.drop();
}

Painter::Painter(std::unique_ptr<Context> context)
    : state_(std::make_unique<State>(std::move(context))) {}
Painter::~Painter() = default;
const GlFacts& Painter::facts() const { return state_->facts; }
int Painter::shadowMapsDrawn() const { return state_->shadowMapsDrawn; }

void Painter::State::prepareTextures(const FramePlan& plan, const OpenTexture& open) {
    textureNames.assign(plan.textures.size(), 0);
    textureNotes.assign(plan.textures.size(), {});
    textureAlphas.assign(plan.textures.size(), image::Alpha::opaque);
    std::vector<const TextureRef*> missing;
    for (std::size_t i = 0; i < plan.textures.size(); ++i) {
        if (const TextureStore::Entry* known = textures.find(plan.textures[i])) {
            textureNames[i] = known->texture.name();
            textureNotes[i] = known->notes;
            textureAlphas[i] = known->alpha;
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
        textureAlphas[i] = entry.alpha;
    };
    // Layers other than the colours need the holes of textures alone.
    const bool isColor = plan.style.layer == Layer::color;
    std::map<const TextureRef*, UndecodedTexture> opened;
    if (!isColor)
        std::erase_if(missing, [&](const TextureRef* ref) {
            return !opened.emplace(ref, open(*ref)).first->second.mayHaveAlpha;
        });
    const OpenTexture openOnce = [&](const TextureRef& ref) {
        return isColor ? open(ref) : opened.at(&ref);
    };
    loadTextures(missing, openOnce, {onReserved, [&] { compileAhead(plan); }, onDecoded}, facts);
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
        if (pass.target.output != PassOutput::none)
            target->resolve(resolver(pass.target.samples), {}, {});
    }
    api.Disable(GL_SCISSOR_TEST);
}

void Painter::State::prepare(FramePlan& plan, const OpenTexture& open) {
    preparePlaces(plan);
    prepareLights(plan);
    if (!plan.shadowMaps.empty()) shadows.bind(plan);
    prepareTextures(plan, open);
    const bool allOpaque =
        std::all_of(textureAlphas.begin(), textureAlphas.end(),
                    [](image::Alpha alpha) { return alpha == image::Alpha::opaque; });
    // Without their textures, models of other layers share draw calls.
    if (allOpaque && (plan.style.layer == Layer::color || plan.textures.empty())) return;
    plan.textureAlphas = textureAlphas;
    composePasses(plan, facts);
    preparePlaces(plan);
}

void Painter::State::prepareLights(const FramePlan& plan) {
    const auto upload = [&](std::vector<Buffer>& buffers, std::size_t set, const auto& values) {
        while (buffers.size() <= set) buffers.emplace_back(api);
        if (values.empty()) return;
        api.BindBuffer(GL_UNIFORM_BUFFER, buffers[set].name());
        api.BufferData(GL_UNIFORM_BUFFER,
                       static_cast<GLsizeiptr>(values.size() * sizeof values.front()),
                       values.data(), GL_STREAM_DRAW);
    };
    for (std::size_t i = 0; i < plan.lightSets.size(); ++i) {
        upload(lightBuffers, i, plan.lightSets[i]);
        if (plan.shadowLights.empty()) continue;
        std::vector<EyeShadowLight> ofSet;
        for (const EyeLight& light : plan.lightSets[i])
            if (light.diffuse.w > 0.0F) ofSet.push_back(shadowLightOf(plan, light));
        upload(shadowBuffers, i, ofSet);
    }
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
Target::Resolver Painter::State::resolver(int samples) {
    if (samples <= 1) return {};
    const ProgramKey key{Shaders::window, {Feature::resolve}, samples};
    return {programs.get(key).program.name(), emptyArray.name()};
}

/// Binds the pass's target; creates it if the last pass had another format. Masks its colours.
void Painter::State::begin(const FramePlan& plan, const Pass& pass) {
    const PassTarget& wanted = pass.target;
    const glm::ivec2 whole = plan.view.size * wanted.scale;
    Target::Format format{whole.x, wanted.rows * wanted.scale, wanted.samples, false};
    for (const glm::ivec4& part : plan.covered)
        format.drawn = glm::max(format.drawn, glm::ivec2(part.x + part.z, part.y + part.w));
    if (!target || !target->suits(format)) {
        peeler.reset();
        target.reset();  // the old one first: two large ones need not fit
        target.emplace(api, format, facts.packInvert);
    }
    target->bind(viewportOf(plan, pass));
    const GLboolean colors = pass.state.depthOnly ? GL_FALSE : GL_TRUE;
    api.ColorMask(colors, colors, colors, colors);
    api.LineWidth(static_cast<float>(wanted.scale));
    api.PointSize(static_cast<float>(wanted.scale));
}

/// The whole image, of which the target shows a band.
glm::ivec4 Painter::State::viewportOf(const FramePlan& plan, const Pass& pass) const {
    const int scale = pass.target.scale;
    const int below = plan.view.size.y - pass.target.firstRow - pass.target.rows;
    return {0, -below * scale, plan.view.size.x * scale, plan.view.size.y * scale};
}

/// The maps that are not as in the frame before.
void Painter::State::drawShadowMaps(const FramePlan& plan) {
    const int before = shadowMapsDrawn;
    for (std::size_t i = 0; i < plan.shadowMaps.size(); ++i) {
        if (shadows.has(plan, i)) continue;
        const FramePlan& frame = *plan.shadowMaps[i].frame;
        preparePlaces(frame);
        shadows.begin(i);
        int calls = 0;  // not those of the image
        const Pass& pass = frame.passes[0];
        // What casts from before a map's depths, casts. A perspective has light at its nearest.
        const bool isParallel = pass.clip[2][3] == 0.0;
        if (isParallel) api.Enable(GL_DEPTH_CLAMP);
        for (const PassItem& item : pass.items) drawModels(frame, pass, item, calls);
        if (isParallel) api.Disable(GL_DEPTH_CLAMP);
        shadows.keep(plan, i);
        ++shadowMapsDrawn;
    }
    if (shadowMapsDrawn > before) preparePlaces(plan);  // over those of the maps
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
            case PassItem::Kind::blended:
                drawBlended(plan, pass, item, drawCalls);
                break;
            case PassItem::Kind::peeled:
                drawPeeled(plan, pass, item, drawCalls);
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
    target->resolve(resolver(drawn.samples), plan.covered,
                    drawn.clearColor.value_or(glm::vec4(0.0F)));
    const auto outputs = std::count_if(plan.passes.begin(), plan.passes.end(), [](const Pass& one) {
        return one.target.output != PassOutput::none;
    });
    if (outputs == 1 && drawn.scale == 1) {
        target->read(0, drawn.rows, image.pixels.data());
        return;
    }
    const bool isLast =
        pass + 1 == plan.passes.size() || plan.passes[pass + 1].target.firstRow != drawn.firstRow;
    if (!mean.begun()) mean.begin(plan.view.size.x, drawn.rows);
    mean.add(*target, drawn.scale);
    if (isLast) mean.finish(drawn.firstRow, image);
}

void Painter::draw(FramePlan& plan, const OpenTexture& open, image::Image& image, Timings& timings,
                   Diagnostics& findings) {
    State& s = *state_;
    s.peeledLayers = 0;
    s.leftLayersOut = false;
    s.context->makeCurrent();
    s.restoreState();
    s.prepare(plan, open);
    s.drawShadowMaps(plan);
    throwOnError(s.api, "preparing");
    for (std::size_t i = 0; i < plan.textures.size(); ++i)
        for (const TextureNote& note : s.textureNotes[i])
            findings.push_back(findingOf(note, plan.textures[i]));
    const auto start = std::chrono::steady_clock::now();
    bool transparent = false;
    image.width = plan.view.size.x;
    image.height = plan.view.size.y;
    image.pixels.resize(static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height) * 4);
    for (std::size_t i = 0; i < plan.passes.size(); ++i) {
        const Pass& pass = plan.passes[i];
        s.drawPass(plan, pass, plan.stats.drawCalls);
        transparent |= pass.target.clearColor && pass.target.clearColor->a < 1.0F;
        if (pass.target.output == PassOutput::none) continue;
        s.api.Finish();  // else the time of drawing would be counted as reading
        const auto drawn = std::chrono::steady_clock::now();
        s.read(plan, i, image);
        timings.readbackMs += sinceMs(drawn);
    }
    throwOnError(s.api, "drawing");
    if (transparent) unpremultiply(image);
    plan.stats.peeledLayers = s.peeledLayers;
    if (s.leftLayersOut)
        findings.push_back(diagnosticOf(
            Severity::warning,
            message<"limit.layers">(
                "count"_arg =
                    std::max(static_cast<int>(deepestSeeThrough(plan)), kMaxPeeledLayers + 1),
                "max"_arg = kMaxPeeledLayers),
            {}));
    timings.drawMs += sinceMs(start) - timings.readbackMs;
}

}  // namespace farol::render::gl
