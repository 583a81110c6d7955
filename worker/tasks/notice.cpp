#include "worker/tasks/notice.h"

#include <algorithm>

#include "image/format.h"
#include "render/plan/overlay.h"

namespace farol::worker {
namespace {

/// Breaks at blanks where a line has no room left.
std::string wrapped(const std::string& text, std::size_t columns) {
    std::string out, line, word;
    const auto endWord = [&] {
        if (!line.empty() && line.size() + 1 + word.size() > columns) {
            out += line + "\n";
            line.clear();
        }
        line += (line.empty() || word.empty() ? "" : " ") + word;
        word.clear();
    };
    for (const char c : text) {
        if (c == ' ' || c == '\n') endWord();
        if (c == '\n') {
            out += line + "\n";
            line.clear();
        }
        if (c != ' ' && c != '\n') word += c;
    }
    endWord();
    return out + line;
}

}  // namespace

render::Picture NoticeTask::run(const Request& request, WorkerState&) {
    const render::PictureOptions& options = request.options;
    constexpr int kWidth = 480, kHeight = 270, kFontWidth = 6, kMargin = 12;
    image::Image image;
    image.width = options.width.value_or(kWidth);
    image.height = options.height.value_or(kHeight);
    const std::size_t count =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.pixels.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i)
        for (const int level : {0x30, 0x18, 0x18, 0xFF})
            image.pixels.push_back(static_cast<std::uint8_t>(level));
    const int scale = std::clamp(image.width / 400, 1, 8);
    const int columns = std::max(1, (image.width - kMargin) / (kFontWidth * scale));
    render::drawText(image, wrapped(request.text, static_cast<std::size_t>(columns)), scale);
    render::Picture picture;
    picture.width = image.width;
    picture.height = image.height;
    picture.bytes = image::encode(image, options.format, options.quality);
    picture.contentType = image::contentType(options.format);
    return picture;
}

}  // namespace farol::worker
