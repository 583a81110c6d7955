#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <string>

#include "image/image.h"
#include "render/renderer.h"
#include "scene/files/assets.h"

/// Random scenes over many powers of ten. The default run draws a fixed part of each sweep;
/// `scripts/test numerics` sets FAROL_SWEEP_SEED and FAROL_SWEEP_TIMES for long ones.
namespace farol::numerics {

/// A sweep's random numbers and length.
class Sweep {
  public:
    /// `cases`: of the default run. Prints the seed where it is not the fixed one.
    Sweep(const char* name, int cases);
    int cases() const { return cases_; }
    /// Evenly in [low, high).
    double between(double low, double high);
    /// Evenly in the exponent: 0 < low < high.
    double power(double low, double high);
    bool chance(double share) { return between(0.0, 1.0) < share; }

  private:
    std::mt19937_64 random_;
    int cases_;
};

/// A number as exact text.
std::string text(double value);
/// `name="x y z"` as three attributes: x="..." y="..." z="...".
std::string xyz(const glm::dvec3& value);

/// A camera as a scene has it.
struct Camera {
    glm::dvec3 eye{0.0}, target{0.0}, up{0.0, 1.0, 0.0};
    double fovDeg = 60.0, near = 0.1, far = 1000.0;

    /// <camera> for a scene.
    std::string xml() const;
    /// World direction of the ray through a place of a square image, px from its upper left; its
    /// part along the view is 1.
    glm::dvec3 ray(double x, double y, int side) const;
};

/// Draws a scene square, one sample a pixel unless the options say otherwise.
image::Image draw(const std::string& xml, int side, render::PictureOptions options = {},
                  const std::map<std::string, std::string>& files = {});
/// The same with NaN and infinity in magenta.
image::Image drawMarked(const std::string& xml, int side, const render::PictureOptions& options);

glm::ivec3 pixel(const image::Image& image, int x, int y);

}  // namespace farol::numerics
