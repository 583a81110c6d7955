#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <new>

#include "image/animation.h"

namespace farol::image {
namespace {

class WebpWriter final : public AnimationWriter {
  public:
    explicit WebpWriter(const AnimationSettings& settings) : AnimationWriter(settings) {
        if (WebPConfigPreset(&config_, WEBP_PRESET_DEFAULT, static_cast<float>(settings.quality)) ==
            0)
            throw std::runtime_error("libwebp has another version");
        config_.method = 2;  // of 0, fast, to 6, small
    }
    ~WebpWriter() override { WebPAnimEncoderDelete(encoder_); }
    WebpWriter(const WebpWriter&) = delete;
    WebpWriter& operator=(const WebpWriter&) = delete;

  private:
    /// From the first frame on, ms.
    int timeOf(int frame) const {
        return static_cast<int>(std::lround(1000.0 * frame / settings_.fps));
    }

    void require(int done) const {
        if (done == 0)
            throw std::runtime_error(std::string("libwebp: ") + WebPAnimEncoderGetError(encoder_));
    }

    void append(const Image& frame) override {
        if (encoder_ == nullptr) {
            WebPAnimEncoderOptions options;
            if (WebPAnimEncoderOptionsInit(&options) == 0)
                throw std::runtime_error("libwebpmux has another version");
            options.allow_mixed = 0;
            encoder_ = WebPAnimEncoderNew(width_, height_, &options);
            if (encoder_ == nullptr) throw std::bad_alloc();
        }
        WebPPicture picture;
        if (WebPPictureInit(&picture) == 0) throw std::runtime_error("libwebp has another version");
        picture.use_argb = 1;
        picture.width = width_;
        picture.height = height_;
        const auto import = settings_.hasAlpha ? WebPPictureImportRGBA : WebPPictureImportRGBX;
        const bool isImported = import(&picture, frame.pixels.data(), 4 * width_) != 0;
        const int done =
            isImported ? WebPAnimEncoderAdd(encoder_, &picture, timeOf(added_), &config_) : 0;
        WebPPictureFree(&picture);
        if (!isImported) throw std::bad_alloc();
        require(done);
    }

    std::string end() override {
        require(WebPAnimEncoderAdd(encoder_, nullptr, timeOf(added_), nullptr));
        WebPData data;
        WebPDataInit(&data);
        const int done = WebPAnimEncoderAssemble(encoder_, &data);
        std::string file(reinterpret_cast<const char*>(data.bytes), data.size);
        WebPDataClear(&data);
        require(done);
        return file;
    }

    WebPConfig config_{};
    WebPAnimEncoder* encoder_ = nullptr;
};

}  // namespace

std::unique_ptr<AnimationWriter> writeAnimatedWebp(const AnimationSettings& settings) {
    return std::make_unique<WebpWriter>(settings);
}

}  // namespace farol::image
