#include "cli/grade_tables.h"

#include <filesystem>
#include <set>
#include <sstream>

#include "cli/files.h"
#include "cli/zip_writer.h"

namespace farol::cli {
namespace {

bool isThere(const std::string& path) {
    std::error_code failed;
    return std::filesystem::is_regular_file(path, failed);
}

grade::Rubric readRubricFile(const std::string& path) {
    return grade::readRubric(readInput(path), path);
}

/// The folder in the zip: of Moodle's name, where the student has an identifier.
std::string folderInZip(const grade::SubmissionResult& student, const grade::Member& member) {
    if (member.number.empty()) return student.id;
    return member.name + "_" + member.number + "_assignsubmission_file_";
}

}  // namespace

std::vector<grade::Rubric> readRubrics(const std::string& path,
                                       const std::vector<GradeTask>& tasks) {
    if (path.empty()) return {tasks.size(), grade::defaultRubric()};
    std::error_code failed;
    if (!std::filesystem::is_directory(path, failed)) return {tasks.size(), readRubricFile(path)};
    const std::string general = path + "/rubric.json";
    const grade::Rubric usual = isThere(general) ? readRubricFile(general) : grade::defaultRubric();
    std::vector<grade::Rubric> rubrics;
    for (const GradeTask& task : tasks) {
        const std::string own = path + "/" + task.name + ".json";
        rubrics.push_back(!task.name.empty() && isThere(own) ? readRubricFile(own) : usual);
    }
    return rubrics;
}

std::string readTable(std::string& path, const std::string& usual) {
    if (path.empty() && isThere(usual)) path = usual;
    return path.empty() ? "" : readInput(path);
}

void writeFeedback(const std::string& path, const grade::ClassResult& all) {
    OutputFile file(path);
    ZipWriter zip([&](std::string_view bytes) { file.append(bytes); });
    std::set<std::string> names;
    for (std::size_t i = 0; i < all.count; ++i) {
        grade::ClassResult alone = all;
        alone.count = 1;
        alone.at = [&](std::size_t) { return all.at(i); };
        std::ostringstream page;
        grade::writeHtml(page, alone);
        const grade::SubmissionResult student = all.at(i);
        for (const grade::Member& member :
             all.groups.membersOf(student.id, student.name, student.number)) {
            const std::string folder = folderInZip(student, member);
            if (names.insert(folder).second) zip.addStored(folder + "/feedback.html", page.str());
        }
    }
    zip.finish();
    file.commit();
}

}  // namespace farol::cli
