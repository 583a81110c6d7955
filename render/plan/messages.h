#pragma once

#include "core/message.h"

namespace farol::render {

/// Messages of this floor, by code.
inline constexpr MessageRow kRenderMessages[] = {
    {"asset.missing/image-file",
     "cannot read the image \"{file}\"; add it to the scene's files, or correct the name",
     {"wood.png"}},
    {"image.alpha",
     "image \"{file}\" has see-through parts, which are drawn opaque; transparency=on shows them",
     {"leaf.png"}},
    {"image.alpha/unset",
     "the alpha of image \"{file}\" is 0 everywhere, so it is drawn opaque; export it without "
     "alpha",
     {"leaf.tga"}},
    {"image.cross",
     "the skybox \"{file}\" is {width} x {height} px; expected a cross of 4 x 3 squares, such as "
     "1024 x 768 px",
     {"sky.png", "512", "512"}},
    {"image.damaged",
     "image \"{file}\" {damage}; the pixels that are lost are grey; export the file again",
     {"wood.jpg", "is cut off"}},
    {"image.scaled",
     "image \"{file}\" is {width} x {height} px, more than the GL takes; using {used}; scale the "
     "image "
     "down",
     {"wood.png", "20000", "2", "16384 x 2 px"}},
    {"limit.cost/frames",
     "the estimated cost is {cost} core-seconds for {size} px, {samples} samples, {triangles} "
     "triangles and {frames} frames; expected at most {most}; {advice}",
     {"12", "4096 x 4096", "16", "3000000", "10", "5", "lower frames, width or height"}},
    {"limit.cost/images",
     "the estimated cost is {cost} core-seconds for {work}; expected at most {most}; use fewer or "
     "smaller images",
     {"12", "comparing images of 4000 x 4000 px", "5"}},
    {"limit.instances/models", "the scene has more than {most} models", {"100000"}},
    {"limit.layers",
     "about {count} see-through surfaces are behind each other in a pixel, of which the nearest "
     "{max} are drawn; use fewer, or transparency=\"on\"",
     {"200", "64"}},
    {"limit.lights/placed", "the scene has more than {most} lights", {"64"}},
    {"limit.pixels/side",
     "the image is {width} x {height} px; expected at most {most} px a side",
     {"9000", "16", "4096"}},
    {"limit.shadows",
     "lights without shadows: {count}; an image has at most {max} shadow maps, and a light that "
     "shines to all sides needs up to 6; use fewer lights",
     {"2", "64"}},
    {"option.camera/far", "far is {far}; expected more than near, {near}", {"1", "2"}},
    {"option.camera/orbit",
     "both eye and an orbit are given; expected either eye, or azimuth, elevation and distance"},
    {"option.camera/same-point",
     "the eye and the target of the camera are the same point; move one of them"},
    {"option.range/background",
     "background is \"{value}\"; expected #rrggbb, r,g,b (each 0 to 255), the name of a basic "
     "colour, transparent, or an image among the scene's files",
     {"#ff"}},
    {"option.range/entity",
     "entity is \"{value}\"; expected a scene file among the scene's files",
     {"hero.xml"}},
    {"option.range/picture",
     "{name} is \"{value}\"; expected {expected}",
     {"width", "0", "1 to 4096 px"}},
    {"option.unknown/picture",
     "there is no image option \"{name}\"[; did you mean \"{suggestion}\"?]",
     {"widht", "width"}},
    {"part.cost-rest", "{left} after the frames before it", {"2.5"}},
    {"part.cost-whole", "{whole}", {"5"}},
    {"part.fewer-triangles", "use fewer triangles or models, or a larger error"},
    {"part.lower-aa", "lower aa, width or height"},
    {"part.lower-aa-or-triangles", "lower aa, or use fewer triangles or models"},
    {"part.lower-frames", "lower frames, width or height"},
    {"part.lower-size", "lower width or height"},
    {"part.fewer-see-through",
     "use transparency=\"on\", or fewer see-through models behind each other"},
    {"part.lower-size-or-layers",
     "lower width or height, or use fewer lights or models behind each other"},
    {"part.models-all", "all {count} models are", {"3"}},
    {"part.models-one", "this model is"},
    {"part.models-some", "{count} of {total} models are", {"2", "5"}},
    {"scene.blank/before-near",
     "too little of the scene is visible: {models} nearer than the near plane of the camera "
     "({near}); "
     "use a smaller near or move the camera back",
     {"this model is", "1"}},
    {"scene.blank/behind",
     "too little of the scene is visible: {models} behind the camera at {eye}; set its lookAt to "
     "{middle}",
     {"this model is", "0 0 5", "0 0 9"}},
    {"scene.blank/beyond-far",
     "too little of the scene is visible: {models} beyond the far plane of the camera ({far}); "
     "use a larger far or move the camera closer",
     {"this model is", "1000"}},
    {"scene.blank/black",
     "too little of the scene is visible: {models} black; add a <color> or a texture",
     {"this model is"}},
    {"scene.blank/camera-inside",
     "too little of the scene is visible: {models} around the camera, which sees only back faces; "
     "move the camera from {eye} out of the model",
     {"this model is", "0 0 0"}},
    {"scene.blank/facing-away",
     "too little of the scene is visible: {models} seen from the back, and back faces are not "
     "drawn; "
     "move the camera to the other side or turn the model by 180 degrees",
     {"this model is"}},
    {"scene.blank/no-extent",
     "too little of the scene is visible: {models} without any size; check that no factor of "
     "<scale> is 0",
     {"this model is"}},
    {"scene.blank/outside",
     "too little of the scene is visible: {models} outside the view of the camera; set its lookAt "
     "to {middle}",
     {"this model is", "50 0 0"}},
    {"scene.blank/too-small",
     "too little of the scene is visible: {models} smaller than a pixel; move the camera from "
     "{eye} "
     "closer to {middle}",
     {"this model is", "0 0 5000", "0 0 0"}},
    {"scene.blank/unlit",
     "too little of the scene is visible: {models} reached by no light; move a light, point it at "
     "the "
     "model, or give the model an ambient colour",
     {"this model is"}},
    {"scene.camera-start/engine",
     "using the start of the 2017 engine: eye 0 0 0, looking along +Z, 45 degrees"},
    {"scene.camera-start/framed", "using a view that frames all models"},
    {"scene.camera-start/none",
     "no <camera>; using a view that frames all models (camera=\"engine\" gives the start of the "
     "2017 engine)"},
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
    {"scene.opacity",
     "{count} models have an opacity under 1 and are drawn opaque; transparency=on shows through "
     "them",
     {"2"}},
    {"scene.outline",
     "the camera is so close to the surface of this model that its outline may be {error} px off, "
     "with {most} divisions of a turn; move the camera away, or use a smaller model",
     {"12", "1024"}},
    {"scene.shadows",
     "shadows=\"map\" has no effect with shading \"{shading}\", whose pixels are not lit; use "
     "shading=\"phong\"",
     {"gouraud"}},
    {"scene.shadows/unlit", "shadows=\"map\" has no effect without lights; add a light"},
};

/// A message of this floor: message<"scene.light-inside">("line"_arg = line).
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kRenderMessages>(arguments...);
}

}  // namespace farol::render
