#pragma once

#include "core/message.h"

namespace farol::render {

/// Messages of this floor, by code.
inline constexpr MessageRow kRenderMessages[] = {
    {"part.models-all", "all {count} models are", {"3"}},
    {"part.models-one", "this model is"},
    {"part.models-some", "{count} of {total} models are", {"2", "5"}},
    {"scene.blank/no-extent",
     "too little of the scene is visible: {models} without any size; check that no factor of "
     "<scale> is 0",
     {"this model is"}},
    {"scene.blank/behind",
     "too little of the scene is visible: {models} behind the camera at {eye}; set its lookAt to "
     "{middle}",
     {"this model is", "0 0 5", "0 0 9"}},
    {"scene.blank/before-near",
     "too little of the scene is visible: {models} nearer than the near plane of the camera "
     "({near}); "
     "use a smaller near or move the camera back",
     {"this model is", "1"}},
    {"scene.blank/beyond-far",
     "too little of the scene is visible: {models} beyond the far plane of the camera ({far}); "
     "use a larger far or move the camera closer",
     {"this model is", "1000"}},
    {"scene.blank/outside",
     "too little of the scene is visible: {models} outside the view of the camera; set its lookAt "
     "to {middle}",
     {"this model is", "50 0 0"}},
    {"scene.blank/too-small",
     "too little of the scene is visible: {models} smaller than a pixel; move the camera from "
     "{eye} "
     "closer to {middle}",
     {"this model is", "0 0 5000", "0 0 0"}},
    {"scene.blank/camera-inside",
     "too little of the scene is visible: {models} around the camera, which sees only back faces; "
     "move the camera from {eye} out of the model",
     {"this model is", "0 0 0"}},
    {"scene.blank/facing-away",
     "too little of the scene is visible: {models} seen from the back, and back faces are not "
     "drawn; "
     "move the camera to the other side or turn the model by 180 degrees",
     {"this model is"}},
    {"scene.blank/black",
     "too little of the scene is visible: {models} black; add a <color> or a texture",
     {"this model is"}},
    {"scene.blank/unlit",
     "too little of the scene is visible: {models} reached by no light; move a light, point it at "
     "the "
     "model, or give the model an ambient colour",
     {"this model is"}},
    {"scene.light-below",
     "the directional light shines from below: its vector {vector} points towards the light "
     "(did you mean {suggestion}?)",
     {"0 -1 0", "0 1 0"}},
    {"scene.light-inside",
     "this solid is dark outside: its only light, at line {line}, is inside it; move the light out "
     "or "
     "give the solid an emissive colour",
     {"12"}},
    {"scene.light-unused",
     "this light has no effect: its group contains no model; move it to the <lights> of the scene "
     "or "
     "into the group of the models"},
};

/// A message of this floor: message<"scene.light-inside">("line"_arg = line).
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kRenderMessages>(arguments...);
}

}  // namespace farol::render
