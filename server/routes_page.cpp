// The web page: files that are linked into the program (cmake/web.cmake).
#include <optional>
#include <span>

#include "scene/embedded.h"
#include "scene/words.h"
#include "server/etag.h"
#include "server/media.h"
#include "server/service.h"

namespace farol {
std::span<const EmbeddedFile> webFiles();
}

namespace farol::server {
namespace {

// The page loads its own script, style and pictures and talks to its own server: nothing else.
constexpr const char* kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::optional<std::string_view> embedded(const std::string& name) {
    for (const EmbeddedFile& file : webFiles())
        if (file.name == name) return file.bytes;
    return std::nullopt;
}

std::string typeOf(const std::string& name) {
    static constexpr std::pair<const char*, const char*> kTypes[] = {
        {".html", "text/html; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".svg", "image/svg+xml"},
        {".yaml", "application/yaml"}};
    for (const auto& [ending, type] : kTypes)
        if (name.ends_with(ending)) return type;
    return "application/octet-stream";
}

}  // namespace

http::Response Service::file(const Call& call, const std::string& name, bool immutable) {
    readParameters(call.request.query, {});
    const auto plain = embedded(name);
    if (!plain || name.ends_with(".gz"))
        throw Error("http.not-found", "There is no file " + scene::quoted(name) + " here.");
    const auto packed = embedded(name + ".gz");
    const bool unpacked = !packed || !call.request.header("accept-encoding") ||
                          acceptedQuality(call.request.header("accept-encoding"), "gzip") <= 0.0;
    const std::string_view bytes = unpacked ? *plain : *packed;
    http::Response response;
    const std::string tag = entityTag({bytes});
    response.set("ETag", tag);
    response.set("Content-Security-Policy", kPagePolicy);
    if (packed) response.set("Vary", "Accept-Encoding");
    // The build puts a hash of the content into these names.
    if (immutable) response.set("Cache-Control", "public, max-age=31536000, immutable");
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        return response;
    }
    if (!unpacked) response.set("Content-Encoding", "gzip");
    response.contentType = typeOf(name);
    response.body = std::string(bytes);
    return response;
}

http::Response Service::getPage(const Call& call) {
    return file(call, embedded("index.html") ? "index.html" : "plain.html", false);
}

http::Response Service::getAsset(const Call& call) {
    const bool ofPlainPage = call.parameter.starts_with("plain.");
    return file(call, "assets/" + call.parameter, !ofPlainPage);
}

}  // namespace farol::server
