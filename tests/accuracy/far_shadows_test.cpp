#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <string>

#include "tests/accuracy/shadow_figures.h"

// Shadow maps of views that reach far: models at hand beside others to the horizon.
using namespace farol::accuracy;

namespace {

struct Sun {
    const char* name;
    const char* towards;
};

/// To a camera that looks along -Z.
constexpr Sun kSuns[] = {{"high", R"(dirX="0.5" dirY="1" dirZ="0.4")"},
                         {"from behind", R"(dirX="0.2" dirY="0.5" dirZ="1")"},
                         {"low, ahead", R"(dirX="0.3" dirY="0.2" dirZ="-1")"},
                         {"low, beside", R"(dirX="1" dirY="0.15" dirZ="0.1")"}};

std::string sunOf(const Sun& sun) {
    return std::string(R"(<light type="directional" )") + sun.towards + "/>";
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

std::string at(double x, double y, double z, const std::string& model) {
    return shadowGroup(
        "<translate x=\"" + number(x) + "\" y=\"" + number(y) + "\" z=\"" + number(z) + "\"/>",
        model);
}

std::string tree(double x, double z, double size) {
    return at(x, 0.5 * size, z,
              shadowModel("cylinder " + number(0.08 * size) + " " + number(size))) +
           at(x, 0.6 * size, z, shadowModel("cone " + number(0.4 * size) + " " + number(size)));
}

/// Near a tree, and on to those that a pixel hides.
std::string trees() {
    std::string groups;
    for (int i = 0; i < 24; ++i) {
        const double away = 3.0 * std::pow(1.28, i);
        groups += tree(away * 0.55 * std::sin(2.4 * i), -away, 2.0 + 0.01 * away);
    }
    return groups;
}

std::string floorOf(double side) { return shadowGroup("", shadowModel("plane " + number(side))); }

std::string camera(
    const std::string& more = R"(<position y="1.7" z="1"/><lookAt y="1.2" z="-5"/>)") {
    return more + R"(<projection fov="50" near="0.1" far="4000"/>)";
}

}  // namespace

TEST_CASE("far shadows of trees on a ground to the horizon are those of the ray caster") {
    for (const Sun& sun : kSuns) {
        std::string xml = shadowDocument(sunOf(sun), floorOf(4000) + trees(), camera());
        CHECK(checkShadows(std::string("trees ") + sun.name, xml) > 1);
        const std::string small = R"(<window width="320" height="320"/>)";
        xml.replace(xml.find(small), small.size(), R"(<window width="960" height="540"/>)");
        checkShadows(std::string("trees, 960 x 540 ") + sun.name, xml);
    }
}

TEST_CASE("far shadows of models at hand beside a far one are those of the ray caster") {
    const std::string near = at(0, 0.5, -3, shadowModel("sphere 0.5")) +
                             at(1.2, 0.4, -4, shadowModel("box 0.8")) +
                             at(-1.3, 0.6, -4.5, shadowModel("torus 0.5 0.1"));
    for (const double away : {50.0, 500.0, 3000.0})
        for (const Sun& sun : kSuns)
            checkShadows("far ball " + number(away) + " " + sun.name,
                         shadowDocument(sunOf(sun),
                                        floorOf(30) + near +
                                            at(0.2 * away, 0.1 * away, -away,
                                               shadowModel("sphere " + number(0.1 * away))),
                                        camera()));
}

TEST_CASE("far shadows on a wide floor that casts, before hills, are those of the ray caster") {
    std::string groups = floorOf(3000) + trees() + at(0, -8, -20, shadowModel("box 4"));
    for (int i = 0; i < 6; ++i)
        groups += shadowGroup("<translate x=\"" + number(-500 + 220.0 * i) + "\" z=\"" +
                                  number(-600 - 90.0 * (i % 3)) +
                                  "\"/><scale x=\"150\" y=\"60\" z=\"100\"/>",
                              shadowModel("sphere 1"));
    for (const Sun& sun : kSuns)
        checkShadows(std::string("hills ") + sun.name,
                     shadowDocument(sunOf(sun), groups, camera()));
}

TEST_CASE("far shadows along a colonnade and from above are those of the ray caster") {
    std::string columns = floorOf(2000);
    for (int i = 0; i < 40; ++i)
        for (const double x : {-2.0, 2.0})
            columns += at(x, 1.5, -3.0 * i, shadowModel("cylinder 0.3 3"));
    for (const Sun& sun : kSuns) {
        checkShadows(std::string("columns ") + sun.name,
                     shadowDocument(sunOf(sun), columns, camera()));
        checkShadows(std::string("from above ") + sun.name,
                     shadowDocument(sunOf(sun), floorOf(4000) + trees(),
                                    camera(R"(<position x="3" y="12" z="4"/><lookAt z="-6"/>)")));
    }
}
