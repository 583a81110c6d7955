#include "server/assignments/assignment.h"

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/digest.h"
#include "core/number.h"
#include "core/text.h"
#include "grade/rubric/rubric_form.h"
#include "server/messages.h"
#include "server/routes/subject.h"

namespace farol::server {

using nlohmann::json;
using store::Time;

namespace {

constexpr const char* kFile = "assignment.json";
constexpr JsonLimits kSettingsJson{.bytes = 65'536, .stringBytes = 1'000};
constexpr int kMaxRetentionDays = 400;
constexpr std::size_t kMaxId = 40;

/// A time of the settings; null and a missing key leave `out`.
template <typename Form>
void readTime(Form& form, const std::string& key, Time& out) {
    std::string text;
    form.text(key, text);
    if (text.empty()) return;
    const auto time = timeOfText(text);
    if (!time)
        throw Error(message<"assignment.time">("key"_arg = key, "value"_arg = text), {kFile, 0, 0},
                    "/" + key);
    out = *time;
}

/// A key's fault is worded as a rubric's, with a code of its family.
Message settingsMessage(Message message) {
    constexpr std::string_view kRubric = "rubric.";
    message.id = "assignment." + message.id.substr(kRubric.size());
    for (const MessageRow& row : kServerMessages)
        if (row.id == message.id) return message;
    throw std::logic_error("no message " + message.id);
}

void readSettings(const std::string& text, Assignment& out) {
    json value;
    try {
        value = parseJson(text, kSettingsJson);
    } catch (const JsonError& fault) {
        throw Error(message<"assignment.json">("reason"_arg = uncut(fault.what())), {kFile, 0, 0});
    }
    if (!value.is_object())
        throw Error(message<"assignment.json">("reason"_arg = "it is no object"), {kFile, 0, 0});
    const std::string file = kFile;
    grade::RubricReader form(value, "", file, settingsMessage);
    form.text("title", out.title);
    readTime(form, "opens", out.opens);
    readTime(form, "closes", out.closes);
    const auto& words = grade::kShownWords.all();
    if (value.contains("shows") && value["shows"] == json::array()) {  // the band alone
        out.view.shows.clear();
        value.erase("shows");
    }
    form.someOf("shows", out.view.shows, {words.begin(), words.end()}, "");
    form.integer("bands", out.view.bands, grade::kMinBands, grade::kMaxBands);
    form.flag("mask", out.view.hasMask);
    form.flag("referenceFiles", out.referenceFiles);
    form.integer("triesPerHour", out.triesPerHour, 1, store::kMaxTries);
    form.integer("tries", out.tries, 1, store::kMaxTries);
    form.integer("retentionDays", out.retentionDays, 0, kMaxRetentionDays);
    form.end();
    if (out.closes <= out.opens)
        throw Error(message<"assignment.time/order">("opens"_arg = timeText(out.opens),
                                                     "closes"_arg = timeText(out.closes)),
                    {kFile, 0, 0}, "/closes");
}

json settingsOf(const Assignment& assignment) {
    json out = {{"title", assignment.title},
                {"opens", nullptr},
                {"closes", nullptr},
                {"shows", assignment.view.shows},
                {"bands", assignment.view.bands},
                {"mask", assignment.view.hasMask},
                {"referenceFiles", assignment.referenceFiles},
                {"triesPerHour", assignment.triesPerHour},
                {"tries", assignment.tries},
                {"retentionDays", assignment.retentionDays}};
    if (assignment.opens != Time{}) out["opens"] = timeText(assignment.opens);
    if (assignment.closes != Time::max()) out["closes"] = timeText(assignment.closes);
    return out;
}

}  // namespace

grade::Rubric Assignment::rules() const {
    grade::Rubric rules =
        rubric.empty() ? grade::defaultRubric() : grade::readRubric(rubric, "rubric.json");
    rules.lend = referenceFiles;
    return rules;
}

grade::Subject Assignment::subject() const {
    return reference.empty() ? grade::Subject{}
                             : subjectOf({"reference", referenceName, "", reference});
}

bool isAssignmentId(const std::string& id) {
    return id.size() <= kMaxId && store::isRecordName(id) && id.find('.') == std::string::npos;
}

std::string timeText(Time time) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    char text[40];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

std::optional<Time> timeOfText(const std::string& text) {
    constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
    if (text.size() != kForm.size()) return std::nullopt;
    for (std::size_t i = 0; i < kForm.size(); ++i)
        if (kForm[i] == '0' ? !isDigit(text[i]) : text[i] != kForm[i]) return std::nullopt;
    const auto number = [&](std::size_t at, std::size_t digits) {
        return parseExact<int>(std::string_view(text).substr(at, digits)).value_or(-1);
    };
    std::tm parts{};
    parts.tm_year = number(0, 4) - 1900;
    parts.tm_mon = number(5, 2) - 1;
    parts.tm_mday = number(8, 2);
    parts.tm_hour = number(11, 2);
    parts.tm_min = number(14, 2);
    parts.tm_sec = number(17, 2);
    constexpr int kFirst = 70, kLast = 300;  // since 1900
    if (parts.tm_year < kFirst || parts.tm_year > kLast) return std::nullopt;
    const Time time = std::chrono::system_clock::from_time_t(timegm(&parts));
    // A date that is none, the 31st of June, became another one.
    return timeText(time) == text ? std::optional(time) : std::nullopt;
}

Assignment readAssignment(const std::string& id, std::vector<Part> parts) {
    Assignment out;
    out.id = id;
    std::string settings;
    for (Part& part : parts) {
        const std::string name = part.name;
        std::string* target = name == "assignment"  ? &settings
                              : name == "rubric"    ? &out.rubric
                              : name == "reference" ? &out.reference
                                                    : nullptr;
        if (target == nullptr)
            throw Error(message<"http.multipart/unknown">(
                            "name"_arg = name, "known"_arg = "assignment, rubric and reference"),
                        {}, shown(name));
        if (!target->empty())
            throw Error(message<"http.multipart/repeated">("name"_arg = name), {}, name);
        if (part.content.empty())
            throw Error(message<"http.multipart/empty">("name"_arg = name), {}, name);
        *target = std::move(part.content);
        if (name == "reference") out.referenceName = std::string(baseName(part.fileName));
    }
    if (!settings.empty()) readSettings(settings, out);
    if (out.title.empty()) out.title = id;
    const bool isCompared = grade::comparedPoints(out.rules()) > 0.0;
    if (out.reference.empty() && isCompared)
        throw Error(message<"grade.no-reference">(), {}, "reference");
    if (!out.reference.empty() && !isCompared)
        throw Error(message<"grade.needless-reference">(), {}, "reference");
    return out;
}

json describe(const Assignment& assignment) {
    json out = settingsOf(assignment);
    for (const char* hidden : {"referenceFiles", "retentionDays"}) out.erase(hidden);
    out["id"] = assignment.id;
    const Time now = store::now();
    out["open"] = assignment.opens <= now && now < assignment.closes;
    return out;
}

json describeWhole(const Assignment& assignment) {
    json out = describe(assignment);
    out.update(settingsOf(assignment));
    out["rubric"] = assignment.rubric.empty() ? json() : json(assignment.rubric);
    out["reference"] = nullptr;
    if (!assignment.reference.empty())
        out["reference"] = {{"name", assignment.referenceName},
                            {"bytes", assignment.reference.size()},
                            {"digest", contentDigest(assignment.reference)}};
    return out;
}

std::string encodeAssignment(const Assignment& assignment) {
    json head = {{"settings", settingsOf(assignment)},
                 {"referenceName", assignment.referenceName},
                 {"rubricBytes", assignment.rubric.size()}};
    return dumpJson(head) + "\n" + assignment.rubric + assignment.reference;
}

std::optional<Assignment> decodeAssignment(const std::string& id, const std::string& record) {
    const std::size_t end = record.find('\n');
    if (end == std::string::npos) return std::nullopt;
    try {
        const json head = parseJson(std::string_view(record).substr(0, end), kSettingsJson);
        Assignment out;
        out.id = id;
        readSettings(dumpJson(head.at("settings")), out);
        out.referenceName = head.at("referenceName").get<std::string>();
        const auto rubricBytes = head.at("rubricBytes").get<std::size_t>();
        if (rubricBytes > record.size() - end - 1) return std::nullopt;
        out.rubric = record.substr(end + 1, rubricBytes);
        out.reference = record.substr(end + 1 + rubricBytes);
        return out;
    } catch (const std::exception&) {  // a record of another version
        return std::nullopt;
    }
}

}  // namespace farol::server
