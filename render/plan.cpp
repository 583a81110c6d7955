#include "render/plan.h"

#include <algorithm>
#include <cmath>

#include "render/background.h"
#include "render/camera.h"
#include "render/frustum.h"
#include "render/light_reach.h"
#include "render/sampling.h"
#include "render/tessellate.h"
#include "scene/animation.h"

namespace farol::render {
namespace {

constexpr int kDefaultSide = 512;
/// Where nobody says: 4. Outlines that may be a pixel off gain nothing by more than one sample, and
/// those held to a twelfth of one are worth more.
int defaultSamples(double errorPx) {
    return errorPx >= 1.0 ? 1 : errorPx > 0.08 ? 4 : errorPx > 0.03 ? 8 : 16;
}

/// Triangles of a frame from which on meshes are drawn as coarse as they come: copies that all fill
/// the view would each be fine enough for it, and a frame take minutes. Some seconds' worth.
constexpr std::int64_t kMostRefined = 16'000'000;
constexpr double kAxisLength = 100.0;  // as the course draws them
// Where the third-person camera holds its entity: in front of the eye, in eye space.
constexpr glm::dvec3 kEntityPlace{0.0, 0.0, -3.0};
// Half the diagonal of a sheared box is at most sqrt(3) times the root of its squared edges.
constexpr double kShear = 1.7320508075688774;

/// Eye space as seen from a space: p_eye = rotation * (p - eye).
struct View {
    glm::dmat3 rotation{1.0};
    glm::dvec3 eye{0.0};
    glm::dvec3 operator()(const glm::dvec3& point) const { return rotation * (point - eye); }
};

bool anyModel(const std::vector<scene::Group>& groups, bool (*test)(const scene::Model&)) {
    return std::any_of(groups.begin(), groups.end(), [&](const scene::Group& group) {
        return std::any_of(group.models.begin(), group.models.end(), test) ||
               anyModel(group.groups, test);
    });
}

/// The automatic choice: without lights, colours and textures the wireframe of the first phases;
/// without lights unlit; else lit per pixel.
scene::Shading automaticShading(const scene::Scene& scene, bool lights) {
    if (lights) return scene::Shading::phong;
    const bool dressed = anyModel(scene.groups, [](const scene::Model& model) {
        return model.material.has_value() || model.texture.has_value();
    });
    return dressed ? scene::Shading::solid : scene::Shading::wireframe;
}

class Planner {
  public:
    Planner(const scene::Scene& scene, const Placed& placed, const PictureOptions& options,
            const scene::Assets& assets, MeshLibrary& meshes, const Skipping& skipping)
        : scene_(scene),
          placed_(placed),
          options_(options),
          assets_(assets),
          meshes_(meshes),
          skipping_(skipping) {}

    FramePlan run() {
        const glm::ivec2 size = pictureSize(scene_, options_);
        plan_.width = size.x;
        plan_.height = size.y;
        plan_.instancing = skipping_.calls;
        aspect_ = static_cast<double>(size.x) / size.y;
        const InstanceList& list = placed_.scene;
        chooseStyle(!list.lights.empty());
        plan_.camera = chooseCamera(scene_, options_, list.bounds, aspect_);
        view_ = {viewRotation(plan_.camera), plan_.camera.eye};
        plan_.worldFromView = glm::mat3(glm::transpose(view_.rotation));
        sight_ = {plan_.camera, plan_.width, plan_.height, errorPx_, plan_.shading};
        clip_ = clipFromView(plan_.camera, aspect_, glm::dvec2(0.0));
        samples_ = samplePattern(plan_.samples);
        addInstances(scene_, list, view_, {});
        plan_.findings = list.findings;
        if (placed_.entity) addEntity();
        addLines(list);
        addBackground();
        plan_.stats.textures = static_cast<int>(plan_.textures.size());
        return std::move(plan_);
    }

  private:
    void chooseStyle(bool lights) {
        plan_.samples =
            options_.samples.value_or(scene_.settings.samples.value_or(defaultSamples(errorPx_)));
        plan_.shading = options_.shading          ? *options_.shading
                        : scene_.settings.shading ? *scene_.settings.shading
                                                  : automaticShading(scene_, lights);
        plan_.layer = options_.layer;
        // Ids, depths and normals have no meaning between two surfaces.
        if (plan_.layer != Layer::color) plan_.samples = 1;
        // More samples than four are asked for to see outlines better: a mesh that errs by more
        // than they tell apart would waste them. `error` bounds from above, so less is allowed.
        if (plan_.samples > 4) errorPx_ = std::min(errorPx_, 1.0 / plan_.samples);
        const bool surface = plan_.shading == scene::Shading::flat ||
                             plan_.shading == scene::Shading::gouraud ||
                             plan_.shading == scene::Shading::phong;
        plan_.lit = surface && lights && plan_.layer == Layer::color;
        plan_.viewer =
            options_.viewer.value_or(scene_.settings.viewer.value_or(scene::Viewer::infinite));
        plan_.specular =
            options_.specular.value_or(scene_.settings.specular.value_or(scene::Specular::single));
        plan_.globalAmbient = scene_.globalAmbient;
    }

    /// `inherited`: lights of the set 0 that a list without lights of its own is lit by.
    void addInstances(const scene::Scene& scene, const InstanceList& list, const View& view,
                      const std::vector<EyeLight>& inherited) {
        const int firstSet = static_cast<int>(plan_.lightSets.size());
        addLights(list, view, inherited);
        addVisible(scene, list, view, firstSet);
    }

    void addVisible(const scene::Scene& scene, const InstanceList& list, const View& view,
                    int firstSet) {
        const BoundsTree::Found found =
            list.tree.find(Frustum(view.rotation, view.eye, plan_.camera,
                                   {plan_.width, plan_.height}, standOutPx(list.anyOpen)));
        plan_.stats.culledGroups += found.groupsSkipped;
        const int firstId = plan_.stats.instances + 1;
        plan_.stats.instances += static_cast<int>(list.instances.size());
        const scene::Material undressed = scene::defaultMaterial(scene.dialect);
        textureOf_.assign(list.textures.size(), -1);
        const auto outside =
            std::count(found.sides.begin(), found.sides.end(), Frustum::Side::outside);
        plan_.items.reserve(plan_.items.size() + found.sides.size() -
                            static_cast<std::size_t>(outside));
        for (std::size_t i = 0; i < list.instances.size(); ++i) {
            // Whether they are seen stands apart: what is not seen is not touched.
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
        addInstances(*scene_.entity, *placed_.entity, {glm::dmat3(1.0), -kEntityPlace},
                     std::vector<EyeLight>(plan_.lightSets[0]));
    }

    EyeLight toEye(const PlacedLight& placed, const View& view) const {
        const scene::Light& light = *placed.light;
        const bool fixed = light.space == scene::LightSpace::camera;
        const glm::dvec3 direction = fixed ? placed.direction : view.rotation * placed.direction;
        const double size = glm::length(direction);
        const glm::vec3 unit = size > 0.0 ? glm::vec3(direction / size) : glm::vec3(0.0F);
        EyeLight eye{};
        if (light.type == scene::LightType::directional)
            eye.position = glm::vec4(unit, 0.0F);
        else
            eye.position =
                glm::vec4(glm::vec3(fixed ? placed.position : view(placed.position)), 1.0F);
        const bool cone = light.type == scene::LightType::spot && light.cutoffDeg < 180.0;
        eye.spot = glm::vec4(
            unit, cone ? static_cast<float>(std::cos(glm::radians(light.cutoffDeg))) : -2.0F);
        eye.attenuation = glm::vec4(light.constant, light.linear, light.quadratic, light.exponent);
        eye.diffuse = glm::vec4(scene::colorAt(light.diffuse, options_.timeS), 1.0F);
        eye.ambient = glm::vec4(scene::colorAt(light.ambient, options_.timeS), 1.0F);
        eye.specular = glm::vec4(scene::colorAt(light.specular, options_.timeS), 1.0F);
        return eye;
    }

    void addLights(const InstanceList& list, const View& view,
                   const std::vector<EyeLight>& inherited) {
        std::vector<EyeLight> lights;
        for (const PlacedLight& one : list.lights) lights.push_back(toEye(one, view));
        for (const std::vector<int>& set : list.lightSets) {
            std::vector<EyeLight>& chosen = plan_.lightSets.emplace_back();
            if (!plan_.lit) continue;
            if (list.lights.empty()) chosen = inherited;
            for (const int index : set) chosen.push_back(lights[static_cast<std::size_t>(index)]);
        }
        plan_.stats.lights += static_cast<int>(list.lights.size());
    }

    /// How far a mesh may stand out of its shape, px: only those made on demand do.
    double standOutPx(bool open) const { return open ? errorPx_ : 0.0; }

    /// True if the whole box is beyond one side of the view, with a margin for rounding and for
    /// points and lines, which reach past their geometry.
    bool outside(const Box& box, const glm::dmat4& viewFromObject, bool open) const {
        const double marginPx = cullingMarginPx(standOutPx(open));
        const double share =
            cullingSlack(plan_.camera, {plan_.width, plan_.height}, standOutPx(open));
        const glm::dmat4 clipFromObject = clip_ * viewFromObject;
        const double marginX = 1.0 + 2.0 * marginPx / plan_.width;
        const double marginY = 1.0 + 2.0 * marginPx / plan_.height;
        unsigned all = 0x3FU;
        for (int corner = 0; corner < 8 && all; ++corner) {
            const glm::dvec4 p =
                clipFromObject * glm::dvec4(corner & 1 ? box.max.x : box.min.x,
                                            corner & 2 ? box.max.y : box.min.y,
                                            corner & 4 ? box.max.z : box.min.z, 1.0);
            const double slack = share * (std::abs(p.x) + std::abs(p.y) + std::abs(p.w));
            const double w = p.w;
            unsigned out = 0;
            if (p.x < -marginX * w - slack) out |= 1U;
            if (p.x > marginX * w + slack) out |= 2U;
            if (p.y < -marginY * w - slack) out |= 4U;
            if (p.y > marginY * w + slack) out |= 8U;
            if (p.z < -slack) out |= 16U;     // beyond far
            if (p.z > w + slack) out |= 32U;  // before near
            all &= out;
        }
        return all != 0;
    }

    /// True if no sample of the picture can lie on what the box holds. (Points and lines reach
    /// past their geometry.)
    bool betweenSamples(const Box& box, const glm::dmat4& viewFromObject) const {
        if (!skipping_.betweenSamples || plan_.shading == scene::Shading::wireframe ||
            plan_.shading == scene::Shading::points)
            return false;
        const std::optional<PixelRect> rect =
            pixelRect(box, clip_ * viewFromObject, {plan_.width, plan_.height});
        return rect && missesSamples(*rect, samples_);
    }

    void add(const InstanceList& list, std::size_t index, const View& view, Frustum::Side side,
             int firstSet, int firstId, const scene::Material& undressed) {
        const Instance& instance = list.instances[index];
        const glm::dmat3 linear = view.rotation * glm::dmat3(instance.worldFromObject);
        if (instance.mesh->mesh.indices.empty() || linear == glm::dmat3(0.0)) {
            ++plan_.stats.culled;
            return;
        }
        glm::dmat4 viewFromObject(linear);
        viewFromObject[3] = glm::dvec4(view(glm::dvec3(instance.worldFromObject[3])), 1.0);
        // The model's own box fits closer than that along the world's axes.
        if (skipping_.outside && side == Frustum::Side::straddles &&
            outside(instance.mesh->bounds, viewFromObject, instance.open)) {
            ++plan_.stats.culled;
            return;
        }
        const scene::Model& model = *instance.model;
        DrawItem item;
        item.mesh = instance.mesh;
        if (instance.open && plan_.stats.triangles < kMostRefined) {
            const std::optional<SeenSurface> seen =
                instance.surface >= 0 && wantsSurface()
                    ? seenSurface(list.surfaces[static_cast<std::size_t>(instance.surface)],
                                  viewFromObject)
                    : std::nullopt;
            item.mesh = meshes_.get(*instance.mesh, model, assets_,
                                    fineness(instance.mesh->bounds, viewFromObject, seen,
                                             model.texture.has_value(), sight_));
            if (seen) {
                const glm::dvec3& balance = item.mesh->balance;
                for (int i = 0; i < 3; ++i) viewFromObject[i] *= balance[i];
                if (needsSurface(*seen, item.mesh->fullTurn, model.texture.has_value()))
                    item.surface = seen->surface;
                item.unitFromObject = glm::vec3(balance / seen->surface.lengths);
                item.surfaceEye = glm::vec3(seen->eye);
            }
        }
        // Only now is it known how far the mesh reaches: balanced ones stand out of their surface.
        if (betweenSamples(item.mesh->bounds, viewFromObject)) {
            ++plan_.stats.betweenSamples;
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
        fillMaterial(item, instance, list, undressed);
        item.lightSet = firstSet + instance.lightSet;
        if (plan_.lit && skipping_.lights) {
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
        plan_.stats.triangles += static_cast<std::int64_t>(item.mesh->mesh.triangles());
        if (model.twoSided) {
            DrawItem back = item;
            back.mirrored = !back.mirrored;
            back.inside = true;
            back.normalFromObject = -back.normalFromObject;
            plan_.stats.triangles += static_cast<std::int64_t>(item.mesh->mesh.triangles());
            plan_.items.push_back(std::move(back));
        }
        plan_.items.push_back(std::move(item));
    }

    /// True where faces are filled and a pixel can show the surface itself, not its facets or their
    /// corners' light.
    bool wantsSurface() const {
        if (plan_.layer != Layer::color) return true;
        if (plan_.lit) return plan_.shading == scene::Shading::phong;
        return plan_.shading != scene::Shading::wireframe &&
               plan_.shading != scene::Shading::points && plan_.shading != scene::Shading::chess;
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
        const bool lines =
            plan_.shading == scene::Shading::wireframe || plan_.shading == scene::Shading::points;
        if (lines && !model.material) item.diffuse = glm::vec3(1.0F);
        if (!model.texture || lines || plan_.layer != Layer::color) return;
        // Unlit, a texture is its own picture: nothing modulates it.
        if (!plan_.lit) item.diffuse = glm::vec3(1.0F);
        item.mapping = model.texture->mapping;
        item.planeS = glm::vec4(model.texture->planeS);
        item.planeT = glm::vec4(model.texture->planeT);
        if (item.mapping == scene::Mapping::mesh && item.mesh->mesh.uvs.empty()) return;
        item.texture = textureIndex(list, static_cast<std::size_t>(instance.texture));
    }

    int textureIndex(const InstanceList& list, std::size_t texture) {
        int& known = textureOf_[texture];
        if (known < 0) {
            TextureRef ref = list.textures[texture];
            ref.filter = options_.filter.value_or(ref.filter);
            known = addTexture(std::move(ref));
        }
        return known;
    }

    int addTexture(TextureRef ref) {
        const auto found =
            std::find_if(plan_.textures.begin(), plan_.textures.end(), [&](const TextureRef& one) {
                return one.key == ref.key && one.filter == ref.filter && one.cube == ref.cube;
            });
        if (found != plan_.textures.end()) return static_cast<int>(found - plan_.textures.begin());
        plan_.textures.push_back(std::move(ref));
        return static_cast<int>(plan_.textures.size()) - 1;
    }

    void addLines(const InstanceList& list) {
        if (plan_.layer != Layer::color) return;
        const auto segment = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::vec3& color) {
            plan_.lines.push_back({glm::vec3(view_(a)), color});
            plan_.lines.push_back({glm::vec3(view_(b)), color});
        };
        if (options_.axes.value_or(scene_.settings.axes.value_or(false)))
            for (int i = 0; i < 3; ++i) {
                glm::dvec3 end(0.0);
                end[i] = kAxisLength;
                glm::vec3 color(0.0F);
                color[i] = 1.0F;
                segment(-end, end, color);
            }
        for (const PlacedCurve& curve : list.curves)
            for (std::size_t i = 0; i < curve.points.size(); ++i)
                segment(curve.points[i], curve.points[(i + 1) % curve.points.size()],
                        glm::vec3(1.0F));
        if (options_.focus) {
            // One fiftieth of the distance: as large at any zoom.
            const double half = glm::length(plan_.camera.eye - plan_.camera.target) / 100.0;
            for (int i = 0; i < 8; ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    if (i & (1 << axis)) continue;
                    const auto corner = [&](int bits) {
                        return plan_.camera.target + half * glm::dvec3(bits & 1 ? 1 : -1,
                                                                       bits & 2 ? 1 : -1,
                                                                       bits & 4 ? 1 : -1);
                    };
                    segment(corner(i), corner(i | (1 << axis)), glm::vec3(1.0F));
                }
        }
    }

    void addBackground() {
        const Background chosen = chooseBackground(scene_, options_, assets_);
        plan_.background = chosen.color;
        if (plan_.layer != Layer::color) {
            plan_.background = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
            return;
        }
        if (!chosen.path.empty()) {
            TextureRef ref = refOf(chosen.path, assets_);
            ref.filter = scene::Filter::linear;
            plan_.backgroundTexture = addTexture(std::move(ref));
        }
        if (scene_.skybox) {
            TextureRef ref = refOf(scene_.skybox->path, assets_);
            ref.cube = true;
            ref.filter = scene::Filter::linear;
            ref.where = scene_.skybox->where;
            plan_.skyboxTexture = addTexture(std::move(ref));
        }
    }

    const scene::Scene& scene_;
    const Placed& placed_;
    const PictureOptions& options_;
    const scene::Assets& assets_;
    MeshLibrary& meshes_;
    const Skipping& skipping_;
    FramePlan plan_;
    double errorPx_ = options_.errorPx.value_or(kDefaultErrorPx);
    SamplePattern samples_;
    ReachedLights reached_{plan_.lightSets};
    std::vector<int> textureOf_;  ///< of an InstanceList, in plan_.textures
    double aspect_ = 1.0;
    View view_;
    Sight sight_;
    glm::dmat4 clip_{1.0};
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
        throw Error("limit.pixels", "a picture of " + std::to_string(size.x) + " x " +
                                        std::to_string(size.y) + " px is too large; at most " +
                                        std::to_string(kMaxSide) + " a side are drawn");
    return size;
}

FramePlan plan(const scene::Scene& scene, const Placed& placed, const PictureOptions& options,
               const scene::Assets& assets, MeshLibrary& meshes, const Skipping& skipping) {
    return Planner(scene, placed, options, assets, meshes, skipping).run();
}

FramePlan plan(const scene::Scene& scene, const PictureOptions& options,
               const scene::Assets& assets, MeshLibrary& meshes, const Skipping& skipping) {
    return plan(scene, place(scene, options.timeS, options.curves, assets, meshes), options, assets,
                meshes, skipping);
}

}  // namespace farol::render
