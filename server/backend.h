#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "render/renderer.h"

/// The narrow door between the service and whatever draws. A job is a plain function of bytes and
/// options, so what stands behind the door may be threads, processes or another machine.
namespace farol::server {

/// The work cannot be taken or did not end in time; the client may try again.
class Busy : public std::runtime_error {
  public:
    Busy(std::string code, const std::string& message, int retryAfterS)
        : std::runtime_error(message), code_(std::move(code)), retryAfterS_(retryAfterS) {}
    const std::string& code() const { return code_; }  ///< busy.queue, busy.deadline, busy.draining
    int retryAfterS() const { return retryAfterS_; }

  private:
    std::string code_;
    int retryAfterS_;
};

/// A shape to generate and the file format to write it in ("3d", "obj", "ply").
struct MeshJob {
    std::vector<std::string> words;  ///< {"cone", "1", "2", "4", "3"}
    std::string format;
};

template <typename Result>
struct Done {
    Result result;
    double queueMs = 0;  ///< time waited for a worker
};

/// Where a backend stands, for readiness and metrics.
struct BackendState {
    int workers = 0, busy = 0, queued = 0;
};

/// All calls block until done, may come from many threads at once, and throw farol::Error for the
/// caller's fault and Busy when over capacity; anything else is a fault of ours.
class Backend {
  public:
    virtual ~Backend() = default;
    virtual Done<render::Picture> render(const render::Job& job) = 0;
    virtual Done<render::SceneReport> inspect(const render::Job& job) = 0;
    virtual Done<std::string> mesh(const MeshJob& job) = 0;
    /// Draws a tiny known scene and checks its pixels. Throws std::runtime_error with the reason
    /// when they are wrong.
    virtual void check() = 0;
    virtual BackendState state() const = 0;
    /// What draws, for /version and ETags.
    virtual std::string version() const = 0;
};

}  // namespace farol::server
