"""Surfaces: ground, walls, wood, metal. All that repeat are periodic in both directions."""

from math import floor, pi, sin, sqrt

from .image import Image
from .noise import Cells, Noise, Random, mix, ramp, step, times


def grass():
    noise, random = Noise(301), Random(302)
    color = ramp((0.0, (30, 58, 20)), (0.45, (64, 108, 38)), (0.75, (104, 146, 54)),
        (1.0, (158, 176, 88)))
    image = Image.of(512, 512, lambda u, v: color(0.4 + 0.3 * noise.tile(u, v, 4, 5)))
    for _ in range(14000):  # blades
        x, y = random.between(0, 512), random.between(0, 512)
        broad = noise.tile(x / 512, y / 512, 4, 3)
        tone = color(0.45 + 0.35 * broad + random.between(-0.28, 0.32))
        lean = random.between(-0.45, 0.45)
        for t in range(random.next() % 6 + 4):
            at = int(y - t) % 512 * 512 + int(x + lean * t) % 512
            image.pixels[at] = mix(image.pixels[at], times(tone, 0.8 + 0.05 * t), 0.7)
    return image


def planks(boards=5, size=512):
    """A floor of boards along u."""
    noise, random = Noise(311), Random(312)
    looks = [(random.between(-0.16, 0.16), random.next() % 97, random.unit())
        for _ in range(boards)]
    color = ramp((0.0, (66, 38, 20)), (0.4, (126, 80, 44)), (0.7, (166, 114, 66)),
        (1.0, (200, 152, 98)))

    def shade(u, v):
        row = floor(v * boards)
        tone, at, joint = looks[row % boards]
        across = v * boards - row
        grain = noise.tile(u, (across + at) / 97, 3, 4, 0.55, 194)
        rings = sin(26 * across + 5 * noise.tile(u, (across + at) / 97, 2, 2, 0.5, 48))
        level = 0.55 + tone + 0.26 * grain + 0.07 * rings
        gap = min(across, 1 - across) / 0.03
        butt = abs((u - joint + 0.5) % 1 - 0.5) / 0.003
        return times(color(level), 0.35 + 0.65 * step(0.0, 1.0, min(gap, butt)))

    return Image.of(size, size, shade)


def wood():
    """Grain along v, wide enough to be projected on a turned piece."""
    noise = Noise(321)
    color = ramp((0.0, (84, 44, 18)), (0.35, (146, 86, 40)), (0.7, (190, 126, 68)),
        (1.0, (222, 168, 108)))

    def shade(u, v):
        bend = noise.tile(u, v, 2, 3)
        rings = 0.5 + 0.5 * sin(2 * pi * (7 * u + 1.1 * bend))
        fibres = noise.tile(u, v, 48, 2, 0.6) * 0.5 + noise.tile(u, v, 64, 1)
        return color(0.38 + 0.45 * rings**1.5 + 0.13 * fibres)

    return Image.of(256, 256, shade)


def bricks():
    noise, random = Noise(331), Random(332)
    columns, rows = 6, 16
    tones = [[random.between(-0.26, 0.26) for _ in range(columns)] for _ in range(rows)]
    color = ramp((0.0, (82, 34, 26)), (0.4, (140, 62, 44)), (0.7, (172, 88, 62)),
        (1.0, (204, 128, 96)))

    def shade(u, v):
        row = floor(v * rows)
        x = u * columns + 0.5 * (row & 1)
        column = floor(x)
        grain = noise.tile(u, v, 16, 4)
        wobble = 0.035 * noise.tile(u, v, 24, 2)
        dx = min(x - column, column + 1 - x) * rows / columns / 1.0
        dy = min(v * rows - row, row + 1 - v * rows)
        edge = min(dx * 0.98, dy) + wobble
        face = color(0.52 + tones[row][column % columns] + 0.28 * grain)
        mortar = times((158, 148, 134), 0.86 + 0.22 * grain)
        lit = 1 + 0.16 * (step(0.86, 0.97, v * rows - row) - step(0.14, 0.03, v * rows - row))
        return mix(mortar, times(face, lit), step(0.05, 0.11, edge))

    return Image.of(512, 512, shade)


def _stones(n, seed, color, joint, size=512):
    noise, cells = Noise(seed), Cells(n, seed + 1, 0.72)
    random = Random(seed + 2)
    tones = [random.between(-0.2, 0.2) for _ in range(n * n)]

    def shade(u, v):
        uw, vw = u + 0.012 * noise.tile(u, v, 12, 2), v + 0.012 * noise.tile(u, v + 0.5, 12, 2)
        first, second, which = cells.at(uw, vw)
        dome = step(0.02, 0.26, second - first)
        grain = noise.tile(u, v, 16, 4)
        face = color(0.5 + tones[which] + 0.2 * grain)
        return mix(times(joint, 0.9 + 0.3 * grain), times(face, 0.72 + 0.34 * dome),
            step(0.02, 0.1, second - first))

    return Image.of(size, size, shade)


def cobbles():
    color = ramp((0.0, (44, 46, 54)), (0.5, (98, 100, 108)), (1.0, (156, 154, 150)))
    return _stones(13, 341, color, (34, 32, 32))


def flagstones():
    color = ramp((0.0, (70, 62, 54)), (0.5, (132, 122, 108)), (1.0, (188, 178, 160)))
    return _stones(7, 351, color, (48, 42, 36))


def plaster():
    noise = Noise(361)
    color = ramp((0.0, (196, 182, 156)), (0.5, (228, 216, 192)), (1.0, (246, 238, 220)))
    return Image.of(
        256, 256, lambda u, v: color(0.55 + 0.3 * noise.tile(u, v, 4, 5, 0.6)
            + 0.1 * noise.tile(u, v, 64, 2))
    )


def tiles():
    """Roof tiles, rounded below, each row over the next."""
    noise, random = Noise(371), Random(372)
    columns, rows = 12, 12
    tones = [[random.between(-0.22, 0.22) for _ in range(columns)] for _ in range(rows)]
    color = ramp((0.0, (74, 26, 18)), (0.5, (148, 60, 38)), (1.0, (206, 112, 76)))

    def shade(u, v):
        for down in (0, 1):  # the tile of this row, else what the row below its rounded end shows
            row = floor(v * rows) + down
            x = u * columns + 0.5 * (row & 1)
            column = floor(x)
            across, along = 2 * (x - column) - 1, v * rows - row
            end = 0.0 if down else 0.34 * (1 - sqrt(max(0.0, 1 - across * across)))
            if down or along > end:
                break
        shadow = 1 - 0.5 * step(0.3, 0.0, along - end) if not down else 0.5
        edge = step(1.0, 0.86, abs(across))
        tone = color(0.5 + tones[row % rows][column % columns] + 0.25 * noise.tile(u, v, 16, 3))
        rim = 1.18 if 0 <= along - end < 0.07 and not down else 1.0
        light = shadow if down else 0.78 + 0.3 * (1 - along)
        return times(tone, (0.45 + 0.55 * edge) * light * rim)

    return Image.of(512, 512, shade)


def metal():
    """Brushed along u, with a few scratches."""
    noise, random = Noise(381), Random(382)
    image = Image.of(
        256, 256,
        lambda u, v: times((1, 1.01, 1.04), 168 + 26 * noise.tile(u, v, 2, 3, 0.7, 64)
            + 14 * noise.tile(u, v, 4, 3)),
    )
    for _ in range(26):
        x, y = random.between(0, 256), random.between(0, 256)
        slope, light = random.between(-0.35, 0.35), random.between(-34, 34)
        for t in range(random.next() % 60 + 10):
            at = int(y + slope * t) % 256 * 256 + int(x + t) % 256
            image.pixels[at] = tuple(c + light for c in image.pixels[at])
    return image


def rust():
    noise = Noise(391)
    paint = ramp((0.0, (206, 120, 12)), (1.0, (250, 176, 42)))
    worn = ramp((0.0, (72, 42, 28)), (1.0, (136, 84, 52)))

    def shade(u, v):
        broad = noise.tile(u, v, 4, 5, 0.6)
        fine = noise.tile(u, v, 32, 3)
        return mix(paint(0.6 + 0.25 * broad + 0.08 * fine), worn(0.5 + 0.5 * fine),
            step(0.42, 0.56, broad + 0.12 * fine))

    return Image.of(256, 256, shade)


def concrete():
    noise, cells = Noise(401), Cells(24, 402)

    def shade(u, v):
        first, _, _ = cells.at(u, v)
        level = (118 + 22 * noise.tile(u, v, 3, 5, 0.6) + 8 * noise.tile(u, v, 64, 2)
            - 26 * step(0.12, 0.05, first))
        joint = min(abs((u * 4) % 1 - 0.5), abs((v * 4) % 1 - 0.5))
        return times((1.0, 0.985, 0.96), level * (0.62 + 0.38 * step(0.0, 0.02, joint)))

    return Image.of(512, 512, shade)


def sea():
    """Night sea from above: long waves with bright crests."""
    noise = Noise(411)
    color = ramp((0.0, (14, 34, 60)), (0.5, (30, 64, 96)), (0.8, (62, 106, 136)),
        (1.0, (170, 204, 216)))

    def shade(u, v):
        bend = noise.tile(u, v, 3, 3)
        wave = 1 - abs(noise.tile(u + 0.02 * bend, v, 7, 4, 0.55, 2))
        ripple = noise.tile(u, v, 48, 2, 0.5, 2)
        return color(0.2 + 0.62 * max(0.0, wave) ** 3 + 0.14 * ripple + 0.12 * bend)

    return Image.of(512, 512, shade)


def crag():
    """Rock with moss and wet foot: v = 0 at the water."""
    noise = Noise(421)
    stone = ramp((0.0, (46, 42, 42)), (0.5, (104, 96, 90)), (1.0, (168, 158, 144)))
    moss = ramp((0.0, (40, 56, 26)), (1.0, (96, 116, 58)))

    def shade(u, v):
        grain = noise.tile(u, v, 6, 6, 0.6)
        layers = noise.tile(u, v, 2, 3, 0.5, 8)
        green = step(0.0, 0.5, noise.tile(u, v, 4, 4) + 0.9 * v - 0.55)
        body = mix(stone(0.5 + 0.35 * grain + 0.2 * layers), moss(0.5 + 0.5 * grain), green * 0.8)
        return times(body, 0.4 + 0.6 * step(0.0, 0.12, v))

    return Image.of(512, 256, shade)


def stripes():
    """A lighthouse's coat: red and white bands up v, weathered."""
    noise = Noise(431)

    def shade(u, v):
        edge = (v * 7 + 0.01 * noise.tile(u, v, 8, 3)) % 2
        red = step(0.0, 0.03, edge) - step(1.0, 1.03, edge)
        dirt = noise.tile(u, v, 8, 4, 0.6, 1)
        streak = max(0.0, noise.tile(u, v, 32, 2, 0.5, 1))
        body = mix((238, 232, 220), (196, 36, 30), red)
        return times(body, 0.94 + 0.09 * dirt - 0.12 * streak)

    return Image.of(256, 512, shade)


def beam():
    """Light in the air: warm at the lamp (v = 1), the night's colour at the far end (v = 0)."""
    far, near = (17, 26, 48), (255, 236, 170)

    def shade(_, v):
        return mix(far, near, 0.55 * v**9 + 0.36 * v**2.6 * (1 - 0.3 * v))

    return Image.of(16, 256, shade)


def windows():
    """Panes in a frame, lit from within."""
    def shade(u, v):
        bar = min(abs(u - 0.5), abs(v - 0.5), u, 1 - u, v, 1 - v)
        glow = 1 - 0.55 * sqrt((u - 0.5) ** 2 + (v - 0.42) ** 2)
        return mix((250, 244, 232), (255 * glow, 206 * glow, 118 * glow), step(0.035, 0.05, bar))

    return Image.of(128, 128, shade)


def door():
    noise = Noise(441)
    columns, rows = ((0.14, 0.46), (0.54, 0.86)), ((0.1, 0.45), (0.53, 0.9))
    panels = [(*column, *row) for row in rows for column in columns]

    def shade(u, v):
        grain = noise.tile(u, v, 32, 3, 0.5, 1)
        tone = times((36, 92, 108), 1 + 0.14 * grain)
        for x0, x1, y0, y1 in panels:
            if x0 < u < x1 and y0 < v < y1:
                edge = min(u - x0, x1 - u, (v - y0) * 2, (y1 - v) * 2)
                side = 0.75 if min(x1 - u, (v - y0) * 2) > edge + 1e-9 else 1.3
                tone = times(tone, side if edge < 0.03 else 1.06)
        return tone

    image = Image.of(128, 256, shade)
    for y in range(256):
        for x in range(128):
            d = sqrt((x - 114) ** 2 + (y - 132) ** 2)
            if d < 6:
                image.put(x, y, times((232, 190, 92), 1.1 - 0.09 * d))
    return image
