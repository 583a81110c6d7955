#pragma once

#include <memory>
#include <optional>
#include <string>

#include "grade/rubric/choice.h"
#include "render/renderer.h"

namespace farol::grade {

/// A scene, or an image of one, that is graded or graded against.
struct Subject {
    /// Of its options only `missing` is used; job.name also names a picture.
    render::Job job;
    std::optional<std::string> picture;  ///< the bytes of a picture file, where it is one
    Wanted wanted;                       ///< of an archive: which of its scenes is meant
    Diagnostics notes;                   ///< which file was chosen, and why

    /// Returns whether this is no subject: a rubric of requirements has no reference.
    bool isNone() const { return !hasScene() && (!job.assets || job.assets->list().empty()); }
    /// Returns whether it is files alone, for requirements of mesh files.
    bool isFiles() const { return !hasScene() && !isNone(); }

  private:
    bool hasScene() const { return picture || !job.xml.empty() || !job.archive.empty(); }
};

/// Chooses the scene, image or archive among files by their paths: chooseDocument() of the .xml
/// files. Without any .xml file the only archive, else the image with the task's name, or without a
/// task the only image or the one highest in the folders. `where` names the
/// files in errors.
/// Where nothing of that is there and Wanted::isScene is false, all files.
/// Throws Error grade.no-scene, grade.which-scene, grade.empty-file.
Subject subjectOf(std::shared_ptr<const scene::Assets> files, const std::string& where,
                  const Wanted& wanted);

/// Opens the subject's archive, if it is one; only inside the sandbox. `files`: names of files in
/// the reference (filesNamedIn), if known. Throws as scene::ArchiveAssets and
/// subjectOf do.
Subject opened(const Subject& subject, const std::vector<std::string>& files = {});

/// By the ending of the name: .png .jpg .jpeg .webp .bmp .tga.
bool isPictureName(const std::string& name);

}  // namespace farol::grade
