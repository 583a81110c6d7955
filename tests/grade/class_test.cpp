#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

#include "grade/rubric/grader.h"
#include "scene/files/assets.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

// A class whose fair marks were decided before any of it was graded: ../shared/data/class_house.
// FAROL_CLASS names another folder of its kind, FAROL_CLASS_TABLE a file for the table of
// docs/grading.md.
using namespace farol;
namespace fs = std::filesystem;

namespace {

std::string readBytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::shared_ptr<const scene::Assets> filesBelow(const fs::path& folder) {
    std::map<std::string, std::string> files;
    if (fs::exists(folder))  // an empty hand-in is not kept among the data
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                files[fs::relative(entry.path(), folder).generic_string()] =
                    readBytes(entry.path());
    return std::make_shared<scene::BundleAssets>(std::move(files));
}

struct Mark {
    std::string name, deed;
    double least = 0, most = 0;
    bool isUngradable = false;       ///< fair is: no mark
    std::optional<double> points{};  ///< nothing: not graded
    std::vector<std::string> causes{};
};

std::vector<Mark> readBands(const fs::path& path) {
    std::vector<Mark> marks;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        Mark mark;
        std::string band;
        std::getline(fields, mark.name, '\t');
        std::getline(fields, band, '\t');
        std::getline(fields, mark.deed);
        if (std::sscanf(band.c_str(), "(%lf, %lf)", &mark.least, &mark.most) != 2) continue;
        mark.isUngradable = mark.most == 0.0 || mark.deed.find("screenshot") != std::string::npos;
        marks.push_back(std::move(mark));
    }
    return marks;
}

bool isInBand(const Mark& mark) {
    constexpr double kSlack = 1.0;
    if (mark.isUngradable) return !mark.points.has_value();
    return mark.points && *mark.points >= mark.least - kSlack && *mark.points <= mark.most + kSlack;
}

std::string shortMark(const Mark& mark) {
    if (!mark.points) return "not graded";
    char text[16];
    std::snprintf(text, sizeof text, "%.1f", *mark.points);
    return text;
}

}  // namespace

TEST_CASE("a class has the marks that a fair teacher gives") {
    const char* other = std::getenv("FAROL_CLASS");
    const fs::path folder = other != nullptr ? fs::path(other)
                                             : fs::path(farol::test::kSourceDir) / ".." / "shared" /
                                                   "data" / "class_house";
    if (!fs::exists(folder / "marks.tsv")) test::skip("no folder ../shared/data/class_house");
    render::Renderer renderer;
    grade::Grader grader(renderer);
    const grade::Rubric rubric = grade::defaultRubric();
    const grade::Subject reference =
        grade::subjectOf(filesBelow(folder / "reference"), "reference", {});
    const grade::Wanted wanted{"", {}, grade::filesNamedIn(reference.job.xml)};
    std::vector<Mark> marks = readBands(folder / "marks.tsv");
    REQUIRE(marks.size() >= 20);
    std::string table =
        "| hand-in | fair | mark | what was done | causes |\n"
        "| --- | --- | --- | --- | --- |\n";
    std::size_t inside = 0;
    for (Mark& mark : marks) {
        try {
            grade::Subject submission =
                grade::subjectOf(filesBelow(folder / "submissions" / mark.name), mark.name, wanted);
            submission.job.options.missing = render::Missing::placeholder;
            const grade::Grade grade = grader.grade(reference, submission, rubric);
            if (!grade.notGraded) mark.points = grade.points;
            if (grade.notGraded) mark.causes.push_back(grade.notGraded->reason.text);
            for (const grade::GradedCause& one : grade.causes) {
                std::ostringstream text;
                text << one.message.text << " (-" << one.points << ")";
                mark.causes.push_back(text.str());
            }
            const auto addLoss = [&](const char* name, double points) {
                std::ostringstream text;
                text << name << " -" << points;
                if (points > 0.0) mark.causes.push_back(text.str());
            };
            addLoss("penalty", grade.penalty);
            addLoss("unexplained", grade.unexplained);
        } catch (const Error& error) {
            mark.causes.push_back(error.what());
        }
        const bool is = isInBand(mark);
        inside += is ? 1 : 0;
        std::string causes;
        for (const std::string& one : mark.causes) causes += (causes.empty() ? "" : "; ") + one;
        char fair[40];
        if (mark.isUngradable)
            std::snprintf(fair, sizeof fair, "not graded");
        else
            std::snprintf(fair, sizeof fair, "%.0f to %.0f", mark.least, mark.most);
        table += "| " + mark.name.substr(0, mark.name.find('_')) + " | " + fair + " | " +
                 shortMark(mark) + (is ? "" : " **out**") + " | " + mark.deed + " | " + causes +
                 " |\n";
    }
    std::size_t pairs = 0, inverted = 0;
    for (const Mark& a : marks)
        for (const Mark& b : marks) {
            constexpr double kClear = 5.0;
            // A submission without a mark is out of its band, and has no place in the order.
            if (a.isUngradable || b.isUngradable || !a.points || !b.points ||
                a.least <= b.most + kClear)
                continue;
            ++pairs;
            if (*a.points <= *b.points) {
                ++inverted;
                table += "\ninverted: " + a.name + " and " + b.name + "\n";
            }
        }
    table += "\n" + std::to_string(inside) + " of " + std::to_string(marks.size()) +
             " marks lie in their band (1 point of slack); of " + std::to_string(pairs) +
             " pairs whose order is clear " + std::to_string(inverted) +
             " are the wrong way round.\n";
    std::cout << table;
    if (const char* path = std::getenv("FAROL_CLASS_TABLE")) std::ofstream(path) << table;
    CHECK(inside + 2 >= marks.size());
    CHECK(inverted == 0);
}
