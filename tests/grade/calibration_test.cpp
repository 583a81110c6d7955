#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "classroom.h"

// Grades of mistakes and of harmless changes. FAROL_CALIBRATION names a file for the
// table of docs/grading.md (scripts/grade-calibration).
using namespace farol;
using namespace farol::test;

namespace {

struct Line {
    int scenes = 0, visible = 0, lost = 0, named = 0;
    double least = 1e9, most = 0, sum = 0;
    std::string misses;
};

grade::Rubric rubric() {
    grade::Rubric out = grade::defaultRubric();
    out.width = 384;  // smaller than the default for time; tolerances are shares of the pictures
    out.height = 288;
    return out;
}

bool names(const grade::Grade& grade, const Variant& variant) {
    for (const grade::GradedCause& one : grade.causes)
        for (const std::string& code : variant.codes)
            if (one.code == code) return true;
    return false;
}

std::string told(const grade::Grade& grade) {
    std::string out;
    for (const auto& one : grade.causes) out += "\n    " + one.code + ": " + one.message.text;
    for (const auto& one : grade.criteria)
        if (one.points < one.most) out += "\n    " + one.reason.text;
    for (const auto& one : grade.diagnostics)
        if (one.severity == Severity::error) out += "\n    " + one.message;
    return out;
}

Line runAll(grade::Grader& grader, const std::vector<ReferenceScene>& scenes,
            const Variant& variant, bool wrong) {
    Line line;
    for (const ReferenceScene& reference : scenes) {
        Work work = open(reference);
        const auto xml = variant.apply(work);
        if (!xml) continue;
        const grade::Grade grade = grader.grade(subjectOf(reference.xml, reference.files),
                                                subjectOf(*xml, work.files), rubric());
        const double loss = grade.most - grade.points;
        ++line.scenes;
        // A round object turned about its own axis, or a cause that no object shows.
        constexpr double kDivisions = 0.005;  // of the work
        const bool isSame = grade.unexplainedShare < kDivisions &&
                            std::none_of(grade.causes.begin(), grade.causes.end(),
                                         [](const grade::GradedCause& one) { return one.isSeen; });
        if (wrong && (!grade.visible || isSame) && !grade.notGraded) {
            std::cout << variant.name << " in " << reference.name << ": not to be seen\n";
            continue;
        }
        ++line.visible;
        line.lost += loss > 0.0 ? 1 : 0;
        line.named += names(grade, variant) ? 1 : 0;
        line.sum += loss;
        line.least = std::min(line.least, loss);
        line.most = std::max(line.most, loss);
        const bool missed = wrong ? loss <= 0.0 || !names(grade, variant) : loss > 1.0;
        if (missed || grade.notGraded)
            std::cout << variant.name << " in " << reference.name << ": loses " << loss
                      << told(grade) << "\n";
    }
    return line;
}

}  // namespace

TEST_CASE(
    "mistakes lose points and are named; harmless changes lose no more than one in a hundred") {
    render::Renderer renderer;
    grade::Grader grader(renderer);
    const std::vector<ReferenceScene> scenes = referenceScenes();
    REQUIRE(scenes.size() >= 12);
    std::string table =
        "| mistake | scenes | to be seen | lose points | named | points lost |\n"
        "| --- | --- | --- | --- | --- | --- |\n";
    int kinds = 0, visible = 0, named = 0;
    const auto row = [](const char* format, auto... values) {
        char text[300];
        std::snprintf(text, sizeof text, format, values...);
        return std::string(text);
    };
    for (const Variant& variant : mutants()) {
        const Line line = runAll(grader, scenes, variant, true);
        INFO(variant.name);
        CHECK(line.lost == line.visible);
        kinds += line.visible > 0 ? 1 : 0;
        visible += line.visible;
        named += line.named;
        table +=
            row("| %s | %d | %d | %d | %d | %.1f..%.1f |\n", variant.name.c_str(), line.scenes,
                line.visible, line.lost, line.named, line.visible ? line.least : 0.0, line.most);
    }
    table += row("\n%d kinds of mistakes, %d cases to be seen, %d named rightly (%.1f %%).\n\n",
                 kinds, visible, named, 100.0 * named / std::max(1, visible));
    table +=
        "| harmless change | scenes | points lost, mean | at most |\n"
        "| --- | --- | --- | --- |\n";
    CHECK(kinds >= 20);
    CHECK(named >= 0.9 * visible);
    int harmlessKinds = 0;
    for (const Variant& variant : harmless()) {
        const Line line = runAll(grader, scenes, variant, false);
        INFO(variant.name);
        CHECK(line.most <= 1.0);
        harmlessKinds += line.scenes > 0 ? 1 : 0;
        table += row("| %s | %d | %.2f | %.2f |\n", variant.name.c_str(), line.scenes,
                     line.sum / std::max(1, line.scenes), line.most);
    }
    CHECK(harmlessKinds >= 8);
    if (const char* path = std::getenv("FAROL_CALIBRATION")) std::ofstream(path) << table;
    std::cout << table;
}
