// Every mesh format, profiles and patch files; what is read can be written and read back equal.
#include <algorithm>
#include <optional>

#include "generator/io/mesh_file.h"
#include "generator/io/mtl.h"
#include "generator/io/patch_file.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

namespace io = generator::io;

/// Decodes under a name, and checks what comes of it.
std::optional<generator::Mesh> tryDecode(std::string_view bytes, const std::string& name) {
    try {
        Diagnostics findings;
        generator::Mesh mesh = io::decodeMesh(bytes, name, findings);
        checkDiagnostics(findings, name, bytes);
        checkMesh(mesh);
        require(!mesh.indices().empty(), "a mesh without triangles");
        require(mesh.normals().size() == mesh.positions().size(), "a mesh without normals");
        return mesh;
    } catch (const Error& error) {
        checkError(error, name, bytes);
        return std::nullopt;
    }
}

/// True for meshes that differ in nothing that the format keeps: no format keeps parts or whole
/// turns of texture coordinates, text of our own no colours. Far from the origin the places' last
/// bits may decide for another origin: then they agree to what a float holds of the mesh.
bool agrees(const generator::Mesh& mesh, const generator::Mesh& again, io::Format format) {
    generator::MeshArrays kept = mesh.arrays(), read = again.arrays();
    kept.parts.clear();
    kept.uvOrigin = glm::dvec2(0.0);
    if (format == io::Format::text3d) kept.colors.clear();
    if (kept == read) return true;
    if (kept.origin == glm::dvec3(0.0) || kept.positions.size() != read.positions.size())
        return false;
    double size = 0.0, away = glm::length(kept.origin);
    for (const glm::vec3& place : kept.positions)
        size = std::max(size, glm::length(glm::dvec3(place)));
    for (std::size_t i = 0; i < kept.positions.size(); ++i)
        if (glm::length(mesh.place(i) - again.place(i)) > 1e-5 * size + 1e-14 * away) return false;
    return kept.indices == read.indices && kept.colors == read.colors && kept.uvs == read.uvs;
}

void checkWritten(const generator::Mesh& mesh) {
    for (const auto format :
         {io::Format::text3d, io::Format::obj, io::Format::ply, io::Format::binary}) {
        Diagnostics findings;
        try {
            require(agrees(mesh, io::decodeMesh(io::encodeMesh(mesh, format), "again", findings),
                           format),
                    "read back, the mesh is another (format " +
                        std::to_string(static_cast<int>(format)) + ")");
        } catch (const Error& error) {
            throw Finding("what was written is refused (format " +
                          std::to_string(static_cast<int>(format)) + "): " + error.what());
        }
    }
}

void tryProfile(std::string_view bytes) {
    try {
        for (const glm::dvec3& point : io::decodeProfile(bytes, "a.ply"))
            for (int i = 0; i < 3; ++i)
                require(std::isfinite(point[i]), "a profile's point that is not finite");
        reached("profile");
    } catch (const Error& error) {
        checkError(error, "a.ply", bytes);
    }
}

void tryMaterials(std::string_view bytes) {
    require(io::materialLibraries(bytes).size() <= 16, "too many material files");
    Diagnostics findings;
    for (const scene::PartMaterial& one : io::parseMtl(bytes, "a.mtl", findings)) {
        const scene::Material& material = one.material;
        for (const glm::vec3& color : {material.diffuse.rgb, material.ambient.rgb,
                                       material.specular.rgb, material.emissive.rgb})
            for (int k = 0; k < 3; ++k)
                require(color[k] >= 0.0F && color[k] <= 1.0F, "a colour out of range");
        require(material.shininess >= 0.0F, "a shininess below 0");
        require(!one.texture || (!one.texture->file.empty() && one.texture->file.size() < 2000),
                "a texture's name without bound");
        reached("material");
    }
    checkDiagnostics(findings, "a.mtl", bytes);
}

void tryPatch(std::string_view bytes) {
    try {
        const io::PatchFile file = io::parsePatchFile(bytes, "a.patch");
        for (const auto& patch : file.patches)
            for (const std::uint32_t index : patch)
                require(index < file.points.size(), "a patch's index out of range");
        for (const glm::dvec3& point : file.points)
            for (int i = 0; i < 3; ++i)
                require(std::isfinite(point[i]), "a control point that is not finite");
        reached("patch");
    } catch (const Error& error) {
        checkError(error, "a.patch", bytes);
    }
}

/// A mutated binary mesh with its checksum put right, so that what it guards is met too.
std::optional<std::string> withChecksum(std::string_view bytes) {
    if (!bytes.starts_with("FAROL3D\n") || bytes.size() < 32) return std::nullopt;
    std::string out(bytes.substr(0, bytes.size() - 8));
    std::uint64_t hash = 14695981039346656037U;
    for (const char c : out) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    for (int i = 0; i < 8; ++i) out += static_cast<char>(hash >> (8 * i) & 0xFFU);
    return out;
}

}  // namespace

const Target& target() {
    static const Target made{
        {"3d", "3db", "ply", "obj", "tri", "patch", "txt", "stl", "off", "mtl"},
        {"ply\n",
         "format ascii 1.0\n",
         "format binary_little_endian 1.0\n",
         "format binary_big_endian 1.0\n",
         "element vertex 3\n",
         "element face 1\n",
         "element edge 4000000000\n",
         "property float x\n",
         "property double y\n",
         "property uchar z\n",
         "property list uchar int vertex_indices\n",
         "property list uint double vertex_index\n",
         "end_header\n",
         "comment x\n",
         "v 0 0 0\n",
         "vn 0 0 1\n",
         "vt 0 0\n",
         "f 1 2 3\n",
         "f 1/1/1 2/2/2 3/3/3\n",
         "f 1//1 2//2 3//3\n",
         "f -1 -2 -3\n",
         "s 1\n",
         "s off\n",
         "usemtl a b\n",
         "mtllib x y.mtl\n",
         "newmtl a b\n",
         "Kd 1 0.5 0\n",
         "map_Kd -s 2 2 -o .5 0 -clamp on a b.png\n",
         "v 0 0 0 1 .5 0\n",
         "property uchar red\nproperty uchar green\nproperty uchar blue\n",
         "element tristrips 1\nproperty list int int vertex_indices\n",
         "COFF\n",
         "STCNOFF\n",
         "solid x\nfacet\n",
         "VERTEX 0 1 2\n",
         "VERTICES:\n",
         "\"indices\":[",
         "<vertex x=\"1\" y=\"2\" z=\"3\"/>",
         "<triangle>0 1 2</triangle>",
         "nan(ind)",
         "1.#QNAN",
         "1e9 ",
         "\xFF\xFE",
         "\\\n",
         "\n\n",
         "\r\n",
         ";",
         ",",
         "# x\n",
         "// x\n",
         "0 0 0\n",
         "0 1 2\n",
         "FAROL3D\n",
         "\xEF\xBB\xBF"},
        512};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol::fuzz;
    const std::string_view bytes(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    for (const char* name : {"a.3d", "a.tri", "a.patch"})
        if (const auto mesh = tryDecode(bytes, name); mesh && mesh->triangles() < 20'000)
            checkWritten(*mesh);
    if (const auto mended = withChecksum(bytes))
        if (const auto mesh = tryDecode(*mended, "a.3db")) checkWritten(*mesh);
    for (const char* name : {"a.stl", "a.off", "a.obj"}) tryDecode(bytes, name);
    tryMaterials(bytes);
    tryProfile(bytes);
    tryPatch(bytes);
    return 0;
}
