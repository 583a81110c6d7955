#include "generator/compare/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/number.h"
#include "generator/compare/checked.h"
#include "generator/compare/messages.h"
#include "generator/compare/vertex_lines.h"
#include "generator/io/raw_mesh.h"
#include "generator/io/sniff.h"
#include "generator/messages.h"

namespace farol::generator {
namespace {

/// The file as it is: neither winding nor normals are repaired.
compare::Checked read(std::string_view bytes, const std::string& fileName) {
    compare::Checked out;
    io::RawMesh raw = io::decodeRaw(bytes, fileName);
    if (raw.indices.empty()) throw Error(message<"mesh.empty/triangles">(), {fileName, 0, 0});
    out.arrays = io::settle(raw);
    checkStructure(out.arrays, fileName);
    for (const glm::vec3& position : out.arrays.positions)
        out.at.push_back(out.arrays.origin + glm::dvec3(position));
    out.lines = vertexLines(bytes, out.at);
    return out;
}

/// Gives each place an id: the expected one's, else a new one.
void number(const compare::Expected& expected, compare::Checked& checked) {
    const auto known = static_cast<int>(expected.places.all().size());
    compare::Places others(expected.places.reach());
    for (const glm::dvec3& at : checked.at) {
        const int id = expected.places.find(at);
        checked.idOf.push_back(id >= 0 ? id : known + others.add(at));
    }
    checked.others = others.all();
}

std::size_t countPlaces(const compare::Checked& checked) {
    std::set<int> used;
    for (const std::uint32_t index : checked.arrays.indices) used.insert(checked.idOf[index]);
    return used.size();
}

}  // namespace

bool MeshCheck::isRight() const {
    return std::none_of(findings.begin(), findings.end(),
                        [](const Diagnostic& one) { return one.severity == Severity::error; });
}

MeshCheck checkMesh(std::string_view bytes, const std::string& fileName, const Mesh& expected) {
    constexpr double kOther = 0.5;  // share of places: below it is another mesh
    compare::Checked checked = read(bytes, fileName);
    const compare::Expected theirs(expected);
    compare::Findings findings(fileName);
    const double share = compare::align(theirs, checked, findings);
    number(theirs, checked);
    MeshCheck out;
    out.triangles = checked.arrays.triangles();
    out.expectedTriangles = expected.triangles();
    out.places = countPlaces(checked);
    out.expectedPlaces = theirs.places.all().size();
    if (share < kOther) {
        findings.add(Severity::error,
                     checkMessage<"check.divisions">(
                         "share"_arg = std::round(1000.0 * share) / 10.0,
                         "found"_arg = out.triangles, "expected"_arg = out.expectedTriangles));
    } else {
        const std::vector<compare::Matched> matched =
            compare::matchTriangles(theirs, checked, findings);
        compare::compareCorners(theirs, checked, matched, findings);
    }
    out.findings = findings.take();
    return out;
}

}  // namespace farol::generator
