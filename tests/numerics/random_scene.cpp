#include "tests/numerics/random_scene.h"

#include <algorithm>

namespace farol::numerics {
namespace {

int below(Sweep& sweep, int count) {
    return static_cast<int>(sweep.between(0.0, static_cast<double>(count)));
}

glm::dvec3 inBox(Sweep& sweep, double half) {
    const double x = sweep.between(-half, half), y = sweep.between(-half, half);
    return {x, y, sweep.between(-half, half)};
}

std::string color(Sweep& sweep, const char* name, double low, double high) {
    std::string out = std::string("<") + name;
    for (const char* channel : {"R", "G", "B"})
        out +=
            std::string(" ") + channel + "=\"" + text(std::floor(sweep.between(low, high))) + '"';
    return out + "/>";
}

std::string randomMaterial(Sweep& sweep) {
    std::string out = "<color>" + color(sweep, "diffuse", 20, 230);
    out += color(sweep, "ambient", 10, 60);
    const bool isShiny = sweep.chance(0.4);
    out += color(sweep, "specular", 0, isShiny ? 200 : 1);
    return out + "<shininess value=\"" + text(isShiny ? sweep.power(1.0, 60.0) : 0.0) +
           "\"/></color>";
}

}  // namespace

glm::dvec3 RandomScene::snapped(const glm::dvec3& place) const {
    return glm::round(place / grid_) * grid_;
}

RandomScene::Step RandomScene::rotation() {
    return {true, std::round(sweep_.between(-360.0, 360.0) * 1024.0) / 1024.0, inBox(sweep_, 1.0)};
}

/// Mostly none; else of either sign, or one for each axis.
void RandomScene::addScale(std::vector<Step>& steps) {
    if (sweep_.chance(0.6)) return;
    const bool isUniform = sweep_.chance(0.4);
    glm::dvec3 scale;
    for (int i = 0; i < 3; ++i)
        scale[i] = sweep_.power(0.4, 2.0) * (sweep_.chance(0.25) ? -1.0 : 1.0);
    steps.push_back({false, 0.0, isUniform ? glm::dvec3(scale.x) : scale});
}

/// Of about that radius; `isNested`: one without flat parts.
RandomScene::Part RandomScene::solid(double radius, bool isNested) {
    struct Kind {
        const char* shape;
        std::vector<glm::dvec2> shares;  ///< ranges of its lengths
    };
    static const std::vector<Kind> kKinds{{"sphere", {{0.3, 1.0}}},
                                          {"ellipsoid", {{0.3, 1.0}, {0.3, 1.0}, {0.3, 1.0}}},
                                          {"torus", {{0.5, 0.8}, {0.1, 0.3}}},
                                          {"sphere", {{0.3, 1.0}}},
                                          {"cylinder", {{0.3, 1.0}, {0.3, 1.0}}},
                                          {"cone", {{0.3, 1.0}, {0.3, 1.0}}},
                                          {"frustum", {{0.5, 1.0}, {0.1, 0.4}, {0.3, 1.0}}},
                                          {"box", {{0.3, 1.0}, {0.3, 1.0}, {0.3, 1.0}}},
                                          {"dome", {{0.3, 1.0}}}};
    const Kind& kind = kKinds[static_cast<std::size_t>(
        below(sweep_, isNested ? 4 : static_cast<int>(kKinds.size())))];
    Part part;
    part.shape = kind.shape;
    for (const glm::dvec2& share : kind.shares)
        part.lengths.push_back(radius * sweep_.between(share.x, share.y));
    part.material = randomMaterial(sweep_);
    return part;
}

/// One object, or a shell and the one within it; counts them down.
RandomScene::Object RandomScene::object(int& left) {
    Object out;
    out.place = snapped(inBox(sweep_, size_));
    --left;
    if (sweep_.chance(0.12)) {
        Part plane;
        plane.shape = "plane";
        plane.lengths = {size_ * sweep_.power(0.5, 1000.0)};
        if (sweep_.chance(0.5)) plane.steps.push_back(rotation());
        plane.material = randomMaterial(sweep_);
        out.parts.push_back(std::move(plane));
        return out;
    }
    const bool isNested = left > 0 && sweep_.chance(0.15);
    Part part = solid(size_ * (isNested ? 0.4 : sweep_.power(0.05, 0.8)), isNested);
    part.steps.push_back(rotation());
    addScale(part.steps);
    if (!isNested && sweep_.chance(0.3)) {
        part.steps.push_back(rotation());
        addScale(part.steps);
    }
    out.parts.push_back(part);
    if (!isNested) return out;
    --left;
    if (part.shape == "sphere") part.steps.push_back(rotation());
    part.steps.push_back({false, 0.0, glm::dvec3(1.0 + sweep_.power(1e-4, 1e-2))});
    part.material = randomMaterial(sweep_);
    out.parts.push_back(std::move(part));
    return out;
}

RandomScene::RandomScene(Sweep& sweep, double size, int objects)
    : sweep_(sweep),
      size_(size),
      grid_(std::exp2(std::floor(std::log2(size)) - 20.0)),
      unit_(size < 1e-2 || size > 1e2 ? size : 1.0) {
    glm::dvec3 away = inBox(sweep, 1.0);
    away /= std::max(0.1, glm::length(away));
    away.y = std::abs(away.y) * 0.7 + 0.1;
    camera_.eye = snapped(away * size * sweep.between(1.5, 5.0));
    camera_.target = snapped(inBox(sweep, 0.3 * size));
    camera_.fovDeg = sweep.between(15.0, 90.0);
    camera_.near = std::max(1e-9, size * sweep.power(1e-3, 1e-2));
    camera_.far = size * 1e4;
    for (int i = 1 + below(sweep, 3); i > 0; --i) {
        const bool isDirectional = sweep.chance(0.5);
        glm::dvec3 value = inBox(sweep, isDirectional ? 1.0 : 3.0 * size);
        if (isDirectional)
            value.y = std::abs(value.y) + 0.2;
        else
            value = snapped(value);
        lights_.push_back({isDirectional, value});
    }
    for (int left = objects; left > 0;) objects_.push_back(object(left));
}

std::string RandomScene::xml(const Wording& wording) const {
    const double factor = std::exp2(wording.power);
    const glm::dvec3 move = wording.move * grid_;
    const auto at = [&](const glm::dvec3& place) { return (place + move) * factor; };
    Camera camera = camera_;
    camera.eye = at(camera_.eye);
    camera.target = at(camera_.target);
    camera.near *= factor;
    camera.far *= factor;
    std::string out = "<world>" + camera.xml() + "<lights>";
    for (const Light& light : lights_) {
        const char* const kind = light.isDirectional ? "directional" : "point";
        const char* const name = light.isDirectional ? "dir" : "pos";
        const glm::dvec3 value = light.isDirectional ? light.value : at(light.value);
        out += std::string("<light type=\"") + kind + "\"";
        for (int i = 0; i < 3; ++i)
            out += std::string(" ") + name + "XYZ"[i] + "=\"" + text(value[i]) + '"';
        out += "/>";
    }
    out += "</lights>";
    const std::string next = wording.isSplit ? "</transform><group><transform>" : "";
    const auto translated = [](const glm::dvec3& by) { return "<translate " + xyz(by) + "/>"; };
    if (!wording.isSplit) out += "<group><transform>" + translated(move * factor) + "</transform>";
    for (const Object& object : objects_)
        for (const Part& part : object.parts) {
            int groups = 1;
            out += "<group><transform>";
            if (wording.isSplit) {
                out += translated(move * factor) + next + translated(0.5 * factor * object.place) +
                       next + translated(0.5 * factor * object.place);
                groups += 2;
            } else {
                out += translated(factor * object.place);
            }
            if (unit_ != 1.0) out += "<scale " + xyz(glm::dvec3(unit_ * factor)) + "/>";
            for (const Step& step : part.steps) {
                out += next;
                groups += wording.isSplit ? 1 : 0;
                if (step.isRotation)
                    out += "<rotate angle=\"" + text(step.angleDeg + 360.0 * wording.turns) +
                           "\" " + xyz(step.value * wording.axisLength) + "/>";
                else
                    out += "<scale " + xyz(step.value) + "/>";
            }
            out += "</transform><models><model command=\"" + part.shape;
            for (const double length : part.lengths)
                out += " " + text(length / unit_ * (unit_ == 1.0 ? factor : 1.0));
            out += "\">" + part.material + "</model></models>";
            for (; groups > 0; --groups) out += "</group>";
        }
    return out + (wording.isSplit ? "" : "</group>") + "</world>";
}

}  // namespace farol::numerics
