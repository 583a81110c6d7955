#pragma once

#include <compare>
#include <map>
#include <string_view>

#include "render/gl/objects.h"
#include "render/plan/features.h"

namespace farol::render::gl {

/// Shader files of a program.
enum class Shaders { model, line, window };

/// Features of a program: only those that a draw needs are compiled into its shader.
struct ProgramKey {
    Shaders shaders = Shaders::model;
    FeatureSet features;
    int count = 0;                      ///< of lights (lightCount) or samples (resolve)
    int samples = 0;                    ///< of the target (eachSample)
    int shadows = 0;                    ///< of the lights (shadowed)
    int shadowCascades = 0;             ///< of those (shadowCascade)
    int shadowCubes = 0;                ///< of those (shadowCube)
    std::string_view surfaceKind = {};  ///< generator::SurfaceKind::glsl
    auto operator<=>(const ProgramKey&) const = default;
};

/// A linked program and where its uniforms are (-1: not used).
struct LinkedProgram {
    Program program;
    GLint viewFromObject, normalFromObject, clipFromView, worldFromView;
    GLint materialDiffuse, materialBase, materialAmbient, materialSpecular, materialShininess;
    GLint unitFromObject, unitEye, surfaceLengths, surfaceForm, surfaceUv, surfaceDiscs, balance,
        seenFrom;
    GLint lightCount, plainColor, planeS, planeT, uvFrom, mappedFrom, nearest, tangents,
        samplesAcross;
    GLint opacity, samplePlaces, shadowOffset;
};

/// Programs by key, compiled once. Throws std::runtime_error with the compiler's log: a shader
/// that does not compile is our bug.
class ProgramCache {
  public:
    explicit ProgramCache(const Api& api) : api_(api) {}
    const LinkedProgram& get(const ProgramKey& key);

  private:
    const Api& api_;
    std::map<ProgramKey, LinkedProgram> programs_;
};

/// Bindings of the uniform blocks Lights and ShadowLights.
inline constexpr GLuint kLightsBinding = 0, kShadowLightsBinding = 1;

/// Texture units: pictures; in peeled layers the depths of opaque surfaces and of the layer before;
/// shadow maps.
inline constexpr GLenum kPictureUnit = 0, kOpaqueDepthUnit = 1, kLayerDepthUnit = 2,
                        kShadowUnit = 3;

}  // namespace farol::render::gl
