#pragma once

#include <optional>

#include "image/animation.h"
#include "worker/reply_check.h"

namespace farol::worker {

inline constexpr const char* kFrameBoundary = "farol-frame";

/// Renders a turntable: the eye moves once around the target, starting at the job's camera.
struct TurntableTask : TaskTraits {
    static constexpr const char* kName = "turntable";
    struct Request {
        render::Job job;
        int frames = 24;
        double fps = 12.0;
        /// One animation; empty: multipart/x-mixed-replace, parts between kFrameBoundary.
        std::optional<image::AnimationFormat> animation;
    };
    using Reply = render::Picture;  ///< all frames in one body; facts and times of the first
    struct Bounds : ImageBounds {
        std::optional<image::AnimationFormat> animation;
    };

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request& request);
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
