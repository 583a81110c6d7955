#include "worker/reply_check.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/code_status.h"
#include "core/text.h"
#include "image/format.h"
#include "worker/job.h"

namespace farol::worker {
namespace {

constexpr std::uint64_t kImageHead = 65'536;
constexpr std::size_t kMaxCode = 96, kMaxText = 8'192;
constexpr double kMaxMs = 1e8;

[[noreturn]] void refuse(const std::string& what) {
    throw WireError("a worker's reply does not fit the request: " + what);
}

bool isWord(std::string_view text, std::string_view marks) {
    return !text.empty() && text.size() <= kMaxCode &&
           std::all_of(text.begin(), text.end(), [&](char c) {
               return isAlphanumeric(c) || marks.find(c) != std::string_view::npos;
           });
}

bool isCode(const std::string& code) { return isWord(code, ".-") && code == lowerCase(code); }

/// Of a row of the message catalogue; empty where a message has none.
bool isMessageId(const std::string& id) { return id.empty() || isWord(id, ".-/"); }

bool areArguments(const MessageArguments& arguments) {
    constexpr std::size_t kMaxCut = 3;  // the dots of a value that was cut
    return arguments.size() <= kMaxArguments &&
           std::all_of(arguments.begin(), arguments.end(), [](const MessageArgument& argument) {
               return isWord(argument.name, ".-") && isMessageId(argument.id) &&
                      argument.text.size() <= kMaxArgumentBytes + kMaxCut;
           });
}

}  // namespace

void require(bool holds, const char* what) {
    if (!holds) refuse(what);
}

void checkFinite(std::initializer_list<double> values) {
    for (const double value : values) require(std::isfinite(value), "a number that is not finite");
}

void checkTimes(std::initializer_list<double> times) {
    for (const double ms : times) require(ms >= 0.0 && ms <= kMaxMs, "a time");
}

void checkDiagnostics(const Diagnostics& diagnostics) {
    require(diagnostics.size() <= kMaxDiagnostics, "too many diagnostics");
    for (const Diagnostic& one : diagnostics)
        require(isCode(one.code) && one.message.size() <= kMaxText &&
                    one.where.file.size() <= kMaxText && one.field.size() <= kMaxText &&
                    one.where.line >= 0 && one.where.column >= 0 && one.count > 0 &&
                    isMessageId(one.id) && areArguments(one.arguments),
                "a diagnostic");
}

void checkRefusal(const Diagnostics& diagnostics) {
    const auto isError = [](const Diagnostic& one) { return one.severity == Severity::error; };
    require(std::any_of(diagnostics.begin(), diagnostics.end(), isError),
            "a refusal without an error");
    for (const Diagnostic& one : diagnostics) {
        const int status = statusOf(one.code);
        require((status == 400 || status == 422) && !one.code.starts_with("http."),
                "a code that is not a worker's");
    }
}

void checkFaultMessage(const std::string& message) {
    require(message.size() <= kMaxText, "the message of a fault");
}

void checkJson(const std::string& text, const JsonLimits& limits, const char* what) {
    try {
        require(parseJson(text, limits).is_object(), what);
    } catch (const JsonError& error) {
        refuse(std::string(what) + ": " + error.what());
    }
}

std::uint64_t pixelsOf(const ImageBounds& bounds) {
    return std::min<std::uint64_t>(
        render::kMaxPixels,
        static_cast<std::uint64_t>(bounds.maxWidth) * static_cast<std::uint64_t>(bounds.maxHeight));
}

std::uint64_t maxImageBytes(image::Format format, std::uint64_t pixels) {
    return maxImageBytes(image::specOf(format).maxBytesPerPixel, pixels);
}

std::uint64_t maxImageBytes(double maxBytesPerPixel, std::uint64_t pixels) {
    return kImageHead + static_cast<std::uint64_t>(static_cast<double>(pixels) * maxBytesPerPixel);
}

ImageBounds imageBoundsOf(const render::PictureOptions& options) {
    ImageBounds bounds{kBaseLimits};
    bounds.format = options.format;
    bounds.maxWidth = options.width.value_or(render::kMaxSide);
    bounds.maxHeight = options.height.value_or(render::kMaxSide);
    bounds.imageBytes = maxImageBytes(options.format, pixelsOf(bounds));
    bounds.bytes += bounds.imageBytes;
    return bounds;
}

void checkPicture(const render::Picture& picture, const ImageBounds& bounds) {
    checkDiagnostics(picture.diagnostics);
    const render::StageTimes& times = picture.times;
    checkTimes({times.parseMs, times.geometryMs, times.drawMs, times.readbackMs, times.encodeMs});
    require(picture.width >= 0 && picture.width <= bounds.maxWidth && picture.height >= 0 &&
                picture.height <= bounds.maxHeight,
            "the size of an image");
    require(picture.bytes.size() <= bounds.imageBytes, "the bytes of an image");
    if (picture.quality) checkFinite({picture.quality->errorPx, picture.quality->expectedMs});
}

void acceptImage(render::Picture& picture, const ImageBounds& bounds) {
    checkPicture(picture, bounds);
    require(image::hasSignature(picture.bytes, bounds.format), "the format of an image");
    // A compromised worker must not choose a header of the response.
    picture.contentType = image::contentType(bounds.format);
}

Answer readAnswer(std::string_view bytes, const PackedJob& job) {
    Unpacker unpacker(bytes, job.limits.entries);
    AnswerHead head;
    unpacker(head);
    checkDiagnostics(head.diagnostics);
    checkFaultMessage(head.message);
    Answer answer{std::move(head), {}};
    if (answer.outcome == Outcome::done) {
        require(answer.diagnostics.empty() && answer.message.empty(), "a job that is done");
        answer.reply = job.readReply(unpacker);
    } else {
        if (answer.outcome == Outcome::refused) checkRefusal(answer.diagnostics);
        unpacker.end();
    }
    return answer;
}

}  // namespace farol::worker
