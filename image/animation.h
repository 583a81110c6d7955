#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace farol::image {

/// Settings of an animation. Frames follow at a constant rate, and the animation loops for ever.
struct AnimationSettings {
    int frames = 1;         ///< at least 1
    double fps = 12.0;      ///< over 0, at most 1000
    bool hasAlpha = false;  ///< keep transparency
    int quality = 90;       ///< of lossy formats, 1..100
};

/// Writes one animation.
class AnimationWriter {
  public:
    explicit AnimationWriter(const AnimationSettings& settings) : settings_(settings) {}
    virtual ~AnimationWriter() = default;
    AnimationWriter(const AnimationWriter&) = delete;
    AnimationWriter& operator=(const AnimationWriter&) = delete;

    /// Throws std::invalid_argument when the size differs from the first frame's or there are more
    /// frames than announced.
    void add(const Image& frame) {
        if (added_ == settings_.frames) throw std::invalid_argument("more frames than announced");
        if (added_ > 0 && (frame.width != width_ || frame.height != height_))
            throw std::invalid_argument("the frames differ in size");
        width_ = frame.width;
        height_ = frame.height;
        append(frame);
        ++added_;
    }
    /// Returns the file. Throws std::logic_error when frames are missing.
    std::string finish() {
        if (added_ != settings_.frames) throw std::logic_error("frames are missing");
        return end();
    }

  protected:
    virtual void append(const Image& frame) = 0;
    virtual std::string end() = 0;

    const AnimationSettings settings_;
    int added_ = 0;               ///< frames before the one that is appended
    int width_ = 0, height_ = 0;  ///< px
};

/// Animated PNG (PNG specification, 3rd edition, section 11.3.6); viewers without animation show
/// the first frame.
std::unique_ptr<AnimationWriter> writeApng(const AnimationSettings& settings);
/// Lossy animated WebP with alpha (libwebpmux). Times are whole ms, without drift.
std::unique_ptr<AnimationWriter> writeAnimatedWebp(const AnimationSettings& settings);
/// GIF89a of at most 256 colours a frame: its own where it has no more, else giflib's median cut of
/// five bits a channel; alpha is on or off. Times are whole
/// 1/100 s, without drift, at least 2/100 s, since browsers slow down shorter ones.
std::unique_ptr<AnimationWriter> writeGif(const AnimationSettings& settings);

/// H.264 in MP4 and VP9 in WebM, on black, by the module of FFmpeg's libraries (image/video/).
/// A frame of odd size has one more column or row, a copy of its last. Throw Error
/// option.unavailable where the module is not installed.
std::unique_ptr<AnimationWriter> writeMp4(const AnimationSettings& settings);
std::unique_ptr<AnimationWriter> writeWebm(const AnimationSettings& settings);

enum class AnimationFormat { apng, webp, gif, mp4, webm };

struct AnimationSpec {
    std::string_view name;     ///< as parameters write it
    std::string_view mime;     ///< media type
    std::string_view endings;  ///< of file names, blank-separated
    /// First bytes of every file; '?' is any byte.
    std::string_view signature;
    /// Upper bound of a frame's size without its head, used to check replies of workers.
    double maxBytesPerPixel;
    bool needsModule;  ///< needs the video module, which is not in every installation
    std::unique_ptr<AnimationWriter> (*write)(const AnimationSettings& settings);
};

/// The table of formats of animations, in the order of AnimationFormat.
inline constexpr std::array kAnimations{
    AnimationSpec{"apng", "image/apng", "png apng", "\x89PNG\r\n\x1a\n", 4.5, false, writeApng},
    AnimationSpec{"animated-webp", "image/webp", "webp", "RIFF????WEBP", 6, false,
                  writeAnimatedWebp},
    // LZW codes of at most 12 bits, of which one clears the table every 4,096.
    AnimationSpec{"gif", "image/gif", "gif", "GIF89a", 2, false, writeGif},
    // Macroblocks of raw samples, 12 bits a pixel, and packets' heads.
    AnimationSpec{"mp4", "video/mp4", "mp4", "????ftyp", 4, true, writeMp4},
    AnimationSpec{"webm", "video/webm", "webm", "\x1A\x45\xDF\xA3", 4, true, writeWebm},
};
inline constexpr AnimationFormat kLastAnimation{kAnimations.size() - 1};

constexpr const AnimationSpec& specOf(AnimationFormat format) {
    return kAnimations[static_cast<std::size_t>(format)];
}

/// Returns the names of the formats that this installation writes, in the table's order. Loads the
/// video module for the rest of the process (70 ms, 24 MB) where it is installed.
std::vector<std::string> writableAnimations();

}  // namespace farol::image
