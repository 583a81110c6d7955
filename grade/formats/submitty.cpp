#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/bounded_json.h"
#include "grade/formats/formats.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

constexpr EnumWords<Severity, Severity::error> kStatusWords{"information", "warning", "failure"};

}  // namespace

void writeSubmitty(std::ostream& out, const Outcome& outcome, const FormatContext&) {
    ordered_json messages = ordered_json::array();
    const auto say = [&](const std::string& text, std::string_view status) {
        messages.push_back({{"message", text}, {"status", status}});
    };
    say(pointsOf(outcome.points, outcome.most), outcome.isPassed ? "success" : "failure");
    for (const std::string& comment : outcome.comments) say(comment, "information");
    for (const OutcomePart& part : outcome.parts) {
        const auto add = [&](const OutcomeFinding& finding) {
            say(nameIn(part, sentenceOf(finding)),
                finding.points > 0.0 ? "failure" : kStatusWords[finding.severity]);
        };
        for (const OutcomeItem& item : part.items)
            for (const OutcomeFinding& finding : item.findings) add(finding);
        for (const OutcomeFinding& finding : diagnosticsOf(part)) add(finding);
        for (const std::string& remark : remarksOf(part)) say(nameIn(part, remark), "failure");
    }
    const double share = outcome.most > 0.0 ? outcome.points / outcome.most : 0.0;
    out << dumpJson(ordered_json{{"status", "success"},
                                 {"data",
                                  {{"score", std::clamp(share, 0.0, 1.0)},
                                   {"message", std::move(messages)}}}},
                    1)
        << "\n";
}

}  // namespace farol::grade
