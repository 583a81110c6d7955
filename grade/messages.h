#pragma once

#include "core/message.h"

namespace farol::grade {

inline constexpr MessageRow kGradeMessages[] = {
    {"grade.chosen",
     "graded \"{path}\", one of {count} .xml files; {reason}",
     {"house_final.xml", "2", "its name is that of the newest version"}},
    {"grade.empty-file",
     "file \"{name}\" is empty (0 bytes); hand in the file again",
     {"scene.xml"}},
    {"grade.image",
     "an image was handed in where a scene is expected; hand in the scene's .xml file"},
    {"grade.no-scene/deep",
     "the scene is more than {max} archives deep; pack its files once",
     {"4"}},
    {"grade.no-scene/files",
     "it holds no .xml file, archive or image; hand in the scene's .xml file"},
    {"grade.no-scene/kind",
     "a .{ending} file is not a scene; hand in the .xml file, alone or in a .zip with its files",
     {"docx"}},
    {"grade.no-scene/task", "it holds nothing that has the name of \"{task}\"", {"test_4_1"}},
    {"grade.table/column",
     "has no column \"{column}\"; expected the columns {expected}",
     {"mark", "student, mark, comment"}},
    {"grade.table/mark", "\"{value}\" is no mark; expected a number of 0 or more", {"good"}},
    {"grade.table/rows", "has more than {max} rows; give a table of one class", {"100000"}},
    {"grade.which-scene",
     "it holds {count} .xml files and none is clearly meant: {names}; hand in one of them, or call "
     "it scene.xml",
     {"2", "a.xml, b.xml"}},
    {"part.chosen/name", "its name is that of the task"},
    {"part.chosen/scene", "the others are no scenes"},
    {"part.chosen/files", "it names the most files of the reference"},
    {"part.chosen/folder", "it has the name of its folder"},
    {"part.chosen/newest", "its name is that of the newest version"},
    {"part.chosen/usual", "its name is scene.xml"},
    {"part.chosen/highest", "it is the highest in the folders"},
};

/// A message of this floor's table.
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kGradeMessages>(arguments...);
}

}  // namespace farol::grade
