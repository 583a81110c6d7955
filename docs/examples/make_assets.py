#!/usr/bin/env python3
"""Makes the pictures that the examples show: python3 docs/examples/make_assets.py

Deterministic, by the standard library and the writers of scenes/make alone."""

import math
import sys
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "scenes"))

from make import see_through  # noqa: E402
from make.image import Image, write  # noqa: E402

INK = (40, 46, 58)
# left to right by hue, so that u is seen; brighter upwards, so that v is
HUES = ((226, 88, 76), (236, 176, 64), (92, 176, 104), (74, 132, 214))
FACES = {
    (1, 0): (226, 232, 240),  # top
    (0, 1): (226, 88, 76),  # left
    (1, 1): (236, 176, 64),  # front
    (2, 1): (92, 176, 104),  # right
    (3, 1): (74, 132, 214),  # back
    (1, 2): (120, 108, 100),  # bottom
}


def letter():
    """Four by four fields and a large F: neither mirrored nor turned can it be mistaken."""
    size = 128
    image = Image(size, size)
    for y in range(size):
        for x in range(size):
            row, column = 3 - y * 4 // size, x * 4 // size
            shade = 0.62 + 0.38 * row / 3
            image.put(x, y, tuple(int(shade * c) for c in HUES[column]))
    for x0, y0, x1, y1 in ((40, 24, 56, 106), (40, 24, 92, 40), (40, 56, 80, 72)):
        image.rectangle(x0 - 3, y0 - 3, x1 + 3, y1 + 3, (252, 252, 250))
    for x0, y0, x1, y1 in ((40, 24, 56, 106), (40, 24, 92, 40), (40, 56, 80, 72)):
        image.rectangle(x0, y0, x1, y1, INK)
    return image


def cross():
    """An unfolded box, 4 x 3 fields, each with its own colour and a frame; dots count them."""
    side = 48
    image = Image(4 * side, 3 * side, (70, 74, 84))
    for dots, ((column, row), color) in enumerate(FACES.items(), 1):
        x, y = column * side, row * side
        image.rectangle(x, y, x + side, y + side, INK)
        image.rectangle(x + 2, y + 2, x + side - 2, y + side - 2, color)
        for dot in range(dots):
            dx, dy = x + 8 + 12 * (dot % 3), y + 8 + 14 * (dot // 3)
            image.rectangle(dx, dy, dx + 8, dy + 8, INK)
    return image


def sky():
    """A day's sky without seams: each pixel is what its direction in the box sees."""
    side, fine = 128, 3
    image = Image(4 * side, 3 * side, (0, 0, 0))
    # right, down and forward of each field, seen from within
    fields = {
        (1, 0): ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
        (0, 1): ((0, 0, -1), (0, -1, 0), (-1, 0, 0)),
        (1, 1): ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
        (2, 1): ((0, 0, 1), (0, -1, 0), (1, 0, 0)),
        (3, 1): ((-1, 0, 0), (0, -1, 0), (0, 0, 1)),
        (1, 2): ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
    }
    for (column, row), (right, down, forward) in fields.items():
        for j in range(side):
            for i in range(side):
                samples = []
                for part in range(fine * fine):
                    a = 2 * (i + (part % fine + 0.5) / fine) / side - 1
                    b = 2 * (j + (part // fine + 0.5) / fine) / side - 1
                    d = [f + a * r + b * w for r, w, f in zip(right, down, forward)]
                    samples.append(sky_color(d))
                mean = tuple(sum(c) // len(samples) for c in zip(*samples))
                image.put(column * side + i, row * side + j, mean)
    return image


def sky_color(d):
    length = math.sqrt(sum(c * c for c in d))
    x, y, z = (c / length for c in d)
    along = math.atan2(x, -z)
    hills = 0.07 + 0.05 * math.sin(3 * along + 1) + 0.03 * math.sin(7 * along)
    if y < hills:
        shade = 0.75 + 0.25 * min(1.0, (y + 1) / (hills + 1))
        return tuple(int(shade * c) for c in (96, 132, 84))
    sun = x * 0.35 + y * 0.4 - z * 0.85
    if sun > 0.985:
        return (255, 244, 196)
    t = min(1.0, y / 0.8)
    return tuple(int(c + t * (e - c)) for c, e in zip((206, 224, 240), (70, 128, 206)))


def main():
    makers = (("letter", letter), ("cross", cross), ("sky", sky), ("lattice", see_through.lattice))
    for name, make in makers:
        write(HERE / f"{name}.png", make())


main()
