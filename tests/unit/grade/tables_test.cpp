#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "grade/report/csv.h"
#include "grade/report/overrides.h"
#include "grade/report/report.h"

// The tables that teachers write: CSV of any spreadsheet, marks by hand, groups.
using namespace farol::grade;

namespace {

SubmissionResult studentOf(const std::string& task = "") {
    SubmissionResult one{"ana.xml", "Ana Sá", "17", 40, 100, false, {}};
    TaskGrade grade;
    grade.json = R"({"points":40,"most":100,"passed":false,"refused":false,"penalty":0,)"
                 R"("criteria":[{"measure":"models","points":10,"most":22},)"
                 R"({"measure":"lights","points":30,"most":78}],"diagnostics":[],"findings":[]})";
    one.tasks.push_back({task, grade});
    return one;
}

nlohmann::json gradeAfter(const std::string& table, SubmissionResult one = studentOf()) {
    const Overrides overrides(table, "overrides.csv");
    overrides.applyToTask(one.tasks[0], one, 100, 50);
    return nlohmann::json::parse(one.tasks[0].grade()->json);
}

std::string csvOf(const SubmissionResult& one, const Groups& groups,
                  void (*write)(std::ostream&, const ClassResult&)) {
    ClassResult all;
    all.count = 1;
    all.at = [one](std::size_t) { return one; };
    all.tasks = {one.tasks[0].task};
    all.groups = groups;
    std::ostringstream out;
    write(out, all);
    return out.str();
}

}  // namespace

TEST_CASE("tables of any spreadsheet are read") {
    for (const char* text : {"Student,Mark\nana,1\n\"a, \"\"b\"\"\nc\",2\n",
                             "\xEF\xBB\xBFmark;STUDENT\r\n1;ana\r\n\r\n2;\"a, \"\"b\"\"\nc\"",
                             "note;;student;mark\n;;ana;1\n;;\"a, \"\"b\"\"\nc\";2;9\n;;;\n"}) {
        INFO(text);
        const CsvTable table(text, "t.csv", {"student", "mark"});
        REQUIRE(table.count() == 2);
        CHECK(table.at(0, "student") == "ana");
        CHECK(table.at(0, "mark") == "1");
        CHECK(table.at(1, "student") == "a, \"b\"\nc");
        CHECK(table.at(1, "mark") == "2");
        CHECK(table.at(1, "colour").empty());
    }
    CHECK(CsvTable("student\n" + forCsv("-ana"), "t", {"student"}).at(0, "student") == "-ana");
    CHECK(CsvTable("a,b\n1\n", "t", {"a", "b"}).at(0, "b").empty());
    CHECK_THROWS_WITH(CsvTable("name,mark\n", "t.csv", {"student", "mark"}),
                      Catch::Contains("\"student\"") && Catch::Contains("student, mark"));
    CHECK_THROWS_AS(CsvTable("", "t.csv", {"student"}), farol::Error);
}

TEST_CASE("a teacher's marks stand over the program's, by student and criterion") {
    CHECK(gradeAfter("student,criterion,mark,comment\nana.xml,models,20,well done\n") ==
          gradeAfter("student;criterion;mark;comment\nparticipant 17;Models;20,0;well done\n"));
    const auto grade =
        gradeAfter("student,criterion,mark,comment\nANA SÁ,models,5,\n17,lights,78,x");
    CHECK(grade.at("points") == 83.0);
    CHECK(grade.at("passed") == true);
    CHECK(grade.at("criteria").at(0).at("points") == 5.0);
    CHECK(grade.at("overrides").size() == 2);
    // No more than there is to have; nobody else's; a comment alone changes no point.
    CHECK(gradeAfter("student,criterion,mark,comment\n17,models,99,").at("points") == 52.0);
    CHECK(gradeAfter("student,mark,comment\nbento,99,").at("points") == 40.0);
    CHECK(gradeAfter("student,criterion,mark,comment\n17,models,,good").at("points") == 40.0);
    CHECK(gradeAfter("student,task,mark,comment\n17,one,70,", studentOf("one")).at("points") ==
          70.0);
    CHECK(gradeAfter("student,task,mark,comment\n17,two,70,", studentOf("one")).at("points") ==
          40.0);
    CHECK_THROWS_WITH(Overrides("student,mark,comment\n17,good,", "o.csv"),
                      Catch::Contains("\"good\""));
    CHECK_THROWS_AS(Overrides("student,mark,comment\n17,-1,", "o.csv"), farol::Error);
}

TEST_CASE("a mark by hand makes a submission graded that was not") {
    const Overrides overrides("student,mark,comment\n17,60,seen on paper\n99,1,", "o.csv");
    SubmissionResult one = studentOf();
    one.graded = false;
    one.tasks[0].result = TaskFailure{"grade.no-scene", "nothing"};
    overrides.applyToTask(one.tasks[0], one, 100, 50);
    CHECK(one.tasks[0].failure() != nullptr);  // the row is of the whole
    overrides.applyToTotal(one, 50);
    CHECK(one.graded);
    CHECK(one.passed);
    CHECK(one.points == 60.0);
    CHECK_THAT(csvOf(one, {}, writeCsv),
               Catch::Contains(",60.00,100.00,,yes,") && Catch::Contains("seen on paper"));
    CHECK_THAT(csvOf(one, {}, writeCriteria), Catch::Contains(",60.00,yes"));
    ClassResult all;
    all.count = 1;
    all.at = [&](std::size_t) { return one; };
    CHECK(overrides.unused(all) == std::vector<int>{3});
}

TEST_CASE("a group is a row for each member, and criteria are columns") {
    const Groups groups(
        "Submission,Full name,Identifier\nana.xml,Ana Sá,Participant 17\nana.xml,Rui,18\nx,Eva,19",
        "groups.csv");
    CHECK(groups.membersOf("other", "Bento", "20").size() == 1);
    const std::string grades = csvOf(studentOf(), groups, writeCsv);
    CHECK_THAT(grades, Catch::Contains("\"Participant 17\",\"Ana Sá\",40.00") &&
                           Catch::Contains("\"Participant 18\",\"Rui\",40.00") &&
                           !Catch::Contains("Eva"));
    CHECK(
        csvOf(studentOf("one"), groups, writeCriteria) ==
        "Identifier,Full name,Submission,Grade,By hand,\"one\",\"one: lights\",\"one: models\"\r\n"
        "\"Participant 17\",\"Ana Sá\",\"ana.xml\",40.00,,40.00,30.00,10.00\r\n"
        "\"Participant 18\",\"Rui\",\"ana.xml\",40.00,,40.00,30.00,10.00\r\n");
}
