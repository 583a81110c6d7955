#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "grade/rubric/grader.h"

/// Submissions and references as teachers have them: folders, files, archives.
namespace farol::cli {

/// One student's submission: an entry of the class's folder.
struct Submission {
    std::string path;
    std::string id;      ///< the entry's name in UTF-8, unique
    std::string name;    ///< the student's; of Moodle's "Name_id_assignsubmission_file_" folders
    std::string number;  ///< Moodle's identifier
};

/// One thing to be done by all: a reference scene or expected picture.
struct GradeTask {
    std::string name;  ///< of the file or folder without its ending; empty where there is one only
    std::string path;
};

/// Entries of the folder, by name: folders, .xml, .zip, .tar, .tar.gz, .tgz and picture files, and
/// whatever else has such a name (a link, a pipe): it is refused when it is read. Hidden entries
/// are left out. Throws Error asset.missing where there is no such folder, grade.no-submissions
/// where it holds none.
std::vector<Submission> findSubmissions(const std::string& folder);

/// A file is the one task. A folder: each of its .xml files is a task (pictures beside them are
/// textures); else each of its folders that holds .xml files; else each picture. Throws Error.
std::vector<GradeTask> findTasks(const std::string& reference);

/// The scene or the picture at `path`, with all files beside or below it in memory. Archives are
/// left packed: they are opened in the sandbox. Of several .xml files in a folder the one of the
/// task's name is used, else scene.xml, else the highest in the folder if it is the only one
/// there. `task` may be empty.
/// Links are not followed, and nothing but a regular file is opened.
/// Throws Error grade.no-scene, grade.which-scene, grade.empty-file, limit.bundle,
/// limit.file-bytes, asset.*.
grade::Subject readSubject(const std::string& path, const std::string& task);

/// The same for a reference. The files beside its .xml file belong to it, but for the folders
/// `apart`: the submissions and the report often lie beside it, too.
grade::Subject readReference(const std::string& path,
                             const std::vector<std::filesystem::path>& apart);

}  // namespace farol::cli
