#include "image/format.h"
#include "image/png_chunks.h"

namespace farol::image {

std::string encodePng(const Image& image) {
    const int channels = isOpaque(image) ? 3 : 4;
    std::string out;
    png::appendHeader(out, image.width, image.height, channels);
    const std::size_t chunk = png::beginChunk(out, "IDAT");
    png::appendPixels(out, image, channels);
    png::finishChunk(out, chunk);
    png::finishChunk(out, png::beginChunk(out, "IEND"));
    return out;
}

}  // namespace farol::image
