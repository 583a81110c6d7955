#include "render/plan/plan.h"

#include <algorithm>
#include <cmath>

#include "render/plan/background.h"
#include "render/plan/camera.h"
#include "render/plan/choose_mesh.h"
#include "render/plan/close_surfaces.h"
#include "render/plan/coplanar.h"
#include "render/plan/crowd.h"
#include "render/plan/frustum.h"
#include "render/plan/light_reach.h"
#include "render/plan/lines.h"
#include "render/plan/messages.h"
#include "render/plan/passes.h"
#include "render/plan/quality.h"
#include "render/plan/sampling.h"
#include "render/plan/shading.h"
#include "render/plan/shadow_casters.h"
#include "render/plan/transparency.h"
#include "scene/animation.h"

namespace farol::render {
namespace {

constexpr int kDefaultSide = 512;
// Half the diagonal of a sheared box is at most sqrt(3) times the root of its squared edges.
constexpr double kShear = 1.7320508075688774;

[[noreturn]] void failSize(const glm::ivec2& size, int maxSide) {
    throw Error(message<"limit.pixels/side">("width"_arg = size.x, "height"_arg = size.y,
                                             "most"_arg = maxSide));
}

class Planner {
  public:
    Planner(const scene::Scene& scene, const Placed& placed, const PictureOptions& options,
            const scene::Assets& assets, MeshLibrary& meshes, const GlFacts& gl,
            const Skipping& skipping, const Crowd& crowd)
        : scene_(scene),
          placed_(placed),
          options_(options),
          assets_(assets),
          meshes_(meshes),
          gl_(gl),
          skipping_(skipping),
          crowd_(crowd) {}

    /// Returns nothing where the models are too many: `next` is then the crowd to try.
    std::optional<FramePlan> run(Crowd& next) {
        const glm::ivec2 size = pictureSize(scene_, options_);
        if (std::max(size.x, size.y) > gl_.maxTargetSide) failSize(size, gl_.maxTargetSide);
        style_.mergesCalls = skipping_.calls;
        style_.depthFirst = skipping_.hidden;
        style_.crops = skipping_.background;
        style_.marksNotFinite = !skipping_.notFinite;
        const InstanceList& list = placed_.scene;
        chooseStyle(list);
        plan_.camera =
            chooseCamera(scene_, options_, list.bounds, static_cast<double>(size.x) / size.y);
        plan_.view = viewOf(plan_.camera, size);
        const Sampling sampling = chooseSampling(style_.samples, gl_, std::max(size.x, size.y));
        samples_ = samplePattern(sampling, gl_);
        snapPx_ = gl_.snapPx / sampling.scale;
        plan_.findings.insert(plan_.findings.begin(), list.findings.begin(), list.findings.end());
        if (style_.hasShadows)
            shadows_ =
                planShadows(list, plan_.view, options_.timeS, seesThrough(), gl_, plan_.findings);
        addInstances(scene_, list, plan_.view, {});
        if (style_.hasShadows) addShadows(list);
        if (placed_.entity) addEntity();
        if (isOverBudget()) {
            next.coarsening *= 4.0;
            return std::nullopt;
        }
        const double layers = coveredPx_ / (static_cast<double>(size.x) * size.y);
        if (layers > kMaxLayers && mayThinSamples()) {
            next.isOneSample = true;
            return std::nullopt;
        }
        plan_.stats.coarsening = crowd_.coarsening;
        if (fillsFaces()) plan_.stats.coplanar = coplanar_.rank(plan_.items, style_);
        sortCrowd(plan_.items, layers);
        if (style_.layer == Layer::color) addLines(plan_, scene_, list, options_);
        addBackground();
        plan_.stats.textures = static_cast<int>(plan_.textures.size());
        if (ignoredOpacities_ > 0)
            plan_.findings.push_back(diagnosticOf(
                Severity::info, message<"scene.opacity">("count"_arg = ignoredOpacities_), {}));
        composePasses(plan_, gl_);
        return std::optional<FramePlan>(std::move(plan_));
    }

  private:
    void chooseStyle(const InstanceList& list) {
        style_.samples =
            options_.samples.value_or(scene_.settings.samples.value_or(samplesFor(errorPx_)));
        style_.shading = chooseShading(scene_, options_, list);
        style_.layer = options_.layer;
        // Ids, depths and normals have no meaning between two surfaces.
        if (style_.layer != Layer::color) style_.samples = 1;
        // A mesh with a larger error than the samples' distance would waste them. `error` is an
        // upper bound, so that less is allowed.
        errorPx_ = errorOf(errorPx_, style_.samples);
        if (crowd_.isOneSample) style_.samples = 1;
        errorPx_ *= crowd_.coarsening;
        style_.lit = isLit(style_.shading, list) && style_.layer == Layer::color;
        style_.viewer =
            options_.viewer.value_or(scene_.settings.viewer.value_or(scene::Viewer::infinite));
        style_.specular =
            options_.specular.value_or(scene_.settings.specular.value_or(scene::Specular::single));
        style_.transparency = options_.transparency.value_or(
            scene_.settings.transparency.value_or(scene::Transparency::on));
        style_.hasShadows = hasShadows(scene_, options_, style_, list, plan_.findings);
        plan_.globalAmbient = scene_.globalAmbient;
    }

    /// Of the scene; the entity before the camera casts none.
    void addShadows(const InstanceList& list) {
        addShadowMaps(plan_, shadows_,
                      {list, assets_, meshes_,
                       [&](std::size_t texture) { return textureIndex(list, texture); },
                       crowd_.coarsening, seesThrough()});
    }

    bool seesThrough() const { return style_.transparency != scene::Transparency::off; }

    /// `inherited`: lights of set 0 for a list that has none.
    void addInstances(const scene::Scene& scene, const InstanceList& list,
                      const ViewTransform& view, const std::vector<EyeLight>& inherited) {
        const int firstSet = static_cast<int>(plan_.lightSets.size());
        addLights(list, view, inherited);
        addVisible(scene, list, view, firstSet);
    }

    void addVisible(const scene::Scene& scene, const InstanceList& list, const ViewTransform& view,
                    int firstSet) {
        const BoundsTree::Found found = list.tree.find(Frustum(view, standOutPx(list.anyOpen)));
        plan_.stats.culledGroups += found.groupsSkipped;
        const int firstId = plan_.stats.instances + 1;
        plan_.stats.instances += static_cast<int>(list.instances.size());
        const scene::Material undressed = scene::defaultMaterial(scene.dialect);
        textureOf_.assign(list.textures.size(), -1);
        if (fillsFaces())
            close_ = needExactDepth(list, found.sides, view, errorPx_, meshes_.closePairs());
        const auto outside =
            std::count(found.sides.begin(), found.sides.end(), Frustum::Side::outside);
        plan_.items.reserve(plan_.items.size() + found.sides.size() -
                            static_cast<std::size_t>(outside));
        for (std::size_t i = 0; i < list.instances.size() && !isOverBudget(); ++i) {
            // The culling results are a separate array: culled instances cost no memory access.
            if (found.sides[i] != Frustum::Side::outside || !skipping_.outside)
                add(list, i, view, found.sides[i], firstSet, firstId, undressed);
            else
                ++plan_.stats.culled;
        }
        plan_.stats.texturesSkipped +=
            static_cast<int>(std::count(textureOf_.begin(), textureOf_.end(), -1));
    }

    /// A second scene whose world is eye space, lit by its own lights, else by the scene's.
    void addEntity() {
        ViewTransform view = plan_.view;
        view.rotation = glm::dmat3(1.0);
        view.eye = -kEntityPlace;
        addInstances(*scene_.entity, *placed_.entity, view,
                     std::vector<EyeLight>(plan_.lightSets[0]));
    }

    void addLights(const InstanceList& list, const ViewTransform& view,
                   const std::vector<EyeLight>& inherited) {
        std::vector<EyeLight> lights;
        for (const PlacedLight& one : list.lights)
            lights.push_back(eyeLight(one, view, options_.timeS));
        if (&list == &placed_.scene) shadows_.mark(lights);
        for (const std::vector<int>& set : list.lightSets) {
            std::vector<EyeLight>& chosen = plan_.lightSets.emplace_back();
            if (!style_.lit) continue;
            if (list.lights.empty()) chosen = inherited;
            for (const int index : set) chosen.push_back(lights[static_cast<std::size_t>(index)]);
            if (style_.hasShadows)  // shaders count their kinds from the first on
                std::stable_sort(
                    chosen.begin(), chosen.end(),
                    [](const EyeLight& a, const EyeLight& b) { return a.diffuse.w > b.diffuse.w; });
        }
        plan_.stats.lights += static_cast<int>(list.lights.size());
    }

    /// Other layers than the colours are filled in any shading.
    bool fillsFaces() const { return style_.layer != Layer::color || !drawsLines(style_); }

    bool isOverBudget() const {
        return crowd_.coarsening < kMostCoarsening &&
               openTriangles_ > triangleBudget(plan_.view.size);
    }

    bool mayThinSamples() const {
        return style_.samples > 1 && !options_.samples && !scene_.settings.samples;
    }

    /// Counts a model in view towards the crowd's size.
    void count(const DrawItem& item, const glm::dmat4& viewFromObject, bool isOpen) {
        if (fillsFaces())
            coveredPx_ += coveredArea(pixelRect(item.mesh->bounds, viewFromObject, plan_.view),
                                      plan_.view.size);
        if (!isOpen) return;
        openTriangles_ += static_cast<std::int64_t>(item.mesh->mesh.triangles());
        if (crowd_.coarsening > 1.0) ++plan_.stats.coarsened;
    }

    /// How far a mesh may stand out of its shape, px: only those made on demand do.
    double standOutPx(bool open) const { return open ? errorPx_ : 0.0; }

    /// True if no sample of the image can lie on the content of the box; false for points and
    /// lines, which reach past their geometry.
    bool betweenSamples(const Box& box, const glm::dmat4& viewFromObject) const {
        if (drawsLines(style_)) return false;
        const std::optional<PixelRect> rect = pixelRect(box, viewFromObject, plan_.view);
        return rect && missesSamples(*rect, samples_, snapPx_);
    }

    void add(const InstanceList& list, std::size_t index, const ViewTransform& view,
             Frustum::Side side, int firstSet, int firstId, const scene::Material& undressed) {
        const Instance& instance = list.instances[index];
        const glm::dmat3 linear = view.rotation * glm::dmat3(instance.worldFromObject);
        if (instance.mesh->mesh.indices().empty() || linear == glm::dmat3(0.0)) {
            ++plan_.stats.culled;
            return;
        }
        glm::dmat4 viewFromObject(linear);
        viewFromObject[3] =
            glm::dvec4(view.eyeFromWorld(glm::dvec3(instance.worldFromObject[3])), 1.0);
        // The model's own box fits closer than that along the world's axes.
        const bool isSeen =
            side == Frustum::Side::inside ||
            (side == Frustum::Side::straddles &&
             !isOutside(instance.mesh->bounds, viewFromObject, view, standOutPx(instance.open)));
        if (skipping_.outside && !isSeen) {
            ++plan_.stats.culled;
            return;
        }
        const scene::Model& model = *instance.model;
        DrawItem item;
        item.mesh = instance.mesh;
        if (instance.open)
            choice_.refine(item, instance, list, view, viewFromObject,
                           !close_.empty() && close_[index]);
        // Only now is it known how far the mesh reaches: balanced ones stand out of their surface.
        const bool isMissed = betweenSamples(item.mesh->bounds, viewFromObject);
        if (isMissed && skipping_.betweenSamples) {
            ++plan_.stats.betweenSamples;
            return;
        }
        // Invisible items that are drawn with culling off must not change other items' results.
        const std::shared_ptr<const MeshData> whole = isSeen && !isMissed ? item.mesh : nullptr;
        const glm::dmat4 placed = viewFromObject;
        if (whole) count(item, viewFromObject, instance.open);
        if (whole && item.hasExactDepth) ++plan_.stats.exactDepth;
        if (!choice_.placeNear(item, instance, view, viewFromObject)) {
            ++plan_.stats.culled;
            return;
        }
        item.viewFromObject = glm::mat4(viewFromObject);
        // Cofactors: the inverse transpose without its division, so flattened objects work too.
        glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
        const double det = glm::dot(linear[0], cofactor[0]);
        if (item.surface)
            for (int i = 0; i < 3; ++i) cofactor[i] /= item.surface->lengths[i];
        double largest = 0.0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(cofactor[i][j]));
        if (largest > 0.0)
            item.normalFromObject = glm::mat3(cofactor * ((det < 0.0 ? -1.0 : 1.0) / largest));
        item.mirrored = det < 0.0;
        if (style_.hasShadows)
            item.shadowOffset = shadowOffsetOf(item, instance, errorPx_ * view.pixelAngle);
        item.isBody = !model.twoSided && !model.source.isSheet && !isFlat(instance.mesh->bounds);
        fillMaterial(item, instance, list, undressed);
        item.indices = item.mesh->mesh.indices().size();
        item.lightSet = firstSet + instance.lightSet;
        if (style_.lit && skipping_.lights) {
            const Box& box = item.mesh->bounds;
            const glm::dvec3 center(viewFromObject * glm::dvec4((box.min + box.max) * 0.5, 1.0));
            const glm::dvec3 half = (box.max - box.min) * 0.5;
            const double radius =
                glm::length(glm::dvec3(glm::length(glm::dvec3(viewFromObject[0])) * half.x,
                                       glm::length(glm::dvec3(viewFromObject[1])) * half.y,
                                       glm::length(glm::dvec3(viewFromObject[2])) * half.z));
            item.lightSet =
                reached_.reduce(item.lightSet, center, radius * kShear, plan_.stats.lightsSkipped);
        }
        item.id = static_cast<std::uint32_t>(firstId) + static_cast<std::uint32_t>(index);
        if (instance.looks >= 0) {
            const std::vector<generator::MeshPart>& parts = item.mesh->mesh.parts();
            for (std::size_t i = 0; i < parts.size(); ++i) {
                item.firstIndex = parts[i].first;
                item.indices = parts[i].count;
                fillPart(item, list, static_cast<std::size_t>(instance.looks) + i, undressed,
                         model.opacity);
                push(item, model.twoSided, whole.get(), placed);
            }
            return;
        }
        push(std::move(item), model.twoSided, whole.get(), placed);
    }

    /// `whole`: the mesh of a model in view before it was placed in double, which stands at
    /// `placed` in eye space; else null.
    void push(DrawItem item, bool twoSided, const MeshData* whole, const glm::dmat4& placed) {
        plan_.stats.triangles += static_cast<std::int64_t>(item.indices / 3);
        if (twoSided) {
            DrawItem back = item;
            back.mirrored = !back.mirrored;
            back.inside = true;
            back.normalFromObject = -back.normalFromObject;
            plan_.stats.triangles += static_cast<std::int64_t>(item.indices / 3);
            if (whole != nullptr) coplanar_.add(*whole, placed, back, plan_.items.size());
            plan_.items.push_back(std::move(back));
        }
        if (whole != nullptr) coplanar_.add(*whole, placed, item, plan_.items.size());
        if (whole != nullptr && item.isBody && item.opacity < 1.0F) {
            DrawItem inner = item;
            inner.mirrored = !inner.mirrored;
            coplanar_.add(*whole, placed, inner, plan_.items.size());
        }
        plan_.items.push_back(std::move(item));
    }

    void fillMaterial(DrawItem& item, const Instance& instance, const InstanceList& list,
                      const scene::Material& undressed) {
        const scene::Model& model = *instance.model;
        const scene::Material& material = model.material ? *model.material : undressed;
        const double t = options_.timeS;
        item.diffuse = scene::colorAt(material.diffuse, t);
        item.ambient = scene::colorAt(material.ambient, t);
        item.specular = scene::colorAt(material.specular, t);
        item.emissive = scene::colorAt(material.emissive, t);
        item.shininess = material.shininess;
        setOpacity(item, material.opacity * model.opacity);
        if (drawsLines(style_) && !model.material) item.diffuse = glm::vec3(1.0F);
        if (model.texture) return fillTexture(item, *model.texture, list, instance.texture);
        if (model.material || item.mesh->mesh.colors().empty() || drawsLines(style_)) return;
        // The mesh's own colours are the material, as bright in ambient light as others are.
        item.colored = true;
        item.ambient = ambientOfWhite(undressed);
        item.diffuse = glm::vec3(1.0F);
    }

    /// The ambient colour of a white material in the dialect's proportion.
    static glm::vec3 ambientOfWhite(const scene::Material& undressed) {
        return undressed.ambient.rgb / undressed.diffuse.rgb;
    }

    void setOpacity(DrawItem& item, float opacity) {
        const bool isDrawn = style_.transparency != scene::Transparency::off && fillsFaces();
        item.opacity = isDrawn ? opacity : 1.0F;
        if (style_.transparency == scene::Transparency::off && opacity < 1.0F) ++ignoredOpacities_;
    }

    /// The material of one part of a mesh; undressed where its file has none. `opacity`: of the
    /// model.
    void fillPart(DrawItem& item, const InstanceList& list, std::size_t look,
                  const scene::Material& undressed, float opacity) {
        const PartLook& part = list.looks[look];
        const scene::Material& material =
            part.material != nullptr ? part.material->material : undressed;
        item.diffuse = material.diffuse.rgb;
        item.ambient = material.diffuse.rgb * ambientOfWhite(undressed);
        item.specular = material.specular.rgb;
        item.emissive = material.emissive.rgb;
        item.shininess = material.shininess;
        setOpacity(item, material.opacity * opacity);
        item.texture = -1;
        item.uvFrom = glm::vec4(1.0F, 1.0F, 0.0F, 0.0F);
        if (drawsLines(style_)) item.diffuse = glm::vec3(1.0F);
        if (part.texture >= 0) fillTexture(item, *part.material->texture, list, part.texture);
    }

    /// `texture`: index into InstanceList::textures.
    void fillTexture(DrawItem& item, const scene::Texture& from, const InstanceList& list,
                     int texture) {
        if (!fillsFaces()) return;
        // Layers show the holes of a texture alone.
        if (style_.layer != Layer::color && style_.transparency == scene::Transparency::off) return;
        // Unlit, a texture is its own picture: nothing modulates it.
        if (!style_.lit) item.diffuse = glm::vec3(1.0F);
        const generator::Mesh& mesh = item.mesh->mesh;
        item.mapping = from.mapping;
        const bool object = item.mapping == scene::Mapping::texgenObject;
        const glm::dvec3 origin = object ? mesh.origin() : glm::dvec3(0.0);
        item.planeS = texgenPlane(from.planeS, origin, from.clamp);
        item.planeT = texgenPlane(from.planeT, origin, from.clamp);
        item.uvFrom = uvPlacement(from, mesh.uvOrigin());
        if (item.mapping == scene::Mapping::mesh && mesh.uvs().empty()) return;
        item.texture = textureIndex(list, static_cast<std::size_t>(texture));
    }

    int textureIndex(const InstanceList& list, std::size_t texture) {
        int& known = textureOf_[texture];
        if (known < 0) {
            TextureRef ref = list.textures[texture];
            ref.filter = options_.filter.value_or(ref.filter);
            ref.alpha = ref.chess                                         ? AlphaUse::none
                        : style_.transparency == scene::Transparency::off ? AlphaUse::ignored
                                                                          : AlphaUse::kept;
            known = addTexture(std::move(ref));
        }
        return known;
    }

    int addTexture(TextureRef ref) {
        const auto found =
            std::find_if(plan_.textures.begin(), plan_.textures.end(), [&](const TextureRef& one) {
                return one.key == ref.key && one.filter == ref.filter && one.cube == ref.cube &&
                       one.clamp == ref.clamp && one.alpha == ref.alpha;
            });
        if (found != plan_.textures.end()) return static_cast<int>(found - plan_.textures.begin());
        plan_.textures.push_back(std::move(ref));
        return static_cast<int>(plan_.textures.size()) - 1;
    }

    void addBackground() {
        const Background chosen = chooseBackground(scene_, options_, assets_);
        style_.background = chosen.color;
        if (style_.layer != Layer::color) {
            style_.background = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
            return;
        }
        if (!chosen.path.empty()) {
            TextureRef ref = refOf(chosen.path, assets_);
            ref.filter = scene::Filter::linear;
            if (!options_.background) ref.where = scene_.background.where;
            style_.backgroundTexture = addTexture(std::move(ref));
        }
        if (scene_.skybox) {
            TextureRef ref = refOf(scene_.skybox->path, assets_);
            ref.cube = true;
            ref.filter = scene::Filter::linear;
            ref.where = scene_.skybox->where;
            style_.skyboxTexture = addTexture(std::move(ref));
        }
    }

    const scene::Scene& scene_;
    const Placed& placed_;
    const PictureOptions& options_;
    const scene::Assets& assets_;
    MeshLibrary& meshes_;
    const GlFacts& gl_;
    const Skipping& skipping_;
    const Crowd& crowd_;
    FramePlan plan_;
    FrameStyle& style_ = plan_.style;
    double errorPx_ = options_.errorPx.value_or(kDefaultErrorPx);
    SamplePattern samples_;
    double snapPx_ = 0.0;  ///< of the image
    PlannedShadows shadows_;
    ReachedLights reached_{plan_.lightSets};
    int ignoredOpacities_ = 0;        ///< of models drawn opaque
    std::int64_t openTriangles_ = 0;  ///< of open shapes in view
    double coveredPx_ = 0.0;          ///< by the models' boxes
    CoplanarFaces coplanar_;
    std::vector<bool> close_;  ///< of the list's instances, or empty
    MeshChoice choice_{style_, errorPx_, assets_, meshes_, plan_.findings};
    std::vector<int> textureOf_;  ///< of an InstanceList, in plan_.textures
};

}  // namespace

glm::ivec2 pictureSize(const scene::Scene& scene, const PictureOptions& options) {
    const scene::Window window = scene.window.value_or(scene::Window{kDefaultSide, kDefaultSide});
    const auto scaled = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(side * options.scale)));
    };
    const glm::ivec2 size(scaled(options.width.value_or(window.width)),
                          scaled(options.height.value_or(window.height)));
    if (size.x > kMaxSide || size.y > kMaxSide || std::int64_t{size.x} * size.y > kMaxPixels)
        failSize(size, kMaxSide);
    return size;
}

FramePlan plan(const scene::Scene& scene, const Placed& placed, const PictureOptions& options,
               const scene::Assets& assets, MeshLibrary& meshes, const GlFacts& gl,
               const Skipping& skipping) {
    for (Crowd crowd;;) {
        const Crowd tried = crowd;
        std::optional<FramePlan> made =
            Planner(scene, placed, options, assets, meshes, gl, skipping, tried).run(crowd);
        if (made) return std::move(*made);
    }
}

}  // namespace farol::render
