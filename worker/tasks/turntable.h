#pragma once

#include <optional>

#include "image/animation.h"
#include "worker/reply_check.h"

namespace farol::worker {

inline constexpr const char* kFrameBoundary = "farol-frame";
inline constexpr int kMaxTurnFrames = 120;
/// Of all frames of a turntable together.
inline constexpr std::int64_t kMaxTurnPixels = 33'554'432;

/// Throws Error option.range where that many frames of these options have more pixels than allowed;
/// sides that are not known count as 1.
void checkTurnPixels(int frames, const render::PictureOptions& options);

/// Renders a turntable, or one loop of the scene's motions. Ends early where the job is cancelled.
struct TurntableTask : TaskTraits {
    static constexpr const char* kName = "turntable";
    struct Request {
        render::Job job;
        /// The eye moves once around the target, starting at the job's camera; else the time goes
        /// once through the scene's time range or loop, from its begin plus the job's time.
        bool isCameraTurning = true;
        int frames = 24;    ///< 2 to kMaxTurnFrames; 0: of the loop, as many as it has at `fps`
        double fps = 12.0;  ///< 1 to 60; 0: of the loop, that of real time, 0.01 to 60
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
