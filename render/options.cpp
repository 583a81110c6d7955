#include "render/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/did_you_mean.h"
#include "core/text.h"
#include "render/plan/messages.h"

namespace farol::render {
namespace {

[[noreturn]] void outOfRange(const std::string& name, const std::string& value,
                             const std::string& expected) {
    throw Error(message<"option.range/picture">("name"_arg = name, "value"_arg = value,
                                                "expected"_arg = uncut(expected)),
                {}, name);
}

double parseNumber(const std::string& name, const std::string& text, double min, double max,
                   const std::string& expected) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
    const auto [at, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || at != end || !std::isfinite(value) || value < min || value > max)
        outOfRange(name, text, expected);
    return value;
}

int parseInt(const std::string& name, const std::string& text, int min, int max,
             const std::string& expected) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end || value < min || value > max)
        outOfRange(name, text, expected);
    return value;
}

bool parseFlag(const std::string& name, const std::string& text) {
    if (text == "1" || text == "true") return true;
    if (text == "0" || text == "false") return false;
    outOfRange(name, text, "0 or 1");
}

constexpr double kFar = 1e12;  // beyond it floats cannot resolve eye-relative positions

glm::dvec3 parseVector(const std::string& name, const std::string& text) {
    constexpr const char* kRange = "three numbers x,y,z from -1e12 to 1e12";
    glm::dvec3 value{0.0};
    std::size_t begin = 0;
    for (int i = 0; i < 3; ++i) {
        const std::size_t comma = i < 2 ? text.find(',', begin) : text.size();
        if (comma == std::string::npos) outOfRange(name, text, kRange);
        std::string part = text.substr(begin, comma - begin);
        part.erase(0, part.find_first_not_of(' '));
        part.erase(part.find_last_not_of(' ') + 1);
        const char* end = part.data() + part.size();
        const auto [at, error] = std::from_chars(part.data(), end, value[i]);
        if (part.empty() || error != std::errc() || at != end || !std::isfinite(value[i]) ||
            std::abs(value[i]) > kFar)
            outOfRange(name, text, kRange);
        begin = comma + 1;
    }
    return value;
}

template <typename Enum>
using Words = std::vector<std::pair<std::string_view, Enum>>;

template <typename Enum, Enum kLast>
Words<Enum> wordsOf(const EnumWords<Enum, kLast>& table) {
    Words<Enum> words;
    for (std::size_t i = 0; i < table.kSize; ++i)
        words.emplace_back(table.all()[i], static_cast<Enum>(i));
    return words;
}

/// "1e-6", "4096", "1e12".
std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    std::string out = text;
    const std::size_t e = out.find('e');
    if (e == std::string::npos) return out;
    const std::string sign = out[e + 1] == '-' ? "-" : "";
    return out.substr(0, e + 1) + sign + out.substr(out.find_first_not_of('0', e + 2));
}

/// "1..4096 px" for help, "1 to 4096 px" for messages.
std::string rangeOf(const std::string& min, const char* between, const std::string& max,
                    const std::string& unit) {
    return min + between + max + (unit.empty() ? "" : " " + unit);
}

OptionSpec row(const std::string& name, OptionType type, const std::string& range,
               const std::string& help, const std::string& details) {
    OptionSpec spec;
    spec.name = name;
    spec.type = type;
    spec.range = range;
    spec.help = help;
    spec.details = details;
    return spec;
}

/// `member`: a pointer to a member of PictureOptions, or a function that returns one.
template <typename Member>
OptionSpec number(const std::string& name, Member member, double min, double max,
                  const std::string& unit, const std::string& help,
                  const std::string& details = "") {
    const std::string range = rangeOf(shortNumber(min), "..", shortNumber(max), unit);
    const std::string expected = rangeOf(shortNumber(min), " to ", shortNumber(max), unit);
    OptionSpec spec = row(name, OptionType::number, range, help, details);
    spec.min = min;
    spec.max = max;
    spec.apply = [=](PictureOptions& o, const std::string& value) {
        std::invoke(member, o) = parseNumber(name, value, min, max, expected);
    };
    return spec;
}

template <typename Member>
OptionSpec integer(const std::string& name, Member PictureOptions::*member, int min, int max,
                   const std::string& unit, const std::string& help,
                   const std::string& details = "") {
    const std::string range = rangeOf(std::to_string(min), "..", std::to_string(max), unit);
    const std::string expected =
        "a whole number in " + rangeOf(std::to_string(min), " to ", std::to_string(max), unit);
    OptionSpec spec = row(name, OptionType::integer, range, help, details);
    spec.min = min;
    spec.max = max;
    spec.apply = [=](PictureOptions& o, const std::string& value) {
        o.*member = parseInt(name, value, min, max, expected);
    };
    return spec;
}

/// An integer of which only some values are valid.
template <typename Member>
OptionSpec choice(const std::string& name, Member PictureOptions::*member,
                  const std::vector<std::string>& values, const std::string& unit,
                  const std::string& help, const std::string& details) {
    const std::string range = joined(values, "|") + " " + unit;
    OptionSpec spec = row(name, OptionType::integer, range, help, details);
    spec.words = values;
    spec.min = std::stoi(values.front());
    spec.max = std::stoi(values.back());
    spec.apply = [=](PictureOptions& o, const std::string& value) {
        const int parsed =
            parseInt(name, value, std::stoi(values.front()), std::stoi(values.back()), range);
        if (std::find(values.begin(), values.end(), std::to_string(parsed)) == values.end())
            outOfRange(name, value, range);
        o.*member = parsed;
    };
    return spec;
}

template <typename Member, typename Enum>
OptionSpec word(const std::string& name, Member PictureOptions::*member, const Words<Enum>& words,
                const std::string& help, const std::string& details = "") {
    std::vector<std::string> names;
    for (const auto& [text, value] : words) names.emplace_back(text);
    OptionSpec spec = row(name, OptionType::word, joined(names, "|"), help, details);
    spec.words = names;
    spec.apply = [=, range = spec.range](PictureOptions& o, const std::string& text) {
        const auto known = std::find_if(words.begin(), words.end(),
                                        [&](const auto& entry) { return entry.first == text; });
        if (known == words.end()) outOfRange(name, text, range);
        o.*member = known->second;
    };
    return spec;
}

template <typename Member>
OptionSpec flag(const std::string& name, Member PictureOptions::*member, const std::string& help) {
    OptionSpec spec = row(name, OptionType::flag, "0 or 1", help, "");
    spec.apply = [=](PictureOptions& o, const std::string& value) {
        o.*member = parseFlag(name, value);
    };
    return spec;
}

OptionSpec vector(const std::string& name, std::optional<glm::dvec3> PictureOptions::*member,
                  const std::string& help) {
    OptionSpec spec = row(name, OptionType::vector, "x,y,z", help, "");
    spec.apply = [=](PictureOptions& o, const std::string& value) {
        o.*member = parseVector(name, value);
    };
    return spec;
}

OptionSpec text(const std::string& name, std::optional<std::string> PictureOptions::*member,
                const std::string& range, const std::string& expected, const std::string& help) {
    OptionSpec spec = row(name, OptionType::text, range, help, "");
    spec.apply = [=](PictureOptions& o, const std::string& value) {
        if (value.empty() || value.size() > 1024) outOfRange(name, value, expected);
        o.*member = value;
    };
    return spec;
}

Words<image::Format> formatWords() {
    Words<image::Format> words;
    for (std::size_t i = 0; i < image::kFormats.size(); ++i)
        words.emplace_back(image::kFormats[i].name, image::Format{static_cast<std::uint8_t>(i)});
    return words;
}

std::string lossyFormats() {
    std::vector<std::string_view> names;
    for (const image::FormatSpec& format : image::kFormats)
        if (format.isLossy) names.push_back(format.name);
    return joined(names, " and ");
}

std::vector<OptionSpec> makeSpecs() {
    using O = PictureOptions;
    return {
        integer("width", &O::width, 1, kMaxSide, "px",
                "image width; default the scene's window, else 512"),
        integer("height", &O::height, 1, kMaxSide, "px",
                "image height; default the scene's window, else 512",
                "Width times height is at most " + std::to_string(kMaxPixels) + "."),
        word("camera", &O::camera, wordsOf(kCameraStartWords),
             "where the camera starts; default scene, framed where it has no camera",
             "framed shows all models; engine is the 2017 engine's start: at the origin, looking "
             "along +Z, 45 degrees. The options below move it."),
        vector("eye", &O::eye, "camera position, world units"),
        vector("target", &O::target, "point looked at, world units"),
        vector("up", &O::up, "direction that is up in the image"),
        number(
            "azimuth", [](O & o) -> auto& { return o.orbit.azimuthDeg; }, -36000, 36000, "degrees",
            "orbit about the target: longitude, 0 is from +Z"),
        number(
            "elevation", [](O & o) -> auto& { return o.orbit.elevationDeg; }, -90, 90, "degrees",
            "orbit about the target: latitude, 90 is from above"),
        number(
            "distance", [](O & o) -> auto& { return o.orbit.distance; }, 1e-6, kFar, "",
            "orbit about the target: distance, world units"),
        number("fov", &O::fovDeg, 0.01, 179, "degrees", "vertical field of view"),
        number("near", &O::near, 1e-6, kFar, "", "nearest distance drawn, world units"),
        number("far", &O::far, 1e-6, kFar, "",
               "farthest distance drawn, world units, more than near"),
        number("time", &O::timeS, -1e9, 1e9, "s", "moment of the animation; default 0"),
        word("shading", &O::shading, wordsOf(scene::kShadingWords),
             "how surfaces are drawn; default by what the scene holds"),
        choice(
            "aa", &O::samples, {"1", "2", "4", "8", "16"}, "samples",
            "antialiasing: at least so many samples a pixel; default by error, 4",
            "2 and 4 share their shading; of 8 (9 are drawn) and 16 each is shaded, and outlines "
            "keep to 1/8 and 1/16 px."),
        word("filter", &O::filter, wordsOf(scene::kFilterWords), "texture filter; default mipmap"),
        number("error", &O::errorPx, 0.01, 64, "px",
               "tessellation on demand: greatest error; default 0.25",
               "It also chooses the default of aa: 1 sample above 2 px, 8 from 0.125 px down, 16 "
               "from 0.0625."),
        number("budget_ms", &O::budgetMs, 0.1, 60000, "ms",
               "chooses aa and error, where they are not given, by the expected time of a frame",
               "No clock is read: the same request gives the same bytes. X-Farol-Quality has what "
               "was chosen."),
        flag("axes", &O::axes, "draws the axes: X red, Y green, Z blue"),
        flag("curves", &O::curves, "draws the curves that groups move along"),
        flag("focus", &O::focus, "draws a white cube at the camera's target"),
        flag("debug", &O::debug, "writes what was drawn into the image"),
        text("background", &O::background,
             "#rrggbb, r,g,b (0..255), a colour's name, transparent, or an image's file",
             "a colour, transparent, or a file's name",
             "what stands behind everything; default black"),
        text("entity", &O::entity, "a scene file of the bundle", "a scene file's name",
             "drawn before the third-person camera"),
        word("format", &O::format, formatWords(), "of the image; default png",
             "A request without it is answered by its Accept header."),
        integer("quality", &O::quality, 1, 100, "", "of " + lossyFormats() + "; default 90"),
        word("layer", &O::layer, wordsOf(kLayerWords), "what the pixels show; default color"),
        word("missing", &O::missing, wordsOf(kMissingWords),
             "what a missing or damaged file does; default error",
             "placeholder draws a checker for a texture and a checkered unit box for a mesh, and "
             "leaves out parts of the document that cannot be read. The errors stay in the "
             "findings."),
        word("viewer", &O::viewer, wordsOf(scene::kViewerWords),
             "specular highlights as OpenGL's default, or exact"),
        word("specular", &O::specular, wordsOf(scene::kSpecularWords),
             "highlights under the texture, or on top of it"),
        word("transparency", &O::transparency, wordsOf(scene::kTransparencyWords),
             "of textures and materials that are not opaque; default on",
             "on draws see-through models after the others, the farthest first; exact sorts the "
             "surfaces in each pixel, so that models that pass through each other are right; off "
             "draws all opaque."),
        word("shadows", &O::shadows, wordsOf(scene::kShadowsWords),
             "of the models in the lights; default off",
             "map draws hard shadows of opaque and cut-out models with shading phong, by maps of "
             "the depths that each light sees. See-through models, lines and the surroundings "
             "cast none."),
        number("scale", &O::scale, 0.1, 1, "", "of width and height, for fast frames; default 1"),
    };
}

const std::vector<OptionSpec>& specs() {
    static const std::vector<OptionSpec> kSpecs = makeSpecs();
    return kSpecs;
}

}  // namespace

std::span<const OptionSpec> optionSpecs() { return specs(); }

void applyOption(PictureOptions& options, const std::string& name, const std::string& value) {
    const std::vector<OptionSpec>& all = specs();
    const auto spec = std::find_if(all.begin(), all.end(),
                                   [&](const OptionSpec& one) { return one.name == name; });
    if (spec != all.end()) return spec->apply(options, value);
    std::vector<std::string> names;
    for (const OptionSpec& one : all) names.push_back(one.name);
    const std::string hint = didYouMean(name, names);
    throw Error(message<"option.unknown/picture">("name"_arg = name, "suggestion"_arg = hint), {},
                name.substr(0, 64));
}

}  // namespace farol::render
