#include <cmath>
#include <nlohmann/json.hpp>

#include "core/bounded_json.h"
#include "grade/formats/formats.h"

namespace farol::grade {

using nlohmann::ordered_json;

void writeClassroom50(std::ostream& out, const Outcome& outcome, const FormatContext& context) {
    const auto variable = [&](const std::string& name) {
        const auto found = context.environment.find(name);
        return found == context.environment.end() ? std::string() : found->second;
    };
    // Scores are integers that add up. A criterion's points are not, so the submission is one
    // test, with its criteria as fields of ours, which the page allows.
    const auto score = static_cast<long>(std::lround(outcome.points));
    const auto most = static_cast<long>(std::lround(outcome.most));
    ordered_json test{{"test-name", outcome.title},
                      {"passed", outcome.isPassed},
                      {"score", score},
                      {"max-score", most},
                      {"criteria", ordered_json::array()},
                      {"messages", linesOf(outcome)}};
    for (const OutcomePart& part : outcome.parts)
        for (const OutcomeItem& item : part.items)
            test["criteria"].push_back(
                {{"name", nameIn(part, item.name)}, {"points", item.points}, {"most", item.most}});
    const std::string commit = variable("COMMIT_URL"), review = variable("REVIEW_URL");
    out << dumpJson(ordered_json{{"schema", "classroom50/result/v1"},
                                 {"classroom", variable("CLASSROOM")},
                                 {"assignment", variable("ASSIGNMENT")},
                                 {"submission", variable("SUBMISSION_TAG")},
                                 {"commit", commit},
                                 {"release", variable("RELEASE_URL")},
                                 {"review", review.empty() ? commit : review},
                                 {"datetime", context.utc},
                                 {"score", score},
                                 {"max-score", most},
                                 {"tests", ordered_json::array({std::move(test)})}},
                    1)
        << "\n";
}

}  // namespace farol::grade
