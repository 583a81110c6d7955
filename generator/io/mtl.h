#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "scene/scene.h"

namespace farol::generator::io {

/// The names behind an OBJ's "mtllib" lines: each line's whole rest (names may hold blanks). At
/// most 16.
std::vector<std::string> materialLibraries(std::string_view obj);

/// The materials of an .mtl file, without the files that their textures mean (Texture::path): Kd,
/// Ks, Ke, Ns, d, Tr, illum, and map_Kd with -s, -o and -clamp. Ambient is a quarter of Kd, as in
/// scene::Material's defaults; Ka is not used, since exporters write 0 or 1 for every object. Other
/// maps and unknown lines are one info. Does not throw.
std::vector<scene::PartMaterial> parseMtl(std::string_view bytes, const std::string& fileName,
                                          Diagnostics& findings);

}  // namespace farol::generator::io
