#include "server/catalogue.h"

#include <new>
#include <system_error>

#include "core/digest.h"
#include "core/text.h"
#include "server/etag.h"
#include "server/messages.h"
#include "server/request/upload.h"
#include "worker/tasks/inspect.h"

namespace farol::server {
namespace {

constexpr std::size_t kMaxKnown = 2'000;
// Expiry of the facts about a scene whose worker ended or failed: then it is inspected again.
constexpr std::chrono::seconds kKeepFailure{60};

void forgetElements(render::SceneReport& report) {
    report.elements = {};
    report.copies = {};
}

}  // namespace

Catalogue::Catalogue(const std::string& folder, store::SceneStore& store, worker::Backend& backend,
                     Logger& logger)
    : folder_(folder), store_(store), backend_(backend), logger_(logger) {
    if (const std::string fault = folder_.watchFault(); !fault.empty())
        logger_.event("scenes", "the folder cannot be watched: " + fault +
                                    ": every request looks at its files, which costs time");
}

ServedScene Catalogue::find(const std::string& id) const {
    std::optional<ServedScene> scene;
    if (!store::isStoredId(id))
        scene = folder_.find(id);
    else if (const auto stored = store_.get(id))
        scene = uploadOf(stored->entry);
    if (!scene) throw Error(message<"http.not-found/scene">("name"_arg = id));
    return std::move(*scene);
}

render::Job Catalogue::jobOf(ServedScene& scene) const {
    const auto goneAway = [&] {
        return Error(message<"http.not-found/scene">("name"_arg = scene.id));
    };
    if (scene.stored) {
        const auto stored = store_.get(scene.id);
        if (!stored) throw goneAway();
        return server::jobOf(stored->bundle,
                             scene.id.substr(1));  // "~" and the digest
    }
    auto xml = folder_.source(scene);
    if (!xml) throw goneAway();
    render::Job job;
    job.name = scene.fileName();
    job.xml = std::move(*xml);
    job.assets = folder_.assets(scene);
    scene.document = contentDigest(job.xml);  // of the bytes read: the file may have changed
    job.identity = entityTag({scene.document, scene.version});
    return job;
}

std::vector<ServedScene> Catalogue::list() const {
    std::vector<ServedScene> all = folder_.list();
    for (const store::Entry& entry : store_.list()) all.push_back(uploadOf(entry));
    return all;
}

std::shared_ptr<const Catalogue::Known> Catalogue::known(const ServedScene& scene) {
    {
        const std::lock_guard lock(mutex_);
        const auto found = known_.find(scene.id);
        if (found != known_.end() && found->second->version == scene.version &&
            std::chrono::steady_clock::now() < found->second->until)
            return found->second;
    }
    auto fresh = std::make_shared<Known>();
    fresh->version = scene.version;
    inspectInto(*fresh, scene);
    keep(scene.id, fresh);
    return fresh;
}

// Errors of a scene, and of its worker, are stored as facts: they do not affect other scenes.
void Catalogue::inspectInto(Known& facts, const ServedScene& scene) const {
    const auto failed = [&](Diagnostic fault) {
        fault.where.file = scene.path;
        facts.errors = {std::move(fault)};
        facts.until = std::chrono::steady_clock::now() + kKeepFailure;
    };
    try {
        if (!isUtf8(scene.id)) throw Error(message<"asset.name">(), {scene.path, 0, 0});
        ServedScene found = scene;
        facts.report = backend_.run<worker::InspectTask>({jobOf(found)}).result;
        forgetElements(facts.report);
    } catch (const Error& error) {
        facts.errors = error.diagnostics();
        if (error.code() == "limit.memory")
            facts.until = std::chrono::steady_clock::now() + kKeepFailure;
    } catch (const worker::Busy& busy) {
        const bool isOfScene = busy.code().starts_with("worker.") ||
                               busy.code() == "busy.deadline" || busy.code() == "store.failed";
        if (!isOfScene) throw;
        failed(busy.diagnostic());
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::system_error&) {
        throw;
    } catch (const std::exception& fault) {
        logger_.event("internal-error", scene.id + ": " + fault.what());
        failed(diagnosticOf(Severity::error, message<"internal">()));
    }
}

std::shared_ptr<const Catalogue::Known> Catalogue::remember(const std::string& id,
                                                            const std::string& version,
                                                            render::SceneReport report) {
    auto facts = std::make_shared<Known>();
    facts->version = version;
    facts->report = std::move(report);
    forgetElements(facts->report);
    keep(id, facts);
    return facts;
}

void Catalogue::keep(const std::string& id, std::shared_ptr<const Known> facts) {
    const std::lock_guard lock(mutex_);
    if (known_.size() >= kMaxKnown) known_.clear();
    known_[id] = std::move(facts);
}

}  // namespace farol::server
