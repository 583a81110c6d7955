#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/class_archive.h"
#include "grade/rubric/grader.h"

/// Submissions and references as teachers have them: folders, files, archives.
namespace farol::cli {

/// One student's submission: an entry of the class's folder, or of the .zip that Moodle sends.
struct Submission {
    std::string path;
    std::string id;      ///< the entry's name in UTF-8, unique
    std::string name;    ///< the student's; of Moodle's "Name_id_assignsubmission_file_" names
    std::string number;  ///< Moodle's identifier
    /// Where Moodle sends files without folders: the paths of all of one student.
    std::vector<std::string> parts = {};
    std::shared_ptr<const ClassArchive> archive = nullptr;  ///< that holds it
    std::vector<std::size_t> entries = {};                  ///< of the archive
};

/// One task of the class: a reference scene or expected image.
struct GradeTask {
    std::string name;  ///< of the file or folder without its ending; empty where there is one only
    std::string path;
};

/// Returns every entry of the folder, or of a .zip of the class, by name; an entry that cannot be
/// graded is refused when it is read. Leaves out hidden entries; files with Moodle's names
/// "Name_id_assignsubmission_file_scene.xml" are one submission a student. Throws Error
/// asset.missing if there is no such folder, grade.no-submissions if it is empty, as ClassArchive.
std::vector<Submission> findSubmissions(const std::string& folder);

/// The folder, archive, scene or image as one submission with its name. Throws Error asset.missing
/// where there is nothing.
Submission oneSubmission(const std::string& path);

/// A file is the one task. A folder: each of its .xml files is a task (pictures beside them are
/// textures); else each of its folders that holds .xml files; else each picture. Throws Error.
std::vector<GradeTask> findTasks(const std::string& reference);

/// Reads a submission as readSubject() does; from a .zip of the class as a zip for the sandbox.
grade::Subject readSubmission(const Submission& submission, const grade::Wanted& wanted);

/// The scene or the picture at `path`, with all files beside or below it in memory. Archives are
/// left packed: they are opened in the sandbox. Which of several files is meant:
/// grade::subjectOf(). Links are not followed, and nothing but a regular file is opened. Throws
/// Error grade.no-scene, grade.which-scene, grade.empty-file, limit.bundle, limit.file-bytes,
/// asset.*.
grade::Subject readSubject(const std::string& path, const grade::Wanted& wanted);

/// The same for a reference. The files beside its .xml file belong to it, but for the folders
/// `apart`: the submissions and the report often lie beside it, too.
grade::Subject readReference(const std::string& path,
                             const std::vector<std::filesystem::path>& apart);

}  // namespace farol::cli
