// Diagnostics between processes: with their messages' ids and arguments, within bounds.
#include <catch2/catch.hpp>

#include "core/messages.h"
#include "worker/enums.h"
#include "worker/reply_check.h"
#include "worker/wire.h"

using namespace farol;
using namespace farol::worker;

namespace {

Diagnostics sample() {
    Diagnostic finding = diagnosticOf(
        Severity::warning, coreMessage<"part.more-like-these">("count"_arg = 3, "shown"_arg = 5),
        {"a.xml", 1, 2}, "field");
    finding.code = "xml.quote";
    finding.count = 3;
    return {finding};
}

}  // namespace

TEST_CASE("diagnostics travel with their message's id, arguments and count") {
    const auto arrived = unpack<Diagnostics>(pack(sample()));
    CHECK(arrived == sample());
    REQUIRE(arrived.at(0).arguments.size() == 2);
    CHECK(arrived.at(0).arguments[0].text == "3");
    CHECK_NOTHROW(checkDiagnostics(arrived));
}

TEST_CASE("a diagnostic with an impossible id, argument or count is refused") {
    const auto isRefused = [](auto&& damage) {
        Diagnostics all = sample();
        damage(all[0]);
        try {
            checkDiagnostics(all);
        } catch (const WireError&) {
            return true;
        }
        return false;
    };
    CHECK_FALSE(isRefused([](Diagnostic&) {}));
    CHECK(isRefused([](Diagnostic& d) { d.id = "<b>"; }));
    CHECK(isRefused([](Diagnostic& d) { d.id.assign(200, 'a'); }));
    CHECK(isRefused([](Diagnostic& d) { d.count = 0; }));
    CHECK(isRefused([](Diagnostic& d) { d.arguments.resize(kMaxArguments + 1, d.arguments[0]); }));
    CHECK(isRefused([](Diagnostic& d) { d.arguments[0].name = ""; }));
    CHECK(isRefused([](Diagnostic& d) { d.arguments[0].id = "a b"; }));
    CHECK(isRefused([](Diagnostic& d) { d.arguments[0].text.assign(1100, 'a'); }));
}
