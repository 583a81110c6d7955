#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/bounded_json.h"
#include "core/digest.h"
#include "grade/formats/formats.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

/// Of GitHub's page on SARIF: more are dropped there, by severity.
constexpr std::size_t kMaxResults = 5'000;

constexpr EnumWords<Severity, Severity::error> kLevelWords{"note", "warning", "error"};
constexpr EnumWords<Severity, Severity::error> kCommandWords{"notice", "warning", "error"};

/// All findings of the class, those that cost or are errors first; equal ones keep their order.
std::vector<OutcomeFinding> findingsOf(const ClassResult& all) {
    std::vector<OutcomeFinding> findings;
    for (std::size_t i = 0; i < all.count; ++i)
        for (const OutcomePart& part : outcomeOf(all, i).parts) {
            for (const OutcomeItem& item : part.items)
                findings.insert(findings.end(), item.findings.begin(), item.findings.end());
            findings.insert(findings.end(), part.diagnostics.begin(), part.diagnostics.end());
        }
    for (OutcomeFinding& finding : findings)
        if (finding.points > 0.0) finding.severity = Severity::error;
    std::stable_sort(
        findings.begin(), findings.end(),
        [](const OutcomeFinding& a, const OutcomeFinding& b) { return a.severity > b.severity; });
    return findings;
}

std::vector<OutcomeFinding> findingsOf(const Diagnostics& diagnostics) {
    std::vector<OutcomeFinding> findings;
    for (const Diagnostic& one : diagnostics)
        findings.push_back({one.code, onOneLine(one.message), one.severity, one.where, 0});
    return findings;
}

/// A relative reference (RFC 3986): all but unreserved characters and "/" are escaped.
std::string uriOf(const std::string& path) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string uri;
    for (const char c : path.starts_with("./") ? path.substr(2) : path) {
        const auto byte = static_cast<unsigned char>(c);
        const bool isPlain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                             (c >= '0' && c <= '9') ||
                             std::string_view("-._~/").find(c) != std::string_view::npos;
        if (isPlain)
            uri += c;
        else
            uri += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
    return uri;
}

void writeSarif(std::ostream& out, std::vector<OutcomeFinding> findings) {
    const std::size_t dropped = findings.size() > kMaxResults ? findings.size() - kMaxResults : 0;
    findings.resize(findings.size() - dropped);
    ordered_json rules = ordered_json::array(), results = ordered_json::array();
    std::map<std::string, std::size_t> known;
    std::map<std::string, int> equal;  // of one code and message in one file
    for (const OutcomeFinding& finding : findings) {
        const std::string rule = finding.code.empty() ? "farol" : finding.code;
        const auto [at, isNew] = known.try_emplace(rule, rules.size());
        if (isNew) rules.push_back({{"id", rule}, {"shortDescription", {{"text", rule}}}});
        ordered_json place{
            {"artifactLocation",
             {{"uri", uriOf(finding.where.file.empty() ? "scene.xml" : finding.where.file)}}},
            {"region", {{"startLine", std::max(1, finding.where.line)}}}};
        const std::string same = rule + "\n" + finding.where.file + "\n" + finding.message;
        results.push_back(
            {{"ruleId", rule},
             {"ruleIndex", at->second},
             {"level", kLevelWords[finding.severity]},
             {"message", {{"text", finding.message}}},
             {"locations",
              ordered_json::array({ordered_json{{"physicalLocation", std::move(place)}}})},
             {"partialFingerprints",
              {{"farolFinding/v1",
                contentDigest(same + "\n" + std::to_string(equal[same]++)).substr(0, 32)}}}});
    }
    ordered_json run{{"tool", {{"driver", {{"name", "Farol"}, {"rules", std::move(rules)}}}}},
                     {"results", std::move(results)}};
    if (dropped > 0) run["properties"] = {{"resultsLeftOut", dropped}};
    out << dumpJson(ordered_json{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                                 {"version", "2.1.0"},
                                 {"runs", ordered_json::array({std::move(run)})}},
                    1)
        << "\n";
}

std::string escaped(const std::string& text, bool isProperty) {
    std::string out;
    for (const char c : text) {
        if (c == '%')
            out += "%25";
        else if (c == '\r')
            out += "%0D";
        else if (c == '\n')
            out += "%0A";
        else if (isProperty && c == ':')
            out += "%3A";
        else if (isProperty && c == ',')
            out += "%2C";
        else
            out += c;
    }
    return out;
}

void writeGithub(std::ostream& out, const std::vector<OutcomeFinding>& findings) {
    for (const OutcomeFinding& finding : findings) {
        out << "::" << kCommandWords[finding.severity] << " ";
        if (!finding.where.file.empty()) out << "file=" << escaped(finding.where.file, true) << ",";
        if (finding.where.line > 0) out << "line=" << finding.where.line << ",";
        out << "title=" << escaped(finding.code.empty() ? "farol" : finding.code, true)
            << "::" << escaped(finding.message, false) << "\n";
    }
}

}  // namespace

void writeSarif(std::ostream& out, const ClassResult& all) { writeSarif(out, findingsOf(all)); }
void writeGithub(std::ostream& out, const ClassResult& all) { writeGithub(out, findingsOf(all)); }
void writeSarif(std::ostream& out, const Diagnostics& diagnostics) {
    writeSarif(out, findingsOf(diagnostics));
}
void writeGithub(std::ostream& out, const Diagnostics& diagnostics) {
    writeGithub(out, findingsOf(diagnostics));
}

}  // namespace farol::grade
