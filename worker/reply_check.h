#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "core/bounded_json.h"
#include "core/error.h"
#include "render/renderer.h"
#include "worker/task.h"

/// Checks replies against their requests: input may have compromised the worker. All check
/// functions throw WireError.
namespace farol::worker {

/// Bytes that every reply may have besides its images and files: numbers, diagnostics, titles.
inline constexpr std::uint64_t kBaseBytes = std::uint64_t{4} << 20U;
inline constexpr std::size_t kMaxDiagnostics = 2'200;  ///< scene/read/findings.cpp keeps 2,000
/// Most list entries of diagnostics: themselves and their messages' arguments.
inline constexpr std::size_t kMaxDiagnosticEntries = kMaxDiagnostics * (1 + kMaxArguments);

/// The bounds that every reply has.
inline constexpr ReplyLimits kBaseLimits{kBaseBytes, kMaxDiagnosticEntries};

/// Throws WireError unless `holds`; its message ends with the second argument.
void require(bool holds, const char* what);
void checkFinite(std::initializer_list<double> values);
/// Times in ms.
void checkTimes(std::initializer_list<double> times);
void checkDiagnostics(const Diagnostics& diagnostics);
/// Checks a refusal: a worker may report faults of the input, but no codes of the HTTP side.
void checkRefusal(const Diagnostics& diagnostics);
void checkFaultMessage(const std::string& message);
/// Checks a JSON object against the limits.
void checkJson(const std::string& text, const JsonLimits& limits, const char* what);

/// Bounds of an image that was requested with these options.
struct ImageBounds : ReplyLimits {
    int maxWidth = 0, maxHeight = 0;  ///< px
    std::uint64_t imageBytes = 0;     ///< of one encoded image
    image::Format format = image::Format::png;
};
/// Of one image, limits included.
ImageBounds imageBoundsOf(const render::PictureOptions& options);
std::uint64_t pixelsOf(const ImageBounds& bounds);

/// Returns the bytes of the largest encoded image of this many pixels.
std::uint64_t maxImageBytes(image::Format format, std::uint64_t pixels);
std::uint64_t maxImageBytes(double maxBytesPerPixel, std::uint64_t pixels);

/// All but the format of the bytes and the content type.
void checkPicture(const render::Picture& picture, const ImageBounds& bounds);
/// A picture in one image; its content type becomes that of the format.
void acceptImage(render::Picture& picture, const ImageBounds& bounds);

}  // namespace farol::worker
