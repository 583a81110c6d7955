#pragma once

#include <string>

#include "render/renderer.h"
#include "server/http/message.h"

namespace farol::server {

/// A scene as it came in the body of a request.
struct Upload {
    render::Job job;          ///< name, xml and assets; the options are still to be set
    std::string optionsJson;  ///< the part `options`, or empty
};

/// Reads application/xml or text/xml (the scene itself), or multipart/form-data with the part
/// `scene` and the files it names. Throws Error http.content-encoding, http.media-type,
/// limit.body, http.multipart, http.body, xml.empty.
Upload readUpload(const http::Request& request, http::Body& body, std::size_t maxBytes);

}  // namespace farol::server
