"""Skies for skyboxes: functions of the direction, laid out as a 4x3 cross (left, front, right,
back in the middle row; top above and bottom below front), so no edge shows a seam."""

from math import exp, sqrt

from .image import Image
from .noise import Noise, Random, mix, ramp, step, times

# Where a face lies in the cross, and its middle, right and up directions seen from within.
FACES = {
    "left": ((0, 1), (-1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "front": ((1, 1), (0, 0, -1), (1, 0, 0), (0, 1, 0)),
    "right": ((2, 1), (1, 0, 0), (0, 0, 1), (0, 1, 0)),
    "back": ((3, 1), (0, 0, 1), (-1, 0, 0), (0, 1, 0)),
    "top": ((1, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1)),
    "bottom": ((1, 2), (0, -1, 0), (1, 0, 0), (0, 0, -1)),
}


def _face(side, axes, shade, stars):
    _, forward, right, up = axes
    image = Image(side, side)
    for y in range(side):
        b = 1 - 2 * (y + 0.5) / side
        for x in range(side):
            a = 2 * (x + 0.5) / side - 1
            d = [forward[i] + a * right[i] + b * up[i] for i in range(3)]
            length = sqrt(sum(c * c for c in d))
            image.pixels[y * side + x] = shade(*(c / length for c in d))
    for direction, light, size in stars:
        ahead = sum(direction[i] * forward[i] for i in range(3))
        if ahead <= 0.4:
            continue
        cx = (sum(direction[i] * right[i] for i in range(3)) / ahead + 1) * side / 2 - 0.5
        cy = (1 - sum(direction[i] * up[i] for i in range(3)) / ahead) * side / 2 - 0.5
        reach = int(3 * size) + 1
        for y in range(int(cy) - reach, int(cy) + reach + 2):
            for x in range(int(cx) - reach, int(cx) + reach + 2):
                if 0 <= x < side and 0 <= y < side:
                    w = exp(-((x - cx) ** 2 + (y - cy) ** 2) / (size * size))
                    old = image.pixels[y * side + x]
                    image.pixels[y * side + x] = tuple(o + w * c for o, c in zip(old, light))
    return image


def cross(side, shade, stars=(), blank=(0, 0, 0)):
    image = Image(4 * side, 3 * side, blank)
    image.quality = 96  # stars ring at less
    for axes in FACES.values():
        (column, row) = axes[0]
        image.paste(_face(side, axes, shade, stars), column * side, row * side)
    return image


def field(seed, count, faintest=40, only=lambda d: True):
    """Stars: many faint, few bright, tinted from blue through white to orange."""
    random = Random(seed)
    tint = ramp((0.0, (0.7, 0.8, 1.0)), (0.5, (1, 1, 1)), (1.0, (1.0, 0.82, 0.6)))
    out = []
    while len(out) < count:
        d = random.direction()
        magnitude = random.unit() ** 6
        color = times(tint(random.unit()), faintest + (330 - faintest) * magnitude)
        if only(d):
            out.append((d, color, 0.55 + 0.75 * magnitude))
    return out


def stars(side=512):
    """Deep space with a faint band of a galaxy."""
    noise = Noise(211)
    pole = (0.42, 0.80, 0.43)

    def shade(x, y, z):
        off = x * pole[0] + y * pole[1] + z * pole[2]
        if abs(off) > 0.55:
            return 3, 4, 10
        cloud = 0.5 + 0.6 * noise.fractal(2.5 * x, 2.5 * y, 2.5 * z, 5, 0.55)
        band = exp(-((off / 0.2) ** 2)) * max(0.0, cloud)
        lane = step(0.15, 0.5, noise.fractal(3.5 * x + 8, 3.5 * y, 3.5 * z, 4))
        lane *= exp(-((off / 0.09) ** 2))
        glow = band * (1 - 0.75 * lane)
        return 3 + 34 * glow, 4 + 32 * glow, 10 + 40 * glow

    return cross(side, shade, field(212, 2600))


def nebula(side=512):
    """Clouds of glowing gas round a bright core, dust before them, stars in and behind."""
    noise, dust = Noise(223), Noise(224)
    core = (-0.35, 0.18, -0.92)

    def shade(x, y, z):
        wx = x + 0.35 * noise.fractal(1.6 * x, 1.6 * y, 1.6 * z, 4)
        wy = y + 0.35 * noise.fractal(1.6 * x + 5, 1.6 * y, 1.6 * z + 9, 4)
        wz = z + 0.35 * noise.fractal(1.6 * x, 1.6 * y + 7, 1.6 * z, 4)
        gas = step(-0.15, 0.75, noise.fractal(1.5 * wx, 1.5 * wy, 1.5 * wz, 6, 0.56))
        veil = noise.ridged(2.3 * wx + 3, 2.3 * wy, 2.3 * wz, 5, 0.55) ** 3
        teal = step(-0.2, 0.6, noise.fractal(1.2 * wx + 11, 1.2 * wy, 1.2 * wz + 4, 4))
        near = max(0.0, x * core[0] + y * core[1] + z * core[2])
        heart = near**10 * 0.55 + near**80 * 0.6
        color = mix((128, 26, 92), (24, 112, 146), teal)
        r, g, b = (c * (gas * 0.75 + veil * 0.85 * (0.25 + gas)) for c in color)
        r += 255 * heart * (0.4 + veil)
        g += 176 * heart * (0.35 + veil)
        b += 150 * heart * (0.4 + veil)
        dark = step(0.1, 0.6, dust.fractal(1.9 * wx, 1.9 * wy + 3, 1.9 * wz, 5))
        k = 1 - 0.8 * dark
        return 6 + r * k, 5 + g * k, 16 + b * k

    return cross(side, shade, field(225, 1500, 60))


def night(side=512):
    """A clear night over the sea: dark blue, paler at the horizon, brighter round the moon, which
    is a model of its own."""
    noise = Noise(233)
    moon = (-0.70, 0.39, -0.598)

    def shade(x, y, z):
        if y < -0.12:
            return 4, 8, 16
        if y < 0:
            return mix((20, 30, 54), (4, 8, 16), step(0.0, 0.12, -y))
        near = max(0.0, x * moon[0] + y * moon[1] + z * moon[2])
        halo = near**40 * 0.28 + near**400 * 0.55
        cloud = 0.0
        if y < 0.6:
            cloud = step(0.1, 0.7, noise.fractal(1.7 * x, 8 * y + 2, 1.7 * z, 5))
            cloud *= step(0.0, 0.1, y) * (1 - step(0.25, 0.6, y))
        base = mix((20, 30, 54), (5, 8, 22), step(0.0, 0.55, y))
        return tuple(c + k * halo + 9 * cloud * (1 + 4 * halo) for c, k in zip(base, (66, 72, 86)))

    def above(d):
        near = d[0] * moon[0] + d[1] * moon[1] + d[2] * moon[2]
        return d[1] > 0.03 and near < 0.998

    return cross(side, shade, field(234, 900, 22, above))


def day(side=256):
    """A summer sky: deep blue above, haze and flat clouds towards the horizon."""
    noise = Noise(243)

    def shade(x, y, z):
        if y < -0.05:
            return 168, 190, 178
        base = mix((206, 226, 240), (84, 146, 212), step(-0.02, 0.7, y))
        k = 1 / (y + 0.16)  # clouds lie in a plane
        u, w = x * k, z * k
        puff = noise.fractal(0.62 * u + 3, 0.3, 0.62 * w, 6, 0.55)
        thick = step(0.08, 0.55, puff) * step(0.0, 0.12, y)
        shadow = noise.fractal(0.62 * u + 3.1, 0.3, 0.62 * w + 0.1, 4, 0.5) - puff
        light = 246 + 40 * min(0.0, shadow)
        return mix(base, (light, light + 1, min(255, light + 4)), 0.92 * thick)

    return cross(side, shade)
