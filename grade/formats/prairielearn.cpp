#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base64.h"
#include "core/bounded_json.h"
#include "grade/formats/formats.h"
#include "grade/messages.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMaxBytes = 1'000'000;  // the page says 1 MB

ordered_json testOf(const OutcomePart& part, const OutcomeItem& item) {
    std::string output;
    for (const OutcomeFinding& finding : item.findings) output += sentenceOf(finding) + "\n";
    return {{"name", nameIn(part, item.name)},
            {"points", item.points},
            {"max_points", item.most},
            {"message", item.reason},
            {"output", output}};
}

/// The text with the first `count` images.
std::string textOf(const ordered_json& result, const std::vector<const OutcomeImage*>& images,
                   std::size_t count) {
    ordered_json whole = result;
    if (count < images.size())
        whole["message"] = whole.value("message", "") + "\n" +
                           message<"part.outcome/images">("count"_arg = images.size() - count,
                                                          "max"_arg = kMaxBytes)
                               .text;
    ordered_json list = ordered_json::array();
    for (std::size_t i = 0; i < count; ++i)
        list.push_back({{"label", images[i]->label},
                        {"url", "data:image/jpeg;base64," + base64(images[i]->jpeg)}});
    if (!list.empty()) whole["images"] = std::move(list);
    return dumpJson(whole) + "\n";
}

}  // namespace

void writePrairieLearn(std::ostream& out, const Outcome& outcome, const FormatContext&) {
    std::string lines;
    for (const std::string& line : linesOf(outcome)) lines += line + "\n";
    const double share = outcome.most > 0.0 ? outcome.points / outcome.most : 0.0;
    ordered_json result{{"gradable", outcome.isGraded}};
    if (outcome.isGraded) result["score"] = std::clamp(share, 0.0, 1.0);
    result["message"] = pointsOf(outcome.points, outcome.most);
    if (!outcome.isGraded) {
        ordered_json errors = ordered_json::array();
        for (const OutcomePart& part : outcome.parts) errors.push_back(nameIn(part, part.reason));
        result["format_errors"] = std::move(errors);
    }
    result["output"] = lines;
    result["tests"] = ordered_json::array();
    std::vector<const OutcomeImage*> images;
    for (const OutcomePart& part : outcome.parts) {
        for (const OutcomeItem& item : part.items) result["tests"].push_back(testOf(part, item));
        for (const OutcomeImage& image : part.images) images.push_back(&image);
    }
    // Text alone may be too long: the list of findings goes first, then the output of each test.
    for (const bool hasOutput : {true, false}) {
        if (!hasOutput) {
            result["output"] = message<"part.outcome/text">("max"_arg = kMaxBytes).text;
            for (ordered_json& test : result["tests"]) test.erase("output");
        }
        for (std::size_t count = images.size() + 1; count-- > 0;) {
            const std::string text = textOf(result, images, count);
            if (text.size() > kMaxBytes) continue;
            out << text;
            return;
        }
    }
    result["tests"] = ordered_json::array();
    result.erase("format_errors");
    out << textOf(result, images, 0);
}

}  // namespace farol::grade
