#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "client.h"
#include "server/server.h"

namespace farol::test {

/// Stands in for the renderer where a test is about HTTP: its answers are plain and it can be
/// told to be busy, broken or slow.
class FakeBackend final : public server::Backend {
  public:
    std::function<render::Picture(const render::Job&)> onRender;
    std::function<render::SceneReport(const render::Job&)> onInspect;
    std::function<void()> onCheck;
    std::atomic<int> renders{0}, inspections{0};
    std::string name = "fake 1";

    void expectRoom(const std::string&, const server::Turn&) const override {}
    server::Done<render::Picture> render(const render::Job& job, const std::string& tag,
                                         const server::Turn& turn) override;
    server::Done<render::SceneReport> inspect(const render::Job& job) override;
    server::Done<std::string> mesh(const server::MeshJob& job) override;
    server::Done<render::Picture> turntable(const render::Job& job,
                                            const server::Turntable& turn) override;
    server::Done<render::Picture> notice(const std::string& text,
                                         const render::PictureOptions& options) override;
    server::Done<scene::Bundle> unpack(const std::string& archive) override;
    server::Done<server::GradeReply> grade(const server::GradeJob& job) override;
    server::Done<server::CompareReply> compare(const server::CompareJob& job) override;
    void check() override;
    server::BackendState state() const override { return {1, 0, 0, {}, 0, 0, 0}; }
    std::string version() const override { return name; }
};

/// A server with the fake behind it on a free port of 127.0.0.1; its log lines are kept.
class FakeServer {
  public:
    explicit FakeServer(server::ServiceOptions service = {},
                        std::function<void(server::http::ListenOptions&)> tune = nullptr);
    int port() const { return server_->port(); }
    void stop() { server_->stop(); }
    const server::Router& router() const { return server_->router(); }
    std::vector<std::string> log() const;

    FakeBackend backend;

  private:
    mutable std::mutex mutex_;
    std::vector<std::string> log_;
    std::unique_ptr<server::Server> server_;
};

/// A folder of its own under the tests' output, removed first and last.
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
