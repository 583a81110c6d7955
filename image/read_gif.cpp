#include <gif_lib.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "image/byte_reader.h"
#include "image/decoder.h"

namespace farol::image {
namespace {

int readBytes(GifFileType* file, GifByteType* to, int count) {
    auto& rest = *static_cast<std::string_view*>(file->UserData);
    const std::size_t size = std::min(rest.size(), static_cast<std::size_t>(std::max(0, count)));
    std::memcpy(to, rest.data(), size);
    rest.remove_prefix(size);
    return static_cast<int>(size);
}

[[noreturn]] void throwGifError(int code) {
    if (code == D_GIF_ERR_READ_FAILED || code == D_GIF_ERR_EOF_TOO_SOON)
        throw std::runtime_error("the file is cut off");
    const char* text = GifErrorString(code);
    throw std::runtime_error(std::string("giflib: ") + (text == nullptr ? "damaged" : text));
}

struct GifReader {
    explicit GifReader(std::string_view bytes) : rest(bytes) {
        int code = 0;
        file = DGifOpen(&rest, readBytes, &code);
        if (file == nullptr) throwGifError(code);
    }
    ~GifReader() {
        int code = 0;
        DGifCloseFile(file, &code);
    }
    GifReader(const GifReader&) = delete;
    GifReader& operator=(const GifReader&) = delete;

    void require(int result) const {
        if (result == GIF_ERROR) throwGifError(file->Error);
    }

    std::string_view rest;
    GifFileType* file = nullptr;
};

/// Reads up to the first image; returns its transparent colour's index, or -1.
int readUntilImage(const GifReader& reader) {
    int transparent = NO_TRANSPARENT_COLOR;
    for (;;) {
        GifRecordType type = UNDEFINED_RECORD_TYPE;
        reader.require(DGifGetRecordType(reader.file, &type));
        if (type == IMAGE_DESC_RECORD_TYPE) return transparent;
        if (type == TERMINATE_RECORD_TYPE) throw std::runtime_error("it has no image");
        if (type != EXTENSION_RECORD_TYPE) throw std::runtime_error("an unknown block");
        int code = 0;
        GifByteType* block = nullptr;  // length first
        reader.require(DGifGetExtension(reader.file, &code, &block));
        GraphicsControlBlock control;
        if (block != nullptr && code == GRAPHICS_EXT_FUNC_CODE &&
            DGifExtensionToGCB(block[0], block + 1, &control) == GIF_OK)
            transparent = control.TransparentColor;
        while (block != nullptr) reader.require(DGifGetExtensionNext(reader.file, &block));
    }
}

/// One row of palette indices to RGBA, clipped at the canvas.
void putRow(const std::vector<GifPixelType>& indices, const ColorMapObject& palette,
            int transparent, int left, int y, Decoded& out) {
    std::uint8_t* row = out.row(y);
    const int count = std::min(static_cast<int>(indices.size()), out.width - left);
    for (int x = 0; x < count; ++x) {
        const int index = indices[static_cast<std::size_t>(x)];
        if (index == transparent) continue;
        if (index >= palette.ColorCount)
            throw std::runtime_error("colour " + std::to_string(index) +
                                     " is not in its palette of " +
                                     std::to_string(palette.ColorCount));
        const GifColorType& color = palette.Colors[index];
        std::uint8_t* to = row + static_cast<std::ptrdiff_t>(left + x) * 4;
        to[0] = color.Red;
        to[1] = color.Green;
        to[2] = color.Blue;
        to[3] = 255;
    }
}

}  // namespace

void readGif(std::string_view bytes, bool wantsPixels, Decoded& out) {
    const GifReader reader(bytes);
    GifFileType& file = *reader.file;
    if (!out.announce(file.SWidth, file.SHeight, 4)) return;
    if (!wantsPixels) return;
    const int transparent = readUntilImage(reader);
    reader.require(DGifGetImageDesc(&file));
    const GifImageDesc& image = file.Image;
    const ColorMapObject* palette = image.ColorMap != nullptr ? image.ColorMap : file.SColorMap;
    if (palette == nullptr) throw std::runtime_error("it has no palette");
    if (image.Width <= 0 || image.Height <= 0 || image.Left < 0 || image.Top < 0 ||
        std::int64_t{image.Width} * image.Height > kMaxTexturePixels)
        throw std::runtime_error("its first image has no valid size");
    out.allocate();
    struct Pass {
        int first, step;
    };
    static constexpr Pass kInterlaced[] = {{0, 8}, {4, 8}, {2, 4}, {1, 2}};
    static constexpr Pass kPlain[] = {{0, 1}};
    std::vector<GifPixelType> indices(static_cast<std::size_t>(image.Width));
    const Pass* pass = image.Interlace ? std::begin(kInterlaced) : std::begin(kPlain);
    const Pass* end = image.Interlace ? std::end(kInterlaced) : std::end(kPlain);
    for (; pass != end; ++pass)
        for (int y = pass->first; y < image.Height; y += pass->step) {
            reader.require(DGifGetLine(&file, indices.data(), image.Width));
            if (image.Top + y < out.height)
                putRow(indices, *palette, transparent, image.Left, image.Top + y, out);
        }
}

}  // namespace farol::image
