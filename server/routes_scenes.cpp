// The routes that tell of scenes and shapes without drawing them.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "generator/registry.h"
#include "scene/digest.h"
#include "scene/words.h"
#include "server/etag.h"
#include "server/json.h"
#include "server/problem.h"
#include "server/service.h"
#include "server/upload.h"

namespace farol::server {

using nlohmann::json;

namespace {

constexpr int kPageSize = 50;
constexpr std::size_t kMaxKnown = 2'000;

// The body with its tag, or 304.
http::Response tagged(const Call& call, std::string body, const std::string& type) {
    http::Response response;
    const std::string tag = entityTag({body});
    response.set("ETag", tag);
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        return response;
    }
    response.contentType = type;
    response.body = std::move(body);
    return response;
}

std::vector<std::string> splitWords(const std::string& text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text + ' ') {
        if (c != ' ' && c != ',') {
            word += c;
        } else if (!word.empty()) {
            words.push_back(std::move(word));
            word.clear();
        }
    }
    return words;
}

}  // namespace

ServedScene Service::sceneOf(const std::string& id) const {
    std::optional<ServedScene> scene;
    if (!store::isStoredId(id))
        scene = scenes_.find(id);
    else if (const auto stored = store_->get(id))
        scene = uploadOf(stored->entry);
    if (!scene) throw Error("http.not-found", "There is no scene " + scene::quoted(id) + " here.");
    return std::move(*scene);
}

render::Job Service::jobOfScene(ServedScene& scene) const {
    const auto goneAway = [&] {
        return Error("http.not-found", "The scene " + scene::quoted(scene.id) + " went away.");
    };
    if (scene.stored) {
        const auto stored = store_->get(scene.id);
        if (!stored) throw goneAway();
        return jobOf(stored->bundle, scene.id.substr(1));  // "~" and the digest
    }
    auto xml = scenes_.source(scene);
    if (!xml) throw goneAway();
    render::Job job;
    job.name = scene.fileName();
    job.xml = std::move(*xml);
    job.assets = scenes_.assets(scene);
    scene.document = scene::contentDigest(job.xml);  // of what was read, were it changed just now
    job.identity = entityTag({scene.document, scene.version});
    return job;
}

std::shared_ptr<const Service::Known> Service::known(const ServedScene& scene) {
    {
        const std::lock_guard lock(knownMutex_);
        const auto found = known_.find(scene.id);
        if (found != known_.end() && found->second->version == scene.version) return found->second;
    }
    auto fresh = std::make_shared<Known>();
    fresh->version = scene.version;
    try {
        ServedScene found = scene;
        fresh->report = backend_.inspect(jobOfScene(found)).result;
        fresh->report.elements = {};  // one for each copy: asked for seldom, and too much to keep
        fresh->report.copies = {};
    } catch (const Error& error) {
        fresh->errors = error.diagnostics();
    }
    remember(scene.id, fresh);
    return fresh;
}

void Service::remember(const std::string& id, std::shared_ptr<const Known> facts) {
    const std::lock_guard lock(knownMutex_);
    if (known_.size() >= kMaxKnown) known_.clear();
    known_[id] = std::move(facts);
}

// All words must be in the id, the title or the description.
bool Service::isFound(const ServedScene& scene, const std::string& words) {
    const auto facts = known(scene);
    const std::string text =
        scene::lowerCase(scene.id + "\n" + facts->report.title + "\n" + facts->report.description);
    const std::vector<std::string> all = splitWords(scene::lowerCase(words));
    return std::all_of(all.begin(), all.end(), [&](const std::string& word) {
        return text.find(word) != std::string::npos;
    });
}

http::Response Service::listScenes(const Call& call) {
    const Parameters wanted = readParameters(call.request.query, {false, false, {"page", "q"}, {}});
    std::vector<ServedScene> all = scenes_.list();
    for (const store::Entry& entry : store_->list()) all.push_back(uploadOf(entry));
    if (const std::string words = wanted.ownValue("q"); !words.empty())
        std::erase_if(all, [&](const ServedScene& one) { return !isFound(one, words); });
    const int pages = std::max(1, (static_cast<int>(all.size()) + kPageSize - 1) / kPageSize);
    const auto page = wholeNumber("page", wanted.ownValue("page", "1"), 1, pages);
    json scenes = json::array();
    const std::size_t first = static_cast<std::size_t>(page - 1) * kPageSize;
    for (std::size_t i = first; i < std::min(all.size(), first + kPageSize); ++i) {
        const auto facts = known(all[i]);
        json entry = describe(all[i], facts->report, facts->errors);
        if (facts->errors.empty())  // the whole list is at the scene's own address
            entry["diagnostics"] = toJson(notable(facts->report.diagnostics));
        scenes.push_back(std::move(entry));
    }
    const json body = {{"scenes", scenes}, {"page", page}, {"pages", pages}, {"total", all.size()}};
    return tagged(call, dump(body, 2) + "\n", "application/json");
}

http::Response Service::getScene(const Call& call) {
    readParameters(call.request.query, {});
    const ServedScene scene = sceneOf(call.parameter);
    const auto facts = known(scene);
    return tagged(call, dump(describe(scene, facts->report, facts->errors), 2) + "\n",
                  "application/json");
}

http::Response Service::getModels(const Call& call) {
    readParameters(call.request.query, {});
    ServedScene scene = sceneOf(call.parameter);
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, backend_.version(), "models"});
    };
    http::Response response;
    if (const std::string tag = tagOf(); matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        response.set("ETag", tag);
        return response;
    }
    const render::Job job = jobOfScene(scene);
    response.set("ETag", tagOf());
    response.contentType = "application/json";
    response.body = dump(modelsOf(backend_.inspect(job).result)) + "\n";
    return response;
}

http::Response Service::getSource(const Call& call) {
    readParameters(call.request.query, {});
    ServedScene scene = sceneOf(call.parameter);
    return tagged(call, jobOfScene(scene).xml, "application/xml");
}

http::Response Service::listPrimitives(const Call& call) {
    readParameters(call.request.query, {});
    json shapes = json::array();
    for (const generator::Shape& shape : generator::shapes()) {
        json arguments = json::array();
        for (const generator::Argument& one : shape.arguments)
            arguments.push_back({{"name", one.name},
                                 {"integer", one.integer},
                                 {"min", one.min},
                                 {"max", one.max},
                                 {"help", one.help}});
        shapes.push_back({{"name", shape.name},
                          {"summary", shape.summary},
                          {"required", shape.required},
                          {"takesFile", shape.takesFile},
                          {"arguments", arguments}});
    }
    return tagged(call, dump({{"shapes", shapes}}, 2) + "\n", "application/json");
}

http::Response Service::getPrimitive(const Call& call) {
    const Parameters wanted =
        readParameters(call.request.query, {false, false, {"args", "format"}, {}});
    if (generator::findShape(call.parameter) == nullptr)
        throw Error("http.not-found",
                    "There is no shape \"" + call.parameter + "\"; /v1/primitives lists them.");
    MeshJob job;
    job.words = splitWords(wanted.ownValue("args"));
    job.words.insert(job.words.begin(), call.parameter);
    job.format = wanted.ownValue("format", "3d");
    if (job.format != "3d" && job.format != "obj" && job.format != "ply")
        throw Error("option.range", "format must be 3d, obj or ply, not \"" + job.format + "\"", {},
                    "format");
    std::string key;
    for (const std::string& word : job.words) key.append(word).append("\n");
    const std::string tag = entityTag({key, job.format, backend_.version()});
    http::Response response;
    response.set("ETag", tag);
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        return response;
    }
    try {
        Done<std::string> done = backend_.mesh(job);
        response.body = std::move(done.result);
        response.logged.emplace_back("queueMs", std::to_string(done.queueMs));
    } catch (const Error& error) {
        if (error.code() != "shape.argument") throw;
        // The arguments came as a parameter: the request's fault, not a document's.
        Diagnostics found = error.diagnostics();
        for (Diagnostic& one : found)
            if (one.field.empty()) one.field = "args";
        return problemResponse({400, error.code(), error.primary().message, found, {}},
                               call.request.id);
    }
    response.contentType = job.format == "obj" ? "model/obj" : "application/octet-stream";
    if (job.format == "3d") response.contentType = "text/plain; charset=utf-8";
    response.set("Content-Disposition",
                 "attachment; filename=\"" + job.words.front() + "." + job.format + "\"");
    return response;
}

}  // namespace farol::server
