#include "render/plan/shadow_splits.h"

#include <algorithm>
#include <cmath>

#include "render/plan/light_bounds.h"

namespace farol::render {
namespace {

constexpr double kBinsPerOctave = 4.0;
/// Boxes whose corners' depths differ by no more than this factor are not looked into.
constexpr double kMaxDepthRatio = 1.25;
constexpr std::size_t kViewPlanes = 6;
/// One more map for each light has to make texels finer by this factor.
constexpr double kGain = 0.9;
/// Pixels that a texel of slices may cover, and those that are fewer than anyone needs.
constexpr double kWanted = 0.75, kEnough = 0.5;

/// The corners of a box's sides; corner i has the bits of x, y and z.
constexpr std::array<std::array<std::size_t, 4>, 6> kBoxSides{
    {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};

bool isFlatBox(const std::array<glm::dvec3, 8>& c) {
    const glm::dvec3 a = c[1] - c[0], b = c[2] - c[0], d = c[4] - c[0];
    return std::abs(glm::dot(a, glm::cross(b, d))) <=
           1e-12 * std::pow(glm::length(c[7] - c[0]), 3.0);
}

/// A slice of the view lies along its direction: the map is filled best.
glm::dmat3 sliceRotation(const LightView& map, const ViewTransform& view) {
    const glm::dvec3 forward = -glm::transpose(map.rotation)[2];
    const glm::dmat3 worldFromEye = glm::transpose(view.rotation);
    const glm::dvec3 ahead = -worldFromEye[2];
    const bool isAlong = glm::length(glm::cross(forward, ahead)) < 0.3;
    return rotationAlong(forward, isAlong ? worldFromEye[1] : ahead);
}

}  // namespace

LitDepths::LitDepths(const InstanceList& list, const std::vector<CastingBox>& boxes,
                     const ViewTransform& view, const LightView& map)
    : view_(view), rotation_(sliceRotation(map, view)) {
    lightFromEye_ = rotation_ * glm::transpose(view.rotation);
    setPlanes(map);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].isThere) add(list.instances[i], boxes[i]);
}

void LitDepths::setPlanes(const LightView& map) {
    planes_[0] = {{0.0, 0.0, -1.0}, -view_.near};
    planes_[1] = {{0.0, 0.0, 1.0}, view_.far};
    for (std::size_t axis = 0; axis < 2; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            const int at = static_cast<int>(axis);
            const std::size_t second = sign > 0.0 ? 1 : 0;
            glm::dvec3 normal(0.0, 0.0, -view_.tanHalfFov[at]);
            normal[at] = sign;
            planes_[2 + 2 * axis + second] = {normal, 0.0};
            const glm::dmat3 eyeFromLight = view_.rotation * glm::transpose(map.rotation);
            const double offset = (map.rotation * (view_.eye - map.origin))[at];
            planes_[kViewPlanes + 2 * axis + second] = {
                sign * eyeFromLight[at], sign * offset - (sign > 0.0 ? map.min[at] : -map.max[at])};
        }
}

std::size_t LitDepths::binOf(double depth) const {
    return static_cast<std::size_t>(
        std::max(0.0, std::floor(kBinsPerOctave * std::log2(depth / view_.near))));
}

double LitDepths::topOf(std::size_t bin) const {
    return view_.near * std::exp2(static_cast<double>(bin + 1) / kBinsPerOctave);
}

void LitDepths::addTo(std::size_t index, const Polygon& places, double nearest) {
    if (places.empty()) return;
    if (bins_.size() <= index) bins_.resize(index + 1);
    Bin& bin = bins_[index];
    bin.nearest = bin.content.empty() ? nearest : std::min(bin.nearest, nearest);
    for (const glm::dvec3& place : places) {
        const glm::dvec3 at = lightFromEye_ * place;
        bin.content.add(glm::dvec3(at.x, at.y, -at.z));
    }
}

/// Cuts the polygon by the first of the planes, and to the bins that it meets.
void LitDepths::addPolygon(Polygon polygon, std::size_t planes) {
    for (std::size_t i = 0; i < planes && !polygon.empty(); ++i) {
        const auto isBefore = [&](const glm::dvec3& at) { return planes_[i].distance(at) >= 0.0; };
        if (!std::all_of(polygon.begin(), polygon.end(), isBefore))
            polygon = cutPolygon(polygon, planes_[i]);
    }
    if (polygon.empty()) return;
    double nearest = 1e300, farthest = 0.0;
    for (const glm::dvec3& at : polygon) {
        nearest = std::min(nearest, -at.z);
        farthest = std::max(farthest, -at.z);
    }
    nearest = std::max(nearest, view_.near);
    for (std::size_t bin = binOf(nearest); !polygon.empty(); ++bin) {
        const double top = topOf(bin);
        if (farthest <= top) return addTo(bin, polygon, nearest);
        addTo(bin, cutPolygon(polygon, {{0.0, 0.0, 1.0}, top}), nearest);
        polygon = cutPolygon(polygon, {{0.0, 0.0, -1.0}, -top});
        nearest = top;
    }
}

/// All that is within a box and in view.
void LitDepths::addBox(const std::array<glm::dvec3, 8>& corners) {
    if (isFlatBox(corners)) {
        for (const auto& side : kBoxSides)
            addPolygon({corners[side[0]], corners[side[1]], corners[side[2]], corners[side[3]]},
                       planes_.size());
        return;
    }
    for (const auto& side : kBoxSides)
        addPolygon({corners[side[0]], corners[side[1]], corners[side[2]], corners[side[3]]},
                   kViewPlanes);
    // Where the view's own sides pass through the box.
    std::array<glm::dvec3, 8> ofView;
    for (std::size_t i = 0; i < ofView.size(); ++i) {
        const double away = i & 4 ? view_.far : view_.near;
        ofView[i] = {(i & 1 ? 1.0 : -1.0) * view_.tanHalfFov.x * away,
                     (i & 2 ? 1.0 : -1.0) * view_.tanHalfFov.y * away, -away};
    }
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) middle += corner / 8.0;
    for (const auto& side : kBoxSides) {
        Polygon polygon{ofView[side[0]], ofView[side[1]], ofView[side[2]], ofView[side[3]]};
        for (const auto& wall : kBoxSides) {
            const glm::dvec3 a = corners[wall[0]];
            const glm::dvec3 normal =
                glm::cross(corners[wall[1]] - a, corners[wall[3]] - a) *
                (glm::dot(glm::cross(corners[wall[1]] - a, corners[wall[3]] - a), middle - a) < 0.0
                     ? -1.0
                     : 1.0);
            polygon = cutPolygon(polygon, {normal, -glm::dot(normal, a)});
        }
        addPolygon(std::move(polygon), 0);
    }
}

void LitDepths::addTriangles(const Instance& instance) {
    const generator::Mesh& mesh = instance.mesh->mesh;
    const glm::dmat3 linear = view_.rotation * glm::dmat3(instance.worldFromObject);
    const glm::dvec3 origin = view_.eyeFromWorld(glm::dvec3(instance.worldFromObject[3]));
    std::vector<glm::dvec3> places;
    std::vector<unsigned> behind;  // the planes, by bits
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec3& place = places.emplace_back(linear * glm::dvec3(position) + origin);
        unsigned bits = 0;
        for (std::size_t i = 0; i < planes_.size(); ++i)
            bits |= planes_[i].distance(place) < 0.0 ? 1U << i : 0U;
        behind.push_back(bits);
    }
    for (std::size_t i = 0; i + 2 < mesh.indices().size(); i += 3) {
        const std::uint32_t* at = &mesh.indices()[i];
        if (behind[at[0]] & behind[at[1]] & behind[at[2]]) continue;
        const bool isInside = (behind[at[0]] | behind[at[1]] | behind[at[2]]) == 0;
        addPolygon({places[at[0]], places[at[1]], places[at[2]]}, isInside ? 0 : planes_.size());
    }
}

void LitDepths::add(const Instance& instance, const CastingBox& casting) {
    std::array<glm::dvec3, 8> corners;
    double nearest = 1e300, farthest = -1e300;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = view_.eyeFromWorld(casting.corners[i]);
        nearest = std::min(nearest, -corners[i].z);
        farthest = std::max(farthest, -corners[i].z);
    }
    bool isInside = true;
    for (const ClipPlane& plane : planes_) {
        const auto before =
            std::count_if(corners.begin(), corners.end(),
                          [&](const glm::dvec3& corner) { return plane.distance(corner) >= 0.0; });
        if (before == 0) return;
        isInside &= before == 8;
    }
    if (isInside && farthest <= kMaxDepthRatio * nearest) {
        for (std::size_t bin = binOf(nearest); bin <= binOf(farthest); ++bin)
            addTo(bin, {corners.begin(), corners.end()},
                  std::max(nearest, topOf(bin) * std::exp2(-1.0 / kBinsPerOctave)));
    } else if (instance.open || isFlatBox(corners)) {
        addBox(corners);  // finer meshes reach beyond this one's triangles
    } else {
        addTriangles(instance);
    }
}

double LitDepths::pixelsOf(double texel) const {
    for (const Bin& bin : bins_)
        if (!bin.content.empty()) return texel / (view_.pixelAngle * bin.nearest);
    return 0.0;
}

double LitDepths::texelOf(const Box& content, int side) const {
    const glm::dvec3 size = content.max - content.min;
    return std::max(size.x, size.y) / side;
}

std::vector<LightView> LitDepths::slices(int side, int most, double pixels) const {
    std::vector<LightView> out;
    const auto addSlice = [&](const Box& content) {
        LightView& light = out.emplace_back();
        light.rotation = rotation_;
        light.origin = view_.eye;
        light.min = content.min;
        light.max = content.max;
        const double texel = texelOf(content, side), range = content.max.z - content.min.z;
        const double slack = 1e-3 * range + 8.0 * texel;
        light.nearest = content.min.z - slack;
        light.farthest = content.max.z + slack;
    };
    Box slice;
    double nearest = 0.0;
    for (const Bin& bin : bins_) {
        if (bin.content.empty()) continue;
        Box longer = slice;
        longer.add(bin.content.min);
        longer.add(bin.content.max);
        if (!slice.empty() && texelOf(longer, side) > pixels * view_.pixelAngle * nearest) {
            addSlice(slice);
            slice = Box();
        }
        if (slice.empty()) {
            if (texelOf(bin.content, side) > pixels * view_.pixelAngle * bin.nearest) return {};
            nearest = bin.nearest;
        }
        slice.add(bin.content.min);
        slice.add(bin.content.max);
    }
    if (!slice.empty()) addSlice(slice);
    if (out.size() > static_cast<std::size_t>(most)) return {};
    return out;
}

double LitDepths::leastPixels(int side, int most, double enough, double acceptable) const {
    if (!slices(side, most, enough).empty()) return enough;
    double no = enough, yes = acceptable;
    if (!(yes > no) || slices(side, most, yes).empty()) return 0.0;
    for (int i = 0; i < 12; ++i) {
        const double middle = std::sqrt(no * yes);
        (slices(side, most, middle).empty() ? no : yes) = middle;
    }
    return yes;
}

namespace {

/// Casters whose shadows may fall into a slice.
PlannedShadowMap mapOf(const LightView& light, const std::vector<std::size_t>& casters,
                       const std::vector<CastingBox>& boxes) {
    PlannedShadowMap map{light, {}};
    const glm::dvec2 size = light.max - light.min;
    const double beside = 0.05 * std::max(size.x, size.y);  // more than fit() adds
    for (const std::size_t i : casters) {
        Box box;
        for (const glm::dvec3& corner : boxes[i].corners)
            box.add(light.rotation * (corner - light.origin));
        const bool isOver = box.min.x <= light.max.x + beside &&
                            box.max.x >= light.min.x - beside &&
                            box.min.y <= light.max.y + beside && box.max.y >= light.min.y - beside;
        if (isOver && -box.max.z <= light.farthest) map.casters.push_back(i);
    }
    return map;
}

}  // namespace

std::vector<std::vector<PlannedShadowMap>> splitMaps(const std::vector<WideLight>& lights,
                                                     const std::vector<CastingBox>& boxes,
                                                     int count,
                                                     const std::function<int(int)>& usableSide) {
    std::vector<std::vector<PlannedShadowMap>> out(lights.size());
    const auto sideWith = [&](int each) {
        return usableSide(count + static_cast<int>(lights.size()) * (each - 1));
    };
    double least = 0.0;
    for (const WideLight& light : lights) least = std::max(least, light.pixels);
    int best = 0;
    for (int each = 1; each <= kMaxCascade && (best == 0 || least > kWanted); ++each) {
        if (count + static_cast<int>(lights.size()) * (each - 1) > kMaxShadowMaps) break;
        double most = 0.0;
        for (const WideLight& light : lights) {
            const double pixels =
                light.depths.leastPixels(sideWith(each), each, kWanted, light.pixels);
            most = std::max(most, pixels > 0.0 ? pixels : light.pixels);
        }
        if (most > kGain * least) continue;
        best = each;
        least = most;
    }
    if (best == 0) return out;
    const int side = sideWith(best);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const LitDepths& depths = lights[i].depths;
        const double pixels = depths.leastPixels(side, best, kEnough, lights[i].pixels);
        for (const LightView& slice : depths.slices(side, best, pixels)) {
            PlannedShadowMap map = mapOf(slice, lights[i].casters, boxes);
            if (!map.casters.empty()) out[i].push_back(std::move(map));
        }
    }
    return out;
}

bool mayBeCoarse(const std::vector<CastingBox>& boxes, const ViewTransform& view, double texel) {
    return std::any_of(boxes.begin(), boxes.end(), [&](const CastingBox& box) {
        if (!box.isThere) return false;
        double nearest = 1e300, farthest = -1e300;
        for (const glm::dvec3& corner : box.corners) {
            const double depth = -view.eyeFromWorld(corner).z;
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
        return farthest > view.near && texel > view.pixelAngle * std::max(nearest, view.near);
    });
}

}  // namespace farol::render
