#pragma once

#include "core/message.h"

namespace farol::grade {

/// The findings that students see of a hidden reference: one text for each criterion, without any
/// value, count or direction.
inline constexpr MessageRow kStudentMessages[] = {
    {"part.differs/animation", "a motion here differs from the assignment"},
    {"part.differs/camera", "the camera differs from the assignment"},
    {"part.differs/lights", "a light here differs from the assignment"},
    {"part.differs/materials", "a material or the shading here differs from the assignment"},
    {"part.differs/missing", "the scene lacks a part of the assignment"},
    {"part.differs/models", "an object here differs from the assignment"},
    {"part.differs/textures", "a texture here differs from the assignment"},
    {"part.differs/transforms", "a transform here differs from the assignment"},
};

/// A message of this table.
template <FixedString kId, FixedString... kNames>
Message studentMessage(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kStudentMessages>(arguments...);
}

}  // namespace farol::grade
