// Resolving many models: time in proportion to their number.
#include <catch2/catch.hpp>
#include <ctime>

#include "generator/registry.h"
#include "scene/files/assets.h"

using namespace farol;

namespace {

double secondsToResolve(scene::Scene& scene, const scene::Assets& assets) {
    Diagnostics diagnostics;
    const std::clock_t begin = std::clock();
    generator::resolve(scene, assets, diagnostics);
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

scene::Scene manyModels(int count) {
    scene::Scene scene;
    auto& models = scene.groups.emplace_back().models;
    for (int i = 0; i < count; ++i)
        models.emplace_back().file = std::string(40, 'm') + std::to_string(i) + ".3d";
    return scene;
}

}  // namespace

TEST_CASE("models whose files are missing take a look-up each") {
    // 0.3 s; listing the files and comparing names for each of them takes minutes.
    scene::BundleAssets::Files files;
    for (int i = 0; i < 5'000; ++i) files[std::string(40, 'f') + std::to_string(i) + ".3d"] = "x";
    scene::Scene scene = manyModels(15'000);
    CHECK(secondsToResolve(scene, scene::BundleAssets(files)) < 5);
}

TEST_CASE("generator comments take a look-up each, whatever their case") {
    // 0.1 s; comparing each name with each comment takes 5 s and more.
    scene::Scene scene = manyModels(15'000);
    for (int i = 0; i < 15'000; ++i)
        scene.generatorComments[std::string(40, 'M') + std::to_string(i) + ".3d"] = {"box", "1"};
    CHECK(secondsToResolve(scene, scene::BundleAssets()) < 3);
    CHECK(scene.groups[0].models[7].source.shape == generator::parseCall({"box", "1"}));
}
