#pragma once

#include <functional>
#include <string>
#include <vector>

#include "grade/rubric/subject.h"

/// A solar system as text, and changes of it, for the tests of requirements.
namespace farol::test {

struct SolarScene {
    std::string name, xml;
    scene::BundleAssets::Files files;
    std::string unmet;  ///< id of the one requirement of api/examples/solar.json that is not met
    int line = 0;       ///< that shows why; 0: nothing stands there

    grade::Subject subject() const;
};

/// The scene that meets all.
SolarScene solarScene();
/// The same with one requirement missing each.
std::vector<SolarScene> solarMisses();
/// Scenes that meet all by other means: other hierarchies, names, meshes, dialects.
std::vector<SolarScene> otherSolarScenes();

}  // namespace farol::test
