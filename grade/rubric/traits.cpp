#include "grade/rubric/traits.h"

#include <cmath>
#include <set>
#include <string_view>

#include "core/digest.h"
#include "core/text.h"
#include "grade/rubric/metrics.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMaxTraits = 300, kMaxTraitBytes = 200;

/// One blank for each run of blanks.
std::string collapsed(std::string_view text) { return joined(split(text), " "); }

std::set<std::string> commentsOf(std::string_view xml) {
    constexpr std::size_t kMinComment = 6;  // shorter ones are anyone's
    std::set<std::string> comments;
    for (std::size_t at = 0; (at = xml.find("<!--", at)) != std::string_view::npos;) {
        const std::size_t end = xml.find("-->", at);
        if (end == std::string_view::npos) break;
        const std::string text = collapsed(xml.substr(at + 4, end - at - 4));
        if (text.size() >= kMinComment) comments.insert(toUtf8(text));
        at = end;
    }
    return comments;
}

/// Returns digests of four consecutive tags: independent authors seldom write the same ones.
std::set<std::string> runsOf(std::string_view xml) {
    constexpr std::size_t kRun = 4, kDigits = 12;
    std::vector<std::string> tags;
    for (std::size_t at = 0; (at = xml.find('<', at)) != std::string_view::npos;) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string_view::npos) break;
        if (xml[at + 1] != '!') tags.push_back(collapsed(xml.substr(at, end + 1 - at)));
        at = end;
    }
    std::set<std::string> runs;
    for (std::size_t i = 0; i + kRun <= tags.size(); ++i) {
        std::string run;
        for (std::size_t k = i; k < i + kRun; ++k) run += tags[k];
        runs.insert(contentDigest(run).substr(0, kDigits));
    }
    return runs;
}

std::set<std::string> placesOf(const Outline& outline) {
    std::set<std::string> places;
    const Poses poses = posesOf(outline, 0.0);
    for (const Outline::Item& item : outline.items) {
        if (item.isGone) continue;
        const glm::dmat4& pose = poses[static_cast<std::size_t>(item.node)];
        std::string text = nameOfItem(outline, static_cast<int>(&item - outline.items.data())).text;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row) {
                constexpr double kSteps = 1e3;
                const double value = std::round(pose[column][row] * kSteps) / kSteps;
                text += " " + shortNumber(value == 0.0 ? 0.0 : value);  // no -0
            }
        places.insert(text);
    }
    return places;
}

/// Those of `all` that are not the reference's, within the bounds.
std::vector<std::string> without(const std::set<std::string>& all,
                                 const std::set<std::string>& theirs) {
    std::vector<std::string> left;
    for (const std::string& text : all)
        if (theirs.count(text) == 0 && left.size() < kMaxTraits)
            left.push_back(toUtf8(std::string_view(text).substr(0, kMaxTraitBytes)));
    return left;
}

}  // namespace

Traits traitsOf(const Diagnosis& diagnosis, const Outline& reference, const std::string& xml,
                const std::string& referenceXml) {
    std::set<std::string> causes;
    for (const Cause& cause : diagnosis.causes)
        for (const Fix& fix : cause.fixes)
            if (!fix.words.values.empty())
                causes.insert(fix.who.text + ": " + fix.words.finding.text + ", " +
                              fix.words.values.text);
    return {without(causes, {}), without(placesOf(diagnosis.submitted), placesOf(reference)),
            without(commentsOf(xml), commentsOf(referenceXml)),
            without(runsOf(xml), runsOf(referenceXml))};
}

}  // namespace farol::grade
