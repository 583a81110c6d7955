#include "generator/io/formats.h"
#include "generator/io/writer.h"

namespace farol::generator::io {

std::string encodeObj(const Mesh& mesh) {
    Writer out;
    for (std::size_t i = 0; i < mesh.positions().size(); ++i) {
        out.text("v ");
        out.place(mesh, i);
        for (int k = 0; k < 3 && !mesh.colors().empty(); ++k) {
            out.text(" ");
            out.number(static_cast<float>(mesh.colors()[i][k]) / 255.0F);
        }
        out.text("\n");
    }
    if (mesh.normals().empty()) out.text("s 1\n");  // else they would be facets when read
    for (const glm::vec2& uv : mesh.uvs()) out.row({uv.x, uv.y}, "vt");
    for (const glm::vec3& n : mesh.normals()) out.row({n.x, n.y, n.z}, "vn");
    for (std::size_t i = 0; i < mesh.indices().size(); ++i) {
        const std::uint64_t number = std::uint64_t{mesh.indices()[i]} + 1;
        out.text(i % 3 == 0 ? "f " : " ");
        out.number(number);
        if (!mesh.uvs().empty() || !mesh.normals().empty()) out.text("/");
        if (!mesh.uvs().empty()) out.number(number);
        if (!mesh.normals().empty()) {
            out.text("/");
            out.number(number);
        }
        if (i % 3 == 2) out.text("\n");
    }
    return out.take();
}

}  // namespace farol::generator::io
