#include "grade/report/report.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>

#include "core/bounded_json.h"
#include "core/error.h"
#include "core/text.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

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
    TaskGrade grade;
    grade.json = R"({"points":40,"most":100,"passed":false,"refused":false,"penalty":0,)"
                 R"("criteria":[],"diagnostics":[],"views":[],"findings":[{"code":"light.missing",)"
                 R"("message":")" +
                 message + R"(","points":5}]})";
    grade.pictures = {"abc", ""};
    out.tasks.push_back({"", grade});
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
    CHECK_THAT(csv, Catch::Contains("\"'@light \"\"2\"\" (-5.00)\""));
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
    bare.tasks[0].result = TaskGrade{grade.dump(), bare.tasks[0].grade()->pictures};
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
    broken.tasks.push_back({"", TaskFailure{"grade.no-scene", "nothing <here>"}});
    const std::string xml = text(writeJunit, classOf({one("Ana", "light 2"), broken}));
    CHECK_THAT(xml, Catch::Contains("tests=\"2\" failures=\"1\" errors=\"1\""));
    CHECK_THAT(xml, Catch::Contains("b&amp;d"));
    CHECK_THAT(xml, Catch::Contains("nothing &lt;here&gt;"));
}

namespace {

/// Rows of quoted or bare fields (RFC 4180); ends the test where the text is none.
std::vector<std::vector<std::string>> rowsOf(const std::string& csv) {
    std::vector<std::vector<std::string>> rows(1);
    std::size_t at = 0;
    while (at < csv.size()) {
        std::string field;
        if (csv[at] == '"') {
            for (++at;; ++at) {
                REQUIRE(at < csv.size());
                if (csv[at] != '"') {
                    field += csv[at];
                } else if (csv.compare(at, 2, "\"\"") == 0) {
                    field += csv[at++];
                } else {
                    ++at;
                    break;
                }
            }
        } else {
            while (at < csv.size() && csv[at] != ',' && csv[at] != '\r') {
                REQUIRE(csv[at] != '"');
                field += csv[at++];
            }
        }
        rows.back().push_back(field);
        REQUIRE(at < csv.size());
        if (csv[at] == ',') {
            ++at;
            continue;
        }
        REQUIRE(csv.compare(at, 2, "\r\n") == 0);
        at += 2;
        rows.emplace_back();
    }
    REQUIRE(rows.back().empty());
    rows.pop_back();
    return rows;
}

/// The texts of the page's JSON script elements.
std::vector<std::string> dataOf(const std::string& html) {
    std::vector<std::string> texts;
    const std::string start = "<script type=\"application/json\"", end = "</script>";
    for (std::size_t at = html.find(start); at != std::string::npos; at = html.find(start, at)) {
        const std::size_t from = html.find('>', at) + 1;
        at = html.find(end, from);
        REQUIRE(at != std::string::npos);
        texts.push_back(html.substr(from, at - from));
    }
    return texts;
}

/// Well-formed XML 1.0: by xmllint where it is, as pugixml accepts control characters and any
/// bytes.
void requireXml(const std::string& xml) {
    REQUIRE(farol::isUtf8(xml));
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(xml.data(), xml.size(), pugi::parse_full, pugi::encoding_utf8);
    INFO(parsed.description());
    REQUIRE(parsed);
    for (const char c : xml) {
        const auto byte = static_cast<unsigned char>(c);
        REQUIRE((byte >= 0x20 || c == '\n' || c == '\t' || c == '\r'));
    }
    if (!farol::test::hasProgram("xmllint")) return;
    std::filesystem::create_directories(farol::test::kTestOutput);
    const std::string file =
        std::string(farol::test::kTestOutput) + "/report-" + std::to_string(getpid());
    std::ofstream(file, std::ios::binary) << xml;
    const int status = std::system(("xmllint --noout '" + file + "'").c_str());
    std::remove(file.c_str());
    REQUIRE(status == 0);
}

/// Characters that names and messages may hold.
const std::vector<std::string> kHostile = {
    "caf\xE9",
    "\xC3",
    "\xED\xA0\x80 surrogate",
    "\xEF\xBF\xBF\xEF\xBF\xBE no characters",
    std::string("nul \0 and \x01\x1F\x7F", 13),
    "line\nfeed\r\nand\ttab",
    "quotes \" ' ` and \\",
    "</script><script>alert(1)</script> <!-- & ]]> &amp;",
    "=1+1",
    "+1",
    "-1",
    "@SUM(A1)",
    "\t=1",
    "\r=1",
    "\n=1",
    "\x01=1",
    "\xEF\xBC\x9D"
    "1+1",
    "a,b;c\"d",
    std::string(255, 'x'),
    std::string(255, '\xE9'),
    "\xE2\x80\xA8 line separator",
};

}  // namespace

TEST_CASE("reports are well-formed, whatever submissions are called") {
    std::vector<SubmissionResult> all;
    for (const std::string& text : kHostile) {
        SubmissionResult graded = one(text, "x");
        graded.id = text;
        graded.number = text;
        graded.tasks[0].task = text;
        nlohmann::json grade = nlohmann::json::parse(graded.tasks[0].grade()->json);
        grade["findings"][0]["message"] = text;
        graded.tasks[0].result =
            TaskGrade{farol::dumpJson(grade), graded.tasks[0].grade()->pictures};
        all.push_back(graded);
        SubmissionResult failed{text, text, text, 0, 100, false, {}};
        failed.tasks.push_back({text, TaskFailure{text, text}});
        all.push_back(failed);
    }
    ClassResult results = classOf(all);
    results.title = kHostile[3] + kHostile[7];
    results.tasks = kHostile;

    const std::string xml = text(writeJunit, results);
    requireXml(xml);
    pugi::xml_document document;
    REQUIRE(document.load_buffer(xml.data(), xml.size()));
    const pugi::xml_node suite = document.child("testsuites").child("testsuite");
    const auto cases = suite.children("testcase");
    CHECK(static_cast<std::size_t>(std::distance(cases.begin(), cases.end())) == all.size());

    const std::string csv = text(writeCsv, results);
    CHECK(farol::isUtf8(csv));
    const auto rows = rowsOf(csv);
    REQUIRE(rows.size() == all.size() + 1);
    for (const auto& row : rows) {
        REQUIRE(row.size() == 8);
        for (const std::string& field : row) {
            INFO(field);
            const bool isFormula =
                !field.empty() && std::string("=+-@\t\r\n").find(field[0]) != std::string::npos;
            CHECK_FALSE(isFormula);
            CHECK_FALSE(field.starts_with("\xEF\xBC\x9D"));
            CHECK(field.find('\0') == std::string::npos);
        }
    }

    const std::string jsonText = text(writeJson, results);
    CHECK(farol::isUtf8(jsonText));
    const auto json = nlohmann::json::parse(jsonText, nullptr, false);
    REQUIRE(json.is_object());
    CHECK(json["submissions"].size() == all.size());

    const std::string html = text(writeHtml, results);
    CHECK(farol::isUtf8(html));
    const auto data = dataOf(html);
    CHECK(data.size() == 1 + 1 + 2 * all.size());  // the class, a reference, and two a submission
    for (const std::string& part : data) {
        CHECK(part.find('<') == std::string::npos);
        CHECK(nlohmann::json::accept(part));
    }
}
