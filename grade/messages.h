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
    {"part.cause/beside",
     "{who} {what}[; it {values}][ (line {line})]",
     {"the camera", "has another up", "is 0 0 1, expected 0 1 0", "5"}},
    {"part.cause/of",
     "{who}: {what}[; it {values}][ (line {line})]",
     {"group \"door\"", "the angle of the rotate has the wrong sign", "is -50, expected 50", "65"}},
    {"part.cause/place", "{who}[ (line {line})]", {"group \"door\"", "65"}},
    {"part.cause/places",
     "at {count} places {what}[; it {values}]: {places}[ and {more} more]",
     {"3", "the rotate turns about the wrong axis", "is 30 about 1 0 0, expected 30 about 0 1 0",
      "group \"a\" (line 5), group \"b\" (line 9)", "1"}},
    {"part.cause/unclosed",
     "{cause}; this follows from the missing end tag",
     {"group \"door\" hangs under group \"walls\" (line 61)"}},
    {"part.chosen/name", "its name is that of the task"},
    {"part.chosen/scene", "the others are no scenes"},
    {"part.chosen/files", "it names the most files of the reference"},
    {"part.chosen/folder", "it has the name of its folder"},
    {"part.chosen/newest", "its name is that of the newest version"},
    {"part.chosen/usual", "its name is scene.xml"},
    {"part.chosen/highest", "it is the highest in the folders"},
    {"rubric.json", "the rubric cannot be read: {reason}", {"line 3: expected a value"}},
    {"rubric.key",
     "{path} is not known here; known are {known}",
     {"criteria[0].wieght", "measure, weight"}},
    {"rubric.range/length",
     "{path} has {count} entries; takes {least} to {most}",
     {"views", "40", "1", "16"}},
    {"rubric.range/number",
     "{path} is {value}; takes {least} to {most}",
     {"passMark", "120", "0", "100"}},
    {"rubric.range/samples", "{path} takes 1, 2, 4, 8 or 16", {"samples"}},
    {"rubric.range/tolerance", "{path} is not below its limit", {"criteria[0].tolerance"}},
    {"rubric.range/twice", "{path} is there twice", {"criteria[1].measure"}},
    {"rubric.range/weights", "{path} weigh nothing", {"criteria"}},
    {"rubric.range/word",
     "{path} is \"{value}\"; takes one of {known}",
     {"filter", "sharp", "nearest, linear"}},
    {"rubric.type/flag", "{path} takes true or false", {"axes"}},
    {"rubric.type/integer", "{path} takes an integer", {"width"}},
    {"rubric.type/list", "{path} takes a list", {"views"}},
    {"rubric.type/missing", "{path} lacks its {key}", {"criteria[0]", "measure"}},
    {"rubric.type/number", "{path} takes a number", {"points"}},
    {"rubric.type/object", "{path} takes an object", {"criteria[0]"}},
    {"rubric.type/text", "{path} takes a string", {"title"}},
};

/// A message of this floor's table.
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kGradeMessages>(arguments...);
}

}  // namespace farol::grade
