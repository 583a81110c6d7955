#include "grade/rubric/metrics.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "grade/rubric/rubric.h"
#include "tests/support/paths.h"

namespace {

using namespace farol::grade;

std::string contentOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Checks that the file, or what stands in it between lines with the marks, is `expected`; under
/// FAROL_UPDATE_GOLDENS=1 it is written.
void checkCurrent(const std::string& name, const std::string& expected,
                  const std::string& begin = "", const std::string& end = "") {
    const std::string path = std::string(farol::test::kSourceDir) + "/" + name;
    const std::string whole = contentOf(path);
    std::size_t from = 0, to = whole.size();
    if (!begin.empty()) {
        from = whole.find(begin);
        REQUIRE(from != std::string::npos);
        from = whole.find('\n', from) + 1;
        to = whole.rfind('\n', whole.find(end, from)) + 1;
        REQUIRE(to >= from);
    }
    INFO(name << " is not current; FAROL_UPDATE_GOLDENS=1 writes it");
    if (std::getenv("FAROL_UPDATE_GOLDENS") != nullptr) {
        std::ofstream(path, std::ios::binary)
            << whole.substr(0, from) << expected << whole.substr(to);
        return;
    }
    CHECK(whole.substr(from, to - from) == expected);
}

}  // namespace

TEST_CASE("the report's script shows the columns of the metrics' table") {
    checkCurrent("grade/report/view.js", metricsScript(), "const shares = (view) => ",
                 "].filter(Boolean)");
}

TEST_CASE("each metric has a unique name, and its sentence and columns fit its result") {
    std::set<std::string_view> names;
    Frame reference, submission;
    for (int i = 0; i < 32 * 32; ++i) {
        for (const int level : {200, i % 256, 0, 255})
            reference.color.pixels.push_back(static_cast<std::uint8_t>(level));
        for (const int level : {200, i * 7 % 256, 90, 255})
            submission.color.pixels.push_back(static_cast<std::uint8_t>(level));
    }
    reference.color.width = reference.color.height = 32;
    submission.color.width = submission.color.height = 32;
    reference.depth = reference.normal = reference.color;
    submission.depth = submission.normal = submission.color;
    reference.ids.assign(32 * 32, 1);
    submission.ids = reference.ids;
    submission.ids[5] = 2;
    const std::vector<Rectangle> hidden;  // outlives the pairs
    FramePair apart(reference, submission, hidden, false),
        same(reference, reference, hidden, false);
    for (const MetricSpec& metric : metrics()) {
        INFO(metric.name);
        CHECK(names.insert(metric.name).second);
        CHECK(!metric.summary.empty());
        if (metric.image() == nullptr) continue;
        CHECK(metric.image()->tolerance < metric.image()->limit);
        CHECK(!metric.image()->sentence(0.5).text.empty());
        for (FramePair* pair : {&apart, &same}) {
            const Measurement measured = metric.image()->compute(*pair);
            CHECK(measured.columns.size() == metric.image()->columns.size());
            CHECK((measured.loss >= 0.0 && measured.loss <= 1.0));
            if (pair == &same) CHECK(measured.loss == 0.0);
        }
    }
    CHECK(mainMetric().appliesToPictures());
}

TEST_CASE("what a rubric's masks hide does not count, in any measure of images") {
    Frame reference, submission;
    for (int i = 0; i < 64 * 64; ++i)
        for (const int level : {i * 5 % 256, 120, 40, 255})
            reference.color.pixels.push_back(static_cast<std::uint8_t>(level));
    reference.color.width = reference.color.height = 64;
    submission.color = reference.color;
    for (int y = 20; y < 28; ++y)
        for (int x = 20; x < 28; ++x)
            submission.color.pixels[static_cast<std::size_t>(4 * (64 * y + x) + 1)] = 255;
    const std::vector<Rectangle> none, hidden = {{8, 8, 32, 32}};
    FramePair open(reference, submission, none, false),
        masked(reference, submission, hidden, false);
    for (const MetricSpec& metric : metrics()) {
        if (!metric.appliesToPictures()) continue;
        INFO(metric.name);
        CHECK(metric.image()->compute(open).loss > 0.001);
        CHECK(metric.image()->compute(masked).loss < 1e-6);
    }
}
