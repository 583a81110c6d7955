#include "tests/fuzz/checks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/utf16.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

bool isCode(const std::string& code) {
    const auto dot = code.find('.');
    return dot != std::string::npos && dot > 0 && dot + 1 < code.size() &&
           std::all_of(code.begin(), code.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
           });
}

/// Lengths of the lines of a text. In XML, and in texts without a line feed, a lone carriage return
/// ends one too. Of UTF-16 they are counted in UTF-8.
std::vector<std::size_t> lengthsOf(std::string_view text, bool xml) {
    if (const auto wide = utf16ToUtf8(text)) return lengthsOf(*wide, xml);
    std::vector<std::size_t> lengths{0};
    xml = xml || (text.find('\n') == std::string_view::npos &&
                  text.substr(0, 4096).find('\0') == std::string_view::npos);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool alone = text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n');
        ++lengths.back();
        if (text[i] == '\n' || (xml && alone)) lengths.push_back(0);
    }
    return lengths;
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void checkDiagnostics(const Diagnostics& diagnostics, std::string_view file,
                      std::string_view text) {
    // A message may quote a name or a value, shortened; nothing makes it longer than this.
    constexpr std::size_t kMaxBytes = 2000;
    const std::vector<std::size_t> lengths = lengthsOf(text, file.ends_with(".xml"));
    for (const Diagnostic& one : diagnostics) {
        const std::string what = one.code + " \"" + one.message.substr(0, 200) + "\" at line " +
                                 std::to_string(one.where.line) + " column " +
                                 std::to_string(one.where.column);
        require(isCode(one.code), "no code: " + what);
        require(!one.message.empty(), "no message: " + what);
        require(one.message.size() <= kMaxBytes, "a message without bound: " + what);
        require(one.where.line >= 0 && one.where.column >= 0, "a negative place: " + what);
        require(one.where.line > 0 || one.where.column == 0, "a column without a line: " + what);
        if (!file.empty() && one.where.file == file && one.where.line > 0) {
            const auto line = static_cast<std::size_t>(one.where.line);
            require(line <= lengths.size(), "a line beyond the end: " + what);
            require(static_cast<std::size_t>(one.where.column) <= lengths[line - 1] + 1,
                    "a column beyond the line's end: " + what);
        }
        reached(one.code);
    }
}

void checkError(const Error& error, std::string_view file, std::string_view text) {
    const Diagnostics& all = error.diagnostics();
    require(std::any_of(all.begin(), all.end(),
                        [](const auto& one) { return one.severity == Severity::error; }),
            "an Error without an error");
    checkDiagnostics(all, file, text);
}

void checkMesh(const generator::Mesh& mesh) {
    const std::size_t count = mesh.positions().size();
    require(mesh.indices().size() % 3 == 0, "part of a triangle");
    require(mesh.normals().empty() || mesh.normals().size() == count, "another number of normals");
    require(mesh.uvs().empty() || mesh.uvs().size() == count, "another number of UVs");
    require(mesh.colors().empty() || mesh.colors().size() == count, "another number of colours");
    require(mesh.triangles() <= 5'000'000, "more triangles than are allowed");
    require(finite(glm::vec3(mesh.origin())), "an origin that is not finite");
    std::size_t inParts = 0;
    for (const generator::MeshPart& part : mesh.parts()) {
        require(part.first == inParts, "parts that are not in order");
        inParts += part.count;
    }
    require(mesh.parts().empty() || inParts == mesh.indices().size(),
            "parts that do not cover the mesh");
    for (const std::uint32_t index : mesh.indices())
        require(index < count, "an index out of range");
    for (const glm::vec3& p : mesh.positions()) require(finite(p), "a position that is not finite");
    for (const glm::vec3& n : mesh.normals()) {
        require(finite(n), "a normal that is not finite");
        // Normalised in float: a few units in the last place.
        require(std::abs(glm::length(glm::dvec3(n)) - 1.0) < 1e-5, "a normal not of unit length");
    }
    for (const glm::vec2& uv : mesh.uvs())
        require(std::isfinite(uv.x) && std::isfinite(uv.y), "a UV that is not finite");
}

}  // namespace farol::fuzz
