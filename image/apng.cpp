#include "image/apng.h"

#include <cmath>
#include <stdexcept>

#include "image/png_chunks.h"

namespace farol::image {

ApngWriter::ApngWriter(int frames, double fps, bool alpha)
    : frames_(frames), fps_(fps), channels_(alpha ? 4 : 3) {}

void ApngWriter::add(const Image& frame) {
    if (added_ == frames_) throw std::invalid_argument("more frames than announced");
    if (added_ == 0) {
        width_ = frame.width;
        height_ = frame.height;
        png::appendHeader(out_, width_, height_, channels_);
        const std::size_t control = png::beginChunk(out_, "acTL");
        png::appendU32(out_, static_cast<std::uint32_t>(frames_));
        png::appendU32(out_, 0);  // for ever
        png::finishChunk(out_, control);
    }
    if (frame.width != width_ || frame.height != height_)
        throw std::invalid_argument("the frames differ in size");
    std::size_t chunk = png::beginChunk(out_, "fcTL");
    png::appendU32(out_, sequence_++);
    png::appendU32(out_, static_cast<std::uint32_t>(width_));
    png::appendU32(out_, static_cast<std::uint32_t>(height_));
    out_.append(8, '\0');  // at the left top corner
    // The delay is a fraction of two 16-bit numbers: exact for whole rates, else to 0.1 ms.
    const bool whole = fps_ >= 1.0 && fps_ == std::floor(fps_);
    png::appendU16(
        out_,
        whole ? 1U : static_cast<std::uint32_t>(std::lround(std::min(65535.0, 10000.0 / fps_))));
    png::appendU16(out_, whole ? static_cast<std::uint32_t>(fps_) : 10000U);
    out_.append(2, '\0');  // leave the frame, replace by the next
    png::finishChunk(out_, chunk);
    chunk = png::beginChunk(out_, added_ == 0 ? "IDAT" : "fdAT");
    if (added_ > 0) png::appendU32(out_, sequence_++);
    png::appendPixels(out_, frame, channels_);
    png::finishChunk(out_, chunk);
    ++added_;
}

std::string ApngWriter::finish() {
    if (added_ != frames_) throw std::logic_error("frames are missing");
    png::finishChunk(out_, png::beginChunk(out_, "IEND"));
    return std::move(out_);
}

}  // namespace farol::image
