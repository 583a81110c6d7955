#pragma once

#include <string_view>

/// The module that links OpenImageIO: its 250 libraries take 0.25 s of CPU time to load, so it is
/// loaded for the first file that needs it.
namespace farol::image {

/// An image whose head has been read, for the module to decode.
struct ModuleRequest {
    const char* format;  ///< OpenImageIO's name
    std::string_view bytes;
    int left, top, width, height;  ///< where the file has pixels, in its own coordinates
    int tileWidth, tileHeight;     ///< 0: rows
    const char* const* channels;   ///< names, in the order of the samples
    int channelCount;
    /// Receives `count` pixels of row `y` from column `x` on, counted from `left` and `top`.
    void (*take)(void* user, int x, int y, int count, const float* samples);
    void* user;
};

/// Decodes every pixel once, in memory without data from earlier calls. Throws
/// std::runtime_error with the reason, also where the module or a library that it needs is not
/// installed.
void readByModule(const ModuleRequest& request);

/// The module's one function, by this name. Returns null, or why the file is not decoded: a text
/// that lasts until the next call. One call at a time.
using ModuleRead = const char* (*)(const ModuleRequest& request);
/// The reason that it returns if memory ran out.
inline constexpr const char* kModuleOutOfMemory = "out of memory";
inline constexpr const char* kModuleRead = "farol_read_image";

}  // namespace farol::image
