#include "render/plan/background.h"

#include <array>
#include <charconv>
#include <optional>

#include "render/plan/messages.h"

namespace farol::render {
namespace {

struct NamedColor {
    const char* name;
    int rgb;
};

// The sixteen of HTML 4, section 6.5, and orange.
constexpr std::array<NamedColor, 17> kNames{{{"black", 0x000000},
                                             {"silver", 0xC0C0C0},
                                             {"gray", 0x808080},
                                             {"white", 0xFFFFFF},
                                             {"maroon", 0x800000},
                                             {"red", 0xFF0000},
                                             {"purple", 0x800080},
                                             {"fuchsia", 0xFF00FF},
                                             {"green", 0x008000},
                                             {"lime", 0x00FF00},
                                             {"olive", 0x808000},
                                             {"yellow", 0xFFFF00},
                                             {"navy", 0x000080},
                                             {"blue", 0x0000FF},
                                             {"teal", 0x008080},
                                             {"aqua", 0x00FFFF},
                                             {"orange", 0xFFA500}}};

glm::vec4 fromRgb(int rgb) {
    return {static_cast<float>((rgb >> 16) & 255) / 255.0F,
            static_cast<float>((rgb >> 8) & 255) / 255.0F, static_cast<float>(rgb & 255) / 255.0F,
            1.0F};
}

std::optional<glm::vec4> parseColor(const std::string& text) {
    for (const NamedColor& one : kNames)
        if (text == one.name) return fromRgb(one.rgb);
    const char* end = text.data() + text.size();
    if (text.size() == 7 && text[0] == '#') {
        int rgb = 0;
        const auto [at, error] = std::from_chars(text.data() + 1, end, rgb, 16);
        if (error == std::errc() && at == end && rgb >= 0) return fromRgb(rgb);
        return std::nullopt;
    }
    glm::vec4 color(1.0F);
    const char* at = text.data();
    for (int i = 0; i < 3; ++i) {
        int value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || value < 0 || value > 255) return std::nullopt;
        if (i < 2 ? next == end || *next != ',' : next != end) return std::nullopt;
        color[i] = static_cast<float>(value) / 255.0F;
        at = next + 1;
    }
    return color;
}

}  // namespace

Background chooseBackground(const scene::Scene& scene, const PictureOptions& options,
                            const scene::Assets& assets) {
    Background chosen;
    if (!options.background) {
        if (scene.background.color) chosen.color = glm::vec4(*scene.background.color, 1.0F);
        chosen.path = scene.background.path;
        return chosen;
    }
    const std::string& text = *options.background;
    if (text == "transparent") {
        chosen.color = glm::vec4(0.0F);
    } else if (const auto color = parseColor(text)) {
        chosen.color = *color;
    } else {
        Diagnostics ignored;  // the request names the file: its location needs no finding
        const auto path = scene::locate(assets, text, {}, ignored, scene.document);
        if (!path)
            throw Error(message<"option.range/background">("value"_arg = text), {}, "background");
        chosen.path = *path;
    }
    return chosen;
}

}  // namespace farol::render
