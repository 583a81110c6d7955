#include "render/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "scene/text.h"
#include "scene/words.h"

namespace farol::render {
namespace {

[[noreturn]] void outOfRange(const std::string& name, const std::string& value,
                             const std::string& range) {
    throw Error("option.range",
                name + "=" + scene::shown(value) + " is not valid: " + name + " takes " + range, {},
                name);
}

double parseNumber(const std::string& name, const std::string& text, double min, double max,
                   const char* range) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
    const auto [at, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || at != end || !std::isfinite(value) || value < min || value > max)
        outOfRange(name, text, range);
    return value;
}

int parseInt(const std::string& name, const std::string& text, int min, int max,
             const char* range) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || at != end || value < min || value > max)
        outOfRange(name, text, range);
    return value;
}

bool parseFlag(const std::string& name, const std::string& text) {
    if (text == "1" || text == "true") return true;
    if (text == "0" || text == "false") return false;
    outOfRange(name, text, "0 or 1");
}

constexpr double kFar = 1e12;  // beyond it a float of the eye-relative position says nothing

glm::dvec3 parseVector(const std::string& name, const std::string& text) {
    constexpr const char* kRange = "three numbers x,y,z within +-1e12";
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

template <typename Enum, std::size_t N>
Enum parseName(const std::string& name, const std::string& text,
               const std::array<std::pair<const char*, Enum>, N>& names) {
    std::string all;
    for (const auto& [word, value] : names) {
        if (text == word) return value;
        all += (all.empty() ? "" : "|") + std::string(word);
    }
    outOfRange(name, text, all);
}

constexpr std::array<std::pair<const char*, scene::Shading>, 7> kShadings{
    {{"points", scene::Shading::points},
     {"wireframe", scene::Shading::wireframe},
     {"solid", scene::Shading::solid},
     {"chess", scene::Shading::chess},
     {"flat", scene::Shading::flat},
     {"gouraud", scene::Shading::gouraud},
     {"phong", scene::Shading::phong}}};
constexpr std::array<std::pair<const char*, scene::Filter>, 4> kFilters{
    {{"nearest", scene::Filter::nearest},
     {"linear", scene::Filter::linear},
     {"mipmap", scene::Filter::mipmap},
     {"anisotropic", scene::Filter::anisotropic}}};
constexpr std::array<std::pair<const char*, Format>, 3> kFormats{
    {{"png", Format::png}, {"jpeg", Format::jpeg}, {"webp", Format::webp}}};
constexpr std::array<std::pair<const char*, Layer>, 4> kLayers{{{"color", Layer::color},
                                                                {"depth", Layer::depth},
                                                                {"normal", Layer::normal},
                                                                {"id", Layer::id}}};
constexpr std::array<std::pair<const char*, scene::Viewer>, 2> kViewers{
    {{"infinite", scene::Viewer::infinite}, {"local", scene::Viewer::local}}};

using O = PictureOptions;
using S = const std::string;

const std::array<OptionSpec, 29> kSpecs{{
    {"width", "1..4096 px", "picture width; default the scene's window, else 512",
     [](O& o, S& v) { o.width = parseInt("width", v, 1, kMaxSide, "1..4096 px"); }},
    {"height", "1..4096 px", "picture height; default the scene's window, else 512",
     [](O& o, S& v) { o.height = parseInt("height", v, 1, kMaxSide, "1..4096 px"); }},
    {"eye", "x,y,z", "camera position, world units",
     [](O& o, S& v) { o.eye = parseVector("eye", v); }},
    {"target", "x,y,z", "point looked at, world units",
     [](O& o, S& v) { o.target = parseVector("target", v); }},
    {"up", "x,y,z", "direction that is up in the picture",
     [](O& o, S& v) { o.up = parseVector("up", v); }},
    {"azimuth", "-36000..36000 degrees", "orbit about the target: longitude, 0 is from +Z",
     [](O& o, S& v) {
         o.azimuthDeg = parseNumber("azimuth", v, -36000, 36000, "-36000..36000 degrees");
     }},
    {"elevation", "-90..90 degrees", "orbit about the target: latitude, 90 is from above",
     [](O& o, S& v) { o.elevationDeg = parseNumber("elevation", v, -90, 90, "-90..90 degrees"); }},
    {"distance", "1e-6..1e12", "orbit about the target: distance, world units",
     [](O& o, S& v) { o.distance = parseNumber("distance", v, 1e-6, kFar, "1e-6..1e12"); }},
    {"fov", "0.01..179 degrees", "vertical field of view",
     [](O& o, S& v) { o.fovDeg = parseNumber("fov", v, 0.01, 179, "0.01..179 degrees"); }},
    {"near", "1e-6..1e12", "nearest distance drawn, world units",
     [](O& o, S& v) { o.near = parseNumber("near", v, 1e-6, kFar, "1e-6..1e12"); }},
    {"far", "1e-6..1e12", "farthest distance drawn, world units, more than near",
     [](O& o, S& v) { o.far = parseNumber("far", v, 1e-6, kFar, "1e-6..1e12"); }},
    {"time", "-1e9..1e9 s", "moment of the animation; default 0",
     [](O& o, S& v) { o.timeS = parseNumber("time", v, -1e9, 1e9, "-1e9..1e9 s"); }},
    {"shading", "points|wireframe|solid|chess|flat|gouraud|phong",
     "default: by what the scene holds",
     [](O& o, S& v) { o.shading = parseName("shading", v, kShadings); }},
    {"aa", "1|2|4|8|16 samples",
     "antialiasing, samples a pixel; 8 and 16 are shaded each; default by error, 4",
     [](O& o, S& v) {
         const int n = parseInt("aa", v, 1, 16, "1|2|4|8|16 samples");
         if ((n & (n - 1)) != 0) outOfRange("aa", v, "1|2|4|8|16 samples");
         o.samples = n;
     }},
    {"filter", "nearest|linear|mipmap|anisotropic", "texture filter; default mipmap",
     [](O& o, S& v) { o.filter = parseName("filter", v, kFilters); }},
    {"error", "0.01..64 px", "tessellation on demand: greatest error; default 0.25",
     [](O& o, S& v) { o.errorPx = parseNumber("error", v, 0.01, 64, "0.01..64 px"); }},
    {"budget_ms", "0.1..60000 ms",
     "chooses aa and error, where they are not given, by the expected time of a frame",
     [](O& o, S& v) { o.budgetMs = parseNumber("budget_ms", v, 0.1, 60000, "0.1..60000 ms"); }},
    {"axes", "0 or 1", "draws the axes: X red, Y green, Z blue",
     [](O& o, S& v) { o.axes = parseFlag("axes", v); }},
    {"curves", "0 or 1", "draws the curves that groups move along",
     [](O& o, S& v) { o.curves = parseFlag("curves", v); }},
    {"focus", "0 or 1", "draws a white cube at the camera's target",
     [](O& o, S& v) { o.focus = parseFlag("focus", v); }},
    {"debug", "0 or 1", "writes what was drawn into the picture",
     [](O& o, S& v) { o.debug = parseFlag("debug", v); }},
    {"background", "#rrggbb, r,g,b (0..255), a colour's name, transparent, or a picture's file",
     "what stands behind everything; default black",
     [](O& o, S& v) {
         if (v.empty() || v.size() > 1024)
             outOfRange("background", v.substr(0, 40), "a colour, transparent, or a file's name");
         o.background = v;
     }},
    {"entity", "a scene file of the bundle", "drawn before the third-person camera",
     [](O& o, S& v) {
         if (v.empty() || v.size() > 1024)
             outOfRange("entity", v.substr(0, 40), "a scene file's name");
         o.entity = v;
     }},
    {"format", "png|jpeg|webp", "of the picture; default png",
     [](O& o, S& v) { o.format = parseName("format", v, kFormats); }},
    {"quality", "1..100", "of jpeg and webp; default 90",
     [](O& o, S& v) { o.quality = parseInt("quality", v, 1, 100, "1..100"); }},
    {"layer", "color|depth|normal|id", "what the pixels show; default color",
     [](O& o, S& v) { o.layer = parseName("layer", v, kLayers); }},
    {"viewer", "infinite|local", "specular highlights as OpenGL's default, or exact",
     [](O& o, S& v) { o.viewer = parseName("viewer", v, kViewers); }},
    {"specular", "single|separate", "highlights under the texture, or on top of it",
     [](O& o, S& v) {
         o.specular = parseName(
             "specular", v,
             std::array<std::pair<const char*, scene::Specular>, 2>{
                 {{"single", scene::Specular::single}, {"separate", scene::Specular::separate}}});
     }},
    {"scale", "0.1..1", "of width and height, for fast frames; default 1",
     [](O& o, S& v) { o.scale = parseNumber("scale", v, 0.1, 1, "0.1..1"); }},
}};

}  // namespace

std::span<const OptionSpec> optionSpecs() { return kSpecs; }

void applyOption(PictureOptions& options, const std::string& name, const std::string& value) {
    const auto spec = std::find_if(kSpecs.begin(), kSpecs.end(),
                                   [&](const OptionSpec& one) { return one.name == name; });
    if (spec != kSpecs.end()) return spec->apply(options, value);
    std::vector<std::string> names;
    for (const OptionSpec& one : kSpecs) names.push_back(one.name);
    const std::string hint = scene::didYouMean(name, names);
    throw Error("option.unknown",
                "there is no picture option '" + name.substr(0, 64) + "'" +
                    (hint.empty() ? "" : "; did you mean '" + hint + "'?"),
                {}, name.substr(0, 64));
}

}  // namespace farol::render
