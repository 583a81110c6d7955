#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "generator/io/raw_mesh.h"

namespace farol::generator::io {

/// The role of numbers, by the words of a file that names its lists.
enum class Role { none, positions, normals, uvs, indices, component };

/// The role of a word, any case: "v", "Vertices", "positions", "vertice", "n", "normals", "uv",
/// "texcoords", "i", "faces", "triangles", ...; `component` for x, y, z and the like.
Role roleOf(std::string_view word);

/// Returns the list of the number after a component's word; `list` is the list that it stands in.
Role componentOf(std::string_view word, Role list);

/// Numbers by their role, in the file's order, and the mesh that they make.
class Gathered {
  public:
    explicit Gathered(const std::string& file) : file_(file) {}

    /// Adds the numbers of one line (or element) that have one role. Eight positions are a place, a
    /// normal and a texture coordinate, five a place and a coordinate, six a place and a normal
    /// where the latter has unit length; one is a count.
    void add(Role role, const std::vector<double>& run, int line);

    bool hasPositions() const { return positions_.size() >= 9; }

    /// Without indices every three places are a triangle; indices that count from 1 are known by
    /// the last vertex. One normal is that of all. Throws Error mesh.*.
    RawMesh take();

  private:
    [[noreturn]] void fail(Message message, int line) const {
        throw Error(std::move(message), {file_, line, line > 0 ? 1 : 0});
    }
    void takeIndices(RawMesh& mesh);

    const std::string& file_;
    std::vector<double> positions_, normals_, uvs_, indices_;
    std::vector<std::size_t> indexRuns_;  ///< lengths, of the first few
    int firstPosition_ = 1, lastLine_ = 1, firstIndex_ = 1;
    std::size_t unknown_ = 0;  ///< numbers without a role
};

}  // namespace farol::generator::io
