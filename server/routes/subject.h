#pragma once

#include "grade/rubric/subject.h"
#include "server/request/multipart.h"

namespace farol::server {

/// An archive or an image by its first bytes, an image without a signature by its name, else a
/// scene.
grade::Subject subjectOf(Part part);

}  // namespace farol::server
