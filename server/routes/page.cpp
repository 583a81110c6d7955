// The web page: files that are linked into the program (cmake/web.cmake).
#include <optional>
#include <span>

#include "core/embedded.h"
#include "core/text.h"
#include "server/etag.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/routes/answers.h"

namespace farol {
std::span<const EmbeddedFile> webFiles();
}

namespace farol::server {
namespace {

// The page loads its own script, style and pictures and talks to its own server: nothing else.
constexpr const char* kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' "
    "blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors ";

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

/// `ancestors`: the pages that may show this one in a frame, as in frame-ancestors.
http::Response embeddedFile(const Call& call, const std::string& name, bool immutable,
                            const std::string& ancestors = "'none'") {
    refuseParameters(call);
    const auto plain = embedded(name);
    if (!plain || name.ends_with(".gz"))
        throw Error(message<"http.not-found/file">("name"_arg = name));
    const auto packed = embedded(name + ".gz");
    const bool unpacked = !packed || !call.request.header("accept-encoding") ||
                          acceptedQuality(call.request.header("accept-encoding"), "gzip") <= 0.0;
    const std::string_view bytes = unpacked ? *plain : *packed;
    http::Response response;
    const std::string tag = entityTag({bytes});
    response.set("ETag", tag);
    response.set("Content-Security-Policy", kPagePolicy + ancestors);
    if (packed) response.set("Vary", "Accept-Encoding");
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

}  // namespace

http::Response getPage(Context&, const Call& call) {
    return embeddedFile(call, embedded("index.html") ? "index.html" : "plain.html", false);
}

http::Response getEmbed(Context& context, const Call& call) {
    // Written into a header: the setting is an origin or "*" (SiteGuard). "null" is no frame's
    // ancestor.
    const std::string& origin = context.options.corsOrigin;
    const bool isNamed = !origin.empty() && origin != "null";
    return embeddedFile(call, embedded("embed.html") ? "embed.html" : "plain.html", false,
                        isNamed ? "'self' " + origin : "'self'");
}

http::Response getPlainPage(Context&, const Call& call) {
    return embeddedFile(call, "plain.html", false);
}

http::Response getOpenApi(Context& context, const Call& call) {
    const std::string& base = context.options.basePath;
    if (base.empty()) return embeddedFile(call, "openapi.yaml", false);
    refuseParameters(call);
    // Its example server gets the path, so that a reader's requests go where the service is.
    constexpr std::string_view kServer = "\n  - url: http://127.0.0.1:8080\n";
    std::string text(embedded("openapi.yaml").value_or(""));
    if (const std::size_t at = text.find(kServer); at != std::string::npos)
        text.insert(at + kServer.size() - 1, base);
    return tagged(call, std::move(text), typeOf("openapi.yaml"));
}

http::Response getAsset(Context&, const Call& call) {
    // All other names have a hash of the content in them.
    const bool isHashed =
        !call.parameter.starts_with("plain.") && !call.parameter.starts_with("document.");
    return embeddedFile(call, "assets/" + call.parameter, isHashed);
}

}  // namespace farol::server
