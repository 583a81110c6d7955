#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/message.h"
#include "scene/files/assets.h"

namespace farol::grade {

/// The search among a submission's files.
struct Wanted {
    std::string task;                 ///< its name; empty where there is one task
    std::vector<std::string> others;  ///< names of the other tasks
    std::vector<std::string> files;   ///< base names that the reference names, lower case
    bool isScene = true;              ///< false: files without a scene will do
};

/// Returns the base names of the files that a document names in quotes, in lower case, each once:
/// texts that end in a dot and two to five letters or digits. At most 1000.
std::vector<std::string> filesNamedIn(std::string_view document);

/// Returns whether a name means the task, ignoring case, accents, blanks, signs and further words:
/// "Test 4.1 (final)" and "testeFase4" mean "test_4_1" and "phase 4". Numbers must be the task's;
/// words may be Portuguese.
bool isNamedLike(std::string_view name, std::string_view task);

/// The chosen document.
struct Choice {
    std::string path;
    Message reason;  ///< why this one; empty where there was no other
};

/// Chooses among documents: those that begin as scenes; of a task's name (or in a folder of that
/// name), else, where the task has a name, those that name half of the reference's files at least;
/// then without those that name less than half as many of the reference's files as another; then
/// by the name scene.xml, the folder's name, the newest version (numbers of phases and versions,
/// "final" before "old"), the files of the reference that they name, and the height in the folders.
/// Returns an empty path where nothing has the task's name. Throws Error grade.which-scene with
/// `where` where several are left that differ.
Choice chooseDocument(const scene::Assets& files, std::vector<std::string> documents,
                      const Wanted& wanted, const std::string& where);

}  // namespace farol::grade
