#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "image/animation.h"

namespace farol::image {

/// Adds frames to an animation in their order, in another thread, at most kWaiting behind the
/// caller: the next frame is drawn meanwhile. The bytes are those of AnimationWriter::add.
class FrameEncoder {
  public:
    /// The animation must outlive the encoder.
    explicit FrameEncoder(AnimationWriter& animation);
    /// Waits for the frames that were added.
    ~FrameEncoder();
    FrameEncoder(const FrameEncoder&) = delete;
    FrameEncoder& operator=(const FrameEncoder&) = delete;

    /// Waits where kWaiting frames are not encoded yet. Throws the exception of an earlier frame.
    void add(Image frame);
    /// Waits for all frames. Throws the exception of one.
    void finish();

  private:
    static constexpr std::size_t kWaiting = 3;

    void end();
    void run();

    AnimationWriter& animation_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Image> frames_;
    std::exception_ptr failure_;
    bool isLast_ = false;
    std::thread thread_;
};

}  // namespace farol::image
