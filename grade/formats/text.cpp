#include "grade/report/text.h"

#include <algorithm>
#include <iterator>

#include "grade/formats/formats.h"
#include "grade/messages.h"

namespace farol::grade {

std::string sentenceOf(const OutcomeFinding& finding) {
    return finding.points > 0.0 ? finding.message + " (-" + twoDigits(finding.points) + ")"
                                : finding.message;
}

std::string pointsOf(double points, double most) {
    return message<"part.outcome/points">("points"_arg = twoDigits(points),
                                          "most"_arg = twoDigits(most))
        .text;
}

std::vector<std::string> remarksOf(const OutcomePart& part) {
    std::vector<std::string> remarks;
    if (!part.isGraded)
        remarks.push_back(
            message<"part.outcome/not-graded">("reason"_arg = uncut(part.reason)).text);
    if (part.unexplained > 0.0)
        remarks.push_back(
            message<"part.outcome/unexplained">("points"_arg = twoDigits(part.unexplained)).text);
    if (part.penalty > 0.0)
        remarks.push_back(
            message<"part.outcome/penalty">("points"_arg = twoDigits(part.penalty)).text);
    return remarks;
}

std::vector<OutcomeFinding> diagnosticsOf(const OutcomePart& part) {
    std::vector<OutcomeFinding> out;
    std::copy_if(part.diagnostics.begin(), part.diagnostics.end(), std::back_inserter(out),
                 [&](const OutcomeFinding& one) { return one.message != part.reason; });
    return out;
}

std::string nameIn(const OutcomePart& part, const std::string& name) {
    return part.task.empty() ? name : part.task + ": " + name;
}

std::vector<std::string> linesOf(const Outcome& outcome) {
    std::vector<std::string> lines = outcome.comments;
    for (const OutcomePart& part : outcome.parts) {
        for (const OutcomeItem& item : part.items) {
            lines.push_back(nameIn(part, item.name + ": " + pointsOf(item.points, item.most)));
            for (const OutcomeFinding& finding : item.findings)
                lines.push_back(nameIn(part, sentenceOf(finding)));
        }
        for (const OutcomeFinding& finding : diagnosticsOf(part))
            lines.push_back(nameIn(part, sentenceOf(finding)));
        for (const std::string& remark : remarksOf(part)) lines.push_back(nameIn(part, remark));
    }
    return lines;
}

}  // namespace farol::grade
