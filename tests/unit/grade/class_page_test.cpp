#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "grade/report/messages.h"
#include "grade/report/report.h"
#include "grade/report/similarity.h"
#include "tests/support/paths.h"

// The page about a class: what it got wrong most, and who handed in the same.
using namespace farol::grade;
using nlohmann::json;

namespace {

SubmissionResult student(const std::string& name, const json& traits, const json& findings) {
    SubmissionResult one{name, name, "", 60, 100, true, {}};
    const json grade = {{"points", 60},
                        {"most", 100},
                        {"findings", findings},
                        {"traits", traits},
                        {"document", "<" + name + "/>"}};
    one.tasks.push_back({"", TaskGrade{grade.dump(), {"jpeg of " + name, ""}}});
    return one;
}

json traitsOf(const json& causes, const json& comments) {
    return {{"causes", causes}, {"places", json::array()}, {"comments", comments}, {"runs", {"r"}}};
}

ClassResult classOf(std::vector<SubmissionResult> all) {
    ClassResult out;
    out.title = "House <1>";
    out.count = all.size();
    out.tasks = {""};
    out.references = {{"reference"}};
    out.at = [all = std::move(all)](std::size_t i) { return all[i]; };
    return out;
}

}  // namespace

TEST_CASE("pairs that share what few have are ranked, and what the class has is not counted") {
    std::vector<SubmissionResult> all;
    for (int i = 0; i < 12; ++i)  // all share "handed out", each has a cause alone
        all.push_back(student("s" + std::to_string(i),
                              traitsOf({"cause " + std::to_string(i)}, {"handed out"}), {}));
    all[3] = student("s3", traitsOf({"x", "y"}, {"by Rui"}), {});
    all[7] = student("s7", traitsOf({"x", "y"}, {"by Rui"}), {});
    all[9] = student("s9", traitsOf({"x"}, {"by Rui"}), {});
    const std::vector<SimilarPair> pairs = similarPairs(classOf(all), 10);
    REQUIRE(pairs.size() == 1);
    CHECK(pairs[0].first == 3);
    CHECK(pairs[0].second == 7);
    CHECK(pairs[0].causes == std::vector<std::string>{"x", "y"});
    CHECK(pairs[0].comments == std::vector<std::string>{"by Rui"});
    CHECK(similarPairs(classOf(all), 0).empty());
    all[9] = student("s9", traitsOf({"a"}, {}), {});  // then two alone have it: it says more
    CHECK(similarPairs(classOf(all), 10).at(0).score > pairs[0].score);
}

TEST_CASE("the class's page counts mistakes, shows all, and escapes what students wrote") {
    const json sign = {{"code", "transform.angle-sign"},
                       {"message", "group <b>: the angle has the wrong sign"},
                       {"points", 10},
                       {"places", json::array({json::object(), json::object()})}};
    const json light = {
        {"code", "light.missing"}, {"message", "m"}, {"points", 4}, {"places", json::array({1})}};
    const json traits = traitsOf({"c1", "c2", "c3"}, {"a <script>"});
    std::vector<SubmissionResult> all = {student("ana", traits, json::array({sign})),
                                         student("rui", traits, json::array({sign, light})),
                                         student("eva", json::object(), json::array())};
    all[2].graded = false;
    all[2].tasks[0].result = TaskFailure{"grade.no-scene", "nothing"};
    std::ostringstream out;
    writeClassPage(out, classOf(all));
    const std::string page = out.str();
    CHECK_THAT(page, Catch::Contains("3 submissions, 2 graded, 3 passed; mean 60.00"));
    CHECK_THAT(page, Catch::Contains("<td>sign of an angle</td><td>2</td><td>4</td><td>10.00</td>"
                                     "<td>group &lt;b&gt;: the angle"));
    CHECK(page.find("sign of an angle") < page.find("a light is missing"));
    CHECK_THAT(page, Catch::Contains("not graded</b>"));
    CHECK_THAT(page, Catch::Contains("ana and rui") && Catch::Contains("&lt;ana/&gt;") &&
                         Catch::Contains("&lt;rui/&gt;"));
    CHECK_THAT(page, !Catch::Contains("<script") && !Catch::Contains("House <1>") &&
                         !Catch::Contains("http://"));
}

TEST_CASE("view.js has the English words of the catalogue") {
    std::ifstream in(std::string(farol::test::kSourceDir) + "/grade/report/view.js");
    const std::string script{std::istreambuf_iterator<char>(in), {}};
    int count = 0;
    for (const farol::MessageRow& row : kReportMessages) {
        const std::string id(row.id.substr(row.id.find('/') + 1));
        if (id.starts_with("class-")) continue;
        INFO(id);
        CHECK(script.find("  '" + id + "': '" + std::string(row.text) + "',\n") !=
              std::string::npos);
        ++count;
    }
    CHECK(count > 40);
}
