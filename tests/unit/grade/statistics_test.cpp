#include "grade/report/statistics.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "grade/report/agreement.h"

// Worked values of the literature, and cases whose values follow from the definitions.
using namespace farol::grade;
using Catch::Detail::Approx;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Four observers, twelve units, some without a value: the reliability data of K. Krippendorff,
/// "Computing Krippendorff's Alpha-Reliability" (2011), section C.
RatedUnits published() {
    const std::vector<std::vector<double>> observers = {
        {1, 2, 3, 3, 2, 1, 4, 1, 2, kNone, kNone, kNone},
        {1, 2, 3, 3, 2, 2, 4, 1, 2, 5, kNone, 3},
        {kNone, 3, 3, 3, 2, 3, 4, 2, 2, 5, 1, kNone},
        {1, 2, 3, 3, 2, 4, 4, 1, 2, 5, 1, kNone}};
    RatedUnits units(12);
    for (const auto& observer : observers)
        for (std::size_t u = 0; u < observer.size(); ++u)
            if (observer[u] == observer[u]) units[u].push_back(observer[u]);
    return units;
}

}  // namespace

TEST_CASE("alpha of interval data is the published example's") {
    const auto alpha = krippendorffAlpha(published());
    REQUIRE(alpha);
    CHECK(*alpha == Approx(0.849).margin(0.0005));  // as printed there
}

TEST_CASE("alpha does not depend on the scale's zero and unit, and large offsets keep it") {
    RatedUnits units = published();
    for (auto& unit : units)
        for (double& value : unit) value = 1e6 + 7.0 * value;
    CHECK(*krippendorffAlpha(units) == Approx(*krippendorffAlpha(published())).epsilon(1e-9));
}

TEST_CASE("alpha is 1 for agreement, and not defined without variation or pairs") {
    CHECK(*krippendorffAlpha({{1, 1}, {5, 5}, {9, 9}}) == Approx(1.0));
    CHECK(*krippendorffAlpha({{0, 10}, {10, 0}}) < 0.0);
    CHECK_FALSE(krippendorffAlpha({{0.1, 0.1}, {0.1, 0.1}}));
    CHECK_FALSE(krippendorffAlpha({{1}, {2}, {}}));
    CHECK_FALSE(krippendorffAlpha({}));
}

TEST_CASE("the bootstrap's interval is repeatable, holds alpha, and narrows with more units") {
    const auto interval = bootstrapAlpha(published());
    REQUIRE(interval);
    const auto again = bootstrapAlpha(published());
    CHECK(interval->low == again->low);
    CHECK(interval->high == again->high);
    CHECK(interval->low < 0.849);
    CHECK(interval->high > 0.849);
    CHECK(interval->high <= 1.0);
    RatedUnits many;
    for (int i = 0; i < 20; ++i)
        for (const auto& unit : published()) many.push_back(unit);
    const auto narrow = bootstrapAlpha(many);
    REQUIRE(narrow);
    CHECK(narrow->high - narrow->low < 0.5 * (interval->high - interval->low));
    CHECK_FALSE(bootstrapAlpha({{2, 2}, {2, 2}}));
}

TEST_CASE("tau-b is the worked values") {
    // The example of SciPy's documentation of kendalltau, with ties on both sides: of the 10 pairs
    // 2 agree and 6 do not; 8 and 9 are untied.
    CHECK(*kendallTauB({12, 2, 1, 12, 2}, {1, 4, 7, 1, 0}) == Approx(-0.47140452079103173));
    CHECK(*kendallTauB({12, 2, 1, 12, 2}, {1, 4, 7, 1, 0}) == Approx(-4.0 / std::sqrt(72.0)));
    // Two rankings without ties, counted by hand: 21 pairs agree and 24 do not.
    CHECK(*kendallTauB({7, 4, 3, 10, 6, 2, 9, 8, 1, 5}, {5, 7, 3, 10, 1, 9, 6, 2, 8, 4}) ==
          Approx(-3.0 / 45.0));
    CHECK(*kendallTauB({1, 2, 3}, {10, 20, 30}) == Approx(1.0));
    CHECK(*kendallTauB({1, 2, 3}, {3, 2, 1}) == Approx(-1.0));
    CHECK_FALSE(kendallTauB({1, 1, 1}, {1, 2, 3}));
    CHECK_FALSE(kendallTauB({}, {}));
}

namespace {

ClassResult classOf(std::vector<SubmissionResult> all) {
    ClassResult out;
    out.title = "Houses";
    out.count = all.size();
    out.at = [all = std::move(all)](std::size_t i) { return all[i]; };
    out.tasks = {""};
    return out;
}

SubmissionResult marked(const std::string& id, double points) {
    return {id, "", "", points, 100, points >= 50, {}};
}

std::string codeOf(const std::string& text) {
    try {
        readPersonMarks(text, "marks.csv");
    } catch (const farol::Error& error) {
        return error.primary().id + ":" + std::to_string(error.primary().where.line);
    }
    return "";
}

}  // namespace

TEST_CASE("marks of people are read by rater, with bands, and wrong tables are refused") {
    const auto marks = readPersonMarks(
        "Student;Rater;Mark;Low;High;Comment;Page\nana;A;80,5;;;well;marking/ana.html\n"
        "ana;B;;70;90;;\nrui;A;;;;;\n",
        "marks.csv");
    REQUIRE(marks.size() == 2);
    CHECK(marks[0].mark == 80.5);
    CHECK(marks[0].page == "marking/ana.html");
    CHECK_FALSE(marks[0].band);
    CHECK(marks[1].mark == 80.0);
    CHECK(marks[1].band->high == 90.0);
    CHECK(marks[1].line == 3);
    CHECK(codeOf("student,mark\nana,x\n") == "grade.table/mark:2");
    CHECK(codeOf("student,mark\nana,-1\n") == "grade.table/mark:2");
    CHECK(codeOf("student,low,high\nana,90,70\n") == "grade.table/band:2");
    CHECK(codeOf("student,low,high\nana,90,\n") == "grade.table/mark:2");
    CHECK(codeOf("student,mark\nana,5\nANA,6\n") == "grade.table/twice:3");
    CHECK(codeOf("student,mark\nana,\n") == "grade.table/no-marks:1");
    CHECK(codeOf("mark\n5\n") == "grade.table/column:1");
    CHECK(codeOf("student,mark,page\nana,5,javascript:x\n") == "grade.table/page:2");
    CHECK(codeOf("student,mark,page\nana,5,//evil.example\n") == "grade.table/page:2");
}

TEST_CASE("the comparison leaves out what one side has not marked, and sorts by difference") {
    SubmissionResult failed = marked("eva", 0);
    failed.graded = false;
    SubmissionResult byHand = marked("gil", 70);
    byHand.isOverridden = true;
    const auto marks = readPersonMarks(
        "student,mark,low,high\nana,90,,\nrui,50,,\nzoe,,60,80\neva,10,,\ngil,70,,\nnobody,1,,\n",
        "m.csv");
    const Agreement agreement =
        compareMarks(classOf({marked("ana", 88), marked("rui", 75), marked("zoe", 81), failed,
                              byHand, marked("extra", 5)}),
                     marks, "m.csv");
    REQUIRE(agreement.submissions.size() == 3);
    CHECK(agreement.submissions[0].id == "rui");
    CHECK(agreement.submissions[1].id == "zoe");
    CHECK(agreement.meanDifference == Approx((2.0 + 25.0 + 11.0) / 3.0));
    CHECK(agreement.bias == Approx((-2.0 + 25.0 + 11.0) / 3.0));
    CHECK(agreement.bands == 1);
    CHECK(agreement.inBand == 1);  // 81 beside 60 to 80: within the slack
    CHECK(agreement.ungraded == 1);
    CHECK(agreement.overridden == 1);
    CHECK(agreement.unmarked == 1);
    CHECK(agreement.unusedLines == std::vector<int>{7});
    CHECK(*agreement.alpha == Approx(*krippendorffAlpha({{90, 88}, {50, 75}, {70, 81}})));
    CHECK_FALSE(agreement.alphaPeople);
    CHECK_THROWS_AS(compareMarks(classOf({marked("ana", 1)}),
                                 readPersonMarks("student,mark\nana,101\n", "m"), "m"),
                    farol::Error);
}

TEST_CASE("two people are compared with each other and with the program") {
    const auto marks = readPersonMarks(
        "student,rater,mark\na,P,10\na,Q,20\nb,P,50\nb,Q,50\nc,P,90\nc,Q,80\n", "m.csv");
    const Agreement agreement =
        compareMarks(classOf({marked("a", 15), marked("b", 50), marked("c", 85)}), marks, "m.csv");
    CHECK(*agreement.alphaPeople == Approx(*krippendorffAlpha({{10, 20}, {50, 50}, {90, 80}})));
    CHECK(*agreement.alpha ==
          Approx(*krippendorffAlpha({{10, 20, 15}, {50, 50, 50}, {90, 80, 85}})));
    CHECK(agreement.meanDifference == Approx(0.0));
    CHECK(*agreement.tauB == Approx(1.0));
}

TEST_CASE("the page of agreement links both sides and runs nothing") {
    const auto marks = readPersonMarks(
        "student,mark,comment,page\na b/ç,15,<script>,https://x.example/?a=\"b\n", "m.csv");
    const Agreement agreement = compareMarks(classOf({marked("a b/ç", 15)}), marks, "m.csv");
    std::ostringstream page, json;
    writeAgreementPage(page, agreement);
    writeAgreementJson(json, agreement);
    CHECK_THAT(page.str(), Catch::Contains("report.html#a%20b%2F%C3%A7\""));
    CHECK_THAT(page.str(), Catch::Contains("href=\"https://x.example/?a=&quot;b\""));
    CHECK_THAT(page.str(), !Catch::Contains("<script"));
    CHECK_THAT(page.str(), Catch::Contains("not defined"));  // without variation there is no alpha
    CHECK_THAT(json.str(), Catch::Contains("\"alpha\": null"));
}
