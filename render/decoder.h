#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

/// One picture format each, behind image_file.h.
namespace farol::render {

/// A picture as its file has it: rows from the top, 8 bits a sample, samples of a pixel together.
struct Decoded {
    int width = 0, height = 0;
    int channels = 0;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; alpha is not multiplied
                       ///< in, and may be 255 throughout where the file has none
    std::vector<std::uint8_t> samples;

    std::int64_t pixels() const { return std::int64_t{width} * height; }
    void allocate() {
        samples.resize(static_cast<std::size_t>(pixels()) * static_cast<std::size_t>(channels));
    }
};

/// Sets the size, and the samples too where `wantsPixels` and the size is within
/// kMaxTexturePixels. Throws std::exception with the reason.
void readPng(std::string_view bytes, bool wantsPixels, Decoded& out);   // PNG 1.2
void readJpeg(std::string_view bytes, bool wantsPixels, Decoded& out);  // ITU T.81
void readWebp(std::string_view bytes, bool wantsPixels, Decoded& out);  // RFC 9649, one picture

/// All else, by OpenImageIO, which with all that it needs takes 0.25 s of CPU time to load: it lies
/// in a module of its own (render/oiio) that is loaded when the first such file comes. `format` is
/// OpenImageIO's name. Throws also where the module or one of its libraries is not installed.
void readByModule(const char* format, std::string_view bytes, bool wantsPixels, Decoded& out);

/// The module's file, to be found beside the program; for a sandbox that must let it be read.
const char* moduleFile();

/// The module's one function, by this name. False: see `fault` (a static or thread's own text).
using ModuleRead = bool (*)(const char* format, std::string_view bytes, bool wantsPixels,
                            Decoded& out, const char*& fault);
inline constexpr const char* kModuleRead = "farol_read_picture";

}  // namespace farol::render
