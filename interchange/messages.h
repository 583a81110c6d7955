#pragma once

#include "core/message.h"

namespace farol::interchange {

inline constexpr MessageRow kInterchangeMessages[] = {
    {"convert.approximated",
     "{format} cannot express {feature}; written as {instead}",
     {"glTF", "the attenuation of this light", "the square of the distance"}},
    {"convert.left-out", "{format} cannot express {feature}; left out", {"glTF", "the background"}},
    {"limit.instances/document",
     "the document would have more than {max} groups; scatter fewer copies",
     {"20000"}},
    {"limit.model/bytes",
     "the model would be larger than {max} MiB; write coarser shapes or smaller textures",
     {"256"}},
    {"limit.model/nodes",
     "the model would have more than {max} nodes; write fewer groups or scattered copies",
     {"250000"}},
    {"limit.model/samples",
     "the animation would have more than {max} samples; give a shorter time range in <render>",
     {"1000000"}},
    {"limit.model/size",
     "a model is scaled or moved beyond {max}; lower the factors of <scale>",
     {"3.4e38"}},
    {"part.feature-ambient", "the brightness of ambient light"},
    {"part.feature-animation", "the motion of groups"},
    {"part.feature-attenuation", "the attenuation of this light"},
    {"part.feature-axes", "axis lines"},
    {"part.feature-background", "the background"},
    {"part.feature-camera", "the camera"},
    {"part.feature-camera-light", "lights that move with the viewer"},
    {"part.feature-chess", "the chess pattern of faces"},
    {"part.feature-chess-texture", "chess textures"},
    {"part.feature-cycles", "colours that turn with the time"},
    {"part.feature-default-color", "the default colours of a mesh file"},
    {"part.feature-entity", "the entity in front of the camera"},
    {"part.feature-exponent", "the exponent of this spot light"},
    {"part.feature-eye-texgen", "texture coordinates in the space of the viewer"},
    {"part.feature-filter", "the filter of a texture"},
    {"part.feature-group-light", "that a light of a group lights only this group"},
    {"part.feature-light-color", "colours of lights"},
    {"part.feature-lights", "lights"},
    {"part.feature-lod", "a model with lod=\"auto\""},
    {"part.feature-loop", "motions that never meet again within an hour"},
    {"part.feature-mapping", "generated texture coordinates"},
    {"part.feature-ninth-light", "more than eight lights"},
    {"part.feature-opacity", "opacity"},
    {"part.feature-settings", "the settings of <render>"},
    {"part.feature-skybox", "the skybox"},
    {"part.feature-two-sided", "models whose back faces are drawn"},
    {"part.feature-uv", "another layout of texture coordinates"},
    {"part.feature-wide-spot", "a cone of more than 90 degrees"},
    {"part.instead-all-lit", "a light of all models"},
    {"part.instead-even-cone", "a cone of even light"},
    {"part.instead-first-color", "the colour at the first moment"},
    {"part.instead-first-moment", "the scene at the first moment"},
    {"part.instead-inner-cone", "a cone that fades from its middle"},
    {"part.instead-longest", "one period of the longest motion"},
    {"part.instead-point", "a point light"},
    {"part.instead-square", "a light that falls off with the square of the distance"},
};

/// A message of this floor's table.
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kInterchangeMessages>(arguments...);
}

}  // namespace farol::interchange
