"""A sitting hare, looking towards +Z: ellipsoids melted into one another, meshed by surface nets
(Gibson 1998), one vertex a cell that the surface crosses."""

from math import cos, radians, sin, sqrt

from .meshes import ply_binary

# centre, half axes, turn about X in degrees (positive tips the top forwards); x is mirrored where
# it is not 0.
_PARTS = [
    ((0.0, 0.62, -0.12), (0.50, 0.56, 0.66), 0),     # body
    ((0.0, 0.84, 0.26), (0.36, 0.50, 0.36), 18),     # chest
    ((0.34, 0.40, -0.30), (0.22, 0.38, 0.42), -15),  # haunches
    ((0.34, 0.10, 0.10), (0.13, 0.10, 0.38), 0),     # hind feet
    ((0.19, 0.30, 0.48), (0.10, 0.36, 0.11), 4),     # fore legs
    ((0.19, 0.07, 0.58), (0.11, 0.08, 0.17), 0),     # fore paws
    ((0.0, 1.32, 0.48), (0.27, 0.28, 0.34), 18),     # head
    ((0.0, 1.24, 0.74), (0.15, 0.14, 0.16), 0),      # muzzle
    ((0.13, 1.22, 0.66), (0.12, 0.11, 0.13), 0),     # cheeks
    ((0.15, 1.86, 0.20), (0.115, 0.48, 0.09), -24), # ears
    ((0.0, 0.52, -0.82), (0.17, 0.17, 0.16), 0),     # tail
]
_MELT = 0.11  # how far parts flow together


def _solid():
    out = []
    for (x, y, z), axes, turn in _PARTS:
        c, s = cos(radians(turn)), sin(radians(turn))
        for side in ((x, -x) if x else (0.0,)):
            out.append((side, y, z, *axes, c, s))
    return out


def _distance(parts, x, y, z):
    """About the distance to the surface, negative inside."""
    best = 9.0
    for cx, cy, cz, ax, ay, az, c, s in parts:
        px, qy, qz = x - cx, y - cy, z - cz
        py, pz = qy * c + qz * s, qz * c - qy * s
        ux, uy, uz = px / ax, py / ay, pz / az
        k0 = sqrt(ux * ux + uy * uy + uz * uz)
        if k0 < 1e-6:
            d = -min(ax, ay, az)
        else:
            vx, vy, vz = ux / ax, uy / ay, uz / az
            d = k0 * (k0 - 1) / sqrt(vx * vx + vy * vy + vz * vz)
        h = abs(best - d)
        best = min(best, d) - ((_MELT - h) ** 2 / (4 * _MELT) if h < _MELT else 0.0)
    return best


def hare(cell=0.05):
    parts = _solid()
    low, high = (-0.75, -0.12, -1.15), (0.75, 2.5, 1.1)
    n = [int((high[i] - low[i]) / cell) + 2 for i in range(3)]

    def at(i, j, k):
        return (i * n[1] + j) * n[2] + k

    values = []
    for i in range(n[0]):
        for j in range(n[1]):
            for k in range(n[2]):
                point = (low[0] + i * cell, low[1] + j * cell, low[2] + k * cell)
                values.append(_distance(parts, *point))
    corners = [(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
    edges = [
        (p, q)
        for p in corners
        for q in corners
        if p < q and sum(abs(x - y) for x, y in zip(p, q)) == 1
    ]
    vertices, number = [], {}
    for i in range(n[0] - 1):
        for j in range(n[1] - 1):
            for k in range(n[2] - 1):
                d = {p: values[at(i + p[0], j + p[1], k + p[2])] for p in corners}
                if min(d.values()) >= 0 or max(d.values()) < 0:
                    continue
                total, count = [0.0, 0.0, 0.0], 0
                for p, q in edges:
                    if (d[p] < 0) != (d[q] < 0):
                        t = d[p] / (d[p] - d[q])
                        for axis in range(3):
                            total[axis] += p[axis] + t * (q[axis] - p[axis])
                        count += 1
                number[i, j, k] = len(vertices)
                vertices.append(tuple(
                    low[a] + ((i, j, k)[a] + total[a] / count) * cell for a in range(3)))
    faces = []
    for (i, j, k) in list(number):
        for axis in range(3):
            step = [0, 0, 0]
            step[axis] = 1
            here = values[at(i, j, k)]
            there = values[at(i + step[0], j + step[1], k + step[2])]
            if (here < 0) == (there < 0):
                continue
            b, c = (axis + 1) % 3, (axis + 2) % 3
            ring = []
            for db, dc in ((0, 0), (-1, 0), (-1, -1), (0, -1)):
                cellAt = [i, j, k]
                cellAt[b] += db
                cellAt[c] += dc
                ring.append(number[tuple(cellAt)])
            if here >= 0:
                ring.reverse()
            faces += [(ring[0], ring[1], ring[2]), (ring[0], ring[2], ring[3])]
    return ply_binary(vertices, faces)
