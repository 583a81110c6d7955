#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "grade/requirements/messages.h"
#include "grade/rubric/grader.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

double twoDigits(double points) { return std::round(points * 100.0) / 100.0; }

/// A measured value, to digits that no machine's arithmetic changes.
double sixDigits(double measured) { return std::round(measured * 1e6) / 1e6; }

/// A text as a sentence, with a capital letter and a full stop.
std::string sentenceIn(Language language, const Message& message) {
    std::string text = textIn(language, message) + ".";
    if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

/// A number, or an object of several.
ordered_json columnsOf(const ImageMetric& metric, const Measurement& measured) {
    if (metric.columns.size() == 1) return sixDigits(measured.columns.front());
    ordered_json out;
    for (std::size_t i = 0; i < metric.columns.size(); ++i)
        out[std::string(metric.columns[i].key)] = sixDigits(measured.columns[i]);
    return out;
}

ordered_json placeOf(const Location& where) {
    ordered_json out = ordered_json::object();  // a finding need not have a place
    if (!where.file.empty()) out["file"] = where.file;
    if (where.line > 0) out["line"] = where.line;
    if (where.column > 0) out["column"] = where.column;
    return out;
}

ordered_json causesOf(const Grade& grade, Language language) {
    ordered_json out = ordered_json::array();
    for (const GradedCause& one : grade.causes) {
        ordered_json entry{{"code", one.code},
                           {"criterion", kTopicWords[kindOf(one.code).topic]},
                           {"message", textIn(language, one)},
                           {"points", twoDigits(one.points)},
                           {"seen", one.isSeen},
                           {"spoils", sixDigits(one.spoiled)}};
        entry.update(placeOf(one.places.front().where));
        if (!one.places.front().excerpt.empty()) entry["excerpt"] = one.places.front().excerpt;
        entry["places"] = ordered_json::array();
        for (const CausePlace& place : one.places) {
            ordered_json where{{"who", textIn(language, place.who)}};
            where.update(placeOf(place.where));
            if (&place != &one.places.front() && !place.excerpt.empty())
                where["excerpt"] = place.excerpt;
            entry["places"].push_back(std::move(where));
        }
        out.push_back(std::move(entry));
    }
    return out;
}

ordered_json thingOf(const RequiredThing& thing, Language language) {
    ordered_json out{{"who", textIn(language, thing.who)}};
    if (!thing.reason.empty()) out["message"] = textIn(language, thing.reason);
    out.update(placeOf(thing.where));
    if (!thing.excerpt.empty()) out["excerpt"] = thing.excerpt;
    return out;
}

ordered_json thingsOf(const std::vector<RequiredThing>& things, Language language) {
    ordered_json out = ordered_json::array();
    for (const RequiredThing& thing : things) out.push_back(thingOf(thing, language));
    return out;
}

/// Requirements and marks by hand stand among the criteria, with their kind.
void addRequirements(const Grade& grade, ordered_json& criteria, Language language) {
    for (const RequirementGrade& one : grade.requirements)
        criteria.push_back({{"measure", one.id},
                            {"kind", "requirement"},
                            {"text", one.text},
                            {"state", kMetWords[one.met]},
                            {"points", twoDigits(one.points)},
                            {"most", twoDigits(one.most)},
                            {"reason", textIn(language, one.reason)},
                            {"found", one.found},
                            {"needed", one.needed},
                            {"matches", thingsOf(one.matches, language)},
                            {"misses", thingsOf(one.misses, language)}});
    for (const ManualCriterion& one : grade.manual)
        criteria.push_back(
            {{"measure", one.id},
             {"kind", "manual"},
             {"text", one.text},
             {"state", "open"},
             {"points", 0.0},
             {"most", twoDigits(one.points)},
             {"reason", textIn(language, requirementMessage<"part.manual/open">())}});
}

/// What is not met is a finding, too, so that every report shows it with its lines.
void addUnmet(const Grade& grade, ordered_json& findings, Language language) {
    for (const RequirementGrade& one : grade.requirements) {
        if (one.met == Met::yes) continue;
        const Message first = one.misses.empty() ? Message{}
                                                 : requirementMessage<"part.miss/of">(
                                                       "who"_arg = one.misses.front().who,
                                                       "reason"_arg = one.misses.front().reason);
        const auto text = "text"_arg = uncut(one.text);
        const auto reason = "reason"_arg = one.reason;
        const auto miss = "miss"_arg = first;
        const Message message = one.met == Met::partly
                                    ? requirementMessage<"requirement.partly">(text, reason, miss)
                                    : requirementMessage<"requirement.unmet">(text, reason, miss);
        ordered_json entry{{"code", message.code()},
                           {"criterion", one.id},
                           {"message", textIn(language, message)},
                           {"points", twoDigits(one.most - one.points)},
                           {"seen", true},
                           {"spoils", 0.0}};
        if (!one.misses.empty()) entry.update(placeOf(one.misses.front().where));
        if (!one.misses.empty() && !one.misses.front().excerpt.empty())
            entry["excerpt"] = one.misses.front().excerpt;
        entry["places"] = thingsOf(one.misses, language);
        findings.push_back(std::move(entry));
    }
}

ordered_json viewsOf(const Grade& grade) {
    // Parts outside the rubric are not shown: a 0 would mean that nothing differs.
    std::set<const MetricSpec*> judged;
    for (const CriterionGrade& one : grade.criteria) judged.insert(one.metric);
    ordered_json out = ordered_json::array();
    for (const ViewGrade& one : grade.views) {
        ordered_json view{
            {"name", one.name}, {"time", one.timeS}, {"width", one.width}, {"height", one.height}};
        for (const MetricSpec& metric : metrics()) {
            const auto found = one.measured.find(&metric);
            if (found == one.measured.end()) continue;
            if (&metric == &mainMetric() || judged.count(&metric) != 0)
                view[std::string(metric.name)] = columnsOf(*metric.image(), found->second);
        }
        out.push_back(std::move(view));
    }
    return out;
}

}  // namespace

std::string toJson(const Grade& grade, Language language) {
    ordered_json out{
        {"state", grade.notGraded ? "not graded" : "graded"},
        {"points", grade.points},
        {"most", grade.most},
        {"passed", grade.passed},
        {"refused", grade.notGraded.has_value()},
        {"visible", grade.visible},
        {"present", sixDigits(grade.present)},
        {"penalty", grade.penalty},
        {"unexplained",
         {{"points", grade.unexplained}, {"share", sixDigits(grade.unexplainedShare)}}}};
    if (grade.notGraded)
        out["reason"] = {{"code", grade.notGraded->code},
                         {"message", textIn(language, grade.notGraded->reason)}};
    if (grade.similarity) out["similarity"] = sixDigits(*grade.similarity);
    out["criteria"] = ordered_json::array();
    for (const CriterionGrade& one : grade.criteria) {
        ordered_json entry{{"measure", one.metric->name},
                           {"points", twoDigits(one.points)},
                           {"most", twoDigits(one.most)}};
        if (one.metric->image() != nullptr) entry["measured"] = sixDigits(one.measured);
        entry["reason"] = sentenceIn(language, one.reason);
        out["criteria"].push_back(std::move(entry));
    }
    addRequirements(grade, out["criteria"], language);
    out["findings"] = causesOf(grade, language);
    addUnmet(grade, out["findings"], language);
    out["diagnostics"] = ordered_json::array();
    for (std::size_t i = 0; i < grade.diagnostics.size(); ++i) {
        const Diagnostic& one = grade.diagnostics[i];
        // Notes of the reader about right scenes are left out; those of the grader are not.
        if (one.severity == Severity::info && !one.code.starts_with("grade.")) continue;
        ordered_json entry{{"code", one.code}, {"severity", kSeverityWords[one.severity]}};
        entry.update(placeOf(one.where));
        entry["message"] = textIn(language, one);
        if (i < grade.excerpts.size() && !grade.excerpts[i].empty())
            entry["excerpt"] = grade.excerpts[i];
        out["diagnostics"].push_back(std::move(entry));
    }
    out["views"] = viewsOf(grade);
    if (!grade.document.empty()) {
        out["traits"] = {{"causes", grade.traits.causes},
                         {"places", grade.traits.places},
                         {"comments", grade.traits.comments},
                         {"runs", grade.traits.runs}};
        out["document"] = grade.document;
    }
    return dumpJson(out);
}

}  // namespace farol::grade
