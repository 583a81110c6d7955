#include "server/upload.h"

#include <algorithm>
#include <map>

#include "scene/assets.h"
#include "scene/words.h"
#include "server/multipart.h"

namespace farol::server {
namespace {

std::string mediaType(const std::string& header) {
    std::string type = header.substr(0, header.find(';'));
    while (!type.empty() && (type.back() == ' ' || type.back() == '\t')) type.pop_back();
    std::transform(type.begin(), type.end(), type.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return type;
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

bool isSceneName(const std::string& path) {
    return path.size() > 4 && mediaType(path.substr(path.size() - 4)) == ".xml";
}

Upload fromParts(std::vector<Part> parts) {
    Upload upload;
    std::map<std::string, std::string> files;
    bool found = false;
    std::string onlyXml;
    int xmlFiles = 0;
    for (Part& part : parts) {
        if (part.name == "options" && part.fileName.empty()) {
            upload.optionsJson = std::move(part.content);
            continue;
        }
        if (part.name == "scene" && part.fileName.empty()) part.fileName = "scene.xml";
        const std::string path = pathOf(part);
        if (files.count(path) != 0)
            throw Error("http.multipart", "The file " + scene::quoted(path) + " is there twice.");
        if (part.name == "scene") {
            if (found) throw Error("http.multipart", "There are two parts named \"scene\".");
            found = true;
            upload.job.name = path;
            upload.job.xml = part.content;
        } else if (isSceneName(path)) {
            onlyXml = path;
            ++xmlFiles;
        }
        files[path] = std::move(part.content);
    }
    if (!found && xmlFiles == 1) {  // no part is called scene, but only one can be meant
        found = true;
        upload.job.name = onlyXml;
        upload.job.xml = files[onlyXml];
    }
    if (!found) throw Error("http.multipart", "There is no part named \"scene\".", {}, "scene");
    upload.job.assets = std::make_shared<scene::BundleAssets>(std::move(files));
    return upload;
}

}  // namespace

Upload readUpload(const http::Request& request, http::Body& body, std::size_t maxBytes) {
    const auto encoding = request.header("content-encoding");
    if (encoding && mediaType(*encoding) != "identity")
        throw Error("http.content-encoding", "Compressed bodies are not taken: send it as it is.");
    const std::string contentType = request.header("content-type").value_or("application/xml");
    const std::string type = mediaType(contentType);
    Upload upload;
    if (type == "application/xml" || type == "text/xml") {
        upload.job.xml = body.read(maxBytes);
        upload.job.assets = std::make_shared<scene::BundleAssets>();
    } else if (type == "multipart/form-data") {
        const auto boundary = boundaryOf(contentType);
        if (!boundary) throw Error("http.multipart", "The Content-Type has no usable boundary.");
        upload = fromParts(parseMultipart(body.read(maxBytes), *boundary));
    } else {
        throw Error("http.media-type",
                    "A scene is sent as application/xml, text/xml or multipart/form-data, not " +
                        scene::shown(type) + ".");
    }
    if (upload.job.xml.empty()) throw Error("xml.empty", "The scene is empty: there is no XML.");
    return upload;
}

}  // namespace farol::server
