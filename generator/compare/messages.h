#pragma once

#include "core/message.h"

namespace farol::generator {

/// Findings about a mesh that is checked against an expected one.
inline constexpr MessageRow kCheckMessages[] = {
    {"check.axes", "its axes are exchanged or mirrored: x y z are at {found}", {"x z -y"}},
    {"check.cap", "a flat side is missing: {count} triangles about {place}", {"10", "0 0 0"}},
    {"check.degenerate",
     "triangle {triangle} has no area: two of its corners are at {place}",
     {"12", "0 1 0"}},
    {"check.divisions",
     "{share} % of its vertices are vertices of the expected mesh; expected other divisions, or "
     "another shape: it has {found} triangles, expected {expected}",
     {"12", "264", "180"}},
    {"check.doubled", "triangle {triangle} is there twice", {"12"}},
    {"check.doubled/back",
     "triangle {triangle} is the back of another one; expected one side only",
     {"12"}},
    {"check.extra",
     "triangle {triangle} (vertices on lines {lines}) is not in the expected mesh",
     {"12", "5, 6, 16"}},
    {"check.missing", "no triangle joins the vertices on lines {lines}", {"5, 6, 16"}},
    {"check.missing/place", "no triangle joins {places}", {"0 1 0, 1 0 0 and 0 0 1"}},
    {"check.more", "{count} more findings of this kind", {"17"}},
    {"check.normals", "its normal is {found}; expected {expected}", {"0 1 0", "0 0 1"}},
    {"check.normals/flat",
     "the normals of {count} vertices are those of the faces; expected those of the surface",
     {"180"}},
    {"check.normals/inward", "the normals of {count} vertices point inward; negate them", {"180"}},
    {"check.normals/length",
     "the normals of {count} vertices have a length of {length}; normalise them",
     {"180", "2"}},
    {"check.normals/none", "the file has no normals; they were computed from the triangles"},
    {"check.place",
     "the middle of the mesh is at {found}; expected {expected}",
     {"0 1 0", "0 0 0"}},
    {"check.position", "the vertex is at {found}; expected {expected}", {"0 1 0", "0 0.9 0"}},
    {"check.position/extra",
     "the vertex at {found} is not in the expected mesh; the nearest one is {distance} away",
     {"0 1 0", "0.1"}},
    {"check.seam", "its texture coordinates start elsewhere: accepted"},
    {"check.size",
     "the mesh is {found} large along x, y, z; expected {expected}",
     {"2 2 2", "1 1 1"}},
    {"check.t-junction",
     "the vertex lies inside the edge between the vertices on lines {lines}, whose triangle has no "
     "vertex there",
     {"5 and 6"}},
    {"check.turned", "its divisions start {degrees} degrees about y away: accepted", {"18"}},
    {"check.uv", "its texture coordinate is {found}; expected {expected}", {"0 1", "0 0"}},
    {"check.uv/flipped", "its texture coordinates run the other way up: write 1 - v"},
    {"check.uv/mirrored", "its texture coordinates run the other way round: write 1 - u"},
    {"check.uv/none", "the file has no texture coordinates"},
    {"check.uv/swapped", "u and v of its texture coordinates are exchanged"},
    {"check.uv/turned", "its texture coordinates are turned by half: write 1 - u and 1 - v"},
    {"check.winding",
     "triangle {triangle} is clockwise seen from outside; exchange two of its vertices",
     {"12"}},
    {"check.winding/all",
     "all {count} triangles are clockwise seen from outside; exchange two vertices of each",
     {"180"}},
};

/// A message of the table above.
template <FixedString kId, FixedString... kNames>
Message checkMessage(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kCheckMessages>(arguments...);
}

}  // namespace farol::generator
