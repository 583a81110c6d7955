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

}  // namespace

TEST_CASE("the report's script shows the columns of the metrics' table") {
    const std::string script =
        contentOf(std::string(farol::test::kSourceDir) + "/grade/report/view.js");
    for (const MetricSpec& metric : metrics()) {
        if (metric.image() == nullptr) continue;
        const auto& columns = metric.image()->columns;
        const std::string value = "view." + std::string(metric.name);
        for (const MetricColumn& column : columns) {
            const std::string shown =
                columns.size() > 1 ? value + "." + std::string(column.key) : value;
            INFO(shown << ", " << column.label);
            CHECK(script.find(column.format == MetricColumn::Format::percent
                                  ? "number(100 * " + shown + ")"
                                  : shown + ".toFixed(3)") != std::string::npos);
            CHECK(script.find(std::string(column.label)) != std::string::npos);
        }
    }
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
