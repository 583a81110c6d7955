#include "server/parameters.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/text.h"
#include "scene/words.h"

namespace farol::server {
namespace {

using nlohmann::json;

Error fault(const std::string& code, const std::string& name, const std::string& message) {
    return Error(code, message, {}, name);
}

bool readFlag(const std::string& name, const std::string& value) {
    if (value == "1" || value == "true") return true;
    if (value == "0" || value == "false") return false;
    throw fault("option.range", name, name + " must be 0 or 1, not " + scene::quoted(value));
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
    const std::string near = scene::didYouMean(name, known);
    std::string message = "there is no parameter " + scene::quoted(name) + " here";
    if (!near.empty()) message += "; did you mean \"" + near + "\"?";
    throw fault("option.unknown", name, message);
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
    throw fault(
        "option.syntax", name,
        "the option " + scene::quoted(name) + " must be text, a number, true, false or numbers");
}

http::Fields fieldsOf(const std::string& text) {
    const json value = json::parse(text, nullptr, false);
    if (value.is_discarded() || !value.is_object())
        throw fault("option.syntax", "options", "the part \"options\" is not a JSON object");
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
                    throw fault("option.repeated", name, scene::quoted(name) + " is given twice");
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
    std::int64_t number = 0;
    const auto [end, failed] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (failed != std::errc{} || end != value.data() + value.size() || number < min || number > max)
        throw fault("option.range", name,
                    name + " must be a whole number in " + std::to_string(min) + ".." +
                        std::to_string(max) + ", not " + scene::quoted(value));
    return number;
}

Turn turnOf(const Parameters& parameters) {
    constexpr std::int64_t kMost = (std::int64_t{1} << 53U) - 1;  // what JavaScript counts to
    Turn turn;
    turn.session = parameters.ownValue("session");
    const std::string seq = parameters.ownValue("seq");
    if (turn.session.empty() && seq.empty()) return turn;
    const auto isPlain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '-' || c == '.' || c == '_';
    };
    if (turn.session.empty() || turn.session.size() > 64 ||
        !std::all_of(turn.session.begin(), turn.session.end(), isPlain))
        throw fault("option.range", "session",
                    "session must be 1 to 64 letters, digits, \"-\", \".\" or \"_\", and seq "
                    "needs one");
    turn.seq = wholeNumber("seq", seq, 0, kMost);
    return turn;
}

}  // namespace farol::server
