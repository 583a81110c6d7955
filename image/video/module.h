#pragma once

#include <cstddef>
#include <cstdint>

/// The module that links libavcodec, libavformat and libswscale: it is built with FAROL_VIDEO
/// alone, since Debian's libraries bring x264, whose licence is the GPL. It is loaded for the first
/// video.
namespace farol::image {

/// Settings of a video. All frames have one size and follow at a constant rate.
struct VideoSettings {
    const char* container;  ///< libavformat's name: "mp4", "webm"
    const char* encoder;    ///< libavcodec's name: "libx264", "libvpx-vp9"
    double fps;
    int quality;  ///< 1..100
};

/// The functions of the module. Texts last until the next call in the same thread.
struct VideoModule {
    /// Returns a video, or null and why.
    void* (*open)(const VideoSettings& settings, const char** why);
    /// Adds a frame: RGBA, top row first, straight alpha; it is shown on black. Returns null, or
    /// why it cannot be added.
    const char* (*add)(void* video, const std::uint8_t* pixels, int width, int height);
    /// Ends the video. Returns null, or why not; `bytes` last as long as the video.
    const char* (*finish)(void* video, const char** bytes, std::size_t* size);
    void (*close)(void* video);
};

/// The module's one function, by this name.
using GetVideoModule = const VideoModule* (*)();
inline constexpr const char* kVideoFunction = "farol_video";

}  // namespace farol::image
