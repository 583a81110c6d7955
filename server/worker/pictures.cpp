#include "server/worker/pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtx/rotate_vector.hpp>
#include <optional>

#include "render/apng.h"
#include "render/encode.h"
#include "render/overlay.h"

namespace farol::server::worker {
namespace {

/// Later frames are seen by the first one's camera, turned; what framed the scene stays.
void turnEye(render::PictureOptions& options, const scene::Camera& first, double angle) {
    options.azimuthDeg.reset();
    options.elevationDeg.reset();
    options.distance.reset();
    options.eye =
        first.target + glm::rotate(first.eye - first.target, angle, glm::normalize(first.up));
    options.target = first.target;
    options.up = first.up;
    options.fovDeg = first.fovDeg;
    options.near = first.near;
    options.far = first.far;
}

void appendPart(std::string& body, const render::Picture& picture) {
    body.append("--").append(kFrameBoundary).append("\r\nContent-Type: ");
    body.append(picture.contentType).append("\r\nContent-Length: ");
    body.append(std::to_string(picture.bytes.size())).append("\r\n\r\n");
    body.append(picture.bytes).append("\r\n");
}

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

render::Picture turnAround(render::Renderer& renderer, const render::Job& job,
                           const Turntable& turn) {
    render::Job one = job;
    render::ApngWriter animation(turn.frames, turn.fps, job.options.background == "transparent");
    render::Picture all;
    std::string body;
    for (int i = 0; i < turn.frames; ++i) {
        if (i > 0) turnEye(one.options, all.camera, glm::two_pi<double>() * i / turn.frames);
        render::Picture frame;
        if (turn.apng) {
            render::Image image;
            frame = renderer.draw(one, image);
            animation.add(image);
        } else {
            frame = renderer.render(one);
            appendPart(body, frame);
        }
        if (i == 0) all = std::move(frame);
    }
    all.bytes = turn.apng ? animation.finish() : body + "--" + kFrameBoundary + "--\r\n";
    return all;
}

render::Picture drawNotice(const std::string& text, const render::PictureOptions& options) {
    constexpr int kWidth = 480, kHeight = 270, kFontWidth = 6, kMargin = 12;
    render::Image image;
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
    render::drawText(image, wrapped(text, static_cast<std::size_t>(columns)), scale);
    render::Picture picture;
    picture.width = image.width;
    picture.height = image.height;
    picture.bytes = render::encode(image, options.format, options.quality);
    picture.contentType = render::contentType(options.format);
    return picture;
}

}  // namespace farol::server::worker
