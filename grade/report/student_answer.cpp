#include "grade/report/student_answer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "grade/images/compare.h"
#include "grade/report/student_messages.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

/// The text of a criterion's finding: the same for all of its causes.
Message differenceOf(Topic topic) {
    switch (topic) {
        case Topic::models:
            return studentMessage<"part.differs/models">();
        case Topic::transforms:
            return studentMessage<"part.differs/transforms">();
        case Topic::textures:
            return studentMessage<"part.differs/textures">();
        case Topic::materials:
            return studentMessage<"part.differs/materials">();
        case Topic::lights:
            return studentMessage<"part.differs/lights">();
        case Topic::camera:
            return studentMessage<"part.differs/camera">();
        case Topic::animation:
            break;
    }
    return studentMessage<"part.differs/animation">();
}

ordered_json placeOf(const Location& where) {
    ordered_json out = ordered_json::object();
    if (!where.file.empty()) out["file"] = where.file;
    if (where.line > 0) out["line"] = where.line;
    return out;
}

ordered_json requirementsOf(const Grade& grade, Language language) {
    ordered_json out = ordered_json::array();
    for (const RequirementGrade& one : grade.requirements) {
        ordered_json entry{{"id", one.id},
                           {"text", one.text},
                           {"state", kMetWords[one.met]},
                           {"reason", textIn(language, one.reason)},
                           {"matches", ordered_json::array()},
                           {"misses", ordered_json::array()}};
        for (const auto& [key, things] :
             {std::pair{"matches", &one.matches}, {"misses", &one.misses}})
            for (const RequiredThing& thing : *things) {
                ordered_json place{{"who", textIn(language, thing.who)}};
                if (!thing.reason.empty()) place["message"] = textIn(language, thing.reason);
                place.update(placeOf(thing.where));
                entry[key].push_back(std::move(place));
            }
        out.push_back(std::move(entry));
    }
    return out;
}

/// One finding for each line and criterion, in the document's order: neither the number of causes
/// at a line nor their points can be read from it. What is missing has no line.
ordered_json findingsOf(const Grade& grade, const StudentView& view, Language language) {
    std::set<std::tuple<std::string, int, Topic>> places;
    for (const GradedCause& cause : grade.causes) {
        const Topic topic = kindOf(cause.code).topic;
        if (!cause.isSeen || !view.isShown(*kShownWords.find(kTopicWords[topic]))) continue;
        for (const CausePlace& place : cause.places) {
            const bool isHere = place.where.line > 0;
            places.emplace(isHere ? place.where.file : "", place.where.line, topic);
        }
    }
    ordered_json out = ordered_json::array();
    for (const auto& [file, line, topic] : places) {
        const Message text =
            line > 0 ? differenceOf(topic) : studentMessage<"part.differs/missing">();
        ordered_json entry{{"criterion", kTopicWords[topic]}, {"message", textIn(language, text)}};
        entry.update(placeOf({file, line, 0}));
        out.push_back(std::move(entry));
    }
    return out;
}

}  // namespace

bool StudentView::isShown(Shown what) const {
    return std::find(shows.begin(), shows.end(), kShownWords[what]) != shows.end();
}

int bandOf(const Grade& grade, int bands) {
    double most = grade.most;
    for (const ManualCriterion& open : grade.manual) most -= open.points;
    if (grade.notGraded || most <= 0.0) return 0;
    const double share = std::clamp(grade.points / most, 0.0, 1.0);
    // Points have two digits: a share on the border belongs to the upper band.
    return std::min(bands - 1, static_cast<int>(std::floor(share * bands + 1e-9)));
}

std::string studentAnswer(const Grade& grade, const StudentView& view, Language language) {
    const int band = bandOf(grade, view.bands);
    const auto percent = [&](int step) { return std::round(100.0 * step / view.bands); };
    ordered_json out{{"points",
                      {{"band", band},
                       {"bands", view.bands},
                       {"fromPercent", percent(band)},
                       {"toPercent", percent(band + 1)}}}};
    if (view.isShown(Shown::requirements)) out["requirements"] = requirementsOf(grade, language);
    const bool showsCriteria =
        std::any_of(view.shows.begin(), view.shows.end(),
                    [](const std::string& word) { return kTopicWords.find(word).has_value(); });
    if (showsCriteria) out["findings"] = findingsOf(grade, view, language);
    if (view.hasMask) {
        const bool isThere = !grade.views.empty() && !grade.views.front().mask.empty();
        out["mask"] = {
            {"columns", kMaskColumns},
            {"rows", kMaskRows},
            {"cells", isThere ? grade.views.front().mask
                              : std::string(std::size_t{kMaskColumns} * kMaskRows, '0')}};
    }
    return dumpJson(out);
}

}  // namespace farol::grade
