#include "core/limit_findings.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace farol;

namespace {

Diagnostics findings(int count, Severity severity, const std::string& code,
                     const std::string& message) {
    Diagnostics all;
    for (int i = 0; i < count; ++i) {
        Diagnostic finding;
        finding.severity = severity;
        finding.code = code;
        finding.message = message;
        finding.where = {"a.xml", i + 1, 1};
        all.push_back(finding);
    }
    return all;
}

}  // namespace

TEST_CASE("a file missing at 132 places is one finding with a count") {
    Diagnostics all = findings(132, Severity::error, "asset.missing", "no file \"a.3d\"");
    all.push_back(findings(1, Severity::error, "asset.missing", "no file \"b.3d\"").front());
    limitFindings(all);
    REQUIRE(all.size() == 2);
    CHECK(all[0].count == 132);
    CHECK(all[0].where.line == 1);
    CHECK(all[1].count == 1);
    CHECK(countFindings(all) == 133);
}

TEST_CASE("equal faults of a document stay at their places") {
    Diagnostics all = findings(3, Severity::warning, "scene.range", "is -1");
    limitFindings(all);
    CHECK(all.size() == 3);
}

TEST_CASE("of many findings fifty are kept, errors first, in their order") {
    Diagnostics all = findings(60, Severity::info, "scene.dialect", "info");
    const Diagnostics warnings = findings(30, Severity::warning, "scene.range", "warning");
    const Diagnostics errors = findings(30, Severity::error, "scene.value", "error");
    all.insert(all.end(), warnings.begin(), warnings.end());
    all.insert(all.end(), errors.begin(), errors.end());
    limitFindings(all);
    REQUIRE(all.size() == kMaxFindings);
    const auto count = [&](Severity severity) {
        return std::count_if(all.begin(), all.end(), [&](const Diagnostic& finding) {
            return finding.severity == severity;
        });
    };
    CHECK(count(Severity::error) == 30);
    CHECK(count(Severity::warning) == 19);
    CHECK(all.front().where.line == 1);
    CHECK(all[18].where.line == 19);
    CHECK(all.back().message == "71 more findings are not shown");
    CHECK(countFindings(all) == 120);
}
