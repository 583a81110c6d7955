#include "grade/rubric/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/text.h"
#include "grade/messages.h"
#include "grade/rubric/excerpt.h"

namespace farol::grade {
namespace {

constexpr std::size_t kTopics = static_cast<std::size_t>(Topic::animation) + 1;
using ByTopic = std::array<double, kTopics>;

double rounded(double points) { return std::round(points * 100.0) / 100.0; }

double lossIn(const ViewGrade& view, const MetricSpec& metric) {
    return view.measured.at(&metric).loss;
}

bool isOfObjects(Topic topic) {
    return topic == Topic::models || topic == Topic::transforms || topic == Topic::textures ||
           topic == Topic::materials;
}

CriterionGrade judgeMeasured(const Grade& grade, const Criterion& rule, double most,
                             double strictness) {
    CriterionGrade out{rule.metric, 0, most, 0, {}};
    const ViewGrade* worst = nullptr;
    for (const ViewGrade& view : grade.views) {
        const double value = lossIn(view, *rule.metric);
        out.measured += value / static_cast<double>(grade.views.size());
        if (worst == nullptr || value > lossIn(*worst, *rule.metric)) worst = &view;
    }
    const double lost = std::clamp(
        strictness * (out.measured - rule.tolerance) / (rule.limit - rule.tolerance), 0.0, 1.0);
    out.points = most * (1.0 - lost) * grade.present;
    const Message loss = rule.metric->image()->sentence(out.measured);
    const bool isUneven =
        worst != nullptr && grade.views.size() > 1 && lossIn(*worst, *rule.metric) > out.measured;
    const std::string view = isUneven ? worst->name : "";
    out.reason =
        out.points < most
            ? message<"part.criterion/lost">("loss"_arg = loss, "view"_arg = view,
                                             "points"_arg = shortNumber(rounded(out.points)),
                                             "most"_arg = shortNumber(rounded(most)))
            : message<"part.criterion/free">("loss"_arg = loss, "view"_arg = view,
                                             "tolerance"_arg = shortNumber(rule.tolerance));
    return out;
}

/// Returns the line of the camera's child element of a cause: the scene stores the camera's only.
Location cameraPlace(const std::string& code, Location where, const std::string& xml) {
    static const std::map<std::string, std::string> kElements{{"camera.position", "<position"},
                                                              {"camera.target", "<lookat"},
                                                              {"camera.up", "<up"},
                                                              {"camera.fov", "<projection"},
                                                              {"camera.fov-radians", "<projection"},
                                                              {"camera.range", "<projection"}};
    const auto element = kElements.find(code);
    if (element == kElements.end() || where.line <= 0) return where;
    std::size_t at = 0;
    for (int line = 1; line < where.line && at != std::string::npos; ++line) {
        at = xml.find('\n', at);
        if (at != std::string::npos) ++at;
    }
    if (at == std::string::npos) return where;
    const std::string rest = lowerCase(xml.substr(at));
    const std::size_t found = rest.find(element->second);
    if (found == std::string::npos || found > rest.find("</camera")) return where;
    where.line += static_cast<int>(
        std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
    where.column = 0;
    return where;
}

double penaltyOf(const Grade& grade, const Rubric& rubric) {
    double sum = 0.0;
    for (const Diagnostic& one : grade.diagnostics) {
        const auto special = rubric.byCode.find(one.code);
        if (special != rubric.byCode.end())
            sum += special->second;
        else if (one.severity != Severity::info)  // errors: of files that placeholders replace
            sum += rubric.perWarning;
    }
    for (const GradedCause& one : grade.causes)
        if (const auto special = rubric.byCode.find(one.code);
            special != rubric.byCode.end() && one.isSeen)
            sum += special->second;
    return std::min(sum, rubric.mostPenalty);
}

constexpr std::size_t kListedPlaces = 6;

std::string lineText(const Location& where) {
    return where.line > 0 ? std::to_string(where.line) : "";
}

/// The first places in a language, with their lines.
std::string listedPlaces(const std::vector<CausePlace>& places, Language language) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < std::min(kListedPlaces, places.size()); ++i)
        texts.push_back(
            textIn(language, message<"part.cause/place">("who"_arg = places[i].who,
                                                         "line"_arg = lineText(places[i].where))));
    return joined(texts, ", ");
}

/// "group "door": the angle has the wrong sign (line 65)"; of several places once, with all.
Message sentenceOf(const Cause& cause, Reveal reveal) {
    const Fix& first = cause.fixes.front();
    const Message& finding = first.words.finding;
    const Message values = reveal == Reveal::values ? first.words.values : Message();
    if (cause.fixes.size() == 1)
        return finding.code() == "part.predicate"
                   ? message<"part.cause/beside">("who"_arg = first.who, "finding"_arg = finding,
                                                  "values"_arg = values,
                                                  "line"_arg = lineText(first.where))
                   : message<"part.cause/of">("who"_arg = first.who, "finding"_arg = finding,
                                              "values"_arg = values,
                                              "line"_arg = lineText(first.where));
    const std::size_t count = cause.fixes.size();
    std::vector<CausePlace> places;
    for (const Fix& fix : cause.fixes) places.push_back({fix.who, fix.where, ""});
    return message<"part.cause/places">(
        "count"_arg = count, "finding"_arg = finding, "values"_arg = values,
        "places"_arg = uncut(listedPlaces(places, Language::en)),
        "more"_arg = count > kListedPlaces ? std::to_string(count - kListedPlaces) : std::string());
}

/// The criteria of the work, as a rubric weighs them.
class WorkScore {
  public:
    WorkScore(Grade& grade, const Evidence& evidence, const Rubric& rubric)
        : grade_(grade), evidence_(evidence), rubric_(rubric) {
        const Rubric usual = defaultRubric();
        double usualWeights = 0.0;
        ByTopic usualWeight{};
        for (const Criterion& one : usual.criteria)
            if (applies(one)) {
                usualWeights += one.weight;
                if (one.metric->causes() != nullptr)
                    usualWeight[indexOf(one.metric->causes()->topic)] = one.weight;
            }
        for (const Criterion& one : rubric.criteria)
            if (applies(one)) weights_ += one.weight;
        for (const Criterion& one : rubric.criteria) {
            if (!applies(one) || one.metric->causes() == nullptr) continue;
            const std::size_t topic = indexOf(one.metric->causes()->topic);
            most_[topic] = comparedPoints(rubric) * one.weight / weights_;
            left_[topic] = most_[topic] * evidence.present;
            const double share = one.weight / weights_,
                         usualShare = usualWeight[topic] / usualWeights;
            constexpr double kMaxFactor = 4.0;
            factor_[topic] = std::min(kMaxFactor, usualShare > 0.0 ? share / usualShare : 1.0) *
                             one.perFinding / 0.5;
        }
    }

    double weights() const { return weights_; }

    bool applies(const Criterion& one) const {
        if (one.weight <= 0.0) return false;
        const CauseMetric* work = one.metric->causes();
        if (work == nullptr) return true;
        if (work->topic == Topic::lights) return evidence_.lights > 0;
        if (work->topic == Topic::camera) return evidence_.hasCamera;
        return work->topic != Topic::animation || evidence_.moves;
    }

    void charge() {
        const auto& causes = evidence_.diagnosis->causes;
        for (std::size_t c = 0; c < causes.size(); ++c)
            grade_.causes[c].points = rounded(chargeCause(causes[c], c));
        if (evidence_.unexplained > kFree) {
            constexpr double kMinCost = 3.0, kMaxCost = 45.0;  // hundredths
            const double share = std::min(1.0, evidence_.unexplained - kFree);
            grade_.unexplained = rounded(
                takeFromObjects(hundredths(kMinCost + (kMaxCost - kMinCost) * std::sqrt(share))));
        }
    }

    CriterionGrade judged(const Criterion& rule) const {
        const Topic topic = rule.metric->causes()->topic;
        const std::size_t at = indexOf(topic);
        CriterionGrade out{rule.metric, left_[at], most_[at], 0, {}};
        int count = 0;
        for (const GradedCause& one : grade_.causes)
            count += kindOf(one.code).topic == topic && one.points > 0.0 ? 1 : 0;
        const std::string share = grade_.present < 1.0 - 1e-9 ? percent(grade_.present) : "";
        if (count == 1)
            out.reason = message<"part.criterion/cause">("share"_arg = share);
        else if (count > 1)
            out.reason = message<"part.criterion/causes">("count"_arg = count, "share"_arg = share);
        else if (!share.empty())
            out.reason = message<"part.criterion/present">("share"_arg = share);
        else if (out.points < out.most - 0.005)
            out.reason = message<"part.criterion/others">();
        else
            out.reason = message<"part.criterion/nothing">();
        return out;
    }

    static constexpr double kFree = 0.02;  // share that rounding and drivers may change

  private:
    static std::size_t indexOf(Topic topic) { return static_cast<std::size_t>(topic); }

    double hundredths(double value) const {
        return value / 100.0 * comparedPoints(rubric_) * rubric_.strictness;
    }

    double chargeCause(const Cause& cause, std::size_t index) {
        const Kind& kind = kindOf(cause.code);
        const std::size_t topic = indexOf(kind.topic);
        if (!grade_.causes[index].isSeen || kind.most <= 0.0) return 0.0;
        if (evidence_.isUnclosed && kind.code == "group.parent") return 0.0;
        double cost =
            hundredths(costOf(kind, evidence_.spoiled[index], cause.fixes.size()) * factor_[topic]);
        if (isOfObjects(kind.topic)) {
            const double own = std::min(cost, left_[topic]);
            left_[topic] -= own;
            return own + (factor_[topic] > 0.0 ? takeFromObjects(cost - own) : 0.0);
        }
        cost *= evidence_.present;
        // A light that is not there earns nothing.
        if (kind.code == "light.missing")
            cost = std::max(cost, most_[topic] * evidence_.present / evidence_.lights);
        const double own = std::min(cost, left_[topic]);
        left_[topic] -= own;
        return own;
    }

    /// Deducts points that one criterion cannot cover from all object criteria; returns how many.
    double takeFromObjects(double points) {
        double all = 0.0;
        for (std::size_t t = 0; t < kTopics; ++t)
            if (isOfObjects(static_cast<Topic>(t))) all += left_[t];
        if (all <= 0.0 || points <= 0.0) return 0.0;
        const double share = std::min(1.0, points / all);
        for (std::size_t t = 0; t < kTopics; ++t)
            if (isOfObjects(static_cast<Topic>(t))) left_[t] *= 1.0 - share;
        return share * all;
    }

    Grade& grade_;
    const Evidence& evidence_;
    const Rubric& rubric_;
    double weights_ = 0.0;
    ByTopic most_{}, left_{}, factor_{};
};

}  // namespace

std::string textIn(Language language, const GradedCause& cause) {
    Message message = cause.message;
    for (MessageArgument& argument : message.arguments)
        if (argument.name == "places" || argument.name == "cause.places")  // part.cause/unclosed
            argument.text = listedPlaces(cause.places, language);
    return textIn(language, message);
}

std::vector<Criterion> pictureCriteria(const Rubric& rubric) {
    std::vector<Criterion> out;
    for (const Criterion& one : rubric.criteria)
        if (one.weight > 0.0 && one.metric->appliesToPictures()) out.push_back(one);
    if (!out.empty()) return out;
    for (const MetricSpec& metric : metrics())
        if (metric.appliesToPictures() && metric.weight > 1.0)
            out.push_back(
                {&metric, metric.weight, metric.image()->tolerance, metric.image()->limit});
    return out;
}

void score(Grade& grade, const Evidence* evidence, const Rubric& rubric, const std::string& xml,
           const std::string& name) {
    const auto excerptAt = [&](const Location& where) {
        return where.line > 0 && where.file == name ? excerptOf(xml, where.line) : "";
    };
    std::set<std::string> shown;  // messages: an error at several places has one excerpt
    for (const Diagnostic& one : grade.diagnostics)
        grade.excerpts.push_back(one.severity != Severity::info && shown.insert(one.message).second
                                     ? excerptAt(one.where)
                                     : "");
    if (grade.notGraded) return;
    double points = 0.0;
    for (const RequirementGrade& one : grade.requirements) points += one.points;
    const double compared = comparedPoints(rubric);
    if (evidence != nullptr && evidence->diagnosis != nullptr) {
        grade.present = evidence->present;
        grade.unexplainedShare = evidence->unexplained;
        std::vector<Cause> causes = evidence->diagnosis->causes;
        for (std::size_t c = 0; c < causes.size(); ++c) {
            for (Fix& fix : causes[c].fixes)
                fix.where = cameraPlace(causes[c].code, fix.where, xml);
            GradedCause cause;
            cause.code = causes[c].code;
            Message sentence = sentenceOf(causes[c], rubric.reveal);
            cause.spoiled = evidence->spoiled[c];
            constexpr double kSeen = 5e-4;  // of the work: less is a few pixels' rounding
            // A missing file is visible even if its placeholder looks like it.
            cause.isSeen = cause.spoiled > kSeen || cause.code.ends_with(".file-missing");
            if (evidence->isUnclosed && cause.code == "group.parent")
                sentence = message<"part.cause/unclosed">("cause"_arg = sentence);
            cause.message = std::move(sentence);
            for (const Fix& fix : causes[c].fixes)
                cause.places.push_back({fix.who, fix.where, excerptAt(fix.where)});
            grade.causes.push_back(std::move(cause));
        }
        WorkScore work(grade, *evidence, rubric);
        work.charge();
        for (const Criterion& one : rubric.criteria) {
            if (!work.applies(one)) continue;
            const double most = compared * one.weight / work.weights();
            grade.criteria.push_back(one.metric->causes() != nullptr
                                         ? work.judged(one)
                                         : judgeMeasured(grade, one, most, rubric.strictness));
            points += grade.criteria.back().points;
        }
    } else if (evidence == nullptr) {
        double weights = 0.0;
        const std::vector<Criterion> criteria = pictureCriteria(rubric);
        for (const Criterion& one : criteria) weights += one.weight;
        for (const Criterion& one : criteria) {
            grade.criteria.push_back(
                judgeMeasured(grade, one, compared * one.weight / weights, rubric.strictness));
            points += grade.criteria.back().points;
        }
    }
    const double repaired = evidence != nullptr ? evidence->penalty / 100.0 * rubric.points : 0.0;
    grade.penalty = rounded(penaltyOf(grade, rubric) + repaired);
    grade.points = rounded(std::max(0.0, points - grade.penalty));
    grade.passed = grade.points >= rubric.points * rubric.passMark / 100.0;
}

}  // namespace farol::grade
