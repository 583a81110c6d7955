// Properties of every row of the table of shapes.
#include <catch2/catch.hpp>
#include <set>

#include "core/number.h"
#include "core/text.h"
#include "tests/unit/generator/checks.h"

using namespace checks;
using namespace farol;
using generator::Argument;
using generator::ShapeEntry;
using scene::UvLayout;

namespace {

const scene::BundleAssets kProfiles(scene::BundleAssets::Files{
    {"p.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
     "property float y\nproperty float z\nend_header\n"
     "0 0 0\n1 0.5 0\n0 2 0\n"}});

/// The shape with its usual sizes and all divisions left out.
generator::ShapeCall usualCall(const ShapeEntry& shape) {
    std::vector<std::string> words{shape.name};
    if (shape.takesFile) words.push_back(shape.builtinFile.empty() ? "p.ply" : shape.builtinFile);
    for (std::size_t i = 0; i < shape.required; ++i)
        words.push_back(farol::formatNumber(shape.arguments[i].usual));
    return generator::parseCall(words);
}

}  // namespace

TEST_CASE("shapes have different names, and arguments with a range that holds their defaults") {
    std::set<std::string> names;
    for (const ShapeEntry& shape : generator::shapes()) {
        CAPTURE(shape.name);
        CHECK(names.insert(shape.name).second);
        CHECK(generator::findShape(shape.name) == &shape);
        for (const std::string& alias : shape.aliases) {
            CHECK(names.insert(alias).second);
            CHECK(generator::findShape(alias) == &shape);
        }
        CHECK(shape.name == lowerCase(shape.name));
        CHECK_FALSE(shape.summary.empty());
        REQUIRE(shape.required <= shape.arguments.size());
        REQUIRE(shape.generate != nullptr);
        REQUIRE(shape.count != nullptr);
        for (std::size_t i = 0; i < shape.arguments.size(); ++i) {
            const Argument& argument = shape.arguments[i];
            CAPTURE(argument.name);
            CHECK_FALSE(argument.help.empty());
            CHECK(argument.min < argument.max);
            const double value = i < shape.required ? argument.usual : argument.fallback;
            CHECK(value >= argument.min);
            CHECK(value <= argument.max);
            if (argument.isLevel()) CHECK(shape.bound != nullptr);
        }
    }
}

TEST_CASE("every shape's mesh is as its entry says, in each texture layout") {
    for (const ShapeEntry& shape : generator::shapes()) {
        CAPTURE(shape.name);
        const generator::ShapeCall call = usualCall(shape);
        const std::size_t most = generator::countTriangles(call, kProfiles);
        std::optional<Mesh> first;
        for (const UvLayout uv : {UvLayout::face, UvLayout::atlas, UvLayout::layout2017}) {
            const Mesh mesh = generator::generate(call, kProfiles, uv);
            CHECK(mesh.triangles() > 0);
            CHECK(mesh.triangles() <= most);
            if (!shape.takesFile) CHECK(mesh.triangles() == most);
            REQUIRE(mesh.normals().size() == mesh.positions().size());
            REQUIRE(mesh.uvs().size() == mesh.positions().size());
            double worstNormal = 0.0, worstUv = 0.0;
            for (const glm::vec3& normal : mesh.normals())
                worstNormal = std::max(worstNormal, std::abs(1.0 - glm::length(dvec3(normal))));
            for (const glm::vec2& at : mesh.uvs())
                for (const float coordinate : {at.x, at.y})
                    worstUv = std::max({worstUv, -double{coordinate}, coordinate - 1.0});
            CHECK(worstNormal < 1e-6);
            CHECK(worstUv <= 0.0);
            if (!first) first = mesh;
            // Where the seam is may differ; how large the shape is may not.
            CHECK(area(mesh) == Approx(area(*first)));
        }
        // Normals point to the side from which the corners run counter-clockwise.
        for (std::size_t t = 0; t < first->triangles(); ++t) {
            const auto [a, b, c] = corners(*first, t);
            dvec3 normal(0.0);
            for (std::size_t k = 0; k < 3; ++k)
                normal += dvec3(first->normals()[first->indices()[3 * t + k]]);
            if (glm::dot(glm::cross(b - a, c - a), normal) <= 0.0) FAIL_CHECK("triangle " << t);
        }
    }
}

TEST_CASE("a finer bound makes more divisions, within their range") {
    for (const ShapeEntry& shape : generator::shapes()) {
        if (shape.bound == nullptr) continue;
        CAPTURE(shape.name);
        scene::Model model;
        model.source.kind = scene::ModelSource::Kind::shape;
        model.source.shape = usualCall(shape);
        REQUIRE(generator::isAdaptive(model));
        const auto triangles = [&](double error) {
            return generator::countTriangles(generator::refine(model, kProfiles, {error, 8}),
                                             kProfiles);
        };
        CHECK(triangles(1e-4) > triangles(1e-2));
        model.autoLod = true;
        CHECK(generator::isAdaptive(model));
        if (const auto surface = generator::surfaceOf(model)) {
            CHECK(surface->lengths.x > 0.0);
            CHECK(generator::fullTurnOf(model.source.shape) >= 8.0);
            CHECK(generator::balancedScale(model.source.shape).x >= 1.0);
        }
    }
}

TEST_CASE("the text of a call parses to the same call") {
    for (const char* text :
         {"plane 2", "box 2 3", "box 1 2 3", "sphere 1 auto 8", "sphere 1 8 auto", "cone 0.1 1e-06",
          "torus 123456789 0.30000000000000004e8 3", "patch teapot.patch auto", "ring 0 1"}) {
        CAPTURE(text);
        const generator::ShapeCall call = generator::parseCall(words(text));
        CHECK(generator::parseCall(words(generator::textOf(call))) == call);
    }
    CHECK(generator::textOf(generator::parseCall(words("CUBE 2.50 +3"))) == "box 2.5 3");
    CHECK(generator::textOf(generator::parseCall(words("sphere 1 auto 8"))) == "sphere 1 auto 8");
    CHECK(generator::textOf(generator::parseCall({"patch", "a 1"})) !=
          generator::textOf(generator::parseCall({"patch", "a", "1"})));
}
