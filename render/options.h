#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/enum_words.h"
#include "image/format.h"
#include "scene/scene.h"

namespace farol::render {

enum class Layer { color, depth, normal, id };
inline constexpr EnumWords<Layer, Layer::id> kLayerWords{"color", "depth", "normal", "id"};

/// The initial camera: the scene's (framed if it has none), a view that frames all models, or that
/// of the 2017 engine.
enum class CameraStart { scene, framed, engine };
inline constexpr EnumWords<CameraStart, CameraStart::engine> kCameraStartWords{"scene", "framed",
                                                                               "engine"};

/// The result where a file or a part of the document cannot be read: an error and no image, or an
/// image with placeholders and the errors beside it.
enum class Missing { error, placeholder };
inline constexpr EnumWords<Missing, Missing::placeholder> kMissingWords{"error", "placeholder"};

inline constexpr int kMaxSide = 4096;                   ///< px
inline constexpr std::int64_t kMaxPixels = 16'777'216;  ///< of one picture

inline constexpr double kDefaultErrorPx = 0.25;

/// A camera's place about its target; unset values are the scene's.
struct Orbit {
    std::optional<double> azimuthDeg, elevationDeg, distance;
    bool isSet() const { return azimuthDeg || elevationDeg || distance; }
};

/// The render options of the command line and of the service; unset ones take the scene's
/// setting, else the default of optionSpecs().
struct PictureOptions {
    std::optional<int> width, height;  ///< 1..4096 px, at most kMaxPixels
    CameraStart camera = CameraStart::scene;
    std::optional<glm::dvec3> eye, target, up;
    Orbit orbit;  ///< about target, in place of eye
    std::optional<double> fovDeg, near, far;
    double timeS = 0.0;
    std::optional<scene::Shading> shading;
    std::optional<int> samples;  ///< 1, 2, 4, 8, 16; default 4
    std::optional<scene::Filter> filter;
    std::optional<double> errorPx;  ///< tessellation on demand; default kDefaultErrorPx
    /// 0.1 to 60000 ms: chooses samples and error where they are not set (quality.h)
    std::optional<double> budgetMs;
    std::optional<bool> axes;
    bool curves = false, focus = false, debug = false;
    std::optional<std::string>
        background;  ///< "#rrggbb", "r,g,b", a name, "transparent" or an asset
    std::optional<std::string> entity;
    image::Format format = image::Format::png;
    int quality = 90;  ///< jpeg and webp, 1..100
    Layer layer = Layer::color;
    std::optional<scene::Viewer> viewer;
    std::optional<scene::Specular> specular;
    std::optional<scene::Transparency> transparency;
    std::optional<scene::Shadows> shadows;
    Missing missing = Missing::error;
    double scale = 1.0;  ///< of width and height, 0.1..1
};

enum class OptionType { number, integer, flag, word, vector, text };

/// One option, of which its flag, its query parameter and their descriptions are made.
struct OptionSpec {
    std::string name;  ///< "width"
    OptionType type = OptionType::text;
    double min = 0, max = 0;         ///< of numbers and integers, inclusive
    std::vector<std::string> words;  ///< of type word; of integers of which only some are valid
    std::string range;               ///< "1..4096 px", for help and messages
    std::string help;
    std::string details;  ///< sentences for which a help line has no room; may be empty
    std::function<void(PictureOptions&, const std::string& value)> apply;  ///< throws option.range
};

/// All options, in the order of the help.
std::span<const OptionSpec> optionSpecs();

/// Sets one option by name. Throws Error option.unknown (with a did-you-mean) or option.range
/// (names the option and its range); Diagnostic::field is the option's name.
void applyOption(PictureOptions& options, const std::string& name, const std::string& value);

}  // namespace farol::render
