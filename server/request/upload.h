#pragma once

#include <memory>
#include <string>

#include "render/renderer.h"
#include "scene/files/bundle.h"
#include "server/http/message.h"
#include "server/request/multipart.h"

namespace farol::server {

/// A scene in the body of a request.
struct Upload {
    /// The document and its files, or an archive of them that is still to be opened; with an
    /// identity, without options.
    render::Job job;
    std::shared_ptr<const scene::Bundle> bundle;  ///< of the job; null for an archive
    std::string optionsJson;                      ///< the part `options`, or empty
    std::vector<std::string> without;             ///< the part `without`: paths, one a line
};

/// Reads XML (the scene itself), multipart/form-data with the scene and the files it names, or a
/// zip or tar of them, which is opened by a worker only. Throws Error http.content-encoding,
/// http.media-type, limit.body, http.multipart, http.body, xml.empty, bundle.*.
Upload readUpload(const http::Request& request, http::Body& body, std::size_t maxBytes);

/// The parts of a multipart/form-data body. Throws Error http.content-encoding, http.media-type,
/// limit.body, http.multipart, http.body.
std::vector<Part> readParts(const http::Request& request, http::Body& body, std::size_t maxBytes);

/// The job of a bundle whose paths are safe; the files are shared, not copied. `digest`: the
/// bundle's (digestOf), where it is known.
render::Job jobOf(const std::shared_ptr<const scene::Bundle>& bundle, std::string digest = "");

}  // namespace farol::server
