#pragma once

#include <memory>
#include <optional>
#include <string>

#include "render/renderer.h"

namespace farol::grade {

/// What is graded, or graded against: a scene, or a picture of one.
struct Subject {
    /// Of its options only `missing` is used; job.name also names a picture.
    render::Job job;
    std::optional<std::string> picture;  ///< the bytes of a picture file, where it is one
    std::string task;  ///< of an archive: which of its scenes is meant; may be empty
};

/// The scene, picture or archive that is meant among files by their paths. Of several .xml files
/// the one of the task's name (or in a folder of that name) is taken; where there is no task
/// scene.xml, else the highest in the folders if it is the only one there. Without any .xml file it
/// is the only archive, else the picture, chosen likewise. `where` names the files in errors.
/// Throws Error grade.no-scene, grade.which-scene, grade.empty-file.
Subject subjectOf(std::shared_ptr<const scene::Assets> files, const std::string& where,
                  const std::string& task);

/// Opens the subject's archive, if it is one: not to be done outside the sandbox. Throws as
/// scene::ArchiveAssets and subjectOf do.
Subject opened(const Subject& subject);

/// By the ending of the name: .png .jpg .jpeg .webp .bmp .tga.
bool isPictureName(const std::string& name);

}  // namespace farol::grade
