// A mesh or texture that was not handed in: a placeholder is graded in its stead, at a cost.
#include <catch2/catch.hpp>

#include "grade/rubric/grader.h"
#include "scene/files/assets.h"

using namespace farol;

namespace {

std::string boxBy(const std::string& file) {
    return "<world><camera><position x=\"4\" y=\"3\" z=\"5\"/><lookAt x=\"0\" y=\"0\" "
           "z=\"0\"/></camera>"
           "<lights><light type=\"directional\" dirx=\"1\" diry=\"2\" dirz=\"1\"/></lights>"
           "<group><models><model file=\"" +
           file + "\"/></models></group></world>";
}

grade::Subject subjectOf(const std::string& xml) {
    grade::Subject subject;
    subject.job.name = "scene.xml";
    subject.job.xml = xml;
    subject.job.assets = std::make_shared<scene::BundleAssets>();
    subject.job.options.missing = render::Missing::placeholder;
    return subject;
}

}  // namespace

TEST_CASE("a mesh that was not handed in costs its share where its placeholder looks right") {
    render::Renderer renderer;
    grade::Grader grader(renderer);
    const grade::Subject reference = subjectOf(boxBy("box_1_2.3d"));
    const grade::Rubric rubric = grade::defaultRubric();
    CHECK(grader.grade(reference, reference, rubric).points == rubric.points);
    const grade::Grade found = grader.grade(reference, subjectOf(boxBy("mine.3d")), rubric);
    REQUIRE(found.causes.size() == 1);
    CHECK(found.causes[0].code == "model.file-missing");
    CHECK(found.causes[0].points > 0.0);
    CHECK(found.points < 0.97 * rubric.points);
    CHECK(found.points > 0.7 * rubric.points);
}
