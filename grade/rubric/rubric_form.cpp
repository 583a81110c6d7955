#include "grade/rubric/rubric_form.h"

#include <algorithm>
#include <cmath>

namespace farol::grade {

ordered_json bound(double value) {
    return value == std::floor(value) ? ordered_json(static_cast<long>(value))
                                      : ordered_json(value);
}

RubricReader::RubricReader(const json& value, std::string path, const std::string& file)
    : value_(value), path_(std::move(path)), file_(file) {
    if (!value.is_object()) fail<"rubric.type/object">(path_);
}

bool RubricReader::has(const std::string& key) {
    known_.insert(key);
    return value_.contains(key) && !value_.at(key).is_null();
}

void RubricReader::number(const std::string& key, double& out, double least, double most,
                          const char*) {
    if (has(key)) out = asNumber(value_.at(key), at(key), least, most);
}

void RubricReader::integer(const std::string& key, int& out, int least, int most) {
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

void RubricReader::text(const std::string& key, std::string& out) {
    if (!has(key)) return;
    if (!value_.at(key).is_string()) fail<"rubric.type/text">(at(key));
    out = value_.at(key).get<std::string>().substr(0, kMaxRubricText);
}

void RubricReader::flag(const std::string& key, bool& out, const char*) {
    if (!has(key)) return;
    if (!value_.at(key).is_boolean()) fail<"rubric.type/flag">(at(key));
    out = value_.at(key).get<bool>();
}

std::size_t RubricReader::place(const std::string& key,
                                const std::vector<std::string_view>& words) {
    std::string given;
    text(key, given);
    const auto found = std::find(words.begin(), words.end(), given);
    if (found == words.end())
        fail<"rubric.range/word">(at(key), "value"_arg = given,
                                  "known"_arg = uncut(joined(words, ", ")));
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
        out.push_back(asNumber(all[i], at(key) + "[" + std::to_string(i) + "]", least, greatest));
}

void RubricReader::numbersByKey(const std::string& key, std::map<std::string, double>& out,
                                double least, double most, const char*) {
    constexpr std::size_t kMaxKey = 80;
    if (!has(key)) return;
    if (!value_.at(key).is_object()) fail<"rubric.type/object">(at(key));
    for (const auto& [name, value] : value_.at(key).items())
        out[name.substr(0, kMaxKey)] = asNumber(value, at(key) + "." + name, least, most);
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
            fail<"rubric.key">(at(key), "known"_arg = uncut(joined(known_, ", ")));
}

void RubricSchema::text(const std::string& key, const std::string&) {
    add(key, {{"type", "string"}, {"maxLength", kMaxRubricText}});
}

void RubricSchema::integer(const std::string& key, int, int least, int most) {
    add(key, {{"type", "integer"}, {"minimum", least}, {"maximum", most}});
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
