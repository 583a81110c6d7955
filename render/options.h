#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace farol::render {

enum class Format { png, jpeg, webp };
enum class Layer { color, depth, normal, id };

inline constexpr int kMaxSide = 4096;                   ///< px
inline constexpr std::int64_t kMaxPixels = 16'777'216;  ///< of one picture

inline constexpr double kDefaultErrorPx = 0.25;

/// The picture options of the command line and of the service; what is unset is the scene's own
/// choice, else the default named in optionSpecs().
struct PictureOptions {
    std::optional<int> width, height;  ///< 1..4096 px, at most kMaxPixels
    std::optional<glm::dvec3> eye, target, up;
    std::optional<double> azimuthDeg, elevationDeg, distance;  ///< an orbit about target
    std::optional<double> fovDeg, near, far;
    double timeS = 0.0;
    std::optional<scene::Shading> shading;
    std::optional<int> samples;  ///< 1, 2, 4, 8, 16; default 4
    std::optional<scene::Filter> filter;
    std::optional<double> errorPx;  ///< tessellation on demand; default kDefaultErrorPx
    /// 0.1..60000: what neither request nor scene says of samples and error (quality.h)
    std::optional<double> budgetMs;
    std::optional<bool> axes;
    bool curves = false, focus = false, debug = false;
    std::optional<std::string>
        background;  ///< "#rrggbb", "r,g,b", a name, "transparent" or an asset
    std::optional<std::string> entity;
    Format format = Format::png;
    int quality = 90;  ///< jpeg and webp, 1..100
    Layer layer = Layer::color;
    std::optional<scene::Viewer> viewer;
    std::optional<scene::Specular> specular;
    double scale = 1.0;  ///< of width and height, 0.1..1
};

/// One option as flags and query parameters know it.
struct OptionSpec {
    std::string name;   ///< "width"
    std::string range;  ///< "1..4096 px", for help and messages
    std::string help;
    void (*apply)(PictureOptions&, const std::string& value);  ///< throws Error option.*
};

/// All options, in the order of the help.
std::span<const OptionSpec> optionSpecs();

/// Sets one option by name. Throws Error option.unknown (with a did-you-mean) or option.range
/// (names the option and its range); Diagnostic::field is the option's name.
void applyOption(PictureOptions& options, const std::string& name, const std::string& value);

}  // namespace farol::render
