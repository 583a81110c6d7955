#include "server/request/upload.h"

#include <algorithm>
#include <iterator>

#include "core/digest.h"
#include "core/text.h"
#include "scene/files/archive.h"
#include "scene/files/assets.h"
#include "server/messages.h"
#include "server/request/multipart.h"

namespace farol::server {
namespace {

std::string mediaType(const std::string& header) {
    return lowerCase(trimmed(std::string_view(header).substr(0, header.find(';')), kLineBlanks));
}

// Some clients send "C:\Users\x\file", of which the last part counts, or a path with a leading
// "./".
std::string pathOf(const Part& part) {
    std::string path = part.fileName.empty() ? part.name : part.fileName;
    std::replace(path.begin(), path.end(), '\\', '/');
    while (path.starts_with("./")) path.erase(0, 2);
    if (path.size() > 2 && path[1] == ':' && path[2] == '/') path = std::string(baseName(path));
    if (!scene::isSafePath(path) || std::any_of(path.begin(), path.end(), [](char c) {
            return static_cast<unsigned char>(c) < 0x20;
        }))
        throw Error(message<"http.multipart/file-name">("name"_arg = path));
    return path;
}

render::Job jobOfArchive(std::string bytes) {
    render::Job job;
    job.archive = std::move(bytes);
    job.assets = std::make_shared<scene::BundleAssets>();
    job.identity = contentDigest(job.archive);
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
        if (part.name == "without" && part.fileName.empty()) {
            for (const std::string_view line : split(part.content, "\r\n"))
                upload.without.emplace_back(line);
            continue;
        }
        if (part.name == "scene" && part.fileName.empty()) part.fileName = "scene.xml";
        const std::string path = pathOf(part);
        const auto known = bundle.files.find(path);
        if (known != bundle.files.end() && known->second != part.content)
            throw Error(message<"http.multipart/repeated">("name"_arg = path));
        if (part.name == "scene") {
            if (!bundle.main.empty())
                throw Error(message<"http.multipart/repeated">("name"_arg = "scene"));
            bundle.main = path;
        }
        bundle.files[path] = std::move(part.content);
    }
    if (bundle.main.empty() && bundle.files.size() == 1 &&
        scene::isArchive(bundle.files.begin()->second))
        bundle.main = bundle.files.begin()->first;
    if (bundle.main.empty()) {  // its files stay where they are
        const scene::BundleAssets files(std::shared_ptr<const scene::BundleAssets::Files>(
            std::shared_ptr<const void>(), &bundle.files));
        bundle.main = scene::mainOf(files);
    }
    if (scene::isArchive(bundle.files[bundle.main])) {
        if (bundle.files.size() > 1) throw Error(message<"http.multipart/archive">());
        upload.job = jobOfArchive(std::move(bundle.files[bundle.main]));
    } else {
        upload.bundle = std::make_shared<const scene::Bundle>(std::move(bundle));
        upload.job = jobOf(upload.bundle);
    }
    return upload;
}

bool isArchiveType(const std::string& type) {
    static constexpr const char* kTypes[] = {"application/zip",
                                             "application/x-zip-compressed",
                                             "application/x-tar",
                                             "application/gzip",
                                             "application/x-gzip",
                                             "application/vnd.rar",
                                             "application/x-rar-compressed",
                                             "application/x-7z-compressed",
                                             "application/octet-stream"};
    return std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
}

void refuseEncoding(const http::Request& request) {
    const auto encoding = request.header("content-encoding");
    if (encoding && mediaType(*encoding) != "identity")
        throw Error(message<"http.content-encoding">("value"_arg = *encoding));
}

Upload fromArchive(std::string bytes, const std::string& type) {
    if (!scene::isArchive(bytes)) {
        const bool isNamed = type != "application/octet-stream";
        throw Error(isNamed ? message<"bundle.damaged/body">()
                            : message<"http.media-type/archive">());
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
        throw Error(message<"http.media-type/parts">("value"_arg = mediaType(contentType)));
    const auto boundary = boundaryOf(contentType);
    if (!boundary) throw Error(message<"http.multipart/boundary">());
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
        throw Error(message<"http.media-type">("value"_arg = type));
    }
    if (upload.job.xml.empty() && upload.job.archive.empty())
        throw Error(message<"xml.empty/body">());
    return upload;
}

}  // namespace farol::server
