#include <catch2/catch.hpp>
#include <cstdio>
#include <string>

#include "tests/accuracy/shadow_figures.h"

// Shadow maps of scenes at hand.
using namespace farol::accuracy;

namespace {

const std::string kFloor = shadowGroup("", shadowModel("plane 12"));

}  // namespace

TEST_CASE("shadows of each shape on a floor are those of the ray caster") {
    const std::string shapes[] = {
        shadowGroup("<translate y=\"0.8\"/>", shadowModel("sphere 0.8")),
        shadowGroup("<translate y=\"0.6\"/>", shadowModel("box 1.2")),
        shadowGroup("", shadowModel("cone 0.9 1.5")),
        shadowGroup("<translate y=\"0.75\"/>", shadowModel("cylinder 0.7 1.5")),
        shadowGroup("<translate y=\"0.25\"/>", shadowModel("torus 0.8 0.25")),
        shadowGroup("<translate y=\"0.9\"/><rotate angle=\"70\" x=\"1\" z=\"0.4\"/>",
                    shadowModel("torus 0.8 0.2")),
        shadowGroup("<translate y=\"0.5\"/><scale x=\"1.4\" y=\"0.5\"/>", shadowModel("sphere 1")),
        shadowGroup("", shadowModel("dome 1")),
    };
    const char* names[] = {"sphere",      "box",         "cone",      "cylinder",
                           "torus lying", "torus stood", "ellipsoid", "dome"};
    for (std::size_t i = 0; i < std::size(shapes); ++i)
        for (const NamedLight& light : shadowLights())
            checkShadows(std::string(names[i]) + " " + light.name,
                         shadowDocument(light.xml, kFloor + shapes[i]));
}

TEST_CASE("shadows are as right with several samples a pixel") {
    // Pixels that two triangles share are lit at samples off their middle.
    const std::string content =
        shadowGroup("<translate x=\"-0.6\" y=\"0.6\"/>", shadowModel("sphere 0.6")) +
        shadowGroup("<translate x=\"0.8\" y=\"0.5\"/>", shadowModel("box 1 1 0.8")) +
        shadowGroup("<translate y=\"0.5\" z=\"-1.2\"/>", shadowModel("cylinder 0.4 1"));
    for (const int samples : {4, 8, 16})
        for (const NamedLight& light : shadowLights()) {
            const std::string title =
                "aa=" + std::to_string(samples) + " " + std::string(light.name);
            checkShadows(title, shadowDocument(light.xml, kFloor + content), samples);
        }
}

TEST_CASE("shadows on curved receivers, thin walls and what stands in contact") {
    const std::string bowl = shadowGroup("<rotate angle=\"180\" x=\"1\"/><translate y=\"-1\"/>",
                                         shadowModel("dome 1", "twoSided=\"true\""));
    const std::string wall =
        shadowGroup("<translate x=\"-0.3\" y=\"0.6\"/>", shadowModel("box 0.01 1.2 1.6"));
    const std::string sheet = shadowGroup(
        "<translate x=\"0.4\" y=\"0.5\"/><rotate angle=\"90\" z=\"1\"/>", shadowModel("plane 1"));
    const std::string stack =
        shadowGroup("<translate y=\"0.25\"/>", shadowModel("box 1.4 0.5 1.4")) +
        shadowGroup("<translate y=\"0.75\"/>", shadowModel("box 1 0.5 1")) +
        shadowGroup("<translate y=\"1.4\"/>", shadowModel("sphere 0.4"));
    const std::string balls =
        shadowGroup("<translate x=\"-0.5\" y=\"0.5\"/>", shadowModel("sphere 0.5")) +
        shadowGroup("<translate x=\"0.5\" y=\"0.5\"/>", shadowModel("sphere 0.5")) +
        shadowGroup("<translate y=\"0.3\" z=\"0.75\"/>", shadowModel("sphere 0.3"));
    const std::string cave = shadowGroup("<translate y=\"1\"/>", shadowModel("torus 1 0.6")) +
                             shadowGroup("<translate y=\"0.2\"/>", shadowModel("sphere 0.2"));
    const std::string saturn = shadowGroup("<translate y=\"1\"/>", shadowModel("sphere 0.7")) +
                               shadowGroup("<translate y=\"1\"/><rotate angle=\"20\" x=\"1\"/>",
                                           shadowModel("ring 0.9 1.5"));
    const std::string room =
        shadowGroup("<translate y=\"1.5\" z=\"-1\"/><rotate angle=\"90\" x=\"1\"/>",
                    shadowModel("plane 6")) +
        shadowGroup("<translate y=\"0.5\" z=\"-0.5\"/>", shadowModel("cone 0.3 1"));
    const std::pair<const char*, const std::string*> rows[] = {
        {"wall of 0.01", &wall},     {"single sheet", &sheet},
        {"stack", &stack},           {"balls in contact", &balls},
        {"ball in a torus", &cave},  {"planet and ring", &saturn},
        {"corner of a room", &room}, {"bowl", &bowl}};
    for (const auto& [name, groups] : rows)
        for (const NamedLight& light : shadowLights())
            checkShadows(std::string(name) + " " + light.name,
                         shadowDocument(light.xml, kFloor + *groups));
}

TEST_CASE("shadows do not depend on the place and the size of the scene") {
    const std::string content =
        kFloor + shadowGroup("<translate y=\"0.8\"/>", shadowModel("sphere 0.8")) +
        shadowGroup("<translate x=\"1.4\" y=\"0.4\"/>", shadowModel("box 0.8"));
    for (const double size : {0.01, 1.0, 100.0})
        for (const double away : {0.0, 1e3}) {
            if (size < 1.0 && away > 0.0) continue;  // positions of the document are decimals
            const auto number = [&](double value) {
                char text[32];
                std::snprintf(text, sizeof text, "%.9g", value);
                return std::string(text);
            };
            const auto place = [&](const char* x, const char* y, const char* z, double at,
                                   double up, double to) {
                return std::string(x) + "=\"" + number(away + size * at) + "\" " + y + "=\"" +
                       number(size * up) + "\" " + z + "=\"" + number(-away + size * to) + "\"";
            };
            const std::string camera = "<position " + place("x", "y", "z", 2.5, 2.6, 4.2) +
                                       "/><lookAt " + place("x", "y", "z", 0.0, 0.4, 0.0) +
                                       "/><projection fov=\"45\" near=\"" + number(0.05 * size) +
                                       "\" far=\"" + number(200.0 * size) + "\"/>";
            const std::string lamp =
                "<light type=\"point\" " + place("posX", "posY", "posZ", 1.7, 2.6, 1.1) + "/>";
            const std::string spot = "<light type=\"spot\" " +
                                     place("posX", "posY", "posZ", 3.0, 4.5, 2.0) +
                                     R"( dirX="-3" dirY="-4.5" dirZ="-2" cutoff="32"/>)";
            for (const std::string& light :
                 {shadowLights()[0].xml, shadowLights()[1].xml, spot, lamp})
                checkShadows(
                    "size " + number(size) + " at " + number(away) + light.substr(12, 12),
                    shadowDocument(light,
                                   "<group><transform><translate " +
                                       place("x", "y", "z", 0.0, 0.0, 0.0) + "/><scale x=\"" +
                                       number(size) + "\" y=\"" + number(size) + "\" z=\"" +
                                       number(size) + "\"/></transform>" + content + "</group>",
                                   camera));
        }
}
