#include <gif_lib.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "image/animation.h"

namespace farol::image {
namespace {

constexpr int kColors = 256;
constexpr int kTransparent = kColors - 1;  ///< the index of transparent pixels, where there are any
constexpr std::uint8_t kHalf = 128;        ///< pixels of less alpha are transparent

int writeBytes(GifFileType* file, const GifByteType* bytes, int count) {
    static_cast<std::string*>(file->UserData)
        ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
}

[[noreturn]] void throwGifError(int code) {
    const char* text = GifErrorString(code);
    throw std::runtime_error(std::string("giflib: ") + (text == nullptr ? "failed" : text));
}

/// A frame's pixels, a channel a list.
struct Channels {
    std::vector<GifByteType> red, green, blue;
};

/// Fills palette and indices where the pixels have at most `limit` colours; else returns false.
bool copyColors(const Channels& pixels, std::size_t limit, GifColorType* palette,
                std::vector<GifByteType>& indices) {
    std::unordered_map<std::uint32_t, GifByteType> known;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::uint32_t color = static_cast<std::uint32_t>(pixels.red[i]) << 16U |
                                    static_cast<std::uint32_t>(pixels.green[i]) << 8U |
                                    pixels.blue[i];
        const auto [at, isNew] = known.emplace(color, static_cast<GifByteType>(known.size()));
        if (isNew && known.size() > limit) return false;
        if (isNew) palette[at->second] = {pixels.red[i], pixels.green[i], pixels.blue[i]};
        indices[i] = at->second;
    }
    return true;
}

class GifWriter final : public AnimationWriter {
  public:
    explicit GifWriter(const AnimationSettings& settings) : AnimationWriter(settings) {
        int code = 0;
        file_ = EGifOpen(&out_, writeBytes, &code);
        if (file_ == nullptr) throwGifError(code);
        EGifSetGifVersion(file_, true);  // 89a
    }
    ~GifWriter() override { close(); }
    GifWriter(const GifWriter&) = delete;
    GifWriter& operator=(const GifWriter&) = delete;

  private:
    using Map = std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)>;

    void require(int result) const {
        if (result == GIF_ERROR) throwGifError(file_->Error);
    }

    /// From the first frame on, 1/100 s.
    int timeOf(int frame) const {
        return std::max(2 * frame, static_cast<int>(std::lround(100.0 * frame / settings_.fps)));
    }

    void begin() {
        require(EGifPutScreenDesc(file_, width_, height_, 8, 0, nullptr));
        // Netscape's extension: looped for ever.
        constexpr char kName[] = "NETSCAPE2.0";
        constexpr GifByteType kLoop[] = {1, 0, 0};
        require(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
        require(EGifPutExtensionBlock(file_, sizeof kName - 1, kName));
        require(EGifPutExtensionBlock(file_, sizeof kLoop, kLoop));
        require(EGifPutExtensionTrailer(file_));
    }

    void append(const Image& frame) override {
        if (added_ == 0) begin();
        const std::size_t count = frame.pixels.size() / 4;
        Channels pixels{std::vector<GifByteType>(count), std::vector<GifByteType>(count),
                        std::vector<GifByteType>(count)};
        std::vector<GifByteType> indices(count);
        bool hasHoles = false;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t* const pixel = &frame.pixels[4 * i];
            pixels.red[i] = pixel[0];
            pixels.green[i] = pixel[1];
            pixels.blue[i] = pixel[2];
            hasHoles = hasHoles || (settings_.hasAlpha && pixel[3] < kHalf);
        }
        const Map map(GifMakeMapObject(kColors, nullptr), GifFreeMapObject);
        if (!map) throw std::bad_alloc();
        int colors = hasHoles ? kTransparent : kColors;
        if (!copyColors(pixels, static_cast<std::size_t>(colors), map->Colors, indices))
            require(GifQuantizeBuffer(static_cast<unsigned>(width_), static_cast<unsigned>(height_),
                                      &colors, pixels.red.data(), pixels.green.data(),
                                      pixels.blue.data(), indices.data(), map->Colors));
        if (hasHoles)
            for (std::size_t i = 0; i < count; ++i)
                if (frame.pixels[4 * i + 3] < kHalf) indices[i] = kTransparent;
        GraphicsControlBlock control{};
        // With holes the frame before must go first.
        control.DisposalMode = hasHoles ? DISPOSE_BACKGROUND : DISPOSE_DO_NOT;
        control.DelayTime = timeOf(added_ + 1) - timeOf(added_);
        control.TransparentColor = hasHoles ? kTransparent : NO_TRANSPARENT_COLOR;
        GifByteType block[4];
        require(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE,
                                 static_cast<int>(EGifGCBToExtension(&control, block)), block));
        require(EGifPutImageDesc(file_, 0, 0, width_, height_, false, map.get()));
        for (int row = 0; row < height_; ++row)
            require(EGifPutLine(
                file_, &indices[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_)],
                width_));
    }

    std::string end() override {
        if (const int code = close(); code != 0) throwGifError(code);
        return std::move(out_);
    }

    /// Returns giflib's code of an error, else 0.
    int close() {
        int code = 0;
        if (file_ != nullptr && EGifCloseFile(file_, &code) == GIF_OK) code = 0;
        file_ = nullptr;
        return code;
    }

    std::string out_;
    GifFileType* file_ = nullptr;
};

}  // namespace

std::unique_ptr<AnimationWriter> writeGif(const AnimationSettings& settings) {
    return std::make_unique<GifWriter>(settings);
}

}  // namespace farol::image
