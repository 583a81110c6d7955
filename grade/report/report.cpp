#include "grade/report/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/base64.h"
#include "core/bounded_json.h"
#include "core/embedded.h"
#include "core/text.h"
#include "grade/rubric/grader.h"

namespace farol {
std::span<const EmbeddedFile> reportFiles();  ///< page.html; page.* and view.* as css and js
}

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

/// Null where the task was not graded.
ordered_json gradeOf(const TaskResult& task) {
    const TaskGrade* grade = task.grade();
    return grade == nullptr ? ordered_json() : parseOrderedJson(grade->json, kGradeJson);
}

ordered_json toJson(const SubmissionResult& one) {
    ordered_json out{{"id", one.id}, {"name", one.name}};
    if (!one.number.empty()) out["identifier"] = "Participant " + one.number;
    out["points"] = one.points;
    out["most"] = one.most;
    out["passed"] = one.passed;
    out["graded"] = one.graded;
    out["tasks"] = ordered_json::array();
    for (const TaskResult& task : one.tasks) {
        ordered_json entry;
        if (!task.task.empty()) entry["task"] = task.task;
        if (const TaskFailure* failure = task.failure())
            entry["failure"] = {{"code", failure->code}, {"message", failure->message}};
        else
            entry["grade"] = gradeOf(task);
        out["tasks"].push_back(std::move(entry));
    }
    return out;
}

/// For text in a script element: nothing in it can end the element.
std::string forScript(std::string json) {
    std::string out;
    for (const char c : json) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

/// For XML 1.0 text and attributes: a character that it cannot hold is left out, or U+FFFD where it
/// is no UTF-8.
std::string forXml(const std::string& text) {
    std::string out;
    const std::string valid = toUtf8(text);
    for (std::size_t i = 0; i < valid.size(); ++i) {
        const char c = valid[i];
        const bool isNoCharacter =
            valid.compare(i, 3, "\xEF\xBF\xBE") == 0 || valid.compare(i, 3, "\xEF\xBF\xBF") == 0;
        if (isNoCharacter) {
            i += 2;
            continue;
        }
        switch (c) {
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '&':
                out += "&amp;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\n':
                out += "&#10;";  // an attribute would make it a blank
                break;
            case '\t':
                out += "&#9;";
                break;
            default:
                if (static_cast<unsigned char>(c) >= 0x20) out += c;
        }
    }
    return out;
}

/// Whether a spreadsheet would read the field as a formula (also by a full-width sign).
bool isFormula(const std::string& field) {
    for (const char* start : {"=", "+", "-", "@", "\t", "\n", "\xEF\xBC\x9D", "\xEF\xBC\x8B",
                              "\xEF\xBC\x8D", "\xEF\xBC\xA0"})
        if (field.starts_with(start)) return true;
    return false;
}

/// A quoted field (RFC 4180) of UTF-8 without control characters but for tab and line feed.
std::string forCsv(const std::string& text) {
    std::string field = toUtf8(text);
    std::erase_if(field, [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') || c == 0x7F;
    });
    if (isFormula(field)) field.insert(field.begin(), '\'');
    std::string out = "\"";
    for (const char c : field) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

/// " (line 3)", " (lines 3, 5)", " (lines 3, 5, 7 and 4 more)"; "" where there is none.
std::string linesText(const std::vector<int>& lines) {
    constexpr std::size_t kListed = 6;
    if (lines.empty()) return "";
    const std::span listed(lines.data(), std::min(kListed, lines.size()));
    std::string out = (lines.size() > 1 ? " (lines " : " (line ") +
                      joined(listed, ", ", [](int line) { return std::to_string(line); });
    if (lines.size() > kListed) out += " and " + std::to_string(lines.size() - kListed) + " more";
    return out + ")";
}

/// Of grades of earlier versions, too.
bool isNotGraded(const ordered_json& grade) {
    return grade.is_object() && grade.value("refused", false);
}

/// The text for a student: each loss, then each finding.
std::string feedback(const SubmissionResult& one) {
    std::string out;
    const auto line = [&](const std::string& text) { out += (out.empty() ? "" : "\n") + text; };
    for (const TaskResult& task : one.tasks) {
        const std::string prefix = task.task.empty() ? "" : task.task + ": ";
        if (const TaskFailure* failure = task.failure()) {
            line(prefix + failure->message);
            continue;
        }
        const ordered_json grade = gradeOf(task);
        // Errors of the document follow below.
        if (grade.contains("reason") && grade.value("diagnostics", ordered_json::array()).empty())
            line(prefix + "not graded: " + grade["reason"].value("message", ""));
        for (const auto& finding : grade.value("findings", ordered_json::array())) {
            const double points = finding.value("points", 0.0);
            const bool isMissing = finding.value("code", "").ends_with(".missing");
            if (points > 0.0)
                line(prefix + finding.value("message", "") + " (-" + number(points) + ")");
            else if (isMissing)
                line(prefix + finding.value("message", ""));
        }
        const double unexplained =
            grade.value("unexplained", ordered_json::object()).value("points", 0.0);
        if (unexplained > 0.0)
            line(prefix + "unexplained: the pictures differ for a reason that was not found (-" +
                 number(unexplained) + ")");
        // An error in many places is reported once, with its lines.
        std::vector<std::pair<std::string, std::vector<int>>> told;
        for (const auto& diagnostic : grade.value("diagnostics", ordered_json::array())) {
            if (diagnostic.value("severity", "") != "error" && !(grade.value("penalty", 0.0) > 0.0))
                continue;
            const std::string message = diagnostic.value("message", "");
            auto found = std::find_if(told.begin(), told.end(),
                                      [&](const auto& entry) { return entry.first == message; });
            if (found == told.end()) found = told.insert(told.end(), {message, {}});
            if (diagnostic.contains("line")) found->second.push_back(diagnostic.value("line", 0));
        }
        for (const auto& [message, lines] : told) line(prefix + message + linesText(lines));
        for (const auto& criterion : grade.value("criteria", ordered_json::array()))
            if (criterion.contains("measured") &&
                criterion.value("points", 0.0) < criterion.value("most", 0.0) &&
                !isNotGraded(grade))
                line(prefix + criterion.value("reason", ""));
    }
    return out;
}

std::string_view fileOf(const char* name) {
    for (const EmbeddedFile& file : reportFiles())
        if (file.name == name) return file.bytes;
    return {};
}

}  // namespace

void writeJson(std::ostream& out, const ClassResult& all) {
    out << "{\"title\":" << dumpJson(ordered_json(all.title))
        << ",\n\"rubric\":" << dumpJson(parseOrderedJson(all.rubric, kRubricJson))
        << ",\n\"tasks\":" << dumpJson(ordered_json(all.tasks)) << ",\n\"submissions\":[";
    for (std::size_t i = 0; i < all.count; ++i)
        out << (i ? ",\n" : "\n") << dumpJson(toJson(all.at(i)));
    out << "\n]}\n";
}

void writeCsv(std::ostream& out, const ClassResult& all) {
    // Moodle takes no worksheet without a column of this name. It is left empty: a report tells no
    // times, and with none Moodle replaces a grade that it has only where the teacher allows it.
    out << "Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,"
           "Feedback comments\r\n";
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        out << forCsv(one.number.empty() ? "" : "Participant " + one.number) << ","
            << forCsv(one.name) << "," << (one.graded ? number(one.points) : "") << ","
            << number(one.most) << ",,"
            << (!one.graded  ? ""
                : one.passed ? "yes"
                             : "no")
            << "," << forCsv(one.id) << "," << forCsv(feedback(one)) << "\r\n";
    }
}

void writeJunit(std::ostream& out, const ClassResult& all) {
    std::size_t tests = 0, failures = 0, errors = 0;
    const auto failed = [](const TaskResult& task) {
        const ordered_json grade = gradeOf(task);
        return grade.is_object() && !isNotGraded(grade) && !grade.value("passed", false);
    };
    const auto hasNone = [](const TaskResult& task) {
        return task.failure() != nullptr || isNotGraded(gradeOf(task));
    };
    for (std::size_t i = 0; i < all.count; ++i)
        for (const TaskResult& task : all.at(i).tasks) {
            ++tests;
            errors += hasNone(task) ? 1 : 0;
            failures += failed(task) ? 1 : 0;
        }
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"" << tests
        << "\" failures=\"" << failures << "\" errors=\"" << errors << "\">\n<testsuite name=\""
        << forXml(all.title) << "\" tests=\"" << tests << "\" failures=\"" << failures
        << "\" errors=\"" << errors << "\">\n";
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        for (const TaskResult& task : one.tasks) {
            const ordered_json grade = gradeOf(task);
            out << "<testcase classname=\"" << forXml(one.id) << "\" name=\""
                << forXml(task.task.empty() ? "grade" : task.task) << "\">";
            if (const TaskFailure* failure = task.failure())
                out << "<error type=\"" << forXml(failure->code) << "\" message=\""
                    << forXml(failure->message) << "\"/>";
            else if (isNotGraded(grade))
                out << "<error type=\"grade.refused\" message=\"" << forXml(feedback(one))
                    << "\"/>";
            else if (failed(task))
                out << "<failure message=\"" << number(grade.value("points", 0.0)) << " of "
                    << number(grade.value("most", 0.0)) << " points\">" << forXml(feedback(one))
                    << "</failure>";
            out << "<system-out>" << number(grade.is_object() ? grade.value("points", 0.0) : 0.0)
                << " points</system-out></testcase>\n";
        }
    }
    out << "</testsuite>\n</testsuites>\n";
}

void writeHtml(std::ostream& out, const ClassResult& all) {
    const std::string_view page = fileOf("page.html");
    const auto put = [&](std::string_view text) { out << text; };
    const auto part = [&](std::string_view mark, std::size_t from) {
        const std::size_t at = page.find(mark, from);
        put(page.substr(from, at == std::string_view::npos ? at : at - from));
        return at == std::string_view::npos ? page.size() : at + mark.size();
    };
    std::size_t at = part("/*STYLE*/", 0);
    put(fileOf("page.css"));
    put(fileOf("view.css"));
    at = part("<!--DATA-->", at);
    put("<script type=\"application/json\" id=\"class\">");
    put(forScript(dumpJson(ordered_json{{"title", all.title}, {"tasks", all.tasks}})));
    put("</script>\n");
    const auto pictures = [&](const std::string& id, const std::vector<std::string>& list) {
        ordered_json urls = ordered_json::array();
        for (const std::string& one : list)
            urls.push_back(one.empty() ? "" : "data:image/jpeg;base64," + base64(one));
        put("<script type=\"application/json\" class=\"pictures\" id=\"" + id + "\">");
        put(dumpJson(urls));
        put("</script>\n");
    };
    for (std::size_t t = 0; t < all.references.size(); ++t)
        pictures("r" + std::to_string(t), all.references[t]);
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        put("<script type=\"application/json\" class=\"submission\">");
        put(forScript(dumpJson(toJson(one))));
        put("</script>\n");
        for (std::size_t t = 0; t < one.tasks.size(); ++t) {
            const TaskGrade* grade = one.tasks[t].grade();
            pictures("p" + std::to_string(i) + "-" + std::to_string(t),
                     grade == nullptr ? std::vector<std::string>{} : grade->pictures);
        }
    }
    at = part("/*SCRIPT*/", at);
    put(fileOf("view.js"));
    put(fileOf("page.js"));
    put(page.substr(at));
}

}  // namespace farol::grade
