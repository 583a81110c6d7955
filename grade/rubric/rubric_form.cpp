#include "grade/rubric/rubric_form.h"

#include <algorithm>
#include <cmath>

#include "core/did_you_mean.h"

namespace farol::grade {

ordered_json bound(double value) {
    return value == std::floor(value) ? ordered_json(static_cast<long>(value))
                                      : ordered_json(value);
}

RubricReader::RubricReader(const json& value, std::string path, const std::string& file,
                           Rename rename)
    : value_(value), path_(std::move(path)), file_(file), rename_(rename) {
    if (!value.is_object()) fail<"rubric.type/object">(path_);
}

std::string RubricReader::at(const std::string& key) const {
    if (key.empty()) return path_;
    std::string out = path_ + "/";
    for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
}

bool RubricReader::has(const std::string& key) {
    known_.insert(key);
    return value_.contains(key) && !value_.at(key).is_null();
}

void RubricReader::number(const std::string& key, double& out, double least, double most,
                          const char*) {
    if (has(key)) out = asNumber(value_.at(key), at(key), least, most);
}

void RubricReader::integer(const std::string& key, int& out, int least, int most, const char*) {
    std::optional<int> value;
    integer(key, value, least, most);
    out = value.value_or(out);
}

void RubricReader::integer(const std::string& key, std::optional<int>& out, int least, int most) {
    if (!has(key)) return;
    if (!value_.at(key).is_number_integer()) fail<"rubric.type/integer">(at(key));
    out = static_cast<int>(asNumber(value_.at(key), at(key), least, most));
}

void RubricReader::samples(const std::string& key, int& out, int most, const char*) {
    integer(key, out, 1, most);
    require<"rubric.range/samples">((out & (out - 1)) == 0, key);
}

void RubricReader::text(const std::string& key, std::string& out, const char*) {
    if (!has(key)) return;
    if (!value_.at(key).is_string()) fail<"rubric.type/text">(at(key));
    out = value_.at(key).get<std::string>().substr(0, kMaxRubricText);
}

void RubricReader::requiredText(const std::string& key, std::string& out, const char*) {
    text(key, out);
    if (out.empty()) fail<"rubric.type/missing">(path_, "key"_arg = key);
}

void RubricReader::flag(const std::string& key, bool& out, const char*) {
    std::optional<bool> value;
    flag(key, value);
    out = value.value_or(out);
}

void RubricReader::flag(const std::string& key, std::optional<bool>& out, const char*) {
    if (!has(key)) return;
    if (!value_.at(key).is_boolean()) fail<"rubric.type/flag">(at(key));
    out = value_.at(key).get<bool>();
}

void RubricReader::someOf(const std::string& key, std::vector<std::string>& out,
                          const std::vector<std::string_view>& words, const char*) {
    if (!has(key)) return;
    const json& all = listAt(key, 1, words.size());
    out.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string path = at(key) + "/" + std::to_string(i);
        if (!all[i].is_string()) fail<"rubric.type/text">(path);
        const std::string word = all[i].get<std::string>();
        if (std::find(words.begin(), words.end(), word) == words.end()) failWord(path, word, words);
        if (std::find(out.begin(), out.end(), word) != out.end()) fail<"rubric.range/twice">(path);
        out.push_back(word);
    }
}

void RubricReader::requireKnown(bool ok, const std::string& key, const std::string& value,
                                const std::vector<std::string>& known) const {
    if (!ok) failWord(at(key), value, {known.begin(), known.end()});
}

void RubricReader::failWord(const std::string& path, const std::string& value,
                            const std::vector<std::string_view>& words) const {
    fail<"rubric.range/word">(path, "value"_arg = value, "known"_arg = uncut(joined(words, ", ")),
                              "suggestion"_arg = didYouMean(value, {words.begin(), words.end()}));
}

std::size_t RubricReader::place(const std::string& key,
                                const std::vector<std::string_view>& words) {
    std::string given;
    text(key, given);
    const auto found = std::find(words.begin(), words.end(), given);
    if (found == words.end()) failWord(at(key), given, words);
    return static_cast<std::size_t>(found - words.begin());
}

std::size_t RubricReader::requiredWord(const std::string& key, std::size_t,
                                       const std::vector<std::string_view>& words) {
    if (!has(key)) fail<"rubric.type/missing">(path_, "key"_arg = key);
    return place(key, words);
}

void RubricReader::numbers(const std::string& key, std::vector<double>& out, std::size_t fewest,
                           std::size_t most, double least, double greatest, const char*) {
    if (!has(key)) return;
    const json& all = listAt(key, fewest, most);
    out.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
        out.push_back(asNumber(all[i], at(key) + "/" + std::to_string(i), least, greatest));
}

void RubricReader::numbersByKey(const std::string& key, std::map<std::string, double>& out,
                                double least, double most, const char*) {
    constexpr std::size_t kMaxKey = 80;
    if (!has(key)) return;
    if (!value_.at(key).is_object()) fail<"rubric.type/object">(at(key));
    for (const auto& [name, value] : value_.at(key).items())
        out[name.substr(0, kMaxKey)] = asNumber(value, at(key) + "/" + name, least, most);
}

double RubricReader::asNumber(const json& value, const std::string& path, double least,
                              double most) const {
    if (!value.is_number()) fail<"rubric.type/number">(path);
    const double number = value.get<double>();
    if (!(number >= least && number <= most))
        fail<"rubric.range/number">(path, "value"_arg = value.dump(),
                                    "least"_arg = json(least).dump(),
                                    "most"_arg = json(most).dump());
    return number;
}

const json& RubricReader::listAt(const std::string& key, std::size_t fewest,
                                 std::size_t most) const {
    const json& all = value_.at(key);
    if (!all.is_array()) fail<"rubric.type/list">(at(key));
    if (all.size() < fewest || all.size() > most)
        fail<"rubric.range/length">(at(key), "count"_arg = all.size(), "least"_arg = fewest,
                                    "most"_arg = most);
    return all;
}

void RubricReader::end() const {
    for (const auto& [key, value] : value_.items())
        if (known_.count(key) == 0)
            fail<"rubric.key">(at(key), "key"_arg = key, "known"_arg = uncut(joined(known_, ", ")),
                               "suggestion"_arg = didYouMean(key, {known_.begin(), known_.end()}));
}

void RubricSchema::text(const std::string& key, const std::string&, const char* about) {
    add(key, {{"type", "string"}, {"maxLength", kMaxRubricText}}, about);
}

void RubricSchema::requiredText(const std::string& key, const std::string&, const char* about) {
    required_.push_back(key);
    add(key, {{"type", "string"}, {"minLength", 1}, {"maxLength", kMaxRubricText}}, about);
}

void RubricSchema::someOf(const std::string& key, const std::vector<std::string>&,
                          const std::vector<std::string_view>& words, const char* about) {
    ordered_json rule =
        listRule({{"type", {"array", "null"}}}, 1, words.size(), about, {{"enum", words}});
    rule["uniqueItems"] = true;
    add(key, std::move(rule));
}

void RubricSchema::integer(const std::string& key, int, int least, int most, const char* about) {
    add(key, {{"type", "integer"}, {"minimum", least}, {"maximum", most}}, about);
}

void RubricSchema::integer(const std::string& key, const std::optional<int>&, int least, int most) {
    add(key, {{"type", {"integer", "null"}}, {"minimum", least}, {"maximum", most}});
}

void RubricSchema::samples(const std::string& key, int, int most, const char* about) {
    ordered_json all = ordered_json::array();
    for (int count = 1; count <= most; count *= 2) all.push_back(count);
    add(key, {{"enum", std::move(all)}}, about);
}

std::size_t RubricSchema::requiredWord(const std::string& key, std::size_t value,
                                       const std::vector<std::string_view>& words) {
    required_.push_back(key);
    add(key, {{"enum", words}});
    return value;
}

void RubricSchema::numbers(const std::string& key, const std::vector<double>&, std::size_t fewest,
                           std::size_t most, double least, double greatest, const char* about) {
    add(key,
        listRule({{"type", {"array", "null"}}}, fewest, most, about, numberRule(least, greatest)));
}

void RubricSchema::numbersByKey(const std::string& key, const std::map<std::string, double>&,
                                double least, double most, const char* about) {
    add(key, {{"type", "object"}, {"additionalProperties", numberRule(least, most)}}, about);
}

ordered_json RubricSchema::rule() const {
    ordered_json out{{"type", "object"}};
    if (!required_.empty()) out["required"] = required_;
    out["additionalProperties"] = false;
    out["properties"] = properties_;
    return out;
}

void RubricSchema::add(const std::string& key, ordered_json rule, const char* about) {
    if (*about != '\0') rule["description"] = about;
    properties_[key] = std::move(rule);
}

ordered_json RubricSchema::numberRule(double least, double most) {
    return {{"type", "number"}, {"minimum", bound(least)}, {"maximum", bound(most)}};
}

ordered_json RubricSchema::listRule(ordered_json rule, std::size_t fewest, std::size_t most,
                                    const char* about, ordered_json items) {
    if (fewest > 0) rule["minItems"] = fewest;
    rule["maxItems"] = most;
    rule["description"] = about;
    rule["items"] = std::move(items);
    return rule;
}

}  // namespace farol::grade
