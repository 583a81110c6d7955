#include "core/limit_findings.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/messages.h"

namespace farol {
namespace {

bool isAboutFile(const Diagnostic& finding) {
    for (const char* family : {"asset.", "image.", "mesh."})
        if (finding.code.starts_with(family)) return true;
    return false;
}

void mergeEqual(Diagnostics& findings) {
    std::map<std::tuple<Severity, std::string, std::string, std::string>, std::size_t> firsts;
    Diagnostics merged;
    for (Diagnostic& finding : findings) {
        if (isAboutFile(finding)) {
            const auto [first, isNew] = firsts.try_emplace(
                std::tuple(finding.severity, finding.code, finding.message, finding.where.file),
                merged.size());
            if (!isNew) {
                merged[first->second].count += finding.count;
                continue;
            }
        }
        merged.push_back(std::move(finding));
    }
    findings = std::move(merged);
}

}  // namespace

void limitFindings(Diagnostics& findings) {
    mergeEqual(findings);
    if (findings.size() <= kMaxFindings) return;
    const int total = countFindings(findings);
    std::vector<bool> isKept(findings.size());
    std::size_t kept = 0;
    for (const Severity severity : {Severity::error, Severity::warning, Severity::info})
        for (std::size_t i = 0; i < findings.size() && kept < kMaxFindings - 1; ++i)
            if (findings[i].severity == severity) {
                isKept[i] = true;
                ++kept;
            }
    Diagnostics shown;
    for (std::size_t i = 0; i < findings.size(); ++i)
        if (isKept[i]) shown.push_back(std::move(findings[i]));
    shown.push_back(hiddenNote(total - countFindings(shown), shown.front().where.file));
    findings = std::move(shown);
}

int countFindings(const Diagnostics& findings) {
    int count = 0;
    for (const Diagnostic& finding : findings) count += finding.count;
    return count;
}

Diagnostic hiddenNote(int count, const std::string& file) {
    Diagnostic note =
        diagnosticOf(Severity::info, coreMessage<"limit.diagnostics">("count"_arg = count), {file});
    note.count = count;
    return note;
}

}  // namespace farol
