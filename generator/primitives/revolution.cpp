#include "generator/primitives/revolution.h"

#include <algorithm>

#include "generator/builder.h"
#include "generator/io/mesh_file.h"
#include "generator/io/raw_mesh.h"
#include "generator/messages.h"

namespace farol::generator::primitives {
namespace {

using glm::dvec2;

/// Round about Y; of N copies the last is upon the first.
constexpr SurfaceKind kTurned{
    .isNeeded = [](const Surface&, double, bool) { return true; },
    .fullTurn = [](const std::vector<double>& levels) { return levels.at(0) - 1.0; },
    .balance =
        [](const std::vector<double>& levels) { return balanceOfSlices(levels.at(0) - 1.0); },
    .hasProfile = true,
};

/// The profile as radii and heights, running upwards.
struct Outline {
    std::vector<dvec2> points;
    bool reversed = false;  ///< against the file's order
};

/// A stretch of the profile without a crease: points with normals (radius, height) and t.
struct Strip {
    std::vector<dvec2> points, normals;
    std::vector<double> t;
};

dvec2 normalOf(const dvec2& a, const dvec2& b) {
    return glm::normalize(dvec2(b.y - a.y, a.x - b.x));
}

void smooth(Strip& strip) {
    const std::size_t n = strip.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        const dvec2 before = normalOf(strip.points[i > 0 ? i - 1 : 0], strip.points[i > 0 ? i : 1]);
        const dvec2 after = i + 1 < n ? normalOf(strip.points[i], strip.points[i + 1]) : before;
        const dvec2 both = before + after;
        // A profile that turns straight back has no middle: the side it came from decides.
        strip.normals.push_back(glm::length(both) > 1e-9 ? glm::normalize(both) : before);
    }
}

Outline flatten(const std::vector<glm::dvec3>& profile, const std::string& file) {
    double low = 0, high = 0, size = 0;
    for (const glm::dvec3& p : profile) {
        low = std::min(low, p.x);
        high = std::max(high, p.x);
        size = std::max({size, std::abs(p.x), std::abs(p.y)});
    }
    // Rounding in the file may leave a point of the axis just beside it.
    const double onAxis = 1e-6 * size;
    if (low < -onAxis && high > onAxis) throw Error(message<"mesh.profile/axis">(), {file, 0, 0});
    std::vector<dvec2> points;
    for (const glm::dvec3& p : profile)
        points.emplace_back(std::abs(p.x) <= onAxis ? 0.0 : std::abs(p.x), p.y);
    // Pappus: the volume between surface and axis is positive where the profile runs upwards.
    double volume = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const dvec2 a = points[i], b = points[i + 1];
        volume += (a.x * a.x + a.x * b.x + b.x * b.x) * (b.y - a.y);
    }
    if (volume < 0) std::reverse(points.begin(), points.end());
    return {std::move(points), volume < 0};
}

std::vector<Strip> stripsOf(const Outline& outline, const std::string& file) {
    const std::vector<dvec2>& points = outline.points;
    double total = 0, length = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        total += glm::distance(points[i - 1], points[i]);
    std::vector<Strip> strips;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double step = i > 0 ? glm::distance(points[i - 1], points[i]) : 0;
        length += step;
        if (i == 0 || step <= 1e-9 * total) strips.emplace_back();
        strips.back().points.push_back(points[i]);
        const double t = total > 0 ? length / total : 0;
        strips.back().t.push_back(outline.reversed ? 1 - t : t);
    }
    std::erase_if(strips, [](const Strip& strip) { return strip.points.size() < 2; });
    if (strips.empty()) throw Error(message<"mesh.profile/points">(), {file, 0, 0});
    for (Strip& strip : strips) smooth(strip);
    return strips;
}

/// Adds the ring of vertices of a point: slices + 1, or one a slice on the axis. On the axis the
/// normal is that of the segment beside it, at the slice's middle.
std::uint32_t addRing(Builder& builder, const Strip& strip, std::size_t j, std::size_t slices) {
    const std::uint32_t start = builder.next();
    const dvec2 p = strip.points[j], n = strip.normals[j];
    const bool axis = p.x == 0;
    for (std::size_t i = 0; i < slices + (axis ? 0 : 1); ++i) {
        const SinCos a = axis ? turn(2 * i + 1, 2 * slices) : turn(i, slices);
        const double s = (static_cast<double>(i) + (axis ? 0.5 : 0)) / static_cast<double>(slices);
        builder.vertex({p.x * a.cos, p.y, -p.x * a.sin}, {n.x * a.cos, n.y, -n.x * a.sin},
                       {s, strip.t[j]});
    }
    return start;
}

}  // namespace

Mesh revolution(const std::vector<glm::dvec3>& profile, std::size_t copies,
                const std::string& fileName) {
    const std::size_t slices = copies - 1;
    // The origin moves along the axis only: x is the profile's radius.
    const double origin = io::originOf(profile).y;
    std::vector<glm::dvec3> near = profile;
    for (glm::dvec3& point : near) point.y -= origin;
    const std::vector<Strip> strips = stripsOf(flatten(near, fileName), fileName);
    Builder builder(profile.size() * copies, 2 * profile.size() * slices);
    builder.origin({0.0, origin, 0.0});
    for (const Strip& strip : strips) {
        std::uint32_t low = addRing(builder, strip, 0, slices);
        for (std::size_t j = 1; j < strip.points.size(); ++j) {
            const std::uint32_t high = addRing(builder, strip, j, slices);
            const bool lowAxis = strip.points[j - 1].x == 0, highAxis = strip.points[j].x == 0;
            for (std::uint32_t i = 0; i < slices; ++i) {
                if (lowAxis && highAxis) continue;  // along the axis: no surface
                if (!lowAxis) builder.triangleUnlessFlat(low + i, low + i + 1, high + i);
                if (!highAxis)
                    builder.triangleUnlessFlat(low + i + (lowAxis ? 0 : 1), high + i + 1, high + i);
            }
            low = high;
        }
    }
    return builder.take();
}

ShapeEntry revolutionEntry() {
    return {
        .name = "revolution",
        .aliases = {"revolve"},
        .summary = "a profile (PLY vertices in z = 0) turned about Y; N copies make N - 1 slices",
        .arguments = {levelArgument("N", 4, kDefaultSlices + 1, "copies of the profile")},
        .takesFile = true,
        .generate =
            [](const ShapeCall& call, const std::string& bytes, scene::UvLayout) {
                return revolution(io::decodeProfile(bytes, call.file), call.count(0), call.file);
            },
        .count =
            [](const ShapeCall& call, const std::string& bytes) {
                const std::size_t points = io::decodeProfile(bytes, call.file).size();
                return 2 * (points - std::min<std::size_t>(points, 1)) * (call.count(0) - 1);
            },
        .bound =
            [](const ShapeCall& call, const std::string& bytes, const Fineness& fineness) {
                double radius = 0.0;
                for (const auto& point : io::decodeProfile(bytes, call.file))
                    radius = std::max(radius, std::abs(double{point.x}));
                if (!(radius > 0.0)) return std::vector<double>{fineness.fullTurn + 1};
                // N copies make N - 1 slices.
                return std::vector<double>{circleDivisions(radius, fineness.error, fineness) + 1};
            },
        .surface =
            [](const ShapeCall&, scene::UvLayout) {
                Surface surface{&kTurned};
                surface.turnFromX = true;
                return surface;
            }};
}

}  // namespace farol::generator::primitives
