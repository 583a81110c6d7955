#pragma once

#include <memory>
#include <thread>
#include <vector>

#include "server/backend.h"
#include "server/queue.h"

namespace farol::server {

/// Draws in threads of this process, each with a Renderer (a GL context) of its own that it
/// makes when first needed. One thread is the default: llvmpipe's rasteriser is shared by the
/// threads of a process, so more of them gain little.
class RenderBackend final : public Backend {
  public:
    RenderBackend(int workers, QueueLimits limits);
    ~RenderBackend() override;

    Done<render::Picture> render(const render::Job& job) override;
    Done<render::SceneReport> inspect(const render::Job& job) override;
    Done<std::string> mesh(const MeshJob& job) override;
    void check() override;
    BackendState state() const override;
    std::string version() const override;

    /// Refuses new jobs (Busy) and waits for those being worked on.
    void stop();

  private:
    struct Worker {
        std::unique_ptr<render::Renderer> renderer;
        render::Renderer& ready();  ///< throws std::runtime_error when there is no GL
    };

    JobQueue<Worker> queue_;
    int workers_;
    std::vector<std::thread> threads_;
};

/// The largest mesh that is sent to a client, in triangles: the file is held in memory.
inline constexpr std::size_t kMaxMeshTriangles = 250'000;

}  // namespace farol::server
