"""Pictures with an alpha channel: leaves and fences with holes, clouds and rings that are seen
through."""

from math import exp, pi, sin

from .image import Image
from .noise import Noise, mix, on_sphere, step


def leaf():
    """A leaf on its stalk, tip up, with veins; on or off, smooth over a texel."""
    size, noise = 128, Noise(811)

    def shade(u, v):
        along = (v - 0.2) / 0.76
        half = 0.36 * max(0.0, sin(pi * min(1.0, max(0.0, along)) ** 0.8)) ** 0.9
        away = abs(u - 0.5)
        blade = step(-0.5 / size, 0.5 / size, half - away) if 0 < along < 1 else 0.0
        stalk = step(-0.5 / size, 0.5 / size, 0.018 - away) if 0.02 < v < 0.3 else 0.0
        vein = exp(-((away / 0.012) ** 2))
        side = exp(-((((v - 0.6 * away) * 9.0) % 1.0 - 0.5) / 0.07) ** 2) * step(0.4, 0.0, away)
        grain = 0.5 + 0.4 * noise.fractal(7 * u, 7 * v, 0.5, 4)
        green = mix((34, 92, 30), (112, 168, 52), grain + 0.25 * along)
        color = mix(green, (190, 208, 120), max(0.8 * vein, 0.35 * side))
        return (*color, 255 * max(blade, stalk))

    return Image.of(size, size, shade)


def clouds():
    """The clouds of a planet, thin to thick."""
    noise = Noise(823)

    def shade(u, v):
        x, y, z = on_sphere(u, v)
        a = noise.fractal(1.6 * x, 2.4 * y, 1.6 * z, 4)
        b = noise.fractal(1.6 * x + 7, 2.4 * y, 1.6 * z + 2, 4)
        cloud = noise.fractal(2.2 * x + 1.1 * a, 4.2 * y + 1.1 * b, 2.2 * z + 0.8 * a, 6, 0.56)
        return 250, 252, 255, 255 * 0.95 * step(0.02, 0.5, cloud)

    return Image.of(512, 256, shade)


def veil_rings():
    """Rings of dust and ice: v = 0 at the inner edge; seen through where they are thin."""
    noise = Noise(829)

    def shade(_, r):
        bands = 0.55 + 0.7 * noise.fractal(0.5, r * 14, 0.5, 4, 0.65)
        gap = exp(-(((r - 0.62) / 0.035) ** 2)) + 0.8 * exp(-(((r - 0.88) / 0.016) ** 2))
        ends = step(0.0, 0.12, r) * step(1.0, 0.94, r)
        color = mix((146, 118, 88), (244, 226, 192), bands)
        return (*color, 255 * ends * min(1.0, max(0.0, bands - gap)))

    return Image.of(8, 256, shade)


def lattice():
    """A wooden lattice: slats crosswise with square holes."""
    size, noise = 256, Noise(839)

    def shade(u, v):
        across, down = (8 * u) % 1.0, (8 * v) % 1.0
        upright = abs(across - 0.5) < 0.16
        if not upright and abs(down - 0.5) >= 0.16:
            return 96, 72, 44, 0
        grain = noise.fractal(*((40 * u, 4 * v) if upright else (4 * u, 40 * v)), 0.5, 3)
        edge = abs(across - 0.5) / 0.16 if upright else abs(down - 0.5) / 0.16
        color = mix((92, 62, 36), (190, 146, 94), 0.55 + 0.5 * grain - 0.25 * edge**4)
        return (*color, 255)

    return Image.of(size, size, shade)
