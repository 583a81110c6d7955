#include <cmath>
#include <nlohmann/json.hpp>

#include "core/bounded_json.h"
#include "grade/report/agreement.h"
#include "grade/report/page_files.h"
#include "grade/report/text.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

std::string threeDigits(const std::optional<double>& value) {
    if (!value) return "not defined";
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", *value);
    return text;
}

std::string withInterval(const std::optional<double>& value,
                         const std::optional<Interval>& interval) {
    if (!value || !interval) return threeDigits(value);
    return threeDigits(value) + " (95 %: " + threeDigits(interval->low) + " to " +
           threeDigits(interval->high) + ")";
}

/// Escapes all but unreserved characters (RFC 3986), as encodeURIComponent() on the report's page.
std::string fragmentOf(const std::string& id) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string out;
    for (const char c : id) {
        const auto byte = static_cast<unsigned char>(c);
        const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                             (c >= '0' && c <= '9') ||
                             std::string_view("-_.!~*'()").find(c) != std::string_view::npos;
        if (isPlain)
            out += c;
        else
            out += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
    return out;
}

void writeFigure(std::ostream& out, const std::string& name, const std::string& value) {
    out << "<tr><th scope=\"row\">" << forMarkup(name) << "</th><td>" << forMarkup(value)
        << "</td></tr>\n";
}

void writeFigures(std::ostream& out, const Agreement& agreement) {
    out << "<table>\n";
    writeFigure(out, "submissions with both marks", std::to_string(agreement.submissions.size()));
    writeFigure(out, "raters", std::to_string(agreement.raters.size()) + " and the program");
    writeFigure(out, "Krippendorff's alpha (interval), program and people",
                withInterval(agreement.alpha, agreement.alphaInterval));
    if (agreement.raters.size() > 1)
        writeFigure(out, "Krippendorff's alpha (interval), people alone",
                    withInterval(agreement.alphaPeople, agreement.alphaPeopleInterval));
    writeFigure(out, "Kendall's tau-b", threeDigits(agreement.tauB));
    writeFigure(
        out, "mean absolute difference",
        twoDigits(agreement.meanDifference) + " of " + twoDigits(agreement.most) + " points");
    writeFigure(out, "mean of program - people", twoDigits(agreement.bias) + " points");
    if (agreement.bands > 0)
        writeFigure(out, "marks in the person's band (1 point of slack)",
                    std::to_string(agreement.inBand) + " of " + std::to_string(agreement.bands));
    if (agreement.ungraded > 0)
        writeFigure(out, "left out: not graded by the program", std::to_string(agreement.ungraded));
    if (agreement.unmarked > 0)
        writeFigure(out, "left out: no mark by a person", std::to_string(agreement.unmarked));
    if (agreement.overridden > 0)
        writeFigure(out, "left out: the mark is the teacher's",
                    std::to_string(agreement.overridden));
    out << "</table>\n";
}

std::string markText(const PersonMark& mark) {
    std::string text = mark.rater.empty() ? "" : mark.rater + ": ";
    text += twoDigits(mark.mark);
    if (mark.band)
        text += " (" + twoDigits(mark.band->low) + " to " + twoDigits(mark.band->high) + ")";
    return mark.comment.empty() ? text : text + " " + mark.comment;
}

}  // namespace

void writeAgreementPage(std::ostream& out, const Agreement& agreement) {
    out << "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta "
           "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta "
           "name=\"color-scheme\" content=\"light dark\">\n<meta "
           "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
           "'unsafe-inline'\">\n<title>Agreement: "
        << forMarkup(agreement.title) << "</title>\n<style>" << pageFile("class.css")
        << "</style></head>\n<body>\n<h1>Agreement: " << forMarkup(agreement.title) << "</h1>\n";
    writeFigures(out, agreement);
    out << "<h2>Submissions, the largest difference first</h2>\n<table><thead><tr><th "
           "scope=\"col\">Submission</th><th scope=\"col\">Program</th><th "
           "scope=\"col\">People</th><th scope=\"col\">Difference</th><th scope=\"col\">Marks by "
           "people</th></tr></thead><tbody>\n";
    for (const MarkedTwice& one : agreement.submissions) {
        out << "<tr><td><a href=\"report.html#" << fragmentOf(one.id) << "\">"
            << forMarkup(one.name.empty() ? one.id : one.name) << "</a></td><td>"
            << twoDigits(one.program) << "</td><td>" << twoDigits(one.people) << "</td><td>"
            << twoDigits(one.program - one.people) << "</td><td>";
        for (const PersonMark* mark : one.marks) {
            const std::string text = forMarkup(markText(*mark));
            out << "<p>";
            if (mark->page.empty())
                out << text;
            else
                out << "<a rel=\"noreferrer\" href=\"" << forMarkup(mark->page) << "\">" << text
                    << "</a>";
            out << "</p>";
        }
        out << "</td></tr>\n";
    }
    out << "</tbody></table>\n</body></html>\n";
}

void writeAgreementJson(std::ostream& out, const Agreement& agreement) {
    const auto number = [](const std::optional<double>& value) {
        return value ? ordered_json(std::round(*value * 1e6) / 1e6) : ordered_json();
    };
    const auto interval = [&](const std::optional<Interval>& value) {
        return value ? ordered_json::array({number(value->low), number(value->high)})
                     : ordered_json();
    };
    ordered_json document{{"title", agreement.title},
                          {"most", agreement.most},
                          {"raters", agreement.raters},
                          {"alpha", number(agreement.alpha)},
                          {"alphaInterval", interval(agreement.alphaInterval)},
                          {"alphaPeople", number(agreement.alphaPeople)},
                          {"alphaPeopleInterval", interval(agreement.alphaPeopleInterval)},
                          {"tauB", number(agreement.tauB)},
                          {"meanDifference", number(agreement.meanDifference)},
                          {"bias", number(agreement.bias)},
                          {"bands", agreement.bands},
                          {"inBand", agreement.inBand},
                          {"ungraded", agreement.ungraded},
                          {"unmarked", agreement.unmarked},
                          {"overridden", agreement.overridden},
                          {"submissions", ordered_json::array()}};
    for (const MarkedTwice& one : agreement.submissions) {
        ordered_json entry{{"id", one.id},
                           {"name", one.name},
                           {"program", one.program},
                           {"people", number(one.people)},
                           {"marks", ordered_json::array()}};
        for (const PersonMark* mark : one.marks) {
            ordered_json row{{"rater", mark->rater}, {"mark", mark->mark}};
            if (mark->band) row["band"] = {mark->band->low, mark->band->high};
            if (!mark->comment.empty()) row["comment"] = mark->comment;
            if (!mark->page.empty()) row["page"] = mark->page;
            entry["marks"].push_back(std::move(row));
        }
        document["submissions"].push_back(std::move(entry));
    }
    out << dumpJson(document, 1) << "\n";
}

}  // namespace farol::grade
