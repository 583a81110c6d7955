#pragma once

#include <map>
#include <string>

#include "render/gl/objects.h"

namespace farol::render::gl {

/// What a program is made for: the text of its #defines, one "#define NAME [VALUE]" a line. Only
/// what a draw needs is compiled into its shader.
struct ProgramKey {
    std::string stage;  ///< "model", "line" or "window": the shader files' name
    std::string defines;
    bool operator<(const ProgramKey& other) const {
        return stage != other.stage ? stage < other.stage : defines < other.defines;
    }
};

/// A linked program and where its uniforms are (-1: not used).
struct LinkedProgram {
    Program program;
    GLint viewFromObject, normalFromObject, clipFromView, worldFromView;
    GLint materialDiffuse, materialBase, materialAmbient, materialSpecular, materialShininess;
    GLint unitFromObject, unitEye, surfaceLengths, surfaceForm, surfaceUv, surfaceDiscs, balance,
        seenFrom;
    GLint lightCount, plainColor, planeS, planeT, nearest, tangents;
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

/// Binding of the Lights uniform block, and of the one texture unit.
inline constexpr GLuint kLightsBinding = 0;

}  // namespace farol::render::gl
