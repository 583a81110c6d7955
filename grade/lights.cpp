#include "grade/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace farol::grade {
namespace {

using render::PlacedLight;
using scene::LightType;

constexpr double kSameCos = 0.99999;  // a quarter of a degree
constexpr double kSameLength = 1e-3;  // of the scene's extent

const char* wordOf(LightType type) {
    constexpr std::array<const char*, 3> kWords{"point", "directional", "spot"};
    return kWords[static_cast<std::size_t>(type)];
}

std::string text(const glm::dvec3& v) {
    return shortNumber(v.x) + " " + shortNumber(v.y) + " " + shortNumber(v.z);
}

std::string levels(const scene::Color& color) { return text(glm::dvec3(color.rgb) * 255.0); }

double cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0.0 ? glm::dot(a, b) / lengths : 1.0;
}

struct Pairing {
    double cost;
    std::size_t theirs, mine;
};

class LightComparer {
  public:
    LightComparer(const Tree& reference, const Tree& submission)
        : theirs_(reference.list.lights), mine_(submission.list.lights) {
        const render::Box& box = reference.list.bounds;
        size_ = box.empty() ? 1.0 : std::max(1e-6, glm::length(box.max - box.min));
    }

    Findings run() {
        std::vector<Pairing> pairs;
        for (std::size_t i = 0; i < theirs_.size(); ++i)
            for (std::size_t j = 0; j < mine_.size(); ++j)
                pairs.push_back(
                    {cost(theirs_[i], mine_[j]) +
                         1e-3 * std::abs(static_cast<double>(i) - static_cast<double>(j)),
                     i, j});
        std::sort(pairs.begin(), pairs.end(), [](const Pairing& a, const Pairing& b) {
            return std::tie(a.cost, a.theirs, a.mine) < std::tie(b.cost, b.theirs, b.mine);
        });
        std::vector<bool> tookTheirs(theirs_.size()), tookMine(mine_.size());
        for (const Pairing& pair : pairs) {
            if (tookTheirs[pair.theirs] || tookMine[pair.mine]) continue;
            tookTheirs[pair.theirs] = tookMine[pair.mine] = true;
            compare(theirs_[pair.theirs], mine_[pair.mine], pair.mine + 1);
        }
        for (std::size_t i = 0; i < theirs_.size(); ++i)
            if (!tookTheirs[i])
                out_.push_back(
                    {"light.missing",
                     Topic::lights,
                     "light " + std::to_string(i + 1) + " is missing: a " + describe(theirs_[i]),
                     {}});
        for (std::size_t j = 0; j < mine_.size(); ++j)
            if (!tookMine[j])
                say("light.extra", mine_[j], j + 1,
                    std::string("is too much: a ") + describe(mine_[j]));
        return std::move(out_);
    }

  private:
    static std::string describe(const PlacedLight& placed) {
        const LightType type = placed.light->type;
        std::string what = std::string(wordOf(type)) + " light";
        if (type != LightType::directional) what += " at " + text(placed.position);
        if (type != LightType::point) what += ", direction " + text(placed.direction);
        return what;
    }

    double cost(const PlacedLight& a, const PlacedLight& b) const {
        const bool typed = a.light->type == b.light->type;
        double sum = typed ? 0.0 : 1.0;
        if (a.light->type != LightType::directional && b.light->type != LightType::directional)
            sum += std::min(1.0, glm::length(a.position - b.position) / size_);
        if (a.light->type != LightType::point && b.light->type != LightType::point)
            sum += 0.5 * (1.0 - std::abs(cosine(a.direction, b.direction)));
        if (a.light->diffuse != b.light->diffuse) sum += 0.2;
        return sum;
    }

    void say(const char* code, const PlacedLight& mine, std::size_t number,
             const std::string& what) {
        out_.push_back({code, Topic::lights,
                        "light " + std::to_string(number) + " " + what + inLine(mine.light->where),
                        mine.light->where});
    }

    void compare(const PlacedLight& theirs, const PlacedLight& mine, std::size_t number) {
        const scene::Light &wanted = *theirs.light, &given = *mine.light;
        if (wanted.type != given.type)
            return say("light.type", mine, number,
                       std::string("is a ") + wordOf(given.type) + " light, expected a " +
                           wordOf(wanted.type) + " light");
        if (wanted.space != given.space)
            say("light.space", mine, number, "moves with another space than expected");
        if (wanted.type != LightType::directional &&
            glm::length(theirs.position - mine.position) > kSameLength * size_)
            say("light.position", mine, number,
                "is at " + text(mine.position) + ", expected " + text(theirs.position));
        if (wanted.type != LightType::point) {
            const double along = cosine(theirs.direction, mine.direction);
            if (along < -kSameCos)
                say("light.direction-negated", mine, number,
                    "shines the opposite way: direction " + text(mine.direction) + ", expected " +
                        text(theirs.direction));
            else if (along < kSameCos)
                say("light.direction", mine, number,
                    "has direction " + text(mine.direction) + ", expected " +
                        text(theirs.direction));
        }
        if (wanted.type == LightType::spot) compareSpot(wanted, mine, number);
        if (wanted.type != LightType::directional &&
            std::abs(wanted.constant - given.constant) + std::abs(wanted.linear - given.linear) +
                    std::abs(wanted.quadratic - given.quadratic) >
                1e-6)
            say("light.attenuation", mine, number,
                "has attenuation " + text({given.constant, given.linear, given.quadratic}) +
                    ", expected " + text({wanted.constant, wanted.linear, wanted.quadratic}));
        const struct {
            const char* name;
            const scene::Color &theirs, &mine;
        } colors[] = {{"diffuse", wanted.diffuse, given.diffuse},
                      {"ambient", wanted.ambient, given.ambient},
                      {"specular", wanted.specular, given.specular}};
        for (const auto& one : colors) {
            const glm::vec3 apart = glm::abs(one.theirs.rgb - one.mine.rgb);
            if (one.theirs.cycles != one.mine.cycles ||
                std::max({apart.x, apart.y, apart.z}) > 1.0F / 255.0F)
                say("light.color", mine, number,
                    std::string("has ") + one.name + " " + levels(one.mine) + ", expected " +
                        levels(one.theirs));
        }
    }

    void compareSpot(const scene::Light& wanted, const PlacedLight& mine, std::size_t number) {
        const scene::Light& given = *mine.light;
        if (std::abs(wanted.cutoffDeg - given.cutoffDeg) > 1e-3) {
            const double degrees = given.cutoffDeg * 180.0 / std::numbers::pi;
            const bool radians = std::abs(degrees - wanted.cutoffDeg) < 0.02 * wanted.cutoffDeg;
            say(radians ? "light.cutoff-radians" : "light.cutoff", mine, number,
                (radians ? "has a cutoff that looks like radians: " : "has the spot cutoff ") +
                    shortNumber(given.cutoffDeg) + ", expected " + shortNumber(wanted.cutoffDeg) +
                    " degrees");
        }
        if (std::abs(wanted.exponent - given.exponent) > 1e-3)
            say("light.exponent", mine, number,
                "has the spot exponent " + shortNumber(given.exponent) + ", expected " +
                    shortNumber(wanted.exponent));
    }

    const std::vector<PlacedLight>&theirs_, &mine_;
    double size_ = 1.0;
    Findings out_;
};

}  // namespace

Findings compareLights(const Tree& reference, const Tree& submission) {
    return LightComparer(reference, submission).run();
}

Findings compareCameras(const scene::Camera& reference, const scene::Camera& submission,
                        double sceneSize) {
    Findings out;
    const auto say = [&](const char* code, const std::string& what) {
        out.push_back({code, Topic::camera, what + inLine(submission.where), submission.where});
    };
    if (glm::length(reference.eye - submission.eye) > kSameLength * sceneSize)
        say("camera.position",
            "the camera is at " + text(submission.eye) + ", expected " + text(reference.eye));
    const glm::dvec3 theirs = reference.target - reference.eye,
                     mine = submission.target - submission.eye;
    if (cosine(theirs, mine) < kSameCos) {
        // A camera that moved may still look at the same point: that is one fault, not two.
        if (glm::length(reference.target - submission.target) > kSameLength * sceneSize)
            say("camera.target", "the camera looks at " + text(submission.target) + ", expected " +
                                     text(reference.target));
    } else if (cosine(glm::cross(theirs, reference.up), glm::cross(mine, submission.up)) <
               kSameCos) {
        say("camera.up",
            "the camera's up is " + text(submission.up) + ", expected " + text(reference.up));
    }
    if (std::abs(reference.fovDeg - submission.fovDeg) > 1e-3) {
        const double degrees = submission.fovDeg * 180.0 / std::numbers::pi;
        const bool radians = std::abs(degrees - reference.fovDeg) < 0.02 * reference.fovDeg;
        say(radians ? "camera.fov-radians" : "camera.fov",
            (radians ? "the field of view looks like radians: " : "the field of view is ") +
                shortNumber(submission.fovDeg) + ", expected " + shortNumber(reference.fovDeg) +
                " degrees");
    }
    if (std::abs(reference.near - submission.near) > 1e-6 * reference.near ||
        std::abs(reference.far - submission.far) > 1e-6 * reference.far)
        say("camera.range", "near and far are " + shortNumber(submission.near) + " and " +
                                shortNumber(submission.far) + ", expected " +
                                shortNumber(reference.near) + " and " + shortNumber(reference.far));
    return out;
}

}  // namespace farol::grade
