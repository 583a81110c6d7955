#pragma once

#include <string>

#include "image/image.h"
#include "render/renderer.h"

/// Small scenes drawn at 64 x 64 px, and properties of their images.
namespace farol::stress {

inline constexpr const char* kCamera =
    R"(<window width="64" height="64"/><camera><position x="1" y="2" z="4"/><lookAt x="0" y="0" z="0"/>
       <projection fov="50" near="0.5" far="100"/></camera>)";
inline constexpr const char* kSun =
    R"(<lights><light type="directional" dirx="1" diry="2" dirz="1.5"/></lights>)";

/// A scene of these models in the sun, before the usual camera or one of these elements.
std::string world(const std::string& models, const std::string& camera = "");
/// A sphere, a cone and a box, all of it moved along X together with its camera.
std::string still(double away);

/// Draws with aa=1 by default.
image::Image draw(const std::string& xml, render::PictureOptions options = {});
/// The code of the error that drawing ends in; "" where it does not.
std::string codeOf(const std::string& xml);

glm::ivec3 pixel(const image::Image& image, int x, int y);
bool lit(const image::Image& image, int x, int y);
/// Pixels that are not black.
int covered(const image::Image& image);
/// Share of pixels of which a channel differs by more than `levels`; 1 where the sizes do.
double shareOff(const image::Image& a, const image::Image& b, int levels);

}  // namespace farol::stress
