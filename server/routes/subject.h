#pragma once

#include "grade/rubric/subject.h"
#include "server/request/multipart.h"

namespace farol::server {

/// A scene, an archive or a picture: the content decides.
grade::Subject subjectOf(Part part);

}  // namespace farol::server
