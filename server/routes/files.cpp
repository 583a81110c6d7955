// The files of a scene, for clients that show, change or save them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "server/http/uri.h"
#include "server/json.h"
#include "server/messages.h"
#include "server/request/parameters.h"
#include "server/request/problem.h"
#include "server/routes/answers.h"

namespace farol::server {
namespace {

/// The paths of a scene's files, its document first. Of a scene in the served folder only the files
/// that it names: others beside it may be no part of it.
std::vector<std::string> filesOf(const ServedScene& scene, const render::Job& job) {
    if (!scene.stored) return scene::filesNamedBy(*job.assets, job.name);
    std::vector<std::string> paths = job.assets->list();
    const auto main = std::find(paths.begin(), paths.end(), job.name);
    if (main != paths.end()) std::rotate(paths.begin(), main, main + 1);
    return paths;
}

}  // namespace

http::Response listFiles(Context& context, const Call& call) {
    refuseParameters(call);
    ServedScene scene = context.scenes.find(call.parameter);
    const render::Job job = context.scenes.jobOf(scene);
    nlohmann::json files = nlohmann::json::array();
    for (const std::string& path : filesOf(scene, job))
        files.push_back({{"path", path}, {"bytes", job.assets->size(path).value_or(0)}});
    return tagged(call, dump({{"main", job.name}, {"files", files}}) + "\n", "application/json");
}

http::Response getFile(Context& context, const Call& call) {
    const Parameters wanted = readParameters(call.request.query, {false, false, {"path"}, {}});
    const std::string path = wanted.ownValue("path");
    ServedScene scene = context.scenes.find(call.parameter);
    const render::Job job = context.scenes.jobOf(scene);
    const std::vector<std::string> known = filesOf(scene, job);
    std::optional<std::string> content;
    if (std::find(known.begin(), known.end(), path) != known.end())
        content = job.assets->read(path);
    if (!content) throw Error(message<"http.not-found/file">("name"_arg = path));
    http::Response response = tagged(call, std::move(*content), "application/octet-stream");
    // A file of a stranger: the browser saves it, and never shows it as a page of this server.
    response.set("Content-Disposition",
                 "attachment; filename*=UTF-8''" + http::percentEncodePath(baseName(path)));
    response.set("Content-Security-Policy", "sandbox");
    return response;
}

}  // namespace farol::server
