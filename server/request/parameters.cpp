#include "server/request/parameters.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/bounded_json.h"
#include "core/did_you_mean.h"
#include "core/number.h"
#include "core/text.h"
#include "server/messages.h"

namespace farol::server {
namespace {

using nlohmann::json;

Error fault(const std::string& name, Message message) {
    return Error(std::move(message), {}, name);
}

bool readFlag(const std::string& name, const std::string& value) {
    if (value == "1" || value == "true") return true;
    if (value == "0" || value == "false") return false;
    throw fault(name, message<"option.range/flag">("name"_arg = name, "value"_arg = value));
}

bool isPictureOption(const std::string& name) {
    const auto specs = render::optionSpecs();
    return std::any_of(specs.begin(), specs.end(),
                       [&](const render::OptionSpec& spec) { return spec.name == name; });
}

[[noreturn]] void refuseUnknown(const std::string& name, const ParameterRules& rules) {
    std::vector<std::string> known = rules.ownNames;
    if (rules.picture || rules.strict) known.emplace_back("strict");
    if (rules.picture)
        for (const render::OptionSpec& spec : render::optionSpecs()) known.push_back(spec.name);
    throw fault(name, message<"option.unknown/parameter">(
                          "name"_arg = name, "suggestion"_arg = didYouMean(name, known)));
}

std::string textOf(const std::string& name, const json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
    if (value.is_number()) return value.dump();
    if (value.is_array()) {
        std::string joined;
        for (const json& one : value) {
            if (!one.is_number()) break;
            joined += (joined.empty() ? "" : ",") + one.dump();
        }
        if (!joined.empty() || value.empty()) return joined;
    }
    throw fault(name, message<"option.syntax/value">("name"_arg = name));
}

http::Fields fieldsOf(const std::string& text) {
    // A flat object of some 30 options, a few of them lists of three numbers.
    constexpr JsonLimits kLimits{
        .bytes = 65'536, .depth = 2, .keys = 200, .values = 1'000, .stringBytes = 4'096};
    json value;
    try {
        value = parseJson(text, kLimits);
    } catch (const JsonError& error) {
        const bool isDuplicate = error.reason() == JsonError::Reason::duplicate;
        throw fault("options",
                    isDuplicate
                        ? message<"option.repeated/json">("reason"_arg = uncut(error.what()))
                        : message<"option.syntax/json">("reason"_arg = uncut(error.what())));
    }
    if (!value.is_object()) throw fault("options", message<"option.syntax/object">());
    http::Fields fields;
    for (const auto& [name, one] : value.items()) fields.emplace_back(name, textOf(name, one));
    return fields;
}

void applyOne(Parameters& out, const ParameterRules& rules, const std::string& name,
              const std::string& value) {
    if (std::count(rules.ownNames.begin(), rules.ownNames.end(), name) > 0) {
        out.own.emplace_back(name, value);
    } else if (name == "strict" && (rules.picture || rules.strict)) {
        out.strict = readFlag(name, value);
    } else if (rules.picture && isPictureOption(name)) {
        render::applyOption(out.picture, name, value);
        out.formatGiven = out.formatGiven || name == "format";
        std::erase_if(out.given, [&](const auto& pair) { return pair.first == name; });
        out.given.emplace_back(name, value);
    } else {
        refuseUnknown(name, rules);
    }
}

}  // namespace

std::string Parameters::ownValue(const std::string& name, const std::string& fallback) const {
    for (const auto& [key, value] : own)
        if (key == name) return value;
    return fallback;
}

Parameters readParameters(const http::Fields& query, const ParameterRules& rules,
                          const std::string& fromBody) {
    Parameters out;
    Diagnostics faults;
    const auto applyAll = [&](const http::Fields& fields) {
        std::set<std::string> seen;
        for (const auto& [name, value] : fields) {
            try {
                if (!seen.insert(name).second)
                    throw fault(name, message<"option.repeated">("name"_arg = name));
                applyOne(out, rules, name, value);
            } catch (const Error& error) {
                const Diagnostics& found = error.diagnostics();
                faults.insert(faults.end(), found.begin(), found.end());
            }
        }
    };
    applyAll(rules.preset);
    if (!fromBody.empty()) applyAll(fieldsOf(fromBody));
    applyAll(query);
    if (!faults.empty()) throw Error(faults);
    std::sort(out.given.begin(), out.given.end());
    return out;
}

std::int64_t wholeNumber(const std::string& name, const std::string& value, std::int64_t min,
                         std::int64_t max) {
    const auto number = parseExact<std::int64_t>(value);
    if (!number || *number < min || *number > max)
        throw fault(name, message<"option.range/number">("name"_arg = name, "value"_arg = value,
                                                         "min"_arg = min, "max"_arg = max));
    return *number;
}

worker::Turn turnOf(const Parameters& parameters) {
    constexpr std::int64_t kMaxSeq =
        (std::int64_t{1} << 53U) - 1;  // the largest exact integer of JavaScript
    worker::Turn turn;
    turn.session = parameters.ownValue("session");
    const std::string seq = parameters.ownValue("seq");
    if (turn.session.empty() && seq.empty()) return turn;
    const auto isPlain = [](char c) {
        return isAlphanumeric(c) || c == '-' || c == '.' || c == '_';
    };
    if (turn.session.empty() || turn.session.size() > 64 ||
        !std::all_of(turn.session.begin(), turn.session.end(), isPlain))
        throw fault("session", message<"option.range/session">());
    turn.seq = wholeNumber("seq", seq, 0, kMaxSeq);
    return turn;
}

}  // namespace farol::server
