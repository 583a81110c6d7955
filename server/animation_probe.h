#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace farol::server {

/// Finds the formats of animations that workers can write, in a child process: FFmpeg's libraries
/// stay out of the service.
class AnimationProbe {
  public:
    /// Starts the child. Make it before other threads are started.
    AnimationProbe();
    ~AnimationProbe();
    AnimationProbe(const AnimationProbe&) = delete;
    AnimationProbe& operator=(const AnimationProbe&) = delete;

    /// Waits for the child. Returns names of image::kAnimations; those without a module where the
    /// child crashes or takes longer than ten seconds.
    std::vector<std::string> names();

  private:
    pid_t child_ = -1;
    int pipe_ = -1;
};

}  // namespace farol::server
