#pragma once

#include "core/message.h"

namespace farol::scene {

/// Messages of scene/files, by code.
inline constexpr MessageRow kFilesMessages[] = {
    {"asset.ambiguous",
     "\"{path}\" is not there, and several different files have its name: {candidates}; write the "
     "path of the one that is meant",
     {"wood.png", "\"a/wood.png\", \"b/wood.png\""}},
    {"asset.case",
     "\"{path}\" is the file \"{found}\"; write capital and small letters as in the file's name",
     {"Wood.PNG", "wood.png"}},
    {"asset.code-page",
     "\"{path}\" is the file \"{found}\", whose name was stored in another code page",
     {"água.png", "ßgua.png"}},
    {"asset.found-elsewhere/end",
     "\"{path}\" is not there; using the file \"{found}\", whose path ends in the same way",
     {"old/tex/wood.png", "data/tex/wood.png"}},
    {"asset.found-elsewhere/name",
     "\"{path}\" is not there; using the file \"{found}\", which has the same name",
     {"wood.png", "data/wood.png"}},
    {"asset.in-parent",
     "\"{path}\" is not in the document's folder; using the file \"{found}\" from a folder above",
     {"tex/wood.png", "tex/wood.png"}},
    {"asset.percent",
     "\"{path}\" is the file \"{found}\", without percent-encoding",
     {"my%20wood.png", "my wood.png"}},
    {"asset.unicode",
     "\"{path}\" is the file \"{found}\", whose accents have another Unicode form",
     {"água.png", "água.png"}},
    {"bundle.closed",
     "the archive \"{path}\" in the archive is not opened: {why}",
     {"old.zip", "it is too large, or too deep in other archives"}},
    {"bundle.closed/limit",
     "the archive \"{path}\" in the archive is not opened; it is too large, or too deep in other "
     "archives",
     {"old.zip"}},
    {"limit.bundle/needed",
     "the files that the scenes name are larger than {most} MiB together; send smaller pictures "
     "or meshes",
     {"64"}},
};

}  // namespace farol::scene
