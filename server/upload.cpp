#include "server/upload.h"

#include <algorithm>
#include <iterator>

#include "scene/archive.h"
#include "scene/assets.h"
#include "scene/digest.h"
#include "scene/words.h"
#include "server/http/text.h"
#include "server/multipart.h"

namespace farol::server {
namespace {

std::string mediaType(const std::string& header) {
    return scene::lowerCase(http::trim(std::string_view(header).substr(0, header.find(';'))));
}

// Some clients send "C:\folder\file" or a path with a leading "./".
std::string pathOf(const Part& part) {
    std::string path = part.fileName.empty() ? part.name : part.fileName;
    std::replace(path.begin(), path.end(), '\\', '/');
    while (path.starts_with("./")) path.erase(0, 2);
    if (!scene::isSafePath(path) || std::any_of(path.begin(), path.end(), [](char c) {
            return static_cast<unsigned char>(c) < 0x20;
        }))
        throw Error("http.multipart",
                    "The file name " + scene::quoted(path) + " of a part is not a relative path.");
    return path;
}

render::Job jobOfArchive(std::string bytes) {
    render::Job job;
    job.archive = std::move(bytes);
    job.assets = std::make_shared<scene::BundleAssets>();
    job.identity = scene::contentDigest(job.archive);
    return job;
}

Upload fromParts(std::vector<Part> parts) {
    Upload upload;
    scene::Bundle bundle;
    for (Part& part : parts) {
        if (part.name == "options" && part.fileName.empty()) {
            upload.optionsJson = std::move(part.content);
            continue;
        }
        if (part.name == "scene" && part.fileName.empty()) part.fileName = "scene.xml";
        const std::string path = pathOf(part);
        if (bundle.files.count(path) != 0)
            throw Error("http.multipart", "The file " + scene::quoted(path) + " is there twice.");
        if (part.name == "scene") {
            if (!bundle.main.empty())
                throw Error("http.multipart", "There are two parts named \"scene\".");
            bundle.main = path;
        }
        bundle.files[path] = std::move(part.content);
    }
    if (bundle.main.empty() && bundle.files.size() == 1 &&
        scene::isArchive(bundle.files.begin()->second))
        bundle.main = bundle.files.begin()->first;
    if (bundle.main.empty()) bundle.main = scene::mainOf(bundle.files);
    if (scene::isArchive(bundle.files[bundle.main])) {
        if (bundle.files.size() > 1)
            throw Error("http.multipart", "An archive comes alone, without other files.");
        upload.job = jobOfArchive(std::move(bundle.files[bundle.main]));
    } else {
        upload.bundle = std::make_shared<const scene::Bundle>(std::move(bundle));
        upload.job = jobOf(upload.bundle);
    }
    return upload;
}

bool isArchiveType(const std::string& type) {
    static constexpr const char* kTypes[] = {"application/zip",    "application/x-zip-compressed",
                                             "application/x-tar",  "application/gzip",
                                             "application/x-gzip", "application/octet-stream"};
    return std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
}

void refuseEncoding(const http::Request& request) {
    const auto encoding = request.header("content-encoding");
    if (encoding && mediaType(*encoding) != "identity")
        throw Error("http.content-encoding", "Compressed bodies are not taken: send it as it is.");
}

Upload fromArchive(std::string bytes, const std::string& type) {
    if (!scene::isArchive(bytes)) {
        const bool said = type != "application/octet-stream";
        throw Error(said ? "bundle.damaged" : "http.media-type",
                    "The body is no zip and no tar file; XML is sent as application/xml.");
    }
    Upload upload;
    upload.job = jobOfArchive(std::move(bytes));
    return upload;
}

}  // namespace

render::Job jobOf(const std::shared_ptr<const scene::Bundle>& bundle, std::string digest) {
    render::Job job;
    job.name = bundle->main;
    job.xml = bundle->files.at(bundle->main);
    job.assets = std::make_shared<scene::BundleAssets>(
        std::shared_ptr<const scene::BundleAssets::Files>(bundle, &bundle->files));
    job.identity = digest.empty() ? scene::digestOf(*bundle) : std::move(digest);
    return job;
}

std::vector<Part> readParts(const http::Request& request, http::Body& body, std::size_t maxBytes) {
    refuseEncoding(request);
    const std::string contentType = request.header("content-type").value_or("");
    if (mediaType(contentType) != "multipart/form-data")
        throw Error("http.media-type", "The body is sent as multipart/form-data.");
    const auto boundary = boundaryOf(contentType);
    if (!boundary) throw Error("http.multipart", "The Content-Type has no usable boundary.");
    return parseMultipart(body.read(maxBytes), *boundary);
}

Upload readUpload(const http::Request& request, http::Body& body, std::size_t maxBytes) {
    refuseEncoding(request);
    const std::string contentType = request.header("content-type").value_or("application/xml");
    const std::string type = mediaType(contentType);
    Upload upload;
    if (type == "application/xml" || type == "text/xml") {
        upload.bundle = std::make_shared<const scene::Bundle>(
            scene::Bundle{"scene.xml", {{"scene.xml", body.read(maxBytes)}}});
        upload.job = jobOf(upload.bundle);
    } else if (type == "multipart/form-data") {
        upload = fromParts(readParts(request, body, maxBytes));
    } else if (isArchiveType(type)) {
        upload = fromArchive(body.read(maxBytes), type);
    } else {
        throw Error("http.media-type",
                    "A scene is sent as application/xml, text/xml, multipart/form-data, "
                    "application/zip, application/x-tar or application/gzip, not " +
                        scene::shown(type) + ".");
    }
    if (upload.job.xml.empty() && upload.job.archive.empty())
        throw Error("xml.empty", "The scene is empty: there is no XML.");
    return upload;
}

}  // namespace farol::server
