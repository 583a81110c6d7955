#include "grade/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/words.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

double rounded(double points) { return std::round(points * 100.0) / 100.0; }

/// What is measured, to digits that no machine's arithmetic changes.
double sixDigits(double measured) { return std::round(measured * 1e6) / 1e6; }

std::string percent(double share) { return shortNumber(std::round(share * 1000.0) / 10.0) + " %"; }

double measuredIn(const ViewGrade& view, Measure measure) {
    switch (measure) {
        case Measure::difference:
            return view.difference;
        case Measure::flip:
            return view.flipMean;
        case Measure::ssim:
            return std::clamp(1.0 - view.ssim, 0.0, 1.0);
        case Measure::coverage:
            return view.coverage;
        case Measure::depth:
            return view.depth;
        default:
            return view.normals;
    }
}

/// What a measure says, before the number and after it.
std::string sentence(Measure measure, double value) {
    switch (measure) {
        case Measure::difference:
            return percent(value) + " of what the pictures show differs beyond a pixel's shift";
        case Measure::flip:
            return "a person who switches between the pictures sees a difference of " +
                   shortNumber(std::round(value * 1000.0) / 1000.0) + " of 1 (mean FLIP)";
        case Measure::ssim:
            return "the structure of the pictures differs by " + percent(value) + " (1 - SSIM)";
        case Measure::coverage:
            return "objects cover " + percent(value) +
                   " of their pixels elsewhere than expected (1 - IoU)";
        case Measure::depth:
            return percent(value) + " of the objects' pixels lie at another depth";
        default:
            return percent(value) + " of the objects' pixels have another normal";
    }
}

const char* subjectOf(Measure measure) {
    constexpr std::array<const char*, 6> kSubjects{"transforms", "models", "textures",
                                                   "materials",  "lights", "camera"};
    return kSubjects[static_cast<std::size_t>(measure) -
                     static_cast<std::size_t>(Measure::transforms)];
}

Topic topicOf(Measure measure) {
    return static_cast<Topic>(static_cast<std::size_t>(measure) -
                              static_cast<std::size_t>(Measure::transforms));
}

std::string pointsText(double points, double most) {
    return shortNumber(rounded(points)) + " of " + shortNumber(rounded(most)) + " points";
}

CriterionGrade judgeMeasured(const Grade& grade, const Criterion& rule, double most,
                             double strictness) {
    CriterionGrade out{rule.measure, 0, most, 0, ""};
    const ViewGrade* worst = nullptr;
    for (const ViewGrade& view : grade.views) {
        const double value = measuredIn(view, rule.measure);
        out.measured += value / static_cast<double>(grade.views.size());
        if (worst == nullptr || value > measuredIn(*worst, rule.measure)) worst = &view;
    }
    const double loss = std::clamp(
        strictness * (out.measured - rule.tolerance) / (rule.limit - rule.tolerance), 0.0, 1.0);
    out.points = most * (1.0 - loss);
    out.reason = sentence(rule.measure, out.measured);
    if (worst != nullptr && grade.views.size() > 1 &&
        measuredIn(*worst, rule.measure) > out.measured)
        out.reason += ", most of it " + worst->name;
    out.reason += loss > 0.0 ? "; that gives " + pointsText(out.points, most)
                             : "; up to " + shortNumber(rule.tolerance) + " costs nothing";
    out.reason += ".";
    out.reason[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out.reason[0])));
    return out;
}

CriterionGrade judgeFindings(Grade& grade, const Criterion& rule, double most, double strictness) {
    CriterionGrade out{rule.measure, most, most, 0, ""};
    double loss = 0.0;
    int count = 0;
    for (CostedFinding& one : grade.findings) {
        if (one.finding.topic != topicOf(rule.measure)) continue;
        ++count;
        if (!grade.visible) continue;
        const double share = std::min(1.0 - loss, strictness * rule.perFinding);
        loss += share;
        one.points = rounded(share * most);
    }
    out.points = most * (1.0 - loss);
    const std::string subject = subjectOf(rule.measure);
    if (count == 0)
        out.reason = "Nothing differs in the " + subject + ".";
    else if (!grade.visible)
        out.reason = std::to_string(count) + " difference" + (count > 1 ? "s" : "") + " in the " +
                     subject + " cannot be seen in any picture and cost" + (count > 1 ? "" : "s") +
                     " nothing.";
    else
        out.reason = std::to_string(count) + " finding" + (count > 1 ? "s" : "") + " in the " +
                     subject + (count > 1 ? " leave " : " leaves ") + pointsText(out.points, most) +
                     ".";
    return out;
}

/// The line and its neighbours, with numbers.
std::string excerptOf(const std::string& xml, int line) {
    constexpr std::size_t kLongest = 160;  // bytes of a line
    std::string out;
    std::size_t begin = 0;
    for (int number = 1; begin < xml.size() && number <= line + 1; ++number) {
        const std::size_t end = std::min(xml.size(), xml.find('\n', begin));
        if (number >= line - 1) {
            std::string text = xml.substr(begin, std::min(end - begin, kLongest));
            while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.pop_back();
            out += std::to_string(number) + (number == line ? " > " : "   ") + text + "\n";
        }
        begin = end + 1;
    }
    return out;
}

void penalise(Grade& grade, const Rubric& rubric) {
    double sum = 0.0;
    for (const Diagnostic& one : grade.diagnostics) {
        const auto special = rubric.byCode.find(one.code);
        if (special != rubric.byCode.end())
            sum += special->second;
        else if (one.severity == Severity::warning)
            sum += rubric.perWarning;
    }
    grade.penalty = rounded(std::min(sum, rubric.mostPenalty));
}

const char* wordOf(Severity severity) {
    return severity == Severity::info      ? "info"
           : severity == Severity::warning ? "warning"
                                           : "error";
}

ordered_json placeOf(const Location& where) {
    ordered_json out = ordered_json::object();  // a finding need not have a place
    if (!where.file.empty()) out["file"] = where.file;
    if (where.line > 0) out["line"] = where.line;
    if (where.column > 0) out["column"] = where.column;
    return out;
}

}  // namespace

void score(Grade& grade, const Findings& findings, const Rubric& rubric, bool scenes,
           const std::string& xml, const std::string& name) {
    const auto excerptAt = [&](const Location& where) {
        return where.line > 0 && where.file == name ? excerptOf(xml, where.line) : "";
    };
    for (const Finding& one : findings) grade.findings.push_back({one, 0, excerptAt(one.where)});
    std::set<std::string> shown;  // of what is wrong in many places, the first
    for (const Diagnostic& one : grade.diagnostics)
        grade.excerpts.push_back(one.severity != Severity::info && shown.insert(one.message).second
                                     ? excerptAt(one.where)
                                     : "");
    double weights = 0.0;
    const auto applies = [&](const Criterion& one) {
        return one.weight > 0.0 && (scenes || one.measure <= Measure::ssim);
    };
    for (const Criterion& one : rubric.criteria)
        if (applies(one)) weights += one.weight;
    if (grade.refused) {
        for (const Criterion& one : rubric.criteria)
            if (applies(one))
                grade.criteria.push_back({one.measure, 0, rubric.points * one.weight / weights, 0,
                                          "The submission could not be read."});
        return;
    }
    double points = 0.0;
    for (const Criterion& one : rubric.criteria) {
        if (!applies(one)) continue;
        const double most = rubric.points * one.weight / weights;
        grade.criteria.push_back(isStructural(one.measure)
                                     ? judgeFindings(grade, one, most, rubric.strictness)
                                     : judgeMeasured(grade, one, most, rubric.strictness));
        points += grade.criteria.back().points;
    }
    penalise(grade, rubric);
    // A rubric of structural criteria alone does not apply to pictures: nothing was judged.
    grade.points = weights > 0.0 ? rounded(std::max(0.0, points - grade.penalty)) : 0.0;
    grade.passed = weights > 0.0 && grade.points >= rubric.points * rubric.passMark / 100.0;
}

std::string toJson(const Grade& grade) {
    ordered_json out{{"points", grade.points},   {"most", grade.most},
                     {"passed", grade.passed},   {"refused", grade.refused},
                     {"visible", grade.visible}, {"penalty", grade.penalty}};
    out["criteria"] = ordered_json::array();
    for (const CriterionGrade& one : grade.criteria) {
        ordered_json entry{{"measure", nameOf(one.measure)},
                           {"points", rounded(one.points)},
                           {"most", rounded(one.most)}};
        if (!isStructural(one.measure)) entry["measured"] = sixDigits(one.measured);
        entry["reason"] = one.reason;
        out["criteria"].push_back(std::move(entry));
    }
    out["findings"] = ordered_json::array();
    for (const CostedFinding& one : grade.findings) {
        ordered_json entry{
            {"code", one.finding.code}, {"message", one.finding.message}, {"points", one.points}};
        entry.update(placeOf(one.finding.where));
        if (!one.excerpt.empty()) entry["excerpt"] = one.excerpt;
        out["findings"].push_back(std::move(entry));
    }
    out["diagnostics"] = ordered_json::array();
    for (std::size_t i = 0; i < grade.diagnostics.size(); ++i) {
        const Diagnostic& one = grade.diagnostics[i];
        // Of what the reader says of right scenes nothing is told, but what the grader did is.
        if (one.severity == Severity::info && !one.code.starts_with("grade.")) continue;
        ordered_json entry{{"code", one.code}, {"severity", wordOf(one.severity)}};
        entry.update(placeOf(one.where));
        entry["message"] = one.message;
        if (i < grade.excerpts.size() && !grade.excerpts[i].empty())
            entry["excerpt"] = grade.excerpts[i];
        out["diagnostics"].push_back(std::move(entry));
    }
    // What the rubric leaves out was not measured: a 0 would say that nothing differs.
    std::set<Measure> measured;
    for (const CriterionGrade& one : grade.criteria) measured.insert(one.measure);
    out["views"] = ordered_json::array();
    for (const ViewGrade& one : grade.views) {
        ordered_json view{{"name", one.name},
                          {"time", one.timeS},
                          {"width", one.width},
                          {"height", one.height},
                          {"difference", sixDigits(one.difference)}};
        const auto put = [&](Measure measure, ordered_json value) {
            if (measured.count(measure) != 0) view[nameOf(measure)] = std::move(value);
        };
        put(Measure::flip, {{"mean", sixDigits(one.flipMean)}, {"p95", sixDigits(one.flipP95)}});
        put(Measure::ssim, sixDigits(one.ssim));
        put(Measure::coverage, sixDigits(one.coverage));
        put(Measure::depth, sixDigits(one.depth));
        put(Measure::normals, sixDigits(one.normals));
        out["views"].push_back(std::move(view));
    }
    return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace farol::grade
