#include "scene/loop.h"

#include <catch2/catch.hpp>

#include "scene/animation.h"

using namespace farol::scene;

namespace {

Scene turning(const std::vector<double>& seconds) {
    Scene scene;
    for (const double one : seconds)
        scene.groups.emplace_back().transforms.push_back(Spin{one, {0, 1, 0}});
    return scene;
}

}  // namespace

TEST_CASE("the loop of a scene is the least common multiple of its motions") {
    CHECK(loopSeconds(turning({})) == std::nullopt);
    CHECK(loopSeconds(turning({4})).value() == Approx(4.0));
    CHECK(loopSeconds(turning({4, -6})).value() == Approx(12.0));
    CHECK(loopSeconds(turning({0.5, 0.75})).value() == Approx(1.5));
    // 59 * 61 * 67 s is longer than an hour.
    CHECK(loopSeconds(turning({59, 61, 67})) == std::nullopt);
    Scene nested;
    nested.groups.emplace_back().groups.emplace_back().transforms.push_back(
        FollowCurve{10.0, false, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
    CHECK(loopSeconds(nested).value() == Approx(10.0));
}

TEST_CASE("hues that cycle are part of the loop") {
    Scene scene = turning({4});
    Model& model = scene.groups[0].models.emplace_back();
    model.material = Material{};
    model.material->emissive.cycles = true;
    CHECK(loopSeconds(scene).value() == Approx(12.0));  // with kHueSeconds = 6
}

TEST_CASE("after one loop every matrix is where it was") {
    const Scene scene = turning({4, -6, 0.5});
    const double loop = loopSeconds(scene).value();
    for (const Group& group : scene.groups)
        for (const double t : {0.0, 0.3, 1.7}) {
            const glm::dmat4 a = matrixAt(group.transforms, t);
            const glm::dmat4 b = matrixAt(group.transforms, t + loop);
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < 4; ++j) CHECK(a[i][j] == Approx(b[i][j]).margin(1e-9));
        }
}
