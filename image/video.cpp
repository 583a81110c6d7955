// Videos by the module that links FFmpeg's libraries.
#include <stdexcept>

#include "core/error.h"
#include "image/animation.h"
#include "image/load_module.h"
#include "image/messages.h"
#include "image/video/module.h"

namespace farol::image {
namespace {

/// Throws Error option.unavailable where the module or a library that it needs is not installed.
const VideoModule& videoModule(const char* format) {
    try {
        // Once loaded, it stays.
        static const VideoModule& module = *reinterpret_cast<GetVideoModule>(
            loadFunction(findModule(FAROL_VIDEO_MODULE), kVideoFunction))();
        return module;
    } catch (const std::runtime_error& error) {
        throw Error(message<"option.unavailable">("format"_arg = format,
                                                  "reason"_arg = uncut(error.what())),
                    {}, "format");
    }
}

class VideoWriter final : public AnimationWriter {
  public:
    VideoWriter(const AnimationSettings& settings, const char* container, const char* encoder)
        : AnimationWriter(settings), module_(videoModule(container)) {
        const char* why = nullptr;
        video_ = module_.open({container, encoder, settings.fps, settings.quality}, &why);
        if (video_ == nullptr)
            throw Error(
                message<"option.unavailable">("format"_arg = container, "reason"_arg = uncut(why)),
                {}, "format");
    }
    ~VideoWriter() override { module_.close(video_); }
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

  private:
    static void check(const char* why) {
        if (why != nullptr) throw std::runtime_error(std::string("cannot write a video: ") + why);
    }
    void append(const Image& frame) override {
        check(module_.add(video_, frame.pixels.data(), frame.width, frame.height));
    }
    std::string end() override {
        const char* bytes = nullptr;
        std::size_t size = 0;
        check(module_.finish(video_, &bytes, &size));
        return {bytes, size};
    }

    const VideoModule& module_;
    void* video_ = nullptr;
};

}  // namespace

std::unique_ptr<AnimationWriter> writeMp4(const AnimationSettings& settings) {
    return std::make_unique<VideoWriter>(settings, "mp4", "libx264");
}

std::unique_ptr<AnimationWriter> writeWebm(const AnimationSettings& settings) {
    return std::make_unique<VideoWriter>(settings, "webm", "libvpx-vp9");
}

std::vector<std::string> writableAnimations() {
    std::vector<std::string> names;
    for (const AnimationSpec& format : kAnimations) {
        try {
            if (format.needsModule) format.write({});
            names.emplace_back(format.name);
        } catch (const Error& error) {
            if (error.code() != "option.unavailable") throw;
        }
    }
    return names;
}

}  // namespace farol::image
