#include "tests/support/ray_caster/tracer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <thread>

#include "tests/support/ray_caster/angles.h"

namespace farol::reference {
namespace {

struct Place {
    glm::dvec2 uv, dx, dy;
};

/// Texture coordinates and their change a pixel to the right and down: the neighbouring rays meet
/// the tangent plane there.
Place placeOf(const World& world, const Instance& one, const Surface& s,
              const glm::dvec3& direction, double depth) {
    glm::dvec3 gradU = s.gradU, gradV = s.gradV;
    Place place;
    place.uv = s.uv;
    switch (one.mapping.mapping) {
        case scene::Mapping::mesh:
            break;
        case scene::Mapping::sphere:
            // u from -X by way of -Z, as atan2(z, x) grows.
            place.uv = {0.5 + std::atan2(s.point.z, s.point.x) / (2.0 * std::numbers::pi),
                        latitudeOf(s.point)};
            gradU = -turnGradient(s.point);
            gradV = latitudeGradient(s.point);
            break;
        case scene::Mapping::texgenObject:
            place.uv = {glm::dot(one.mapping.planeS, glm::dvec4(s.point, 1.0)),
                        glm::dot(one.mapping.planeT, glm::dvec4(s.point, 1.0))};
            gradU = glm::dvec3(one.mapping.planeS);
            gradV = glm::dvec3(one.mapping.planeT);
            break;
        case scene::Mapping::texgenEye: {
            const glm::dvec4 eye(depth * direction, 1.0);
            place.uv = {glm::dot(one.mapping.planeS, eye), glm::dot(one.mapping.planeT, eye)};
            gradU = glm::transpose(one.viewFromObject) * glm::dvec3(one.mapping.planeS);
            gradV = glm::transpose(one.viewFromObject) * glm::dvec3(one.mapping.planeT);
            break;
        }
    }
    const double pixel = 2.0 * world.tanHalf / world.height;
    const glm::dvec3 along = one.objectFromView * direction;
    const auto change = [&](const glm::dvec3& step) {
        const glm::dvec3 aside = one.objectFromView * step;
        const glm::dvec3 moved =
            depth * (aside - along * (glm::dot(s.normal, aside) / glm::dot(s.normal, along)));
        return glm::dvec2(glm::dot(gradU, moved), glm::dot(gradV, moved));
    };
    place.dx = change({pixel, 0.0, 0.0});
    place.dy = change({0.0, -pixel, 0.0});
    return place;
}

/// True where the texture of a cut-out has a hole.
bool isHole(const World& world, const Instance& one, const Ray& ray, const Hit& hit,
            const glm::dvec3& direction) {
    if (one.kind != Texture::Kind::cutOut || !one.texture) return false;
    const Place place = placeOf(world, one, one.shape->surface(ray, hit), direction, hit.t);
    return one.texture->sample(place.uv, glm::dvec2(0.0), glm::dvec2(0.0), one.filter).a < 0.5;
}

/// True where a surface is between the light and the point, in eye space. Light meets the outsides
/// of bodies, and both sides of sheets; what is blended stops none.
bool isShadowed(const World& world, const EyeLight& light, const glm::dvec3& point) {
    // From the light, as seen from there: directional light from beyond all that there is.
    const glm::dvec3 from = light.positional
                                ? light.position
                                : point + light.towards * (2.0 * world.reach + glm::length(point));
    const glm::dvec3 direction = point - from;
    // Before the surface itself, by a share of its distance from the eye: that of a far light's
    // would pass what casts.
    const double before =
        std::clamp(1e-7 * glm::length(point) / glm::length(direction), 1e-13, 1e-7);
    for (const Instance& one : world.instances) {
        if (one.kind == Texture::Kind::blended) continue;
        const Ray ray{one.objectFromView * (from - one.originView), one.objectFromView * direction};
        double begin = 0.0;
        for (;;) {
            Nearest nearest(begin, 1.0 - before, one.isSheet);
            one.shape->intersect(ray, nearest);
            if (!nearest.found()) break;
            if (!isHole(world, one, ray, nearest.best(), direction)) return true;
            begin = nearest.best().t + 1e-9;
        }
    }
    return false;
}

/// Fills in a surface alone. Returns its opacity; the colour is not multiplied by it.
double color(const World& world, const Instance& one, const Ray& ray, const Hit& hit,
             const glm::dvec3& direction, Sample& sample) {
    const Surface s = one.shape->surface(ray, hit);
    const glm::dmat3 normalMatrix = glm::transpose(one.objectFromView);
    const double side = glm::dot(s.normal, ray.direction) > 0.0 ? -1.0 : 1.0;  // a back, shown
    const glm::dvec3 inner = s.shadingNormal == glm::dvec3(0.0) ? s.normal : s.shadingNormal;
    sample.point = hit.t * direction;
    sample.normal = glm::normalize(side * (normalMatrix * s.normal));
    sample.id = one.id;
    sample.depth = hit.t;
    sample.part = hit.face * 2 + (side < 0.0 ? 1 : 0);
    glm::dvec4 texture(1.0);
    if (one.texture) {
        const Place place = placeOf(world, one, s, direction, hit.t);
        texture = one.texture->sample(place.uv, place.dx, place.dy, one.filter);
        if (one.filter == scene::Filter::nearest)
            sample.texel = glm::floor(place.uv * glm::dvec2(one.texture->size(0)));
        constexpr double kJump = 0.125;  // as round the poles, where no filter is right
        sample.coarse = glm::length(place.dx) > kJump || glm::length(place.dy) > kJump;
    }
    double opacity = one.opacity * texture.a;
    if (one.kind == Texture::Kind::cutOut) opacity = opacity < 0.5 ? 0.0 : 1.0;
    if (!(opacity > 0.0)) return 0.0;
    const glm::dvec3 texel = glm::dvec3(texture) / texture.a;
    if (one.unlit) {
        sample.color = one.dress.diffuse * texel;
        return opacity;
    }
    for (const EyeLight& light : one.lights)
        sample.part = 2 * (sample.part % (1 << 20)) + (inCone(light, sample.point) ? 1 : 0);
    const glm::dvec3 normal = glm::normalize(side * (normalMatrix * inner));
    std::uint64_t shadowed = 0;
    for (std::size_t i = 0; i < one.lights.size(); ++i) {
        const EyeLight& light = one.lights[i];
        const glm::dvec3 towards = light.positional ? light.position - sample.point : light.towards;
        const std::uint64_t bit = std::uint64_t{1} << (i % 64);
        if (world.shadows && isShadowed(world, light, sample.point)) shadowed |= bit;
        if (glm::dot(normal, towards) > 0.0 && inCone(light, sample.point)) sample.lit |= bit;
    }
    sample.lit &= ~shadowed;
    sample.color = shade(world.rules, one.dress, one.lights, sample.point, normal, texel, shadowed);
    return opacity;
}

/// Runs `row` for all rows; each writes only what is its own.
void eachRow(int height, int threads, const std::function<void(int)>& row) {
    std::atomic<int> next{0};
    const auto work = [&] {
        for (int y = next++; y < height; y = next++) row(y);
    };
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(work);
    work();
    for (std::thread& one : others) one.join();
}

/// True where the step between the points leaves either tangent plane by more than 30 degrees, or
/// the planes differ by as much: another sheet, or a crease.
bool bends(const Sample& a, const Sample& b) {
    const glm::dvec3 step = b.point - a.point;
    const double rise =
        std::max(std::abs(glm::dot(step, a.normal)), std::abs(glm::dot(step, b.normal)));
    return rise > 0.5 * glm::length(step) || glm::dot(a.normal, b.normal) < 0.866;
}

std::uint8_t flagsOf(const Picture& picture, const std::vector<Sample>& samples, int x, int y) {
    const Sample& here = samples[picture.at(x, y)];
    unsigned flags = here.coarse ? kCrease : kInterior;
    for (int j = std::max(0, y - 1); j <= std::min(picture.height - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(picture.width - 1, x + 1); ++i) {
            const Sample& there = samples[picture.at(i, j)];
            if (there.ids != here.ids)
                flags |= kSilhouette;
            else if (here.id != 0 && (i != x || j != y) &&
                     (there.parts != here.parts || there.texel != here.texel || bends(here, there)))
                flags |= kCrease;
        }
    return static_cast<std::uint8_t>(flags);
}

glm::dvec3 meanOf(const World& world, int x, int y, int n) {
    glm::dvec3 sum(0.0);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) sum += trace(world, x + (i + 0.5) / n, y + (j + 0.5) / n).color;
    return sum / static_cast<double>(n * n);
}

/// A surface that a ray meets.
struct Met {
    const Instance* instance = nullptr;
    Ray ray{};
    Hit hit;
};

/// The nearest surface behind `last`, or in its place and later in the document.
Met nextBehind(const World& world, double x, double y, const Met& last) {
    const glm::dvec3 direction = world.direction(x, y);
    Met met;
    double far = world.far;
    for (const Instance& one : world.instances) {
        if (x < one.pixelMin.x || x > one.pixelMax.x || y < one.pixelMin.y || y > one.pixelMax.y)
            continue;
        // Rounding must not find a surface twice.
        double from = world.near;
        if (last.instance != nullptr)
            from = last.hit.t * (&one > last.instance ? 1.0 - 1e-12 : 1.0 + 1e-7);
        const Ray ray{-(one.objectFromView * one.originView), one.objectFromView * direction};
        Nearest nearest(std::max(from, world.near), far, one.twoSided);
        one.shape->intersect(ray, nearest);
        if (!nearest.found() || !(nearest.best().t < met.hit.t)) continue;
        met = {&one, ray, nearest.best()};
        far = met.hit.t;
    }
    return met;
}

void addTo(std::uint64_t& digest, int value) {
    digest = (digest ^ (static_cast<std::uint64_t>(value) + 0x9e3779b97f4a7c15U)) * 0x100000001b3U;
}

}  // namespace

Sample trace(const World& world, double x, double y) {
    constexpr double kOpaque = 1e-6;  // what is seen through less adds nothing
    Sample sample;
    glm::dvec3 sum(0.0);
    double left = 1.0;
    for (Met met; left > kOpaque;) {
        met = nextBehind(world, x, y, met);
        if (met.instance == nullptr) break;
        Sample surface;
        const double opacity =
            color(world, *met.instance, met.ray, met.hit, world.direction(x, y), surface);
        if (!(opacity > 0.0)) continue;
        surface.ids = sample.ids;
        surface.parts = sample.parts;
        surface.opaqueId = sample.opaqueId;
        if (surface.opaqueId == 0 && opacity >= 0.5) surface.opaqueId = surface.id;
        addTo(surface.ids, surface.id);
        addTo(surface.parts, surface.part);
        sum += left * opacity * surface.color;
        left *= 1.0 - opacity;
        if (sample.id == 0) {
            sample = surface;
        } else {
            sample.ids = surface.ids;
            sample.parts = surface.parts;
            sample.opaqueId = surface.opaqueId;
            sample.coarse |= surface.coarse;
        }
    }
    sample.color = sum + left * world.background;
    return sample;
}

Picture traceCenters(const World& world, int threads) {
    Picture picture{world.width, world.height, {}, {}, {}, {}, {}, 1, 0.0};
    const std::size_t count = picture.at(0, world.height);
    picture.color.resize(count);
    picture.id.resize(count);
    picture.opaqueId.resize(count);
    picture.edge.resize(count);
    picture.lit.resize(count);
    std::vector<Sample> samples(count);
    eachRow(world.height, threads, [&](int y) {
        for (int x = 0; x < world.width; ++x) {
            Sample& sample = samples[picture.at(x, y)];
            sample = trace(world, x + 0.5, y + 0.5);
            picture.color[picture.at(x, y)] = sample.color;
            picture.id[picture.at(x, y)] = sample.id;
            picture.opaqueId[picture.at(x, y)] = sample.opaqueId;
            picture.lit[picture.at(x, y)] = sample.lit;
        }
    });
    for (int y = 0; y < world.height; ++y)
        for (int x = 0; x < world.width; ++x)
            picture.edge[picture.at(x, y)] = flagsOf(picture, samples, x, y);
    return picture;
}

Picture traceAreas(const World& world, int cap, int threads) {
    Picture picture = traceCenters(world, threads);
    constexpr double kLevel = 1.0 / 255.0;
    std::vector<double> change(picture.color.size(), std::numeric_limits<double>::infinity());
    for (int n = 2; n <= cap; n *= 2) {
        eachRow(world.height, threads, [&](int y) {
            for (int x = 0; x < world.width; ++x) {
                const std::size_t at = picture.at(x, y);
                // The first doubling is not trusted.
                if (n > 4 && picture.edge[at] == kInterior && change[at] < 0.05 * kLevel) continue;
                const glm::dvec3 mean = meanOf(world, x, y, n);
                change[at] = glm::length(mean - picture.color[at]) / std::sqrt(3.0);
                picture.color[at] = mean;
            }
        });
        double sum = 0.0;
        for (const double one : change) sum += one * one;
        picture.side = n;
        picture.change = std::sqrt(sum / static_cast<double>(change.size()));
        if (n > 2 && picture.change < 0.1 * kLevel) break;
    }
    return picture;
}

}  // namespace farol::reference
