// The scenes that are served, without drawing them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "server/etag.h"
#include "server/json.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "server/request/problem.h"
#include "server/routes/answers.h"
#include "worker/tasks/inspect.h"

namespace farol::server {

using nlohmann::json;

namespace {

constexpr int kPageSize = 50;

/// All words must be in the id, the title or the description.
bool isFound(Catalogue& scenes, const ServedScene& scene, const std::string& words) {
    const auto facts = scenes.known(scene);
    const std::string text =
        lowerCase(scene.id + "\n" + facts->report.title + "\n" + facts->report.description);
    const std::string lower = lowerCase(words);
    const std::vector<std::string_view> all = split(lower, " ,");
    return std::all_of(all.begin(), all.end(),
                       [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

}  // namespace

http::Response listScenes(Context& context, const Call& call) {
    const Parameters wanted = readParameters(call.request.query, {false, false, {"page", "q"}, {}});
    std::vector<ServedScene> all = context.scenes.list();
    if (const std::string words = wanted.ownValue("q"); !words.empty())
        std::erase_if(all,
                      [&](const ServedScene& one) { return !isFound(context.scenes, one, words); });
    const int pages = std::max(1, (static_cast<int>(all.size()) + kPageSize - 1) / kPageSize);
    const auto page = wholeNumber("page", wanted.ownValue("page", "1"), 1, pages);
    const Language language = languageOf(call.request);
    json scenes = json::array();
    const std::size_t first = static_cast<std::size_t>(page - 1) * kPageSize;
    for (std::size_t i = first; i < std::min(all.size(), first + kPageSize); ++i) {
        const auto facts = context.scenes.known(all[i]);
        json entry =
            describe(all[i], facts->report, facts->errors, context.options.basePath, language);
        if (facts->errors.empty())  // the whole list is at the scene's own address
            setDiagnostics(entry, "diagnostics", notable(facts->report.diagnostics), language);
        scenes.push_back(std::move(entry));
    }
    const json body = {{"scenes", scenes}, {"page", page}, {"pages", pages}, {"total", all.size()}};
    return taggedJson(call, body, language);
}

http::Response getScene(Context& context, const Call& call) {
    refuseParameters(call);
    const ServedScene scene = context.scenes.find(call.parameter);
    const auto facts = context.scenes.known(scene);
    const Language language = languageOf(call.request);
    return taggedJson(
        call, describe(scene, facts->report, facts->errors, context.options.basePath, language),
        language);
}

http::Response getModels(Context& context, const Call& call) {
    refuseParameters(call);
    ServedScene scene = context.scenes.find(call.parameter);
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, context.backend.version(), "models"});
    };
    http::Response response;
    if (const std::string tag = tagOf(); matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        response.set("ETag", tag);
        return response;
    }
    const render::Job job = context.scenes.jobOf(scene);
    response.set("ETag", tagOf());
    response.contentType = "application/json";
    response.body = dump(modelsOf(context.backend.run<worker::InspectTask>({job}).result)) + "\n";
    return response;
}

http::Response getSource(Context& context, const Call& call) {
    refuseParameters(call);
    ServedScene scene = context.scenes.find(call.parameter);
    return tagged(call, context.scenes.jobOf(scene).xml, "application/xml");
}

}  // namespace farol::server
