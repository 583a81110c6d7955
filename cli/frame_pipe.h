#pragma once

#include <optional>

#include "image/animation.h"

/// Frames between the processes that draw one animation.
namespace farol::cli {

/// Sends the frames that are added to it over a socket. Throws std::runtime_error where the
/// receiver has ended.
class FrameSender final : public image::AnimationWriter {
  public:
    FrameSender(int frames, int socket) : AnimationWriter({frames}), socket_(socket) {}

  private:
    void append(const image::Image& frame) override;
    std::string end() override { return ""; }

    const int socket_;
};

/// Waits for the next frame of a sender. Returns nothing where it ended before all of the frame
/// arrived.
std::optional<image::Image> receiveFrame(int descriptor);

}  // namespace farol::cli
