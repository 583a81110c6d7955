#include <catch2/catch.hpp>
#include <iostream>

#include "tests/numerics/random_scene.h"
#include "tests/support/mismatch.h"

// Random scenes of any size, anywhere, against the ray caster and against each other.
using namespace farol;
using namespace farol::numerics;

namespace {

constexpr int kSide = 256;
constexpr int kMaxObjects = 30;
constexpr double kShare = 0.999;  ///< of pixels within 2 levels

int objects(Sweep& sweep) { return 1 + static_cast<int>(sweep.between(0.0, kMaxObjects)); }

glm::dvec3 direction(Sweep& sweep) {
    const double x = sweep.between(-1, 1), y = sweep.between(-1, 1);
    return {x, y, sweep.between(-1, 1)};
}

}  // namespace

TEST_CASE("random scenes of any size, anywhere, show what rays show") {
    Sweep sweep("random scenes", 6);
    int bad = 0, crowded = 0;
    std::int64_t inside = 0, off = 0, beside = 0;
    double least = 1.0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const double size = sweep.power(1e-6, 1e6);
        const RandomScene scene(sweep, size, objects(sweep));
        Wording wording;
        // Up to 1e9, and as far as doubles tell a scene's places apart.
        const double farthest = std::min(1e9, 1e9 * size) / scene.grid();
        if (sweep.chance(0.7))
            wording.move = direction(sweep) * sweep.power(1e-6 * farthest, farthest);
        const std::string xml = scene.xml(wording);
        test::Mismatch mismatch = test::mismatchOf(xml, draw(xml, kSide));
        // Outlines, which may be 0.25 px off, are half as much of an image twice as wide.
        const bool isCrowded = mismatch.share() < kShare;
        if (isCrowded) mismatch = test::mismatchOf(xml, draw(xml, 2 * kSide));
        crowded += isCrowded ? 1 : 0;
        least = std::min(least, mismatch.share());
        inside += mismatch.inside;
        off += mismatch.insideOff;
        beside += mismatch.beside;
        const int wrong = mismatch.insideOff - mismatch.beside;
        if (mismatch.share() >= kShare && wrong == 0) continue;
        if (++bad <= 5)
            UNSCOPED_INFO(100.0 * mismatch.share()
                          << " % within 2 levels, " << wrong
                          << " px off inside outlines, the worst by " << mismatch.worst << " at "
                          << mismatch.worstX << ',' << mismatch.worstY << ": " << xml);
    }
    std::cout << sweep.cases() << " scenes, " << crowded << " of them at " << 2 * kSide << " px; "
              << bad << " wrong; least share " << 100.0 * least << " %, " << off << " of " << inside
              << " px inside outlines off, " << beside << " of them beside an outline" << std::endl;
    CHECK(bad == 0);
}

TEST_CASE("random scenes moved by 1 to 1e9 are the same, byte for byte") {
    Sweep sweep("moves", 6);
    int bad = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const RandomScene scene(sweep, sweep.power(1.0, 8.0), objects(sweep));
        const image::Image here = draw(scene.xml(), kSide / 2);
        Wording far;
        // On the grid: doubles hold every sum.
        far.move = glm::round(direction(sweep) * sweep.power(1.0, 1e9) / scene.grid());
        const std::string xml = scene.xml(far);
        if (draw(xml, kSide / 2).pixels != here.pixels && ++bad <= 5) UNSCOPED_INFO(xml);
    }
    CHECK(bad == 0);
}

TEST_CASE("random scenes moved off the grid of doubles differ by roundings alone") {
    Sweep sweep("moves off the grid", 6);
    int bad = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const RandomScene scene(sweep, sweep.power(1.0, 8.0), objects(sweep));
        const image::Image here = draw(scene.xml(), kSide / 2);
        Wording far;
        far.move = direction(sweep) * sweep.power(1.0, 1e9) / scene.grid();
        const std::string xml = scene.xml(far);
        const image::Image there = draw(xml, kSide / 2);
        int off = 0;
        for (std::size_t at = 0; at < here.pixels.size(); ++at)
            off += std::abs(here.pixels[at] - there.pixels[at]) > 2 ? 1 : 0;
        // A rounding of 1e-7 of the scene's size puts hardly any sample on the other side of an
        // outline.
        if (off > 12 && ++bad <= 5) UNSCOPED_INFO(off << " values differ: " << xml);
    }
    CHECK(bad == 0);
}

TEST_CASE("random scenes are the same, byte for byte, in other words") {
    Sweep sweep("rewordings", 5);
    int bad = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        // No shape gets shorter than 1e-6, 2^-12 times as large.
        const RandomScene scene(sweep, sweep.power(1.0, 1e3), objects(sweep));
        const image::Image plain = draw(scene.xml(), kSide / 2);
        const auto check = [&](const char* name, const Wording& wording) {
            const std::string xml = scene.xml(wording);
            if (draw(xml, kSide / 2).pixels != plain.pixels && ++bad <= 5)
                UNSCOPED_INFO(name << ": " << xml);
        };
        Wording turned, longer, split, larger;
        turned.turns = 1 + static_cast<int>(sweep.between(0.0, 20.0));
        check("whole turns", turned);
        longer.axisLength = std::exp2(std::floor(sweep.between(-20.0, 20.0)));
        check("longer axes", longer);
        split.isSplit = true;
        check("split groups and moves", split);
        larger.power = static_cast<int>(sweep.between(-12.0, 13.0));
        check("a power of two", larger);
    }
    CHECK(bad == 0);
}
