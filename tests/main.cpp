#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>

#include "tests/support/skip.h"

namespace {

constexpr int kSkipped = 77;  // SKIP_RETURN_CODE of every test

/// Counts over all test cases of this process.
struct Counts {
    int cases = 0, skipped = 0;
    bool isSkipped = false;  ///< the current test case
} counts;

class SkipListener : public Catch::TestEventListenerBase {
  public:
    using Catch::TestEventListenerBase::TestEventListenerBase;
    void testCaseStarting(const Catch::TestCaseInfo& /*info*/) override {
        counts.isSkipped = false;
    }
    void testCaseEnded(const Catch::TestCaseStats& /*stats*/) override {
        ++counts.cases;
        counts.skipped += counts.isSkipped ? 1 : 0;
    }
};
CATCH_REGISTER_LISTENER(SkipListener)

}  // namespace

namespace farol::test {

void skip(const std::string& reason) {
    counts.isSkipped = true;
    std::cout << "SKIPPED: " << reason << std::endl;
    throw Catch::TestFailureException();  // ends the test case; counts no failure by itself
}

void skipMissing(const std::string& reason) {
    const char* ci = std::getenv("CI");
    if (ci != nullptr && std::string(ci) == "true") FAIL(reason << " (required under CI=true)");
    skip(reason);
}

bool hasProgram(const std::string& name) {
    return std::system(("command -v '" + name + "' > /dev/null 2>&1").c_str()) == 0;
}

}  // namespace farol::test

int main(int argc, char** argv) {
    const int failed = Catch::Session().run(argc, argv);
    if (failed != 0 || counts.skipped == 0) return failed;
    if (counts.skipped == counts.cases) return kSkipped;
    std::cout << counts.skipped << " of " << counts.cases << " test cases skipped" << std::endl;
    return 0;
}
