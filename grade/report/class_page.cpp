#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base64.h"
#include "core/bounded_json.h"
#include "core/text.h"
#include "grade/report/messages.h"
#include "grade/report/page_files.h"
#include "grade/report/report.h"
#include "grade/report/similarity.h"
#include "grade/report/text.h"
#include "grade/rubric/grader.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMaxPairs = 30, kShownTraits = 12;

/// How often a kind of mistake was made.
struct Frequency {
    std::size_t students = 0, places = 0;
    double points = 0;
    std::string example;
};

nlohmann::json parsedGrade(const TaskResult& task) {
    const TaskGrade* grade = task.grade();
    return grade == nullptr ? nlohmann::json::object() : parseJson(grade->json, kGradeJson);
}

/// A word of the page, escaped.
std::string wordIn(const ClassResult& all, const Message& message) {
    return forMarkup(textIn(all.language, message));
}

void writeFrequencies(std::ostream& out, const ClassResult& all) {
    std::map<std::string, Frequency> byCode;
    for (std::size_t i = 0; i < all.count; ++i) {
        std::set<std::string> counted;
        for (const TaskResult& task : all.at(i).tasks)
            for (const auto& finding :
                 parsedGrade(task).value("findings", nlohmann::json::array())) {
                Frequency& entry = byCode[finding.value("code", "")];
                entry.students += counted.insert(finding.value("code", "")).second ? 1 : 0;
                entry.places += finding.value("places", nlohmann::json::array()).size();
                entry.points += finding.value("points", 0.0);
                if (entry.example.empty()) entry.example = finding.value("message", "");
            }
    }
    std::vector<std::pair<std::string, Frequency>> ranked(byCode.begin(), byCode.end());
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
        return a.second.students > b.second.students;
    });
    out << "<h2>" << wordIn(all, reportMessage<"part.page/class-mistakes">())
        << "</h2>\n<table><thead><tr>";
    for (const Message& head :
         {reportMessage<"part.page/class-mistake">(), reportMessage<"part.page/class-students">(),
          reportMessage<"part.page/class-places">(), reportMessage<"part.page/class-points">(),
          reportMessage<"part.page/class-example">()})
        out << "<th>" << wordIn(all, head) << "</th>";
    out << "</tr></thead><tbody>\n";
    for (const auto& [code, entry] : ranked) {
        out << "<tr><td>" << forMarkup(aboutKind(code, all.language)) << "</td><td>"
            << entry.students << "</td><td>" << entry.places << "</td><td>"
            << twoDigits(entry.points / static_cast<double>(entry.students)) << "</td><td>"
            << forMarkup(entry.example) << "</td></tr>\n";
    }
    out << "</tbody></table>\n";
}

void writeSheet(std::ostream& out, const ClassResult& all) {
    out << "<h2>" << wordIn(all, reportMessage<"part.page/class-sheet">())
        << "</h2>\n<div class=\"sheet\">\n";
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        const std::string name = forMarkup(one.name.empty() ? one.id : one.name);
        out << "<figure>";
        for (std::size_t t = 0; t < one.tasks.size(); ++t) {
            const TaskGrade* grade = one.tasks[t].grade();
            std::string image;
            if (grade != nullptr && !grade->pictures.empty()) {
                image = grade->pictures.front();
                // It looks as the reference does.
                if (image.empty() && t < all.references.size() && !all.references[t].empty())
                    image = all.references[t].front();
            }
            if (!image.empty())
                out << "<img alt=\"" << name << "\" loading=\"lazy\" src=\"data:image/jpeg;base64,"
                    << base64(image) << "\">";
        }
        out << "<figcaption>" << name << "<b>"
            << (one.graded ? twoDigits(one.points)
                           : wordIn(all, reportMessage<"part.page/not-graded">()))
            << "</b></figcaption></figure>\n";
    }
    out << "</div>\n";
}

void writeShared(std::ostream& out, const std::string& title,
                 const std::vector<std::string>& texts) {
    if (texts.empty()) return;
    out << "<p>" << title << "</p><ul>";
    for (std::size_t i = 0; i < std::min(texts.size(), kShownTraits); ++i)
        out << "<li>" << forMarkup(texts[i]) << "</li>";
    out << "</ul>";
}

void writeSimilar(std::ostream& out, const ClassResult& all) {
    out << "<h2>" << wordIn(all, reportMessage<"part.page/class-similar">()) << "</h2>\n<p>"
        << wordIn(all, reportMessage<"part.page/class-similar-about">()) << ".</p>\n";
    const std::vector<SimilarPair> pairs = similarPairs(all, kMaxPairs);
    if (pairs.empty())
        out << "<p>" << wordIn(all, reportMessage<"part.page/class-none">()) << ".</p>\n";
    for (const SimilarPair& pair : pairs) {
        const SubmissionResult both[2] = {all.at(pair.first), all.at(pair.second)};
        const auto name = [&](const SubmissionResult& one) {
            return one.name.empty() ? one.id : one.name;
        };
        out << "<details><summary>"
            << wordIn(all,
                      reportMessage<"part.page/class-both">(
                          "first"_arg = uncut(name(both[0])), "second"_arg = uncut(name(both[1])),
                          "task"_arg = uncut(all.tasks[pair.task])))
            << "<b>" << twoDigits(pair.score) << "</b></summary>\n";
        writeShared(
            out,
            wordIn(all, reportMessage<"part.page/class-same">("count"_arg = pair.causes.size())),
            pair.causes);
        writeShared(
            out,
            wordIn(all, reportMessage<"part.page/class-objects">("count"_arg = pair.places.size())),
            pair.places);
        writeShared(out,
                    wordIn(all, reportMessage<"part.page/class-comments">(
                                    "count"_arg = pair.comments.size())),
                    pair.comments);
        out << "<p>" << wordIn(all, reportMessage<"part.page/class-alike">("count"_arg = pair.runs))
            << "</p>\n<div class=\"both\">";
        for (const SubmissionResult& one : both)
            out << "<div><h3>" << forMarkup(name(one)) << "</h3><pre>"
                << forMarkup(parsedGrade(one.tasks[pair.task]).value("document", ""))
                << "</pre></div>";
        out << "</div></details>\n";
    }
}

}  // namespace

void writeClassPage(std::ostream& out, const ClassResult& all) {
    out << "<!doctype html>\n<html lang=\"" << kLanguageWords[all.language]
        << "\"><head><meta charset=\"utf-8\">\n<meta "
           "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta "
           "name=\"color-scheme\" content=\"light dark\">\n<meta "
           "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
           "style-src 'unsafe-inline'\">\n<title>"
        << forMarkup(all.title) << "</title>\n<style>" << pageFile("class.css")
        << "</style></head>\n<body>\n<h1>" << forMarkup(all.title) << "</h1>\n";
    double sum = 0.0;
    std::size_t graded = 0, passed = 0;
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        graded += one.graded ? 1 : 0;
        passed += one.passed ? 1 : 0;
        sum += one.graded ? one.points : 0.0;
    }
    const std::string mean = graded > 0 ? twoDigits(sum / static_cast<double>(graded)) : "-";
    out << "<p>"
        << wordIn(all, reportMessage<"part.page/class-summary">(
                           "count"_arg = all.count, "graded"_arg = graded, "passed"_arg = passed,
                           "mean"_arg = mean))
        << "</p>\n";
    writeFrequencies(out, all);
    writeSheet(out, all);
    writeSimilar(out, all);
    out << "</body></html>\n";
}

}  // namespace farol::grade
