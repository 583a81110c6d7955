#include "grade/report.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "grade/subject.h"
#include "scene/error.h"

namespace {

using namespace farol::grade;

ClassResult classOf(const std::vector<SubmissionResult>& all) {
    ClassResult out;
    out.title = "Exercise </script><b>1</b>";
    out.count = all.size();
    out.at = [all](std::size_t i) { return all[i]; };
    out.tasks = {""};
    out.references = {{"jpeg"}};
    out.rubric = "{}";
    return out;
}

SubmissionResult one(const std::string& name, const std::string& message) {
    SubmissionResult out{"folder", name, "17", 40, 100, false, {}};
    TaskResult task;
    task.json = R"({"points":40,"most":100,"passed":false,"refused":false,"penalty":0,)"
                R"("criteria":[],"diagnostics":[],"views":[],"findings":[{"code":"light.missing",)"
                R"("message":")" +
                message + R"(","points":5}]})";
    task.pictures = {"abc", ""};
    out.tasks.push_back(task);
    return out;
}

template <typename Write>
std::string text(Write write, const ClassResult& all) {
    std::ostringstream out;
    write(out, all);
    return out.str();
}

}  // namespace

TEST_CASE("the grade book's table has Moodle's columns, and no formula of a student's") {
    const std::string csv = text(writeCsv, classOf({one("=HYPERLINK(1)", "@light \\\"2\\\"")}));
    // Without "Last modified (grade)" Moodle refuses the file.
    CHECK_THAT(csv,
               Catch::StartsWith("Identifier,Full name,Grade,Maximum Grade,"
                                 "Last modified (grade),Passed,Submission,Feedback comments\r\n"));
    CHECK_THAT(csv, Catch::Contains("\"Participant 17\",\"'=HYPERLINK(1)\",40.00,100.00,,no,"));
    CHECK_THAT(csv, Catch::Contains("\"'@light \"\"2\"\"\""));
}

TEST_CASE("feedback tells once what is wrong in many places, with its lines") {
    SubmissionResult bare = one("Ana", "x");
    nlohmann::json grade = {{"points", 0},
                            {"most", 100},
                            {"passed", false},
                            {"refused", true},
                            {"penalty", 0},
                            {"criteria", nlohmann::json::array()},
                            {"views", nlohmann::json::array()},
                            {"findings", nlohmann::json::array()}};
    for (int line = 1; line <= 8; ++line)
        grade["diagnostics"].push_back(
            {{"severity", "error"}, {"message", "no texture"}, {"line", line}});
    grade["diagnostics"].push_back({{"severity", "error"}, {"message", "no mesh"}, {"line", 9}});
    grade["diagnostics"].push_back({{"severity", "error"}, {"message", "no end"}});
    bare.tasks[0].json = grade.dump();
    const std::string csv = text(writeCsv, classOf({bare}));
    CHECK_THAT(csv, Catch::Contains("\"no texture (lines 1, 2, 3, 4, 5, 6 and 2 more)\n"
                                    "no mesh (line 9)\nno end\""));
}

TEST_CASE("the page holds the submissions' words as data only") {
    const std::string html =
        text(writeHtml, classOf({one("<script>alert(1)</script>", "a </script> b")}));
    CHECK_THAT(html, !Catch::Contains("<script>alert(1)"));
    CHECK_THAT(html, !Catch::Contains("a </script> b"));
    CHECK_THAT(html, !Catch::Contains("</script><b>1"));
    CHECK_THAT(html, Catch::Contains("data:image/jpeg;base64,YWJj"));
    CHECK_THAT(html, !Catch::Contains("http://"));
    CHECK_THAT(html, !Catch::Contains("https://"));
    CHECK(text(writeHtml, classOf({one("a", "b")})) == text(writeHtml, classOf({one("a", "b")})));
}

TEST_CASE("JUnit counts what failed and what could not be graded") {
    SubmissionResult broken{"b&d", "", "", 0, 100, false, {}};
    TaskResult task;
    task.code = "grade.no-scene";
    task.failure = "nothing <here>";
    broken.tasks.push_back(task);
    const std::string xml = text(writeJunit, classOf({one("Ana", "light 2"), broken}));
    CHECK_THAT(xml, Catch::Contains("tests=\"2\" failures=\"1\" errors=\"1\""));
    CHECK_THAT(xml, Catch::Contains("b&amp;d"));
    CHECK_THAT(xml, Catch::Contains("nothing &lt;here&gt;"));
}

TEST_CASE("the scene that is meant among files") {
    struct Case {
        std::map<std::string, std::string> files;
        const char* task;
        const char* expected;
    };
    const Case given = GENERATE(values<Case>({
        {{{"a.xml", "x"}, {"t.png", "x"}}, "", "a.xml"},
        {{{"work/a.xml", "x"}, {"work/t.png", "x"}}, "", "a.xml"},
        {{{"a.xml", "x"}, {"scene.xml", "x"}}, "", "scene.xml"},
        {{{"a.xml", "x"}, {"old/a.xml", "x"}}, "", "a.xml"},
        {{{"a.xml", "x"}, {"b.xml", "x"}}, "", "grade.which-scene"},
        {{{"a.xml", "x"}, {"b.xml", "x"}}, "B", "b.xml"},
        {{{"one/s.xml", "x"}, {"two/s.xml", "x"}}, "two", "s.xml"},
        {{{"a.xml", "x"}}, "b", "grade.no-scene"},
        {{{"read.me", "x"}}, "", "grade.no-scene"},
        {{{"shot.png", "x"}}, "", "shot.png"},
        {{{"hand-in.zip", "x"}, {"notes.txt", "x"}}, "", "hand-in.zip"},
    }));
    std::string found;
    try {
        found = subjectOf(given.files, "folder", given.task).job.name;
    } catch (const farol::Error& error) {
        found = error.code();
    }
    CHECK(found == given.expected);
}
