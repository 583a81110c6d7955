#pragma once

#include <any>
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client.h"
#include "server/http/listener.h"
#include "server/log.h"
#include "server/service.h"
#include "worker/backend.h"

namespace farol::test {

/// Stands in for the renderer where a test is about HTTP: its answers are plain and it can be
/// set to be busy, broken or slow. Requests reach it packed, as they reach a worker.
class FakeBackend final : public worker::Backend {
  public:
    FakeBackend();

    std::function<render::Picture(const render::Job&)> onRender;
    std::function<render::SceneReport(const render::Job&)> onInspect;
    std::function<void()> onCheck;
    std::atomic<int> renders{0}, inspections{0};
    std::string name = "fake 1";

    /// Does all jobs of one kind, in the place of what did them before.
    template <worker::Task T>
    void on(std::function<typename T::Reply(const typename T::Request&)> work) {
        tasks_[T::kName] = [work = std::move(work)](worker::Unpacker& unpacker) -> std::any {
            typename T::Request request;
            unpacker(request);
            unpacker.end();
            return work(request);
        };
    }

    void expectRoom(const worker::RunOptions&) const override {}
    worker::BackendState state() const override { return {1, 0, 0, {}, 0, 0, 0, {}}; }
    std::string version() const override { return name; }

  protected:
    worker::Done<std::any> submit(worker::PackedJob job, const worker::RunOptions&) override;

  private:
    std::map<std::string, std::function<std::any(worker::Unpacker&)>> tasks_;
};

/// The service on a separate socket, as `farol serve` composes it; it is served at once.
class TestServer {
  public:
    /// `backend` outlives it. Throws as the listener and the service do.
    explicit TestServer(
        worker::Backend& backend, server::ServiceOptions options = {},
        const server::http::ListenOptions& listen = anywhere(),
        server::Logger::Sink log = [](const std::string&) {});
    ~TestServer();
    /// A free port of 127.0.0.1, eight threads.
    static server::http::ListenOptions anywhere();

    void drain();
    void stop();
    int port() const { return listener_.port(); }
    const server::Router& router() const { return service_.router(); }

  private:
    static server::ServiceOptions withStore(server::ServiceOptions options);

    server::Logger logger_;
    server::Service service_;
    server::http::Listener listener_;
};

/// A server with the fake behind it on a free port of 127.0.0.1; its log lines are kept.
class FakeServer {
  public:
    explicit FakeServer(server::ServiceOptions service = {},
                        std::function<void(server::http::ListenOptions&)> tune = nullptr);
    int port() const { return server_->port(); }
    void stop() { server_->stop(); }
    void drain() { server_->drain(); }
    const server::Router& router() const { return server_->router(); }
    std::vector<std::string> log() const;

    FakeBackend backend;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> log_;
    std::unique_ptr<TestServer> server_;
};

/// A separate folder under the tests' output, removed first and last.
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const std::string& name);
    ~TemporaryFolder();
    const std::string& path() const { return path_; }
    void write(const std::string& file, const std::string& content) const;

  private:
    std::string path_;
};

}  // namespace farol::test
