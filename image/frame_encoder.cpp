#include "image/frame_encoder.h"

#include <utility>

namespace farol::image {

FrameEncoder::FrameEncoder(AnimationWriter& animation)
    : animation_(animation), thread_([this] { run(); }) {}

FrameEncoder::~FrameEncoder() { end(); }

void FrameEncoder::add(Image frame) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return frames_.size() < kWaiting || failure_; });
    if (failure_) std::rethrow_exception(failure_);
    frames_.push_back(std::move(frame));
    changed_.notify_all();
}

void FrameEncoder::finish() {
    end();
    if (failure_) std::rethrow_exception(failure_);
}

void FrameEncoder::end() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        isLast_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void FrameEncoder::run() {
    for (;;) {
        Image frame;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return !frames_.empty() || isLast_; });
            if (frames_.empty()) return;
            frame = std::move(frames_.front());
            frames_.pop_front();
        }
        changed_.notify_all();
        try {
            animation_.add(frame);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            failure_ = std::current_exception();
            frames_.clear();
            changed_.notify_all();
            return;
        }
    }
}

}  // namespace farol::image
