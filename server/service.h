#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/backend.h"
#include "server/http/message.h"
#include "server/http/traffic.h"
#include "server/log.h"
#include "server/metrics.h"
#include "server/parameters.h"
#include "server/picture_cache.h"
#include "server/rate_limiter.h"
#include "server/router.h"
#include "server/scenes.h"
#include "server/store/scene_store.h"
#include "server/upload.h"

namespace farol::server {

struct ServiceOptions {
    std::string scenesDir;  ///< empty: no scenes are served
    std::size_t maxBodyBytes = 16U << 20;
    std::size_t cacheBytes = std::size_t{64} << 20U;  ///< of pictures kept; 0: none
    RateLimit rate;
    std::string corsOrigin;                    ///< Access-Control-Allow-Origin; empty: not sent
    std::shared_ptr<store::SceneStore> store;  ///< of uploads; null: a small one in memory
    std::string token;                         ///< that writing to the store needs; empty: none
};

/// The REST interface (docs/http.md): what the routes do, without sockets and without GL.
class Service final : public http::Handler {
  public:
    Service(ServiceOptions options, Backend& backend, Logger& logger);

    std::size_t bodyLimit(const http::Request& request) const override;
    http::Response handle(const http::Request& request, http::Body& body) override;
    http::Response refuse(const http::Request& request, int status, const std::string& code,
                          const std::string& message) override;
    void finished(const http::Request& request, const http::Response& response, double milliseconds,
                  bool sent) override;

    /// Readiness turns false; requests are still answered.
    void drain() { draining_ = true; }
    /// Where the metrics learn of connections. Call it before the first request.
    void watch(std::function<http::Traffic()> traffic) { traffic_ = std::move(traffic); }
    const Router& router() const { return router_; }

  private:
    /// What is known of a served scene without drawing it, or why it cannot be read.
    struct Known {
        std::string version;
        render::SceneReport report;
        Diagnostics errors;
    };

    std::vector<Route> routes();
    http::Response file(const Call& call, const std::string& name, bool immutable);
    http::Response getPage(const Call& call);
    http::Response getAsset(const Call& call);
    http::Response livez(const Call& call);
    http::Response readyz(const Call& call);
    http::Response version(const Call& call);
    http::Response metrics(const Call& call);
    http::Response drawn(Done<render::Picture> done);
    http::Response postRender(const Call& call);
    http::Response postValidate(const Call& call);
    http::Response postGrade(const Call& call);
    http::Response postCompare(const Call& call);
    http::Response listScenes(const Call& call);
    http::Response postScene(const Call& call);
    http::Response deleteScene(const Call& call);
    http::Response getScene(const Call& call);
    http::Response getSource(const Call& call);
    http::Response getModels(const Call& call);
    http::Response getTurntable(const Call& call);
    http::Response getImage(const Call& call, const http::Fields& preset);
    http::Response listPrimitives(const Call& call);
    http::Response getPrimitive(const Call& call);

    ServedScene sceneOf(const std::string& id) const;
    /// The scene is told of the document that was read: its tag is then of what is drawn, also if
    /// the file changed since it was looked for.
    render::Job jobOfScene(ServedScene& scene) const;
    Upload takeUpload(const Call& call, const std::string& base) const;
    void authorize(const http::Request& request) const;
    bool isFound(const ServedScene& scene, const std::string& words);
    std::shared_ptr<const Known> known(const ServedScene& scene);
    void remember(const std::string& id, std::shared_ptr<const Known> facts);
    /// The problem as a picture, where the request wants that and a worker can draw it.
    void drawProblem(const http::Request& request, http::Response& response);
    void finish(const http::Request& request, http::Response& response) const;
    void sweep();

    const ServiceOptions options_;
    const std::shared_ptr<store::SceneStore> store_;
    std::atomic<std::chrono::steady_clock::rep> swept_{0};  ///< when the store last expired scenes
    Backend& backend_;
    Logger& logger_;
    std::function<http::Traffic()> traffic_;
    Metrics metrics_;
    PictureCache pictures_;
    RateLimiter limiter_;
    SceneFolder scenes_;
    Router router_;
    std::atomic<bool> draining_{false};
    std::mutex knownMutex_;
    std::map<std::string, std::shared_ptr<const Known>> known_;  ///< by id; bounded
};

}  // namespace farol::server
