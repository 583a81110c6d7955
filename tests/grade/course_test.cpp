#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "grade/rubric/grader.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

// The course's own scenes and screenshots, which nobody here made: each scene passes against its
// own picture and fails against every other's, by the default rubric's measures.
using namespace farol;
namespace fs = std::filesystem;

namespace {

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

grade::Subject sceneAt(const fs::path& path) {
    grade::Subject subject;
    subject.job.name = path.filename().string();
    subject.job.xml = readFile(path);
    subject.job.assets = std::make_shared<scene::FolderAssets>(path.parent_path().string());
    return subject;
}

grade::Subject pictureAt(const fs::path& path) {
    grade::Subject subject;
    subject.job.name = path.filename().string();
    subject.picture = readFile(path);
    return subject;
}

}  // namespace

TEST_CASE("the course pack grades itself") {
    const fs::path course = fs::path(farol::test::kSourceDir) / ".." / "shared" / "data" / "course";
    if (!fs::exists(course)) test::skip("no folder ../shared/data/course");
    const std::vector<std::pair<std::string, std::string>> pairs{
        {"phase_1/test_1_1", "phase_1/test_1_1"}, {"phase_1/test_1_2", "phase_1/test_1_2"},
        {"phase_1/test_1_3", "phase_1/test_1_3"}, {"phase_1/test_1_4", "phase_1/test_1_4"},
        {"phase_1/test_1_5", "phase_1/test_1_5"}, {"phase_2/test_2_1", "phase_2/test_2_1"},
        {"phase_2/test_2_2", "phase_2/test_2_2"}, {"phase_2/test_2_3", "phase_2/test_2_3"},
        {"phase_2/test_2_4", "phase_2/test_2_4"}, {"phase_4/test_4_1", "phase_4/4_1"},
        {"phase_4/test_4_2", "phase_4/4_2"},      {"phase_4/test_4_6", "phase_4/4_6"}};
    render::Renderer renderer;
    grade::Grader grader(renderer);
    double leastOwn = 1e9, mostOther = 0.0;
    for (const auto& [name, own] : pairs) {
        std::cout << name << ":";
        grade::Rubric rubric = grade::defaultRubric();
        if (name.starts_with("phase_4")) {  // as the engine of the screenshots lights and filters
            rubric.shading = scene::Shading::gouraud;
            rubric.filter = scene::Filter::linear;
        }
        for (const auto& [otherScene, picture] : pairs) {
            const grade::Grade grade = grader.grade(pictureAt(course / (picture + ".png")),
                                                    sceneAt(course / (name + ".xml")), rubric);
            std::cout << " " << grade.points;
            INFO(name << " against " << picture << ": " << grade.points);
            CHECK_FALSE(grade.notGraded);
            CHECK(grade.passed == (picture == own));
            if (picture == own)
                leastOwn = std::min(leastOwn, grade.points);
            else
                mostOther = std::max(mostOther, grade.points);
        }
        std::cout << "\n";
    }
    std::cout << "own pictures: at least " << leastOwn << " points; others: at most " << mostOther
              << "\n";
}
