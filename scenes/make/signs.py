"""Things people made: lettering, panels, labels, boxes."""

from math import atan2, cos, pi, sin, sqrt

from .image import Image
from .noise import Noise, mix, ramp, step, times

# 5x7 letters, a row a number, the left column the highest bit.
_LETTERS = {
    "A": (14, 17, 17, 31, 17, 17, 17), "B": (30, 17, 17, 30, 17, 17, 30),
    "C": (14, 17, 16, 16, 16, 17, 14), "D": (30, 17, 17, 17, 17, 17, 30),
    "E": (31, 16, 16, 30, 16, 16, 31), "F": (31, 16, 16, 30, 16, 16, 16),
    "G": (14, 17, 16, 23, 17, 17, 14), "H": (17, 17, 17, 31, 17, 17, 17),
    "I": (14, 4, 4, 4, 4, 4, 14), "L": (16, 16, 16, 16, 16, 16, 31),
    "M": (17, 27, 21, 21, 17, 17, 17), "N": (17, 25, 21, 19, 17, 17, 17),
    "O": (14, 17, 17, 17, 17, 17, 14), "P": (30, 17, 17, 30, 16, 16, 16),
    "R": (30, 17, 17, 30, 20, 18, 17), "S": (15, 16, 16, 14, 1, 1, 30),
    "T": (31, 4, 4, 4, 4, 4, 4), "U": (17, 17, 17, 17, 17, 17, 14),
    "V": (17, 17, 17, 17, 17, 10, 4), "X": (17, 17, 10, 4, 10, 17, 17),
    " ": (0, 0, 0, 0, 0, 0, 0),
}


def text(image, words, x, y, size, color):
    """Writes words with letters of 5x7 squares of `size` px; (x, y) is the top left corner."""
    for letter in words:
        for row, bits in enumerate(_LETTERS[letter]):
            for column in range(5):
                if bits >> (4 - column) & 1:
                    x0, y0 = x + column * size, y + row * size
                    image.rectangle(x0, y0, x0 + size, y0 + size, color)
        x += 6 * size


def _width(words, size):
    return (6 * len(words) - 1) * size


def box_side():
    """A police box's side: two leaves of four panels, the top ones windows."""
    noise = Noise(501)
    blue = (24, 58, 128)

    def paint(u, v):
        grain = noise.tile(u, v, 4, 3, 0.6, 1) + 0.5 * noise.tile(u, v, 32, 2, 0.5, 1)
        return times(blue, 1 + 0.12 * grain)

    def shade(u, v):
        tone = paint(u, v)
        if min(u, 1 - u) < 0.045:
            return times(tone, 0.82)
        if abs(u - 0.5) < 0.012:
            return times(tone, 0.45)
        left = 0.075 if u < 0.5 else 0.545
        x = (u - left) / 0.38
        y = (v - 0.03) / 0.236
        row = int(y)
        y -= row
        if not 0 < x < 1 or not 0.09 < y < 0.95 or v < 0.03 or row > 3:
            return tone
        dx, dy = min(x, 1 - x) * 0.38, min(y - 0.09, 0.95 - y) * 0.236 * 2
        edge = min(dx, dy)
        if edge < 0.028:
            dark = (x < 0.5) if dx < dy else (y > 0.5)
            return times(tone, 0.62 if dark else 1.45)
        if row == 3:
            bar = min(abs(x - 1 / 3), abs(x - 2 / 3)) * 0.38, abs(y - 0.52) * 0.236 * 2
            if min(bar) < 0.012:
                return (214, 220, 230)
            glow = 1 - 0.3 * abs(y - 0.5) - 0.25 * abs(x - 0.5)
            return times((255, 240, 196), glow)
        return times(tone, 1.08)

    return Image.of(256, 512, shade)


def box_window():
    """Frosted panes, three by two, lit from within."""
    def shade(u, v):
        bar = min(abs(u - 1 / 3), abs(u - 2 / 3), abs(v - 0.5))
        glow = 1 - 0.35 * sqrt((u - 0.5) ** 2 + (v - 0.6) ** 2)
        return mix((66, 84, 122), times((255, 236, 190), glow), step(0.018, 0.034, bar))

    return Image.of(128, 128, shade)


def box_front():
    """The side with the doors: a notice and a handle."""
    image = box_side()
    image.rectangle(36, 152, 104, 236, (228, 228, 220))
    image.rectangle(38, 154, 102, 234, (246, 246, 240))
    for i, words in enumerate(("POLICE", "TELEPHONE", "FREE")):
        text(image, words, 70 - _width(words, 1) // 2, 162 + 10 * i, 1, (22, 34, 84))
    for y in range(194, 230, 4):
        image.rectangle(44, y, 96 - y * 7 % 13, y + 1, (108, 112, 128))
    image.rectangle(138, 250, 144, 286, (206, 208, 214))
    image.rectangle(137, 290, 145, 298, (232, 196, 104))
    return image


def box_sign():
    image = Image(512, 64, (8, 10, 18))
    image.rectangle(0, 0, 512, 3, (30, 66, 140))
    image.rectangle(0, 61, 512, 64, (30, 66, 140))
    text(image, "POLICE", 34, 14, 5, (255, 255, 250))
    text(image, "PUBLIC", 237, 14, 2, (255, 255, 250))
    text(image, "CALL", 249, 34, 2, (255, 255, 250))
    text(image, "BOX", 338, 14, 5, (255, 255, 250))
    return image


def label():
    """A drink's label round a can: the sea, a lighthouse and its beams, the name."""
    noise = Noise(511)
    night = ramp((0.0, (10, 34, 84)), (1.0, (34, 118, 168)))

    def shade(u, v):
        x, y = (u * 2) % 1 - 0.5, v - 0.55
        body = night(1.2 * v - 0.1 + 0.05 * noise.tile(u, v, 6, 3))
        angle = atan2(y, x) + 0.3 * sqrt(x * x + y * y)
        ray = step(0.55, 0.75, cos(angle * 12)) * step(0.02, 0.06, x * x + y * y)
        body = mix(body, (250, 206, 74), 0.85 * ray * step(0.5, 0.2, sqrt(x * x + y * y)))
        wave = 0.2 + 0.02 * sin(2 * pi * u * 10)
        if v < wave:
            crest = step(wave - 0.02, wave - 0.005, v)
            body = mix((14, 64, 120), (232, 244, 250), crest)
        if v < wave - 0.07 + 0.01 * sin(2 * pi * u * 10 + 2):
            body = (8, 40, 88)
        # the tower and its lantern
        if -0.36 < y < 0.0 and abs(x) < 0.045 - 0.05 * (y + 0.3) * 0.5:
            body = (206, 38, 34) if int((y + 0.36) * 13.9) % 2 else (246, 244, 236)
        if 0.0 <= y < 0.06 and abs(x) < 0.03:
            body = (255, 246, 190)
        if 0.06 <= y < 0.11 and abs(x) < 0.045 * (0.11 - y) / 0.05:
            body = (170, 24, 24)
        return body

    image = Image.of(512, 256, shade)
    for half in (0, 256):
        x = half + 128 - _width("FAROL", 7) // 2
        for dx, dy, color in ((4, 4, (6, 16, 44)), (0, 0, (255, 236, 150))):
            text(image, "FAROL", x + dx, 14 + dy, 7, color)
        claim = "LIGHT AND BITTER"
        text(image, claim, half + 128 - _width(claim, 2) // 2, 232, 2, (236, 244, 250))
    return image


def lid():
    """Turned metal: u round, v along the profile."""
    noise = Noise(521)
    return Image.of(
        256, 64,
        lambda u, v: times((1.0, 1.01, 1.03), 186 + 30 * noise.tile(u, v, 2, 3, 0.6, 16)
            + 26 * cos(4 * pi * u)),
    )


def crate():
    noise = Noise(531)
    color = ramp((0.0, (92, 58, 28)), (0.5, (168, 118, 66)), (1.0, (214, 168, 108)))

    def shade(u, v):
        rim = min(u, 1 - u, v, 1 - v)
        slant = abs(u - v) / sqrt(2)
        if rim < 0.12 or slant < 0.07:
            upright = u < 0.12 or u > 0.88
            along = noise.tile(*((v, u) if upright else (u, v)), 3, 4, 0.55, 16)
            edge = abs(rim - 0.12) if rim < 0.12 else min(0.07 - slant, rim - 0.12)
            tone = color(0.62 + 0.22 * along)
            nail = (min(u, 1 - u) - 0.06) ** 2 + (min(v, 1 - v) - 0.06) ** 2 < 0.00022
            return (70, 66, 64) if nail else times(tone, 0.6 + 0.4 * step(0.0, 0.012, edge))
        board = (v * 6) % 1
        tone = color(0.36 + 0.24 * noise.tile(u, v, 3, 4, 0.55, 24))
        shadow = 0.7 + 0.3 * step(0.12, 0.17, rim) * step(0.07, 0.1, slant)
        return times(tone, (0.5 + 0.5 * step(0.0, 0.07, min(board, 1 - board))) * shadow)

    return Image.of(256, 256, shade)


def hazard():
    noise = Noise(541)

    def shade(u, v):
        t = (u * 8 + v * 2) % 1
        black = step(0.0, 0.03, t) - step(0.5, 0.53, t)
        return times(mix((238, 184, 24), (26, 26, 28), black), 1 + 0.12 * noise.tile(u, v, 16, 3))

    return Image.of(256, 64, shade)


def hull():
    """Plates of a space ship, with panel lines, a stripe and small hatches."""
    noise = Noise(551)

    def shade(u, v):
        row = int(v * 8)
        x = u * 6 + 0.5 * (row & 1)
        tone = (176 + 22 * noise.at(int(x) % 6 * 0.71 + 0.3, row * 0.93 + 0.4, 0.5)
            + 12 * noise.tile(u, v, 8, 4))
        seam = min(x % 1, 1 - x % 1) * 1.3, min(v * 8 % 1, 1 - v * 8 % 1)
        body = times((0.94, 0.98, 1.04), tone * (0.55 + 0.45 * step(0.0, 0.05, min(seam))))
        if 0.44 < v < 0.5:
            body = times((196, 52, 40), 0.9 + 0.15 * noise.tile(u, v, 16, 3))
        hatch = abs(x % 1 - 0.5) < 0.12 and abs(v * 8 % 1 - 0.5) < 0.14 and (int(x) + row) % 3 == 0
        return times(body, 0.7) if hatch else body

    return Image.of(256, 256, shade)


def compass():
    """What a texture coordinate is: columns of hue along u, brighter up v, a grid, an arrow up."""
    def shade(u, v):
        hue = ramp((0, (214, 72, 64)), (0.25, (226, 176, 60)), (0.5, (88, 168, 92)),
            (0.75, (66, 128, 200)), (1, (214, 72, 64)))
        grid = min(u * 8 % 1, 1 - u * 8 % 1, v * 8 % 1, 1 - v * 8 % 1)
        field = 1.0 if (int(u * 8) + int(v * 8)) % 2 else 0.82
        return mix((250, 250, 246), times(hue(u), (0.6 + 0.5 * v) * field), step(0.02, 0.05, grid))

    return Image.of(256, 256, shade)
