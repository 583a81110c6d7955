#pragma once

#include "core/message.h"

namespace farol::generator {

inline constexpr MessageRow kGeneratorMessages[] = {
    {"asset.missing/file",
     "there is no file \"{file}\"[; {fix}]",
     {"comet.patch", "did you mean \"teapot.patch\"?"}},
    {"asset.missing/model",
     "there is no file \"{file}\", no generator comment for it, and its name is no shape's; {fix}",
     {"trous.3d", "did you mean \"torus.3d\"?"}},
    {"asset.outside",
     "\"{file}\" cannot be read; {fix}",
     {"../meshes/cone.3d", "send both in one archive"}},
    {"mesh.assumed",
     "the faces of the PLY file have no \"property\" line; read as \"property list uchar int "
     "vertex_indices\""},
    {"mesh.assumed/base", "the indices of the OBJ file count from 0; OBJ counts from 1"},
    {"mesh.count-wrong/ply",
     "the header of the PLY file has {count} faces, but the file holds {held}; these are drawn",
     {"12", "11"}},
    {"mesh.count-wrong/soup",
     "the count in the first line, {count}, is not that of the vertices, triangles or numbers that "
     "follow; all {vertices} vertices are drawn",
     {"22", "6"}},
    {"mesh.count-wrong/stl",
     "the header of the STL file has the count {count}, but the file holds {held} triangles; all "
     "{held} are drawn",
     {"12", "11"}},
    {"mesh.empty/off", "the OFF file holds no faces"},
    {"mesh.format/other",
     "looks like {kind}, not a mesh; expected rows of numbers, OBJ, PLY, STL or OFF",
     {"an image"}},
    {"mesh.format/words",
     "the mesh file holds words and no coordinates; it begins with \"{start}\", expected rows of "
     "numbers like \"0 1.5 -2\", OBJ, PLY, STL or OFF",
     {"to be done"}},
    {"mesh.left-out", "not read of \"{file}\": {list}", {"box.obj", "2 lines, 1 points"}},
    {"mesh.material/file",
     "the material file \"{file}\" of \"{mesh}\" is missing; its materials are not drawn",
     {"box.mtl", "box.obj"}},
    {"mesh.material/texture",
     "the texture \"{file}\" of the material \"{material}\" is missing; the material is drawn "
     "without it",
     {"wood.png", "table"}},
    {"mesh.number/place", "a coordinate is no finite number within 1e18"},
    {"mesh.replaced",
     "cannot read the mesh \"{file}\": {problem}; drawn as \"{shape}\", which its name or comment "
     "says",
     {"plane_2_3.3d", "\"PLANE\" is not a number", "plane 2 3"}},
    {"mesh.truncated/off", "the OFF file ends before its last face"},
    {"part.point-for-comma", "write a point for the comma: \"{name}\"", {"box_1.5.3d"}},
};

/// A message of this floor: message<"mesh.left-out">("file"_arg = name, "list"_arg = list).
template <FixedString kId, FixedString... kNames>
Message message(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kGeneratorMessages>(arguments...);
}

}  // namespace farol::generator
