#include <cmath>

#include "image/animation.h"
#include "image/png_chunks.h"

namespace farol::image {
namespace {

class ApngWriter final : public AnimationWriter {
  public:
    using AnimationWriter::AnimationWriter;

  private:
    void append(const Image& frame) override {
        const int channels = settings_.hasAlpha ? 4 : 3;
        if (added_ == 0) {
            png::appendHeader(out_, width_, height_, channels);
            const std::size_t control = png::beginChunk(out_, "acTL");
            png::appendU32(out_, static_cast<std::uint32_t>(settings_.frames));
            png::appendU32(out_, 0);  // for ever
            png::finishChunk(out_, control);
        }
        std::size_t chunk = png::beginChunk(out_, "fcTL");
        png::appendU32(out_, sequence_++);
        png::appendU32(out_, static_cast<std::uint32_t>(width_));
        png::appendU32(out_, static_cast<std::uint32_t>(height_));
        out_.append(8, '\0');  // at the left top corner
        // The delay is a fraction of two 16-bit numbers: exact for whole rates, else to 0.1 ms.
        const double fps = settings_.fps;
        const bool whole = fps >= 1.0 && fps == std::floor(fps);
        png::appendU16(
            out_,
            whole ? 1U : static_cast<std::uint32_t>(std::lround(std::min(65535.0, 10000.0 / fps))));
        png::appendU16(out_, whole ? static_cast<std::uint32_t>(fps) : 10000U);
        out_.append(2, '\0');  // leave the frame, replace by the next
        png::finishChunk(out_, chunk);
        chunk = png::beginChunk(out_, added_ == 0 ? "IDAT" : "fdAT");
        if (added_ > 0) png::appendU32(out_, sequence_++);
        png::appendPixels(out_, frame, channels);
        png::finishChunk(out_, chunk);
    }

    std::string end() override {
        png::finishChunk(out_, png::beginChunk(out_, "IEND"));
        return std::move(out_);
    }

    std::string out_;
    unsigned sequence_ = 0;
};

}  // namespace

std::unique_ptr<AnimationWriter> writeApng(const AnimationSettings& settings) {
    return std::make_unique<ApngWriter>(settings);
}

}  // namespace farol::image
