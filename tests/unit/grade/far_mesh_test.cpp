// A mesh that is far from the origin of its file for its size is graded where it is drawn.
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <string>

#include "grade/rubric/grader.h"
#include "scene/files/assets.h"

using namespace farol;

namespace {

constexpr int kAway = 1'000'000;  // of a mesh of 3

std::string meshAt(int x) {
    const auto vertex = [x](int dx, const char* yz) { return "v " + std::to_string(x + dx) + yz; };
    return vertex(0, " 0 0\n") + vertex(2, " 0 0\n") + vertex(0, " 1 0\n") + vertex(0, " 0 3\n") +
           "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

/// A scene that looks at kAway; its mesh is at `meshX` of its file, in a group moved by `groupX`.
grade::Subject subjectOf(int meshX, int groupX) {
    grade::Subject subject;
    subject.job.name = "scene.xml";
    subject.job.xml = "<world><camera><position x=\"" + std::to_string(kAway + 3) +
                      "\" y=\"4\" z=\"9\"/><lookAt x=\"" + std::to_string(kAway) +
                      "\" y=\"0\" z=\"0\"/></camera><lights><light type=\"directional\" "
                      "dirx=\"1\" diry=\"2\" dirz=\"3\"/></lights><group><transform><translate "
                      "x=\"" +
                      std::to_string(groupX) +
                      "\" y=\"0\" z=\"0\"/></transform><models><model file=\"mesh.obj\"/></models>"
                      "</group></world>";
    subject.job.assets = std::make_shared<scene::BundleAssets>(
        std::map<std::string, std::string>{{"mesh.obj", meshAt(meshX)}});
    return subject;
}

}  // namespace

TEST_CASE("a mesh far away in its file is graded where it is drawn") {
    render::Renderer renderer;
    grade::Grader grader(renderer);
    const grade::Rubric rubric = grade::defaultRubric();
    const grade::Subject far = subjectOf(kAway, 0);
    CHECK(grader.grade(far, subjectOf(0, kAway), rubric).points == rubric.points);
    CHECK(grader.grade(subjectOf(0, kAway), far, rubric).points == rubric.points);
    const grade::Grade lost = grader.grade(far, subjectOf(0, 0), rubric);
    CHECK(lost.points < 0.9 * rubric.points);
    CHECK(!lost.causes.empty());
    const grade::Grade beside = grader.grade(far, subjectOf(kAway, 1), rubric);
    REQUIRE(beside.causes.size() == 1);
    CHECK(beside.points < rubric.points);
}
