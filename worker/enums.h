#pragma once

#include "core/error.h"
#include "core/language.h"
#include "image/animation.h"
#include "image/format.h"
#include "render/options.h"
#include "scene/scene.h"

/// The last value of each enumeration in messages; larger values are refused (worker/wire.h).
namespace farol {
constexpr Severity lastOf(Severity) { return Severity::error; }
constexpr Language lastOf(Language) { return Language::cs; }
}  // namespace farol

namespace farol::scene {
constexpr Shading lastOf(Shading) { return Shading::phong; }
constexpr Filter lastOf(Filter) { return Filter::anisotropic; }
constexpr Viewer lastOf(Viewer) { return Viewer::local; }
constexpr Specular lastOf(Specular) { return Specular::separate; }
constexpr Transparency lastOf(Transparency) { return Transparency::exact; }
constexpr Shadows lastOf(Shadows) { return Shadows::map; }
}  // namespace farol::scene

namespace farol::image {
constexpr Format lastOf(Format) { return kLastFormat; }
constexpr AnimationFormat lastOf(AnimationFormat) { return kLastAnimation; }
}  // namespace farol::image

namespace farol::render {
constexpr Layer lastOf(Layer) { return Layer::id; }
constexpr Missing lastOf(Missing) { return Missing::placeholder; }
constexpr CameraStart lastOf(CameraStart) { return CameraStart::engine; }
}  // namespace farol::render
