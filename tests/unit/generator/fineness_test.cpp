#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "generator/registry.h"

using namespace farol;
using generator::Fineness;

namespace {

scene::Model shape(const std::vector<std::string>& words) {
    scene::Model model;
    model.source.kind = scene::ModelSource::Kind::shape;
    model.source.shape = generator::parseCall(words);
    return model;
}

/// Largest value of `distance` over points spread over the mesh's triangles.
template <typename Distance>
double worst(const generator::Mesh& mesh, Distance distance) {
    double most = 0.0;
    for (std::size_t i = 0; i < mesh.indices().size(); i += 3)
        for (const glm::dvec3& weights :
             {glm::dvec3(1.0 / 3), glm::dvec3(0.5, 0.5, 0), glm::dvec3(0, 0.5, 0.5),
              glm::dvec3(0.5, 0, 0.5), glm::dvec3(0.6, 0.2, 0.2), glm::dvec3(0.1, 0.3, 0.6)}) {
            glm::dvec3 point(0.0);
            for (int c = 0; c < 3; ++c)
                point +=
                    weights[c] *
                    glm::dvec3(mesh.positions()[mesh.indices()[i + static_cast<std::size_t>(c)]]);
            most = std::max(most, std::abs(distance(point)));
        }
    return most;
}

}  // namespace

TEST_CASE("the roundUpToStep has few steps, each at least what was asked") {
    for (double n = 1.0; n < 1024.0; n += 0.7) {
        const double step = generator::roundUpToStep(n);
        REQUIRE(step >= n);
        REQUIRE(step <= std::max(1.0, 1.51 * n));
        if (step >= 8.0) REQUIRE(std::fmod(step, 4.0) == 0.0);
    }
    CHECK(generator::roundUpToStep(1e9) == generator::kMaxDivisions);
}

TEST_CASE("what a scene writes is not open, what it leaves out or calls auto is") {
    CHECK(generator::isAdaptive(shape({"sphere", "1"})));
    CHECK(generator::isAdaptive(shape({"sphere", "1", "auto", "8"})));
    CHECK_FALSE(generator::isAdaptive(shape({"sphere", "1", "8", "8"})));
    CHECK_FALSE(generator::isAdaptive(shape({"box", "2"})));
    CHECK_FALSE(generator::isAdaptive(shape({"plane", "2"})));
    const generator::ShapeCall call =
        generator::refine(shape({"cone", "1", "2", "auto", "3"}), scene::BundleAssets(), {1e-3, 8});
    CHECK(call.count(3) == 3);
    CHECK(call.count(2) > 8);
}

TEST_CASE("chosen divisions keep the error, for any size and error") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> exponent(-3.0, 3.0);
    std::uniform_real_distribution<double> fraction(-3.5, -1.0);
    const scene::BundleAssets none;
    for (int i = 0; i < 60; ++i) {
        const double r = std::pow(10.0, exponent(random));
        const Fineness fine{r * std::pow(10.0, fraction(random)), 8};
        CAPTURE(r, fine.error);
        const std::string radius = std::to_string(r);
        const double exact = std::stod(radius);
        // A float of the position holds 6e-8 of the radius.
        const double bound = fine.error + 1e-6 * r;
        const auto make = [&](const std::vector<std::string>& words) {
            return generator::generate(generator::refine(shape(words), none, fine), none);
        };
        CHECK(worst(make({"sphere", radius}),
                    [&](const glm::dvec3& p) { return glm::length(p) - exact; }) <= bound);
        CHECK(worst(make({"torus", radius, std::to_string(r / 3)}), [&](const glm::dvec3& p) {
                  return std::hypot(std::hypot(p.x, p.z) - exact, p.y) -
                         std::stod(std::to_string(r / 3));
              }) <= bound);
        // Of the closed cylinder only the side is curved.
        CHECK(worst(make({"cylinder", radius, "1"}), [&](const glm::dvec3& p) {
                  return p.y > 1e-4 && p.y < 1.0 - 1e-4 ? std::hypot(p.x, p.z) - exact : 0.0;
              }) <= bound);
    }
}

TEST_CASE("the teapot's divisions follow the bound on its second derivatives") {
    const scene::BundleAssets none;
    const auto level = [&](double error) {
        return generator::refine(shape({"patch", "teapot.patch"}), none, {error, 8}).count(0);
    };
    CHECK(level(1.0) < level(0.01));
    CHECK(level(0.01) < level(0.0001));
    // Second order: a hundredth of the error needs ten times the divisions, within the
    // roundUpToStep's step.
    CHECK(level(0.0005) >= 6 * level(0.05));
    // Against a mesh so fine that it stands for the surface: same parameters, close points.
    const auto fine =
        generator::generate(generator::parseCall({"patch", "teapot.patch", "64"}), none);
    for (const double error : {0.1, 0.01}) {
        const auto mesh = generator::generate(
            generator::refine(shape({"patch", "teapot.patch"}), none, {error, 4}), none);
        double most = 0.0;
        for (std::size_t i = 0; i < fine.positions().size(); i += 997) {
            const glm::dvec3 p(fine.positions()[i]);
            double nearest = 1e9;
            for (std::size_t k = 0; k < mesh.indices().size(); k += 3) {
                const glm::dvec3 a(mesh.positions()[mesh.indices()[k]]);
                const glm::dvec3 b(mesh.positions()[mesh.indices()[k + 1]]);
                const glm::dvec3 c(mesh.positions()[mesh.indices()[k + 2]]);
                // Distance to the triangle: to its plane above its inside, else to its edges.
                const glm::dvec3 n = glm::cross(b - a, c - a);
                const double area = glm::length(n);
                if (area <= 0.0) continue;
                const glm::dvec3 unit = n / area;
                const glm::dvec3 q = p - unit * glm::dot(p - a, unit);
                const double u = glm::dot(glm::cross(c - b, q - b), unit) / area;
                const double v = glm::dot(glm::cross(a - c, q - c), unit) / area;
                if (u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9)
                    nearest = std::min(nearest, std::abs(glm::dot(p - a, unit)));
                else
                    for (const auto& [s, e] : {std::pair{a, b}, {b, c}, {c, a}}) {
                        const double t = glm::clamp(
                            glm::dot(p - s, e - s) / std::max(1e-300, glm::dot(e - s, e - s)), 0.0,
                            1.0);
                        nearest = std::min(nearest, glm::length(p - (s + t * (e - s))));
                    }
            }
            most = std::max(most, nearest);
        }
        CHECK(most <= error);
    }
}
