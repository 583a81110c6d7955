#pragma once

#include <string>
#include <vector>

// Shadow maps against the ray caster's hard shadows.
namespace farol::accuracy {

struct NamedLight {
    const char* name;
    std::string xml;
};

/// A high and a low sun, a spot and a lamp.
const std::vector<NamedLight>& shadowLights();

std::string shadowGroup(const std::string& transform, const std::string& model);
std::string shadowModel(const std::string& command, const std::string& more = "");
/// A scene with shadows, 320 x 320 px.
std::string shadowDocument(const std::string& light, const std::string& groups,
                           const std::string& camera = R"(<position x="2.5" y="2.6" z="4.2"/>
                               <lookAt y="0.4"/><projection fov="45" near="0.05" far="200"/>)");

/// Draws the scene by both, prints the shares of right pixels, and checks them against the bar.
/// Outlines and pixels within two of a shadow's edge are left out. Returns the number of maps.
int checkShadows(const std::string& title, const std::string& xml, int samples = 1);

}  // namespace farol::accuracy
