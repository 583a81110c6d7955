#include "tests/accuracy/shadow_figures.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <memory>

#include "render/renderer.h"
#include "scene/read/reader.h"
#include "tests/support/ray_caster/tracer.h"

namespace farol::accuracy {
namespace {

constexpr double kMostOff = 8.0;  // levels
constexpr int kBesidePx = 2;      // of a shadow's edge
constexpr double kLeastShare = 0.995;

struct Figures {
    int compared = 0, wrong = 0, shadowed = 0;
    int isolated = 0;  ///< wrong pixels of which at most two neighbours are wrong
    int maps = 0;
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

Figures compare(const std::string& xml, int samples) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>();
    job.options.samples = samples;
    image::Image image;
    render::Renderer renderer;
    Figures figures;
    figures.maps = renderer.draw(job, image).stats.shadowMaps;
    const scene::Scene scene = scene::read(xml, {}, *job.assets).scene;
    reference::Options taken;
    taken.width = image.width;
    taken.height = image.height;
    taken.shadows = true;
    const reference::Picture exact =
        reference::traceCenters(reference::makeWorld(scene, {}, taken));
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

}  // namespace

const std::vector<NamedLight>& shadowLights() {
    static const std::vector<NamedLight> kLights = {
        {"directional", R"(<light type="directional" dirX="0.6" dirY="1" dirZ="0.4"/>)"},
        {"low", R"(<light type="directional" dirX="1" dirY="0.09" dirZ="0.35"/>)"},
        {"spot", R"(<light type="spot" posX="3" posY="4.5" posZ="2" dirX="-3" dirY="-4.5" dirZ="-2"
            cutoff="32"/>)"},
        {"point", R"(<light type="point" posX="1.7" posY="2.6" posZ="1.1"/>)"},
    };
    return kLights;
}

std::string shadowGroup(const std::string& transform, const std::string& model) {
    return "<group><transform>" + transform + "</transform><models>" + model + "</models></group>";
}

std::string shadowModel(const std::string& command, const std::string& more) {
    return "<model command=\"" + command + "\" " + more + "/>";
}

std::string shadowDocument(const std::string& light, const std::string& groups,
                           const std::string& camera) {
    return R"(<world><window width="320" height="320"/><render shadows="map" shading="phong"/>
        <camera>)" +
           camera + "</camera><lights>" + light + "</lights>" + groups + "</world>";
}

int checkShadows(const std::string& title, const std::string& xml, int samples) {
    const Figures figures = compare(xml, samples);
    std::printf("%-34s %2d maps %6d px, %5d dark: %8.4f %% right, %d wrong, %d alone\n",
                title.c_str(), figures.maps, figures.compared, figures.shadowed,
                100.0 * figures.share(), figures.wrong, figures.isolated);
    INFO(title);
    CHECK(figures.compared > 5000);
    CHECK(figures.share() >= kLeastShare);
    CHECK(figures.isolated <= figures.compared / 2000);
    return figures.maps;
}

}  // namespace farol::accuracy
