#include "render/plan/passes.h"

#include <algorithm>

#include "render/plan/batches.h"
#include "render/plan/coverage.h"
#include "render/plan/depth_pass.h"
#include "render/plan/frustum.h"
#include "render/plan/sampling.h"
#include "render/plan/transparency.h"

namespace farol::render {
namespace {

constexpr FeatureSet kShapeFeatures{Feature::eyePositions,  Feature::surface,
                                    Feature::surfaceCaps,   Feature::surfaceProfile,
                                    Feature::surfaceRay,    Feature::surfaceTwoSteps,
                                    Feature::surfaceWrapsV, Feature::surfaceTurnFromX,
                                    Feature::surfaceDiscUv, Feature::exactDepth};

FeatureSet surfaceFeatures(const DrawItem& item) {
    const generator::Surface& surface = *item.surface;
    const generator::SurfaceKind& kind = *surface.kind;
    FeatureSet features{Feature::surface};
    if (kind.hasCaps) features.add(Feature::surfaceCaps);
    if (kind.hasProfile) features.add(Feature::surfaceProfile);
    if (kind.wrapsV) features.add(Feature::surfaceWrapsV);
    if (kind.raySteps > 0 && !item.isOnSurface) features.add(Feature::surfaceRay);
    if (kind.raySteps > 1) features.add(Feature::surfaceTwoSteps);
    if (surface.turnFromX) features.add(Feature::surfaceTurnFromX);
    if (surface.discUv) features.add(Feature::surfaceDiscUv);
    if (item.hasExactDepth) features.add(Feature::exactDepth);
    return features;
}

FeatureSet textureFeatures(scene::Filter filter, scene::Mapping mapping) {
    FeatureSet features{Feature::textured};
    if (filter == scene::Filter::mipmap) features.add(Feature::filterMipmap);
    if (filter == scene::Filter::anisotropic) features.add(Feature::filterAnisotropic);
    if (mapping == scene::Mapping::sphere) features.add(Feature::mappingSphere);
    if (mapping == scene::Mapping::texgenObject) features.add(Feature::texgenObject);
    if (mapping == scene::Mapping::texgenEye) features.add(Feature::texgenEye);
    return features;
}

constexpr FeatureSet kTextureFeatures{Feature::textured,          Feature::filterMipmap,
                                      Feature::filterAnisotropic, Feature::mappingSphere,
                                      Feature::texgenObject,      Feature::texgenEye,
                                      Feature::alphaTest};

/// Returns the lighting features that the shader of this light set and material needs.
FeatureSet lightFeatures(const DrawItem& item, const std::vector<EyeLight>& lights,
                         const FrameStyle& style) {
    FeatureSet features;
    const auto any = [&](auto test) { return std::any_of(lights.begin(), lights.end(), test); };
    if (any([](const EyeLight& light) { return light.position.w != 0.0F; }))
        features.add(Feature::positional);
    if (any([](const EyeLight& light) { return light.spot.w > -2.0F; }))
        features.add(Feature::spot);
    const bool shines = item.specular != glm::vec3(0.0F) && any([](const EyeLight& light) {
                            return glm::vec3(light.specular) != glm::vec3(0.0F);
                        });
    if (!shines) return features;
    features.add(Feature::specular);
    if (style.viewer == scene::Viewer::local) features.add(Feature::localViewer);
    if (style.specular == scene::Specular::separate && (item.texture >= 0 || item.colored))
        features.add(Feature::separateSpecular);
    return features;
}

FeatureSet itemFeatures(const FramePlan& plan, const DrawItem& item) {
    FeatureSet features;
    const bool isColor = plan.style.layer == Layer::color;
    const bool hasTexture = item.texture >= 0 && (isColor || item.alpha != image::Alpha::opaque);
    if (item.alpha == image::Alpha::cutOut) features.add(Feature::alphaTest);
    if (item.alpha == image::Alpha::blended) {
        features.add(Feature::blended);
        if (plan.style.transparency == scene::Transparency::exact) features.add(Feature::peeled);
    }
    if (hasTexture)
        features =
            features | textureFeatures(plan.textures[static_cast<std::size_t>(item.texture)].filter,
                                       item.mapping);
    if (item.colored) features.add(Feature::vertexColor);
    if (!item.mesh->eyePositions.empty()) features.add(Feature::eyePositions);
    if (plan.style.lit)
        features =
            features | lightFeatures(item, plan.lightSets[static_cast<std::size_t>(item.lightSet)],
                                     plan.style);
    // Models without light and texture need their outline only, as do their ids.
    const bool plain =
        !hasTexture && (plan.style.layer == Layer::id || (isColor && !plan.style.lit));
    if (item.surface && (!plain || item.hasExactDepth)) features = features | surfaceFeatures(item);
    return features;
}

FeatureSet shadingFeatures(const FrameStyle& style) {
    FeatureSet features{Feature::lightCount};
    if (style.shading == scene::Shading::chess) features.add(Feature::chess);
    if (style.marksNotFinite) features.add(Feature::markNotFinite);
    if (style.hasShadows) features.add(Feature::shadowed);
    if (!style.lit)
        features.add(Feature::unlit);
    else if (style.shading == scene::Shading::flat)
        features.add(Feature::flat);
    else if (style.shading == scene::Shading::gouraud)
        features.add(Feature::gouraud);
    else if (style.shading == scene::Shading::phong)
        features.add(Feature::phong);
    return features;
}

void chooseFeatures(const FrameStyle& style, Pass& pass) {
    switch (style.layer) {
        case Layer::color:
            pass.features = shadingFeatures(style);
            break;
        case Layer::id:
            pass.features = {Feature::lightCount, Feature::layerId};
            pass.itemFeatures = kShapeFeatures | kTextureFeatures;
            break;
        case Layer::normal:
            pass.features = {Feature::lightCount, Feature::layerNormal};
            pass.itemFeatures = kShapeFeatures | kTextureFeatures;
            break;
        case Layer::depth:
            pass.features = {Feature::lightCount, Feature::layerDepth};
            pass.itemFeatures = kShapeFeatures | kTextureFeatures;
            break;
    }
}

/// True where flat attributes of all triangles cost less than uniforms that fragments read.
/// Measured on the example scenes: from 1.5 fragments a triangle on they cost less, at 0.6 more.
bool carriesUniforms(const FramePlan& plan, int shadings, const GlFacts& gl) {
    constexpr int kComponents = 128;  // what they and the others take at most
    constexpr double kMinFragments = 1.2, kMostLayers = 8.0;
    if (!gl.readsUniformsByPixel || gl.vertexComponents < kComponents) return false;
    double triangles = 0.0;
    for (const DrawItem& item : plan.items) triangles += static_cast<double>(item.indices / 3);
    const double most = kMostLayers * shadings * plan.view.size.x * plan.view.size.y;
    if (most < kMinFragments * triangles) return false;
    double fragments = 0.0;
    for (const DrawItem& item : plan.items) {
        const auto rect = pixelRect(item.mesh->bounds, glm::dmat4(item.viewFromObject), plan.view);
        fragments += shadings * item.mesh->filled * coveredArea(rect, plan.view.size);
        if (fragments >= kMinFragments * triangles) return true;
    }
    return false;
}

/// Three bytes of red, green and blue.
glm::vec3 colorOf(std::uint32_t id) {
    const glm::vec3 color(static_cast<float>((id >> 16) & 255U),
                          static_cast<float>((id >> 8) & 255U), static_cast<float>(id & 255U));
    return color / 255.0F;
}

/// Lines, models, a backdrop behind them, and what is seen through; a skybox hides the background's
/// picture.
void addItems(const FramePlan& plan, Pass& pass) {
    if (!plan.lines.empty())
        pass.items.push_back({PassItem::Kind::lines, 0, plan.lines.size(), -1});
    const std::size_t opaque = plan.batches.firstBlended;
    const std::size_t blended = plan.batches.batches.size() - opaque;
    pass.items.push_back({PassItem::Kind::models, 0, opaque, -1});
    if (plan.style.skyboxTexture >= 0)
        pass.items.push_back({PassItem::Kind::skybox, 0, 0, plan.style.skyboxTexture});
    else if (plan.style.backgroundTexture >= 0)
        pass.items.push_back({PassItem::Kind::picture, 0, 0, plan.style.backgroundTexture});
    if (blended == 0) return;
    const bool isExact = plan.style.transparency == scene::Transparency::exact;
    pass.items.push_back(
        {isExact ? PassItem::Kind::peeled : PassItem::Kind::blended, opaque, blended, -1});
}

/// So many that a target of larger scale stays within kMaxTargetPixels, in bands of one height: a
/// target of another size costs its pages anew.
int rowsOfTarget(const glm::ivec2& size, const Sampling& sampling, bool isPeeled) {
    constexpr std::int64_t kMaxTargetPixels = 32 << 20;  // 256 MiB of colour and depth
    constexpr int kOfPeeled = 6;  // with the colours and depths of its layers
    if (sampling.scale == 1 && !isPeeled) return size.y;
    const std::int64_t row = std::int64_t{size.x} * sampling.scale * sampling.scale *
                             (isPeeled ? kOfPeeled * sampling.samples : 1);
    const auto most = static_cast<int>(std::clamp<std::int64_t>(kMaxTargetPixels / row, 1, size.y));
    const int bands = (size.y + most - 1) / most;
    return (size.y + bands - 1) / bands;
}

/// Returns a pass that draws the depths of `occluders` alone: `pass` then shades fewer pixels.
Pass depthPassOf(const Pass& pass, const std::vector<PassItem>& occluders) {
    Pass depths = pass;
    depths.target.clearColor.reset();
    depths.target.output = PassOutput::none;
    depths.state.depthOnly = true;
    depths.features = {Feature::unlit};
    depths.itemFeatures = {Feature::eyePositions};
    depths.items = occluders;
    return depths;
}

/// The frame that a light sees: what is not seen through, cut out by its texture.
void composeShadowMap(const FramePlan& plan, ShadowMap& map) {
    auto frame = std::make_shared<FramePlan>();
    for (const DrawItem& caster : map.casters) {
        DrawItem item = caster;
        if (item.texture >= 0 && !plan.textureAlphas.empty())
            item.alpha = plan.textureAlphas[static_cast<std::size_t>(item.texture)];
        if (item.alpha == image::Alpha::blended) continue;
        if (item.alpha == image::Alpha::opaque) item.texture = -1;
        frame->items.push_back(std::move(item));
    }
    frame->batches = batchesOf(frame->items, plan.view, plan.style.mergesCalls, 0);
    for (Batch& batch : frame->batches.batches) {
        const DrawItem& first = frame->items[frame->batches.order[batch.first]];
        if (first.texture < 0) continue;
        batch.features = textureFeatures(
            plan.textures[static_cast<std::size_t>(first.texture)].filter, first.mapping);
        batch.features.add(Feature::alphaTest);
    }
    Pass& pass = frame->passes.emplace_back();
    pass.target.output = PassOutput::none;
    pass.clip = map.clip;
    pass.features = {Feature::lightCount, Feature::unlit};
    pass.items.push_back({PassItem::Kind::models, 0, frame->batches.batches.size(), -1});
    map.frame = std::move(frame);
}

}  // namespace

void composePasses(FramePlan& plan, const GlFacts& gl) {
    for (ShadowMap& map : plan.shadowMaps) composeShadowMap(plan, map);
    const FrameStyle& style = plan.style;
    const bool ids = style.layer == Layer::id;
    // Each model has another id colour: no two are alike.
    const std::size_t blendedFrom = arrangeSeeThrough(plan);
    plan.batches = batchesOf(plan.items, plan.view, style.mergesCalls && !ids, blendedFrom);
    for (Batch& batch : plan.batches.batches) {
        const DrawItem& first = plan.items[plan.batches.order[batch.first]];
        batch.features = itemFeatures(plan, first);
        batch.plainColor = ids ? colorOf(first.id) : first.diffuse;
    }

    const glm::ivec2& size = plan.view.size;
    const Sampling sampling = chooseSampling(style.samples, gl, std::max(size.x, size.y));
    Pass pass;
    pass.target.scale = sampling.scale;
    pass.target.samples = sampling.samples;
    if (style.skyboxTexture < 0 && style.backgroundTexture < 0)
        pass.target.clearColor = style.background;
    if (style.layer == Layer::color) {
        if (style.shading == scene::Shading::wireframe) pass.state.polygons = Polygons::outlined;
        if (style.shading == scene::Shading::points) pass.state.polygons = Polygons::cornered;
    }
    chooseFeatures(style, pass);
    if (sampling.scale > 1) pass.features.add(Feature::supersampled);
    if (sampling.samples > 1) pass.features.add(Feature::eachSample);
    if (pass.features.has(Feature::phong) &&
        carriesUniforms(plan, sampling.scale * sampling.scale * sampling.passes, gl))
        pass.features.add(Feature::carried);
    addItems(plan, pass);
    DepthPass depths;
    // The GL's samples share their shading already; flat meshes have separate buffers.
    if (style.depthFirst && sampling.samples == 1 && pass.state.polygons == Polygons::filled &&
        !pass.features.has(Feature::flat)) {
        const int shadings = sampling.scale * sampling.scale * sampling.passes;
        depths = planDepthPass(plan, shadings, sampling.passes);
        plan.stats.occluders = depths.models;
        plan.stats.overdraw = depths.overdraw;
    }
    pass.target.rows =
        rowsOfTarget(size, sampling, pass.items.back().kind == PassItem::Kind::peeled);
    plan.passes.clear();
    for (int row = 0; row < size.y; row += pass.target.rows) {
        // The last band may draw rows of the one before again.
        pass.target.firstRow = std::min(row, size.y - pass.target.rows);
        for (int i = 0; i < sampling.passes; ++i) {
            pass.clip = movedClip(plan.view, passOffset(i, sampling));
            pass.target.clearDepth = true;
            if (!depths.occluders.empty()) {
                plan.passes.push_back(depthPassOf(pass, depths.occluders));
                pass.target.clearDepth = false;
            }
            plan.passes.push_back(pass);
        }
    }
    plan.covered.clear();
    if (style.crops && sampling.samples > 1) plan.covered = coveredRects(plan);
}

}  // namespace farol::render
