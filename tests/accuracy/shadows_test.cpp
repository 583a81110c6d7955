#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene/read/reader.h"
#include "tests/accuracy/pattern.h"
#include "tests/support/paths.h"
#include "tests/support/ray_caster/tracer.h"

// Shadow maps against the ray caster's hard shadows.
using namespace farol;
using namespace farol::accuracy;

namespace {

constexpr double kMostOff = 8.0;  // levels
constexpr int kBesidePx = 2;      // of a shadow's edge
constexpr double kLeastShare = 0.995;

struct Light {
    const char* name;
    std::string xml;
};

const std::vector<Light>& lights() {
    static const std::vector<Light> kLights = {
        {"directional", R"(<light type="directional" dirX="0.6" dirY="1" dirZ="0.4"/>)"},
        {"low", R"(<light type="directional" dirX="1" dirY="0.09" dirZ="0.35"/>)"},
        {"spot", R"(<light type="spot" posX="3" posY="4.5" posZ="2" dirX="-3" dirY="-4.5" dirZ="-2"
            cutoff="32"/>)"},
        {"point", R"(<light type="point" posX="1.7" posY="2.6" posZ="1.1"/>)"},
    };
    return kLights;
}

std::string group(const std::string& transform, const std::string& model) {
    return "<group><transform>" + transform + "</transform><models>" + model + "</models></group>";
}

std::string model(const std::string& command, const std::string& more = "") {
    return "<model command=\"" + command + "\" " + more + "/>";
}

std::string document(const std::string& light, const std::string& groups,
                     const std::string& camera = R"(<position x="2.5" y="2.6" z="4.2"/>
                         <lookAt y="0.4"/><projection fov="45" near="0.05" far="200"/>)") {
    return R"(<world><window width="320" height="320"/><render shadows="map" shading="phong"/>
        <camera>)" +
           camera + "</camera><lights>" + light + "</lights>" + groups + "</world>";
}

const std::string kFloor = group("", model("plane 12"));

struct Figures {
    int compared = 0, wrong = 0, shadowed = 0;
    int isolated = 0;  ///< wrong pixels of which at most two neighbours are wrong
    double share() const { return 1.0 - static_cast<double>(wrong) / std::max(1, compared); }
};

/// True within kBesidePx of a pixel of the same object that other lights reach.
bool isNearEdge(const reference::Picture& exact, int x, int y) {
    const std::size_t here = exact.at(x, y);
    for (int j = std::max(0, y - kBesidePx - 1); j <= std::min(exact.height - 1, y + kBesidePx + 1);
         ++j)
        for (int i = std::max(0, x - kBesidePx - 1);
             i <= std::min(exact.width - 1, x + kBesidePx + 1); ++i) {
            const std::size_t there = exact.at(i, j);
            if (exact.id[there] == exact.id[here] && exact.lit[there] != exact.lit[here])
                return true;
        }
    return false;
}

Figures compare(const std::string& xml, const render::PictureOptions& options,
                const Supplies& given = {}) {
    render::Job job;
    job.xml = xml;
    job.assets = given.assets ? given.assets : std::make_shared<scene::BundleAssets>();
    job.options = options;
    image::Image image;
    render::Renderer renderer;
    renderer.draw(job, image);
    const scene::Scene scene = scene::read(xml, {}, *job.assets).scene;
    reference::Options taken;
    taken.width = image.width;
    taken.height = image.height;
    taken.shadows = true;
    const reference::Picture exact =
        reference::traceCenters(reference::makeWorld(scene, given.files, taken));
    Figures figures;
    std::vector<int> state(exact.id.size(), 0);  // 1: right, 2: wrong
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::size_t at = exact.at(x, y);
            if (exact.id[at] == 0 || exact.edge[at] != reference::kInterior) continue;
            if (isNearEdge(exact, x, y)) continue;
            ++figures.compared;
            figures.shadowed += exact.lit[at] == 0 ? 1 : 0;
            const std::uint8_t* p = &image.pixels[4 * at];
            double off = 0.0;
            for (int c = 0; c < 3; ++c)
                off = std::max(off, std::abs(p[c] - 255.0 * exact.color[at][c]));
            state[at] = off > kMostOff ? 2 : 1;
            figures.wrong += off > kMostOff ? 1 : 0;
        }
    for (int y = 1; y + 1 < image.height; ++y)
        for (int x = 1; x + 1 < image.width; ++x) {
            if (state[exact.at(x, y)] != 2) continue;
            int others = 0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) others += state[exact.at(x + i, y + j)] == 2 ? 1 : 0;
            figures.isolated += others <= 3 ? 1 : 0;
        }
    return figures;
}

render::PictureOptions options(int samples = 1) {
    render::PictureOptions chosen;
    chosen.samples = samples;
    return chosen;
}

void print(const std::string& title, const Figures& figures) {
    std::printf("%-34s %6d px, %5d dark: %8.4f %% right, %d wrong, %d alone\n", title.c_str(),
                figures.compared, figures.shadowed, 100.0 * figures.share(), figures.wrong,
                figures.isolated);
}

void check(const std::string& title, const std::string& xml, const Supplies& given = {}) {
    const Figures figures = compare(xml, options(), given);
    print(title, figures);
    INFO(title);
    CHECK(figures.compared > 5000);
    CHECK(figures.share() >= kLeastShare);
    CHECK(figures.isolated <= figures.compared / 2000);
}

}  // namespace

TEST_CASE("shadows of each shape on a floor are those of the ray caster") {
    const std::string shapes[] = {
        group("<translate y=\"0.8\"/>", model("sphere 0.8")),
        group("<translate y=\"0.6\"/>", model("box 1.2")),
        group("", model("cone 0.9 1.5")),
        group("<translate y=\"0.75\"/>", model("cylinder 0.7 1.5")),
        group("<translate y=\"0.25\"/>", model("torus 0.8 0.25")),
        group("<translate y=\"0.9\"/><rotate angle=\"70\" x=\"1\" z=\"0.4\"/>",
              model("torus 0.8 0.2")),
        group("<translate y=\"0.5\"/><scale x=\"1.4\" y=\"0.5\"/>", model("sphere 1")),
        group("", model("dome 1")),
    };
    const char* names[] = {"sphere",      "box",         "cone",      "cylinder",
                           "torus lying", "torus stood", "ellipsoid", "dome"};
    for (std::size_t i = 0; i < std::size(shapes); ++i)
        for (const Light& light : lights())
            check(std::string(names[i]) + " " + light.name,
                  document(light.xml, kFloor + shapes[i]));
}

TEST_CASE("shadows are as right with several samples a pixel") {
    // Pixels that two triangles share are lit at samples off their middle.
    const std::string content = group("<translate x=\"-0.6\" y=\"0.6\"/>", model("sphere 0.6")) +
                                group("<translate x=\"0.8\" y=\"0.5\"/>", model("box 1 1 0.8")) +
                                group("<translate y=\"0.5\" z=\"-1.2\"/>", model("cylinder 0.4 1"));
    for (const int samples : {4, 8, 16})
        for (const Light& light : lights()) {
            const std::string title =
                "aa=" + std::to_string(samples) + " " + std::string(light.name);
            const Figures figures =
                compare(document(light.xml, kFloor + content), options(samples));
            print(title, figures);
            INFO(title);
            CHECK(figures.share() >= kLeastShare);
            CHECK(figures.isolated <= figures.compared / 2000);
        }
}

TEST_CASE("shadows on curved receivers, thin walls and what stands in contact") {
    const std::string bowl = group("<rotate angle=\"180\" x=\"1\"/><translate y=\"-1\"/>",
                                   model("dome 1", "twoSided=\"true\""));
    const std::string wall = group("<translate x=\"-0.3\" y=\"0.6\"/>", model("box 0.01 1.2 1.6"));
    const std::string sheet =
        group("<translate x=\"0.4\" y=\"0.5\"/><rotate angle=\"90\" z=\"1\"/>", model("plane 1"));
    const std::string stack = group("<translate y=\"0.25\"/>", model("box 1.4 0.5 1.4")) +
                              group("<translate y=\"0.75\"/>", model("box 1 0.5 1")) +
                              group("<translate y=\"1.4\"/>", model("sphere 0.4"));
    const std::string balls = group("<translate x=\"-0.5\" y=\"0.5\"/>", model("sphere 0.5")) +
                              group("<translate x=\"0.5\" y=\"0.5\"/>", model("sphere 0.5")) +
                              group("<translate y=\"0.3\" z=\"0.75\"/>", model("sphere 0.3"));
    const std::string cave = group("<translate y=\"1\"/>", model("torus 1 0.6")) +
                             group("<translate y=\"0.2\"/>", model("sphere 0.2"));
    const std::string saturn =
        group("<translate y=\"1\"/>", model("sphere 0.7")) +
        group("<translate y=\"1\"/><rotate angle=\"20\" x=\"1\"/>", model("ring 0.9 1.5"));
    const std::string room =
        group("<translate y=\"1.5\" z=\"-1\"/><rotate angle=\"90\" x=\"1\"/>", model("plane 6")) +
        group("<translate y=\"0.5\" z=\"-0.5\"/>", model("cone 0.3 1"));
    const std::pair<const char*, const std::string*> rows[] = {
        {"wall of 0.01", &wall},     {"single sheet", &sheet},
        {"stack", &stack},           {"balls in contact", &balls},
        {"ball in a torus", &cave},  {"planet and ring", &saturn},
        {"corner of a room", &room}, {"bowl", &bowl}};
    for (const auto& [name, groups] : rows)
        for (const Light& light : lights())
            check(std::string(name) + " " + light.name, document(light.xml, kFloor + *groups));
}

TEST_CASE("shadows do not depend on the place and the size of the scene") {
    const std::string content = kFloor + group("<translate y=\"0.8\"/>", model("sphere 0.8")) +
                                group("<translate x=\"1.4\" y=\"0.4\"/>", model("box 0.8"));
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
            for (const std::string& light : {lights()[0].xml, lights()[1].xml, spot, lamp})
                check("size " + number(size) + " at " + number(away) + light.substr(12, 12),
                      document(light,
                               "<group><transform><translate " +
                                   place("x", "y", "z", 0.0, 0.0, 0.0) + "/><scale x=\"" +
                                   number(size) + "\" y=\"" + number(size) + "\" z=\"" +
                                   number(size) + "\"/></transform>" + content + "</group>",
                               camera));
        }
}
