#include <nlohmann/json.hpp>
#include <set>

#include "core/base64.h"
#include "core/bounded_json.h"
#include "grade/formats/formats.h"
#include "grade/report/text.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

std::string listItem(const std::string& text) { return "<li>" + forMarkup(text) + "</li>"; }

ordered_json tagsOf(const std::vector<OutcomeFinding>& findings) {
    ordered_json tags = ordered_json::array();
    std::set<std::string> known;
    for (const OutcomeFinding& finding : findings)
        if (!finding.code.empty() && known.insert(finding.code).second)
            tags.push_back(finding.code);
    return tags;
}

ordered_json testOf(const OutcomePart& part, const OutcomeItem& item, const std::string& number) {
    std::string output = item.reason.empty() ? "" : "<p>" + forMarkup(item.reason) + "</p>";
    std::string list;
    for (const OutcomeFinding& finding : item.findings) list += listItem(sentenceOf(finding));
    if (!list.empty()) output += "<ul>" + list + "</ul>";
    constexpr double kRounding = 0.005;  // of points with two digits
    ordered_json test{{"score", item.points},
                      {"max_score", item.most},
                      {"status", item.points >= item.most - kRounding ? "passed" : "failed"},
                      {"name", nameIn(part, item.name)},
                      {"name_format", "text"},
                      {"number", number},
                      {"output", output},
                      {"output_format", "html"},
                      {"visibility", "visible"}};
    if (const ordered_json tags = tagsOf(item.findings); !tags.empty()) test["tags"] = tags;
    return test;
}

/// A test without points: the diagnostics of the whole document, with the images.
ordered_json documentTest(const OutcomePart& part, const std::string& number) {
    std::string list, images;
    for (const std::string& remark : remarksOf(part)) list += listItem(remark);
    for (const OutcomeFinding& finding : diagnosticsOf(part)) list += listItem(sentenceOf(finding));
    for (const OutcomeImage& image : part.images) {
        const std::string label = forMarkup(image.label);
        images += "<figure><img alt=\"" + label + "\" src=\"data:image/jpeg;base64," +
                  base64(image.jpeg) + "\"><figcaption>" + label + "</figcaption></figure>";
    }
    ordered_json test{{"status", part.isGraded ? "passed" : "failed"},
                      {"name", nameIn(part, "document")},
                      {"name_format", "text"},
                      {"number", number},
                      {"output", (list.empty() ? "" : "<ul>" + list + "</ul>") + images},
                      {"output_format", "html"},
                      {"visibility", "visible"}};
    if (const ordered_json tags = tagsOf(part.diagnostics); !tags.empty()) test["tags"] = tags;
    return test;
}

}  // namespace

void writeGradescope(std::ostream& out, const Outcome& outcome, const FormatContext&) {
    std::string text = outcome.title + ": " + pointsOf(outcome.points, outcome.most);
    for (const std::string& comment : outcome.comments) text += "\n" + comment;
    ordered_json result{{"score", outcome.points},       {"output", text},
                        {"output_format", "text"},       {"visibility", "visible"},
                        {"stdout_visibility", "hidden"}, {"tests", ordered_json::array()}};
    for (std::size_t p = 0; p < outcome.parts.size(); ++p) {
        const OutcomePart& part = outcome.parts[p];
        const std::string prefix =
            outcome.parts.size() > 1 ? std::to_string(p + 1) + "." : std::string();
        std::size_t number = 0;
        for (const OutcomeItem& item : part.items)
            result["tests"].push_back(testOf(part, item, prefix + std::to_string(++number)));
        result["tests"].push_back(documentTest(part, prefix + std::to_string(++number)));
    }
    out << dumpJson(result, 1) << "\n";
}

}  // namespace farol::grade
