#include "generator/primitives/frustum.h"

#include <algorithm>

#include "generator/builder.h"
#include "generator/messages.h"

namespace farol::generator::primitives {
namespace {

using scene::UvLayout;

/// The radius form.x + form.y * q.y for q.y in 0..1, closed by discs.
constexpr SurfaceKind kFrustum{
    .distance =
        [](const Surface& surface, const glm::dvec3& eye) {
            const glm::dvec2 form = surface.form;
            return distanceToSegment(aboutY(eye), {form.x, 0.0}, {form.x + form.y, 1.0});
        },
    .isNeeded = [](const Surface& surface, double fullTurn,
                   bool) { return surface.form.y != 0.0 || fullTurn < kSmoothTurn; },
    .fullTurn = fullTurnOfSlices,
    .balance = [](const std::vector<double>& levels) { return balanceOfSlices(levels.at(0)); },
    .hasCaps = true,
    .raySteps = 1,
    .glsl = R"(
void expand(vec3 q, vec3 d, out float a, out float b, out float c) {
    float radius = surfaceForm.x + surfaceForm.y * q.y;
    float slope = surfaceForm.y * d.y;
    a = dot(d.xz, d.xz) - slope * slope;
    b = dot(q.xz, d.xz) - slope * radius;
    c = dot(q.xz, q.xz) - radius * radius;
}
vec3 sideGradient(vec3 q) {
    return vec3(q.x, -surfaceForm.y * (surfaceForm.x + surfaceForm.y * q.y), q.z);
}
#ifdef TEXTURED
float shareOf(vec3 q) { return q.y; }
float shareChange(vec3 q, vec3 step) { return step.y; }
#endif
)"};

constexpr double kAtlasSide = 0.625;  // of the texture's height is the side's

/// Where the parts of a frustum lie in the texture.
class Texturing {
  public:
    Texturing(UvLayout layout, FrustumAtlas atlas, std::size_t slices, std::size_t stacks)
        : layout_(layout), atlas_(atlas), slices_(slices), stacks_(stacks) {}

    /// `slice` may be a half: the middle of a slice, at an apex.
    glm::dvec2 side(double slice, std::size_t stack, const SinCos& a, double share) const {
        const double u = slice / static_cast<double>(slices_), v = fraction(stack, stacks_);
        if (layout_ == UvLayout::layout2017) return {1 - u, v};
        if (layout_ == UvLayout::face) return {share > 0 ? u : 0.5, v};
        if (atlas_ == FrustumAtlas::cone) return disc({0.75, 0.5}, 0.25 * share, a);
        return {u, kAtlasSide * v};
    }

    glm::dvec2 cap(bool top, std::size_t slice, const SinCos& a, double share) const {
        if (layout_ == UvLayout::layout2017) return {fraction(slice, slices_), share > 0 ? 0 : 1};
        if (layout_ == UvLayout::face) return disc({0.5, 0.5}, 0.5 * share, a);
        if (atlas_ == FrustumAtlas::cone) return disc({0.25, 0.5}, 0.25 * share, a);
        return disc({top ? 0.4375 : 0.8125, 0.8125}, 0.1875 * share, a);
    }

  private:
    static glm::dvec2 disc(const glm::dvec2& centre, double radius, const SinCos& a) {
        return {centre.x + radius * a.sin, centre.y + radius * a.cos};
    }

    UvLayout layout_;
    FrustumAtlas atlas_;
    std::size_t slices_, stacks_;
};

void addCap(Builder& builder, const Texturing& texturing, bool top, double radius, double y,
            std::size_t slices) {
    const glm::dvec3 normal(0, top ? 1 : -1, 0);
    for (std::size_t i = 0; i < slices; ++i) {
        const SinCos a = turn(i, slices), b = turn(i + 1, slices);
        const auto centre = builder.vertex({0, y, 0}, normal, texturing.cap(top, i, a, 0));
        const auto first = builder.vertex({radius * a.sin, y, radius * a.cos}, normal,
                                          texturing.cap(top, i, a, 1));
        const auto second = builder.vertex({radius * b.sin, y, radius * b.cos}, normal,
                                           texturing.cap(top, i + 1, b, 1));
        builder.triangle(centre, top ? first : second, top ? second : first);
    }
}

}  // namespace

Mesh frustum(double bottom, double top, double height, std::size_t slices, std::size_t stacks,
             UvLayout uv, FrustumAtlas atlas) {
    Builder builder((stacks + 1) * (slices + 1) + 6 * slices,
                    frustumTriangles(bottom, top, slices, stacks));
    const Texturing texturing(uv, atlas, slices, stacks);
    const double slope = (bottom - top) / height, widest = std::max(bottom, top);
    const auto radiusAt = [&](std::size_t j) {
        return bottom * fraction(stacks - j, stacks) + top * fraction(j, stacks);
    };
    const auto row = [&](std::size_t j) {  // slices + 1 vertices, or one a slice at an apex
        const std::uint32_t start = builder.next();
        const double radius = radiusAt(j), y = height * fraction(j, stacks);
        const bool apex = radius == 0;
        for (std::size_t i = 0; i < slices + (apex ? 0 : 1); ++i) {
            const SinCos a = apex ? turn(2 * i + 1, 2 * slices) : turn(i, slices);
            const double slice = static_cast<double>(i) + (apex ? 0.5 : 0);
            builder.vertex({radius * a.sin, y, radius * a.cos}, {a.sin, slope, a.cos},
                           texturing.side(slice, j, a, radius / widest));
        }
        return start;
    };
    std::uint32_t low = row(0);
    for (std::size_t j = 0; j < stacks; ++j) {
        const std::uint32_t high = row(j + 1);
        for (std::uint32_t i = 0; i < slices; ++i) {
            if (radiusAt(j) > 0) builder.triangle(low + i, low + i + 1, high + i);
            if (radiusAt(j + 1) > 0)
                builder.triangle(low + i + (radiusAt(j) > 0 ? 1 : 0), high + i + 1, high + i);
        }
        low = high;
    }
    if (bottom > 0) addCap(builder, texturing, false, bottom, 0, slices);
    if (top > 0) addCap(builder, texturing, true, top, height, slices);
    return builder.take();
}

Surface frustumSurface(double bottom, double top, double height, UvLayout uv, FrustumAtlas atlas) {
    const double widest = std::max(bottom, top);
    Surface surface{&kFrustum, {widest, height, widest}};
    surface.form = {bottom / widest, (top - bottom) / widest};
    if (uv == UvLayout::layout2017) {
        surface.uv = {1.0, -1.0, 0.0, 1.0};
    } else if (uv == UvLayout::atlas && atlas == FrustumAtlas::cone) {
        surface.uv = {0.75, 0.25, 0.5, 0.25};
        surface.discs = {0.25, 0.5, 0.25, 0.5};
        surface.discUv = true;
    } else if (uv == UvLayout::atlas) {
        surface.uv.w = kAtlasSide;
        surface.discs = {0.8125, 0.8125, 0.4375, 0.8125};
    }
    return surface;
}

std::size_t frustumTriangles(double bottom, double top, std::size_t slices, std::size_t stacks) {
    // Each end has a disc, or lacks half of its row of quads: one triangle a slice either way.
    const std::size_t discs = (bottom > 0 ? 1 : 0) + (top > 0 ? 1 : 0);
    return slices * (2 * stacks - (2 - discs) + discs);
}

ShapeEntry frustumEntry() {
    Argument bottom = lengthArgument("BOTTOM", "radius of the base; 0 is an apex");
    Argument top = lengthArgument("TOP", "radius of the top; 0 is an apex", 0.5);
    bottom.min = top.min = 0;
    return {.name = "frustum",
            .aliases = {"tronco"},
            .summary = "the frustum of a cone, base in XZ, top at y = HEIGHT",
            .arguments = {bottom, top, lengthArgument("HEIGHT", "height"),
                          levelArgument("SLICES", 3, kDefaultSlices, "divisions about Y"),
                          levelArgument("STACKS", 1, 8, "divisions of the side along its height")},
            .required = 3,
            .generate =
                [](const ShapeCall& call, const std::string&, UvLayout uv) {
                    return frustum(call.length(0), call.length(1), call.length(2), call.count(3),
                                   call.count(4), uv, FrustumAtlas::cylinder);
                },
            .count =
                [](const ShapeCall& call, const std::string&) {
                    return frustumTriangles(call.length(0), call.length(1), call.count(3),
                                            call.count(4));
                },
            .check = [](const ShapeCall& call) -> Message {
                const double low = call.length(0), high = call.length(1);
                if (low == 0 && high == 0) return message<"part.frustum-zero">();
                for (const double radius : {low, high})
                    if (radius > 0 && radius < kMinLength)
                        return message<"part.frustum-small">("bottom"_arg = low, "top"_arg = high);
                return {};
            },
            .bound =
                [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                    const double radius = std::max(call.length(0), call.length(1));
                    return std::vector<double>{circleDivisions(radius, fineness.error, fineness),
                                               roundUpToStep(std::max(1.0, fineness.straightSide))};
                },
            .surface =
                [](const ShapeCall& call, UvLayout uv) {
                    return frustumSurface(call.length(0), call.length(1), call.length(2), uv,
                                          FrustumAtlas::cylinder);
                }};
}

}  // namespace farol::generator::primitives
