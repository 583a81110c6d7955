// What a student sees of a grade: a band, and places without the reference's values.
#include "grade/report/student_answer.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "grade/images/compare.h"

using namespace farol;
using namespace farol::grade;
using nlohmann::json;

namespace {

/// A grade with a cause whose texts hold the reference's values.
Grade gradeWith(double points, const std::string& secret) {
    Grade grade;
    grade.points = points;
    grade.most = 100.0;
    for (const char* code : {"transform.value", "light.position", "model.missing"}) {
        GradedCause cause;
        cause.code = code;
        cause.message = Message{"part.finding/place", secret, {{"value", secret, ""}}};
        const bool isMissing = cause.code == "model.missing";
        cause.places.push_back({Message{"part.who/group", secret, {{"name", secret, ""}}},
                                {isMissing ? "" : "scene.xml", isMissing ? 0 : 12, 3},
                                secret});
        cause.points = points / 7.0;
        cause.spoiled = points / 1000.0;
        grade.causes.push_back(cause);
    }
    grade.unexplained = points / 3.0;
    grade.views.push_back({"own", 0.0, 64, 64, {}, secret, secret, std::string(192, '1')});
    return grade;
}

StudentView viewOf(std::vector<std::string> shows, int bands = 4, bool hasMask = false) {
    StudentView view;
    view.bands = bands;
    view.shows = std::move(shows);
    view.hasMask = hasMask;
    return view;
}

json answerOf(const Grade& grade, const StudentView& view, Language language = Language::en) {
    return json::parse(studentAnswer(grade, view, language));
}

}  // namespace

TEST_CASE("points become bands of one width, without the marks by hand") {
    Grade grade = gradeWith(0.0, "x");
    const auto band = [&](double points, int bands) {
        grade.points = points;
        return bandOf(grade, bands);
    };
    CHECK(band(0.0, 4) == 0);
    CHECK(band(24.99, 4) == 0);
    CHECK(band(25.0, 4) == 1);
    CHECK(band(99.99, 4) == 3);
    CHECK(band(100.0, 4) == 3);
    CHECK(band(33.33, 3) == 0);
    CHECK(band(33.34, 3) == 1);
    grade.manual.push_back({"care", "Care", 50.0});
    CHECK(band(50.0, 4) == 3);
    grade.notGraded = NotGraded{"grade.image", {}};
    CHECK(band(50.0, 4) == 0);
}

TEST_CASE("an answer of two references is the same in a band, byte for byte") {
    for (const auto& shows : {std::vector<std::string>{}, {"requirements", "document"}}) {
        std::set<std::string> answers;
        for (const double points : {50.0, 61.37, 74.99})
            for (const std::string secret : {"expected 4.25 at 1 2 3", "-50", "group \"wall\""})
                answers.insert(
                    studentAnswer(gradeWith(points, secret), viewOf(shows), Language::en));
        CHECK(answers.size() == 1);
        // All bands have answers of one length.
        std::set<std::size_t> sizes{answers.begin()->size()};
        sizes.insert(studentAnswer(gradeWith(30.0, "x"), viewOf(shows), Language::en).size());
        CHECK(sizes.size() == 1);
    }
}

TEST_CASE("findings of chosen criteria say where, not what") {
    const Grade grade = gradeWith(40.0, "expected 4.25");
    const json answer = answerOf(grade, viewOf({"transforms", "models"}));
    REQUIRE(answer["findings"].size() == 2);
    CHECK(answer["findings"][0]["criterion"] == "models");
    CHECK(answer["findings"][0]["message"] == "the scene lacks a part of the assignment");
    CHECK_FALSE(answer["findings"][0].contains("line"));
    CHECK(answer["findings"][1]["criterion"] == "transforms");
    CHECK(answer["findings"][1]["line"] == 12);
    CHECK(answer["findings"][1]["message"] == "a transform here differs from the assignment");
    CHECK(answer.dump().find("4.25") == std::string::npos);
    CHECK_FALSE(answer.contains("mask"));
    CHECK_FALSE(answerOf(grade, viewOf({})).contains("findings"));
    CHECK_FALSE(answerOf(grade, viewOf({"requirements"})).contains("findings"));
    CHECK(answerOf(grade, viewOf({"transforms"}), Language::pt)["findings"][0]["message"] !=
          answer["findings"][1]["message"]);
}

TEST_CASE("several causes at one line are one finding, and their order is the document's") {
    Grade grade = gradeWith(40.0, "x");
    GradedCause again = grade.causes.front();
    again.code = "transform.order";
    again.places.front().where.line = 4;
    again.points = 99.0;
    grade.causes.push_back(grade.causes.front());
    grade.causes.push_back(again);
    GradedCause unseen = grade.causes.front();
    unseen.places.front().where.line = 2;
    unseen.isSeen = false;
    grade.causes.push_back(unseen);
    const json findings = answerOf(grade, viewOf({"transforms"}))["findings"];
    REQUIRE(findings.size() == 2);
    CHECK(findings[0]["line"] == 4);
    CHECK(findings[1]["line"] == 12);
}

TEST_CASE("the mask is coarse, and its size is always the same") {
    Grade grade = gradeWith(40.0, "x");
    const json mask = answerOf(grade, viewOf({}, 4, true))["mask"];
    CHECK(mask["columns"].get<int>() * mask["rows"].get<int>() == 192);
    CHECK(mask["cells"] == std::string(192, '1'));
    grade.views.front().mask.clear();
    CHECK(answerOf(grade, viewOf({}, 4, true))["mask"]["cells"] == std::string(192, '0'));

    Plane plane{160, 120, std::vector<float>(std::size_t{160} * 120)};
    CHECK(coarseMask(plane) == std::string(192, '0'));
    for (int y = 0; y < 10; ++y) plane.values[static_cast<std::size_t>(y) * 160 + 25] = 1.0F;
    std::string expected(192, '0');
    expected[2] = '1';  // a tenth of the cell's pixels
    CHECK(coarseMask(plane) == expected);
    plane = {3, 2, std::vector<float>(6, 1.0F)};  // smaller than the grid
    CHECK(coarseMask(plane).size() == 192);
}
