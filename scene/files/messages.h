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
    {"asset.missing/background",
     "there is no background \"{file}\"; {fix}",
     {"sky.png", "correct it"}},
    {"asset.missing/skybox",
     "there is no skybox texture \"{file}\"; {fix}",
     {"sky.png", "correct it"}},
    {"asset.missing/texture", "there is no texture \"{file}\"; {fix}", {"wood.png", "correct it"}},
    {"asset.percent",
     "\"{path}\" is the file \"{found}\", without percent-encoding",
     {"my%20wood.png", "my wood.png"}},
    {"asset.unicode",
     "\"{path}\" is the file \"{found}\", whose accents have another Unicode form",
     {"água.png", "água.png"}},
    {"asset.unreadable/file", "cannot be read; check the permissions of the file"},
    {"bundle.closed",
     "the archive \"{path}\" in the archive is not opened: {why}",
     {"old.zip", "it is too large, or too deep in other archives"}},
    {"bundle.closed/limit",
     "the archive \"{path}\" in the archive is not opened; it is too large, or too deep in other "
     "archives",
     {"old.zip"}},
    {"bundle.damaged/archive",
     "the archive cannot be read[: {problem}]; pack the files again as a zip file",
     {"Truncated ZIP file header"}},
    {"bundle.damaged/lost",
     "the archive does not hold \"{path}\", which its list names; pack the files again as a zip "
     "file",
     {"wood.png"}},
    {"bundle.damaged/twice",
     "the archive is compressed more than once; expected .zip, .tar or .tar.gz"},
    {"bundle.entry",
     "\"{path}\" in the archive is encrypted; pack the files without a password",
     {"scene.xml"}},
    {"bundle.entry/method",
     "\"{path}\" in the archive is packed as \"{method}\"; expected stored or deflated files",
     {"scene.xml", "ZIP 2.0 (lzma)"}},
    {"bundle.link",
     "\"{path}\" in the archive is a link; using the file \"{target}\"",
     {"tex/wood.png", "common/wood.png"}},
    {"bundle.link/outside",
     "\"{path}\" in the archive is a link to something that is no file of the archive, and is left "
     "out",
     {"tex/wood.png"}},
    {"bundle.no-scene",
     "there is no scene among the files; add a scene.xml, or send the scene as the part \"scene\""},
    {"bundle.no-scene/mesh",
     "there is no scene among the files, only meshes; add a scene.xml with "
     "<world><group><models><model file=\"{mesh}\"/></models></group></world>",
     {"hare.obj"}},
    {"bundle.path",
     "the name \"{path}\" in the archive is not a relative path; pack the files under relative "
     "names",
     {"/home/ana/scene.xml"}},
    {"bundle.path/none", "the archive has a file without a name; pack the files again"},
    {"bundle.path/twice",
     "the archive has the file \"{path}\" twice, with different content; pack it once",
     {"wood.png"}},
    {"bundle.which-scene",
     "several files may be the scene: {candidates}; call one scene.xml, or send it as the part "
     "\"scene\"",
     {"\"a.xml\", \"b.xml\""}},
    {"limit.bundle/bytes",
     "the files of the archive are larger than {max} MiB, the most for an archive of its size; "
     "send "
     "only the files that the scene names",
     {"64"}},
    {"limit.bundle/entries",
     "the archive has more than {max} entries; leave out folders that the scene does not name",
     {"50000"}},
    {"limit.bundle/needed",
     "the files that the scenes name are larger than {most} MiB together; send smaller images "
     "or meshes",
     {"64"}},
    {"limit.file-bytes/asset",
     "the file \"{path}\" is larger than {max} MiB; use a smaller file",
     {"sky.png", "256"}},
    {"part.add-file", "add it to the scene's files, or correct the name"},
    {"part.name-assets",
     "it is outside the scene's folder: name a folder that holds both with --assets, or send both "
     "in one archive"},
    {"part.near-file", "did you mean \"{name}\"?", {"wood.png"}},
};

}  // namespace farol::scene
