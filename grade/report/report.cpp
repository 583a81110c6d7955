#include "grade/report/report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/base64.h"
#include "core/bounded_json.h"
#include "core/text.h"
#include "grade/messages.h"
#include "grade/report/csv.h"
#include "grade/report/messages.h"
#include "grade/report/page_files.h"
#include "grade/report/text.h"
#include "grade/rubric/grader.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

/// Null where the task was not graded.
ordered_json gradeOf(const TaskResult& task) {
    const TaskGrade* grade = task.grade();
    return grade == nullptr ? ordered_json() : parseOrderedJson(grade->json, kGradeJson);
}

/// The class page alone compares submissions.
ordered_json withoutTraits(ordered_json grade) {
    grade.erase("traits");
    grade.erase("document");
    return grade;
}

ordered_json toJson(const SubmissionResult& one) {
    ordered_json out{{"id", one.id}, {"name", one.name}};
    if (!one.number.empty()) out["identifier"] = "Participant " + one.number;
    out["points"] = one.points;
    out["most"] = one.most;
    out["passed"] = one.passed;
    out["graded"] = one.graded;
    if (one.isOverridden) out["overridden"] = true;
    if (!one.comments.empty()) out["comments"] = one.comments;
    out["tasks"] = ordered_json::array();
    for (const TaskResult& task : one.tasks) {
        ordered_json entry;
        if (!task.task.empty()) entry["task"] = task.task;
        if (const TaskFailure* failure = task.failure())
            entry["failure"] = {{"code", failure->code}, {"message", failure->message}};
        else
            entry["grade"] = withoutTraits(gradeOf(task));
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

/// The text with the lines where it holds: "a (lines 3, 5 and 4 more)".
std::string withLines(Language language, const std::string& text, const std::vector<int>& lines) {
    constexpr std::size_t kListed = 6;
    if (lines.empty()) return text;
    if (lines.size() == 1)
        return textIn(language, message<"part.feedback/one-line">("text"_arg = uncut(text),
                                                                  "line"_arg = lines.front()));
    const std::span listed(lines.data(), std::min(kListed, lines.size()));
    const std::string list = joined(listed, ", ", [](int line) { return std::to_string(line); });
    const std::string more =
        lines.size() > kListed ? std::to_string(lines.size() - kListed) : std::string();
    return textIn(language, message<"part.feedback/lines">("text"_arg = uncut(text),
                                                           "lines"_arg = list, "more"_arg = more));
}

/// The words of view.js by their ids without "part.page/"; none for English, which it has.
ordered_json wordsIn(Language language) {
    ordered_json words = ordered_json::object();
    for (const MessageRow& row : kReportMessages)
        if (const auto text = templateOf(language, row.id))
            words[std::string(row.id.substr(row.id.find('/') + 1))] = *text;
    return words;
}

/// Of grades of earlier versions, too.
bool isNotGraded(const ordered_json& grade) {
    return grade.is_object() && grade.value("refused", false);
}

/// Points by the measure of each criterion.
std::map<std::string, double> criteriaOf(const TaskResult& task) {
    std::map<std::string, double> points;
    const ordered_json grade = gradeOf(task);
    if (grade.is_object())
        for (const auto& criterion : grade.value("criteria", ordered_json::array()))
            points[criterion.value("measure", "")] = criterion.value("points", 0.0);
    return points;
}

std::string identityFields(const Member& member) {
    return forCsv(member.number.empty() ? "" : "Participant " + member.number) + "," +
           forCsv(member.name);
}

/// The text for a student: each loss, then each finding.
std::string feedback(const SubmissionResult& one, Language language) {
    std::string out;
    const auto line = [&](const std::string& text) { out += (out.empty() ? "" : "\n") + text; };
    for (const std::string& comment : one.comments) line(comment);
    for (const TaskResult& task : one.tasks) {
        const std::string prefix = task.task.empty() ? "" : task.task + ": ";
        if (const TaskFailure* failure = task.failure()) {
            line(prefix + failure->message);
            continue;
        }
        const ordered_json grade = gradeOf(task);
        for (const auto& entry : grade.value("overrides", ordered_json::array())) {
            const std::string criterion = entry.value("criterion", "");
            if (entry.contains("comment"))
                line(prefix + (criterion.empty() ? "" : criterion + ": ") +
                     entry.value("comment", ""));
        }
        // Errors of the document follow below.
        if (grade.contains("reason") && grade.value("diagnostics", ordered_json::array()).empty())
            line(prefix +
                 textIn(language, message<"part.feedback/not-graded">(
                                      "reason"_arg = uncut(grade["reason"].value("message", "")))));
        for (const auto& finding : grade.value("findings", ordered_json::array())) {
            const double points = finding.value("points", 0.0);
            const bool isMissing = finding.value("code", "").ends_with(".missing");
            if (points > 0.0)
                line(prefix + finding.value("message", "") + " (-" + twoDigits(points) + ")");
            else if (isMissing)
                line(prefix + finding.value("message", ""));
        }
        const double unexplained =
            grade.value("unexplained", ordered_json::object()).value("points", 0.0);
        if (unexplained > 0.0)
            line(prefix + textIn(language, message<"part.feedback/unexplained">(
                                               "points"_arg = twoDigits(unexplained))));
        // An error at several places is listed once, with its lines.
        std::vector<std::pair<std::string, std::vector<int>>> errors;
        for (const auto& diagnostic : grade.value("diagnostics", ordered_json::array())) {
            if (diagnostic.value("severity", "") != "error" && !(grade.value("penalty", 0.0) > 0.0))
                continue;
            const std::string text = diagnostic.value("message", "");
            auto found = std::find_if(errors.begin(), errors.end(),
                                      [&](const auto& entry) { return entry.first == text; });
            if (found == errors.end()) found = errors.insert(errors.end(), {text, {}});
            if (diagnostic.contains("line")) found->second.push_back(diagnostic.value("line", 0));
        }
        for (const auto& [text, lines] : errors) line(prefix + withLines(language, text, lines));
        for (const auto& criterion : grade.value("criteria", ordered_json::array()))
            if (criterion.contains("measured") &&
                criterion.value("points", 0.0) < criterion.value("most", 0.0) &&
                !isNotGraded(grade))
                line(prefix + criterion.value("reason", ""));
    }
    return out;
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
    // Moodle requires a column of this name. It stays empty: reports have no times, and without
    // one Moodle overwrites an existing grade only if the teacher allows it.
    out << "Identifier,Full name,Grade,Maximum Grade,Last modified (grade),Passed,Submission,"
           "Feedback comments\r\n";
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        const std::string comments = forCsv(feedback(one, all.language));
        for (const Member& member : all.groups.membersOf(one.id, one.name, one.number))
            out << identityFields(member) << "," << (one.graded ? twoDigits(one.points) : "") << ","
                << twoDigits(one.most) << ",,"
                << (!one.graded  ? ""
                    : one.passed ? "yes"
                                 : "no")
                << "," << forCsv(one.id) << "," << comments << "\r\n";
    }
}

void writeCriteria(std::ostream& out, const ClassResult& all) {
    // Criteria as they first appear: each task may have another rubric.
    std::vector<std::vector<std::string>> criteria(all.tasks.size());
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        for (std::size_t t = 0; t < one.tasks.size() && t < criteria.size(); ++t)
            for (const auto& [measure, points] : criteriaOf(one.tasks[t]))
                if (std::find(criteria[t].begin(), criteria[t].end(), measure) == criteria[t].end())
                    criteria[t].push_back(measure);
    }
    out << "Identifier,Full name,Submission,Grade,By hand";
    for (std::size_t t = 0; t < criteria.size(); ++t) {
        const std::string task = all.tasks[t].empty() ? "" : all.tasks[t] + ": ";
        if (!task.empty()) out << "," << forCsv(all.tasks[t]);
        for (const std::string& measure : criteria[t]) out << "," << forCsv(task + measure);
    }
    out << "\r\n";
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        std::string fields;
        bool isByHand = one.isOverridden;
        for (std::size_t t = 0; t < criteria.size(); ++t) {
            const ordered_json grade = gradeOf(one.tasks[t]);
            isByHand = isByHand || grade.contains("overrides");
            const bool hasMark = grade.is_object() && !isNotGraded(grade);
            if (!all.tasks[t].empty())
                fields += "," + (hasMark ? twoDigits(grade.value("points", 0.0)) : "");
            const auto points = criteriaOf(one.tasks[t]);
            for (const std::string& measure : criteria[t]) {
                const auto found = points.find(measure);
                fields += "," + (hasMark && found != points.end() ? twoDigits(found->second) : "");
            }
        }
        for (const Member& member : all.groups.membersOf(one.id, one.name, one.number))
            out << identityFields(member) << "," << forCsv(one.id) << ","
                << (one.graded ? twoDigits(one.points) : "") << "," << (isByHand ? "yes" : "")
                << fields << "\r\n";
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
        << forMarkup(all.title) << "\" tests=\"" << tests << "\" failures=\"" << failures
        << "\" errors=\"" << errors << "\">\n";
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        for (const TaskResult& task : one.tasks) {
            const ordered_json grade = gradeOf(task);
            out << "<testcase classname=\"" << forMarkup(one.id) << "\" name=\""
                << forMarkup(task.task.empty() ? "grade" : task.task) << "\">";
            if (const TaskFailure* failure = task.failure())
                out << "<error type=\"" << forMarkup(failure->code) << "\" message=\""
                    << forMarkup(failure->message) << "\"/>";
            else if (isNotGraded(grade))
                out << "<error type=\"grade.refused\" message=\""
                    << forMarkup(feedback(one, all.language)) << "\"/>";
            else if (failed(task))
                out << "<failure message=\"" << twoDigits(grade.value("points", 0.0)) << " of "
                    << twoDigits(grade.value("most", 0.0)) << " points\">"
                    << forMarkup(feedback(one, all.language)) << "</failure>";
            out << "<system-out>" << twoDigits(grade.is_object() ? grade.value("points", 0.0) : 0.0)
                << " points</system-out></testcase>\n";
        }
    }
    out << "</testsuite>\n</testsuites>\n";
}

void writeHtml(std::ostream& out, const ClassResult& all) {
    const std::string_view page = pageFile("page.html");
    const auto put = [&](std::string_view text) { out << text; };
    const auto part = [&](std::string_view mark, std::size_t from) {
        const std::size_t at = page.find(mark, from);
        put(page.substr(from, at == std::string_view::npos ? at : at - from));
        return at == std::string_view::npos ? page.size() : at + mark.size();
    };
    std::size_t at = part("/*STYLE*/", 0);
    put(pageFile("page.css"));
    put(pageFile("view.css"));
    at = part("<!--DATA-->", at);
    put("<script type=\"application/json\" id=\"class\">");
    put(forScript(dumpJson(ordered_json{{"title", all.title},
                                        {"tasks", all.tasks},
                                        {"language", kLanguageWords[all.language]},
                                        {"words", wordsIn(all.language)}})));
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
    put(pageFile("view.js"));
    put(pageFile("page.js"));
    put(page.substr(at));
}

}  // namespace farol::grade
