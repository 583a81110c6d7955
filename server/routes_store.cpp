// The routes that change the store of uploads.
#include <nlohmann/json.hpp>

#include "scene/digest.h"
#include "scene/words.h"
#include "server/http/text.h"
#include "server/http/uri.h"
#include "server/json.h"
#include "server/problem.h"
#include "server/service.h"
#include "server/upload.h"

namespace farol::server {
namespace {

constexpr std::chrono::seconds kSweep{60};

// Digests are compared, so that the time taken tells nothing of where the texts differ.
bool sameSecret(const std::string& a, const std::string& b) {
    return scene::contentDigest(a) == scene::contentDigest(b);
}

std::optional<std::string> bearerOf(const http::Request& request) {
    const auto header = request.header("authorization");
    if (!header) return std::nullopt;
    const std::size_t space = header->find(' ');
    if (space == std::string::npos || !scene::sameWord(header->substr(0, space), "bearer"))
        return std::nullopt;
    return std::string(http::trim(std::string_view(*header).substr(space)));
}

// The document of the upload in the place of the job's own, beside the job's files.
Upload onFilesOf(render::Job base, const Upload& document) {
    Upload out;
    out.optionsJson = document.optionsJson;
    out.job = std::move(base);
    out.job.xml = document.job.xml;
    out.job.identity = scene::contentDigest(out.job.identity + "\n" + document.job.identity);
    return out;
}

// What a job needs, copied to be kept.
scene::Bundle bundleOf(const render::Job& job) {
    scene::Bundle bundle{job.name, {{job.name, job.xml}}};
    for (const std::string& path : job.assets->list()) {
        if (path == job.name) continue;
        if (auto bytes = job.assets->read(path)) bundle.files[path] = std::move(*bytes);
        if (bundle.files.size() > scene::kMaxBundleFiles || bundle.bytes() > scene::kMaxBundleBytes)
            throw Error("limit.bundle",
                        "The scene's folder holds more than 256 files or 64 MiB: send the scene "
                        "with the files that it needs.");
    }
    return bundle;
}

}  // namespace

void Service::authorize(const http::Request& request) const {
    if (options_.token.empty()) return;
    const auto given = bearerOf(request);
    if (!given || !sameSecret(*given, options_.token))
        throw Error("http.unauthorized", given ? "The token is not the right one."
                                               : "This needs \"Authorization: Bearer TOKEN\".");
}

Upload Service::takeUpload(const Call& call, const std::string& base) const {
    Upload upload = readUpload(call.request, call.body, options_.maxBodyBytes);
    if (base.empty()) return upload;
    if (!upload.bundle || upload.bundle->files.size() != 1)
        throw Error("option.range", "base= is for a document that comes alone, without files.", {},
                    "base");
    ServedScene scene = sceneOf(base);
    return onFilesOf(jobOfScene(scene), upload);
}

http::Response Service::postScene(const Call& call) {
    const Parameters wanted =
        readParameters(call.request.query, {false, true, {"public", "base"}, {}});
    const bool listed = wholeNumber("public", wanted.ownValue("public", "0"), 0, 1) == 1;
    Upload upload = takeUpload(call, wanted.ownValue("base"));
    // Options are of a picture, not of a scene: they are looked at, and left.
    readParameters({}, {true, true, {}, {}}, upload.optionsJson);
    if (!upload.job.archive.empty())
        upload.bundle =
            std::make_shared<const scene::Bundle>(backend_.unpack(upload.job.archive).result);
    if (!upload.bundle) upload.bundle = std::make_shared<const scene::Bundle>(bundleOf(upload.job));
    render::Job job = jobOf(upload.bundle);
    job.strict = wanted.strict;
    const auto facts = std::make_shared<Known>();
    facts->report = backend_.inspect(job).result;  // a scene that cannot be drawn is not kept
    facts->report.elements = {};
    facts->report.copies = {};
    const store::SceneStore::Put kept = store_->put(*upload.bundle, listed);
    facts->version = kept.entry.id;
    remember(kept.entry.id, facts);
    http::Response response;
    response.status = kept.created ? 201 : 200;
    response.contentType = "application/json";
    response.body = dump(describe(uploadOf(kept.entry), facts->report, {}), 2) + "\n";
    response.set("Location", "/v1/scenes/" + http::percentEncodePath(kept.entry.id));
    response.set("Cache-Control", "no-store");
    response.logged.emplace_back("scene", kept.entry.id);
    return response;
}

http::Response Service::deleteScene(const Call& call) {
    readParameters(call.request.query, {});
    if (!store::isStoredId(call.parameter)) {
        sceneOf(call.parameter);  // or it is a 404
        return problemResponse({405,
                                "http.method",
                                "The scenes of the served folder cannot be deleted.",
                                {},
                                {{"Allow", "GET, HEAD, OPTIONS"}}},
                               call.request.id);
    }
    if (!store_->remove(call.parameter))
        throw Error("http.not-found",
                    "There is no scene " + scene::quoted(call.parameter) + " here.");
    http::Response response;
    response.status = 204;
    return response;
}

void Service::sweep() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    auto last = swept_.load();
    const auto pause = std::chrono::duration_cast<std::chrono::steady_clock::duration>(kSweep);
    if (now - last < pause.count() || !swept_.compare_exchange_strong(last, now)) return;
    if (const std::size_t gone = store_->expire(); gone > 0)
        logger_.event("expired", std::to_string(gone) + " scenes");
}

}  // namespace farol::server
