"""Meshes that no primitive gives: rocks, an island, a hare, a comet of patches, profiles to
revolve and a lighthouse's beam. Right-handed, +Y up, counter-clockwise seen from outside."""

import struct
from math import cos, pi, sin, sqrt

from .noise import Noise


def _normalized(p):
    length = sqrt(sum(c * c for c in p)) or 1.0
    return [c / length for c in p]


def ply(vertices, faces=()):
    """PLY as text; without faces it is a profile."""
    head = ["ply", "format ascii 1.0", f"element vertex {len(vertices)}"]
    head += [f"property float {c}" for c in "xyz"]
    if faces:
        head += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
    lines = head + ["end_header"]
    lines += [" ".join(f"{c:.5g}" for c in v) for v in vertices]
    lines += [" ".join(map(str, (len(f), *f))) for f in faces]
    return ("\n".join(lines) + "\n").encode()


def ply_binary(vertices, faces):
    head = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(vertices)}\n"
    head += "".join(f"property float {c}\n" for c in "xyz")
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    return (
        head.encode()
        + b"".join(struct.pack("<3f", *v) for v in vertices)
        + b"".join(struct.pack("<B3i", 3, *f) for f in faces)
    )


def obj(vertices, uvs, normals, faces):
    lines = [f"v {x:.3f} {y:.3f} {z:.3f}" for x, y, z in vertices]
    lines += [f"vt {u:.3f} {v:.3f}" for u, v in uvs]
    lines += [f"vn {x:.3f} {y:.3f} {z:.3f}" for x, y, z in normals]
    lines += ["f " + " ".join(f"{i + 1}/{i + 1}/{i + 1}" for i in f) for f in faces]
    return ("\n".join(lines) + "\n").encode()


def _icosphere(levels):
    g = (1 + sqrt(5)) / 2
    points = [_normalized(p) for p in (
        (-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
        (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1))]
    faces = [
        (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
        (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
        (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middle, finer = {}, []

        def between(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(_normalized([points[a][i] + points[b][i] for i in range(3)]))
            return middle[key]

        for a, b, c in faces:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return points, faces


def asteroid(seed=601, levels=2):
    noise = Noise(seed)
    points, faces = _icosphere(levels)
    shaped = []
    for x, y, z in points:
        r = (1 + 0.5 * noise.at(1.1 * x + 2, 1.1 * y, 1.1 * z)
            + 0.22 * noise.at(2.7 * x, 2.7 * y + 4, 2.7 * z))
        shaped.append((r * x, 0.8 * r * y, 0.9 * r * z))
    return ply(shaped, faces)


def island():
    """A crag of radius about 5 with a flat top of radius 1.9 at y = 1; its foot is under water."""
    noise, rings, sectors = Noise(611), 20, 60

    def place(i, j):
        a = 2 * pi * j / sectors
        x, z = sin(a), cos(a)
        t = i / rings
        rim = 4.3 + 1.0 * noise.fractal(1.1 * x + 3, 1.1 * z, 0.5, 3)
        r = 1.9 * min(1.0, t / 0.2) if t < 0.2 else 1.9 + (rim - 1.9) * (t - 0.2) / 0.8
        fall = max(0.0, (t - 0.2) / 0.8)
        y = 1 - 1.5 * fall**1.35
        if fall > 0:
            rough = min(1.0, 4 * fall)
            y += rough * 0.5 * noise.fractal(r * x * 0.8, r * z * 0.8, 1.3, 4)
            r += rough * 0.25 * noise.fractal(r * x, y * 2.2, r * z, 3)
        return [r * x, y, r * z]

    grid = [[place(i, j % sectors) for j in range(sectors + 1)] for i in range(rings + 1)]
    vertices, uvs, normals, faces = [], [], [], []
    for i in range(rings + 1):
        for j in range(sectors + 1):
            left, right = grid[i][(j - 1) % sectors], grid[i][(j + 1) % sectors]
            inner, outer = grid[max(0, i - 1)][j], grid[min(rings, i + 1)][j]
            du = [right[k] - left[k] for k in range(3)]
            dv = [outer[k] - inner[k] for k in range(3)]
            n = [
                dv[1] * du[2] - dv[2] * du[1],
                dv[2] * du[0] - dv[0] * du[2],
                dv[0] * du[1] - dv[1] * du[0],
            ]
            vertices.append(grid[i][j])
            uvs.append((j / sectors, 1 - i / rings))
            normals.append(_normalized(n) if i > 0 else [0, 1, 0])
    for i in range(rings):
        for j in range(sectors):
            a, b = i * (sectors + 1) + j, (i + 1) * (sectors + 1) + j
            faces.append((a, b, b + 1))
            if i > 0:
                faces.append((a, b + 1, a + 1))
    return obj(vertices, uvs, normals, faces)


def beam(length=44.0, near=0.34, far=3.4, slices=40):
    """The mantle of a cone along +Z, without ends; v = 1 at the lamp, 0 far out."""
    stations = [0, 0.03, 0.08, 0.15, 0.25, 0.4, 0.6, 0.8, 1]
    vertices, uvs, normals, faces = [], [], [], []
    for t in stations:
        r = near + (far - near) * t
        for j in range(slices + 1):
            a = 2 * pi * j / slices
            vertices.append((r * cos(a), r * sin(a), length * t))
            uvs.append((j / slices, 0.99 - 0.98 * t))  # clear of the texture's wrapped edge
            normals.append(_normalized((cos(a), sin(a), (near - far) / length)))
    for i in range(len(stations) - 1):
        for j in range(slices):
            a, b = i * (slices + 1) + j, (i + 1) * (slices + 1) + j
            faces += [(a, a + 1, b + 1), (a, b + 1, b)]
    return obj(vertices, uvs, normals, faces)


# A comet: profiles of cubic Bezier segments (along, radius) turned about X by four quarter patches.

_ROUND = 0.5522847  # the cubic's arm for a quarter circle


def patches(segments, bumps=None):
    """A `.patch` file. Rows run along the profile towards -X, columns round it, so that the
    surface faces outwards; `bumps(x, y, z)` may move a control point."""
    points, rows = [], []
    quarter = [(1.0, 0.0), (1.0, _ROUND), (_ROUND, 1.0), (0.0, 1.0)]
    for segment in segments:
        for q in range(4):
            c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[q]
            rows.append(list(range(len(points), len(points) + 16)))
            for along, radius in segment:
                for a, b in reversed(quarter):
                    p = (along, radius * (a * c - b * s), radius * (a * s + b * c))
                    points.append(bumps(*p) if bumps else p)
    lines = [str(len(rows))] + [", ".join(map(str, row)) for row in rows]
    lines += [str(len(points))] + [", ".join(f"{c:.6g}" for c in p) for p in points]
    return ("\n".join(lines) + "\n").encode()


def comet_head():
    noise = Noise(621)

    def bumps(x, y, z):
        k = 1 + 0.22 * noise.at(1.3 * x + 0.2, 1.3 * y, 1.3 * z)
        return k * x, k * y, k * z

    k = _ROUND
    return patches(
        [[(1.1, 0), (1.1, k), (1.1 * k, 1), (0, 1)], [(0, 1), (-1.2 * k, 1), (-1.2, k), (-1.2, 0)]],
        bumps,
    )


def comet_tail():
    return patches([
        [(0.75, 0), (0.75, 0.7), (0.3, 1.12), (-0.6, 1.12)],
        [(-0.6, 1.12), (-3.5, 1.12), (-7.0, 0.62), (-12.0, 0.0)],
    ])


# Profiles: x is the radius, y the height; a point given twice makes a crease.

def _profile(points):
    return ply([(x, y, 0.0) for x, y in points])


def can_body():
    return _profile([(1.0, 0.28), (1.0, 0.9), (1.0, 1.6), (1.0, 2.3), (1.0, 2.98)])


def can_top():
    return _profile([
        (1.0, 2.98), (0.985, 3.03), (0.94, 3.1), (0.885, 3.17), (0.86, 3.2), (0.86, 3.2),
        (0.895, 3.22), (0.9, 3.26), (0.87, 3.285), (0.84, 3.26), (0.825, 3.2), (0.8, 3.14),
        (0.76, 3.12), (0.4, 3.12), (0.0, 3.12)])


def can_bottom():
    return _profile([
        (0.0, 0.17), (0.35, 0.14), (0.6, 0.06), (0.7, 0.0), (0.74, 0.0), (0.78, 0.03),
        (0.84, 0.1), (0.93, 0.19), (0.985, 0.245), (1.0, 0.28)])


def pawn():
    """A chess pawn, 2.6 high on a base of radius 0.8."""
    outline = [
        (0.0, 0.0), (0.8, 0.0), (0.8, 0.0), (0.82, 0.08), (0.8, 0.2), (0.72, 0.27), (0.66, 0.29),
        (0.66, 0.29), (0.68, 0.36), (0.62, 0.44), (0.5, 0.54), (0.4, 0.68), (0.33, 0.88),
        (0.28, 1.12), (0.25, 1.36), (0.24, 1.52), (0.28, 1.58), (0.42, 1.62), (0.47, 1.67),
        (0.42, 1.73), (0.3, 1.77), (0.3, 1.77)]
    centre, radius = 2.14, 0.46
    for k in range(1, 17):
        a = -0.93 + (pi / 2 + 0.93) * k / 16
        outline.append((radius * cos(a) if k < 16 else 0.0, centre + radius * sin(a)))
    return _profile(outline)


def vase():
    return _profile([
        (0.0, 0.0), (0.5, 0.0), (0.5, 0.0), (0.54, 0.05), (0.5, 0.14), (0.46, 0.2), (0.62, 0.4),
        (0.83, 0.68), (0.95, 1.0), (0.94, 1.3), (0.8, 1.58), (0.55, 1.8), (0.38, 1.98),
        (0.34, 2.14), (0.4, 2.32), (0.56, 2.44), (0.6, 2.46), (0.6, 2.46), (0.5, 2.42),
        (0.34, 2.3), (0.28, 2.14), (0.26, 1.9), (0.0, 1.9)])
