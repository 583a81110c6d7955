#pragma once

#include <map>
#include <string>

#include "render/renderer.h"

namespace farol::grade {

/// What is graded, or graded against: a scene, or a picture of one.
struct Subject {
    render::Job job;      ///< its options are not used; job.name also names a picture
    std::string picture;  ///< a picture file's bytes; empty: the job is the scene
    std::string task;     ///< of an archive: which of its scenes is meant; may be empty
};

/// The scene, picture or archive that is meant among files by their paths. Of several .xml files
/// the one of the task's name (or in a folder of that name) is taken; where there is no task
/// scene.xml, else the highest in the folders if it is the only one there. Without any .xml file it
/// is the only archive, else the picture, chosen likewise. `where` names the files in errors.
/// Throws Error grade.no-scene, grade.which-scene.
Subject subjectOf(std::map<std::string, std::string> files, const std::string& where,
                  const std::string& task);

/// Opens the subject's archive, if it is one: not to be done outside the sandbox. Throws as
/// scene::readFiles and subjectOf do.
Subject opened(const Subject& subject);

/// By the ending of the name: .zip .tar .tgz .gz; .png .jpg .jpeg .webp .bmp .tga.
bool isArchiveName(const std::string& name);
bool isPictureName(const std::string& name);

}  // namespace farol::grade
