"""The solar system's faces: each a function of the point on the unit sphere, so that they close
at the seam and do not pinch at the poles."""

from math import asin, atan2, cos, exp, pi, sin, sqrt

from .image import Image
from .noise import Noise, Random, mix, on_sphere, ramp, step, times


def _sphere(width, shade):
    return Image.of(width, width // 2, lambda u, v: shade(*on_sphere(u, v)))


def sun():
    noise = Noise(11)
    color = ramp(
        (0.0, (150, 38, 4)), (0.3, (228, 96, 10)), (0.55, (255, 158, 30)),
        (0.8, (255, 208, 84)), (1.0, (255, 244, 190)),
    )

    def shade(x, y, z):
        wx = x + 0.25 * noise.fractal(3 * x, 3 * y, 3 * z, 3)
        wy = y + 0.25 * noise.fractal(3 * x + 9, 3 * y, 3 * z, 3)
        granules = noise.ridged(9 * wx, 9 * wy, 9 * z, 4)
        broad = noise.fractal(2.2 * x, 2.2 * y, 2.2 * z + 4, 3)
        spots = step(0.52, 0.78, noise.fractal(3.1 * x + 7, 3.1 * y, 3.1 * z, 3))
        return color(0.1 + 0.85 * granules + 0.22 * broad - 0.7 * spots)

    return _sphere(512, shade)


def _craters(width, seed, count, largest):
    """Heights of bowls with rims, by the point's place in the picture."""
    height = width // 2
    field = [0.0] * (width * height)
    random = Random(seed)
    for i in range(count):
        cx, cy, cz = random.direction()
        radius = largest * (0.12 + 0.88 * random.unit() ** 5)
        lat0, reach = asin(cy), radius * 1.7
        for y in range(height):
            lat = pi * (0.5 - (y + 0.5) / height)
            if abs(lat - lat0) > reach:
                continue
            c = cos(lat)
            wide = pi if c < reach * 1.2 else min(pi, 1.3 * reach / c)
            lon0 = atan2(cx, cz)
            x0 = int((lon0 - wide) / (2 * pi) * width)
            for x in range(x0, min(x0 + width, x0 + int(2 * wide / (2 * pi) * width) + 2)):
                px, py, pz = on_sphere((x + 0.5) / width, 1 - (y + 0.5) / height)
                d = 2 * asin(min(1.0, 0.5 * sqrt((px - cx) ** 2 + (py - cy) ** 2 + (pz - cz) ** 2)))
                t = d / radius
                if t < 1.7:
                    bowl = -0.9 * (1 - t * t) if t < 0.85 else 0.45 * exp(-(((t - 1) / 0.22) ** 2))
                    field[y * width + x % width] += bowl * (0.5 + 0.5 * radius / largest)
    return field


def _cratered(width, seed, count, largest, color, roughness, maria):
    noise, field = Noise(seed), _craters(width, seed + 1, count, largest)
    height = width // 2
    image = Image(width, height)
    for y in range(height):
        slope = 1.0 / max(0.35, sin(pi * (y + 0.5) / height))
        for x in range(width):
            p = on_sphere((x + 0.5) / width, 1 - (y + 0.5) / height)
            east = field[y * width + (x + 2) % width]
            west = field[y * width + (x - 2) % width]
            relief = (east - west) * slope
            grain = noise.fractal(*(6 * c for c in p), 5)
            sea = step(-0.05, 0.35, noise.fractal(*(1.7 * c + 3 for c in p), 4)) * maria
            level = (0.62 + roughness * grain - 0.34 * sea + 0.12 * field[y * width + x]
                + 0.2 * relief)
            image.put(x, y, color(level))
    return image


def mercury():
    color = ramp((0.1, (60, 52, 48)), (0.55, (142, 128, 116)), (1.0, (216, 204, 188)))
    return _cratered(512, 21, 420, 0.2, color, 0.2, 0.5)


def moon():
    color = ramp((0.1, (52, 52, 56)), (0.55, (140, 139, 138)), (1.0, (226, 224, 218)))
    return _cratered(512, 31, 320, 0.17, color, 0.13, 1.0)


def venus():
    noise = Noise(41)
    color = ramp(
        (0.0, (140, 88, 36)), (0.35, (205, 152, 78)), (0.65, (236, 198, 126)),
        (1.0, (252, 236, 196)),
    )

    def shade(x, y, z):
        a = noise.fractal(1.4 * x, 2.6 * y, 1.4 * z, 4)
        b = noise.fractal(1.4 * x + 5, 2.6 * y + 2, 1.4 * z, 4)
        swirl = noise.fractal(1.6 * x + 1.5 * a, 5.0 * y + 1.5 * b, 1.6 * z + a, 5)
        return color(0.52 + 0.6 * swirl + 0.08 * sin(7 * y + 3 * a))

    return _sphere(512, shade)


def earth():
    """A planet like ours but not ours: seas, shelves, biomes by latitude, ice, clouds."""
    noise, sky = Noise(57), Noise(58)
    sea = ramp((0.0, (6, 24, 74)), (0.6, (14, 58, 124)), (0.9, (30, 104, 158)),
        (1.0, (74, 158, 178)))
    warm = ramp((0.0, (34, 96, 40)), (0.35, (72, 118, 48)), (0.6, (164, 142, 84)),
        (1.0, (118, 92, 66)))
    cold = ramp((0.0, (52, 88, 56)), (0.5, (118, 116, 92)), (1.0, (206, 206, 204)))

    def shade(x, y, z):
        wx = x + 0.3 * noise.fractal(2 * x + 3, 2 * y, 2 * z, 4)
        wz = z + 0.3 * noise.fractal(2 * x, 2 * y + 8, 2 * z, 4)
        land = noise.fractal(1.25 * wx + 0.4, 1.25 * y, 1.25 * wz + 1.1, 7, 0.55) + 0.03
        away = abs(y) + 0.1 * noise.fractal(4 * x, 4 * y, 4 * z, 4)
        if land < 0:
            color = sea(1 + land * 2.4)
        else:
            dry = (0.5 + 0.55 * noise.fractal(3 * x + 6, 3 * y, 3 * z, 4)
                - 0.5 * abs(abs(y) - 0.4) * 2)
            hills = min(1.0, land * 1.6)
            color = mix(warm(0.65 * dry + 0.45 * hills), cold(hills + 0.1), step(0.55, 0.8, away))
            relief = noise.fractal(11 * x, 11 * y, 11 * z, 3)
            color = times(color, 1 + 0.22 * relief)
        color = mix(color, (244, 249, 252), step(0.93, 0.985, away + (0.02 if land > 0 else 0)))
        a = sky.fractal(1.6 * x, 2.4 * y, 1.6 * z, 4)
        b = sky.fractal(1.6 * x + 7, 2.4 * y, 1.6 * z + 2, 4)
        cloud = sky.fractal(2.2 * x + 1.1 * a, 4.2 * y + 1.1 * b, 2.2 * z + 0.8 * a, 6, 0.56)
        return mix(color, (252, 253, 255), 0.92 * step(0.06, 0.55, cloud))

    return _sphere(512, shade)


def mars():
    noise = Noise(61)
    color = ramp(
        (0.0, (72, 34, 24)), (0.3, (138, 66, 38)), (0.6, (192, 104, 60)), (1.0, (232, 172, 118))
    )

    def shade(x, y, z):
        warp = noise.fractal(2 * x, 2 * y, 2 * z, 4)
        broad = noise.fractal(1.3 * x + 0.6 * warp, 1.7 * y, 1.3 * z + 3, 5)
        grain = noise.fractal(8 * x, 8 * y, 8 * z, 4)
        canyon = step(0.88, 1.02, noise.ridged(1.8 * x + 4, 3.2 * y, 1.8 * z, 3))
        body = color(0.58 + 0.62 * broad + 0.16 * grain - 0.3 * canyon)
        ice = step(0.955, 0.985, abs(y) + 0.03 * warp + (0.012 if y > 0 else 0))
        return mix(body, (248, 244, 240), ice)

    return _sphere(512, shade)


def _banded(seed, bands, color, turbulence, storm=None):
    noise = Noise(seed)

    def shade(x, y, z):
        lat = y
        glow = 0.0
        if storm:
            lon0, lat0, wide, tall, tint = storm
            lon = (atan2(x, z) - lon0 + pi) % (2 * pi) - pi
            d = sqrt((lon / wide) ** 2 + ((asin(max(-1.0, min(1.0, y))) - lat0) / tall) ** 2)
            glow = step(1.15, 0.75, d) if d > 0.75 else 1.0
            lat += 0.05 * exp(-((d - 1.1) ** 2) * 6) * (1 if y > sin(lat0) else -1)
        a = noise.fractal(2.4 * x, 9 * y, 2.4 * z, 4)
        b = noise.fractal(5 * x + 2.2 * a, 22 * y, 5 * z + 2.2 * a, 4)
        at = lat + turbulence * (0.045 * a + 0.022 * b) * sqrt(max(0.0, 1 - y * y))
        stripe = noise.fractal(0.31, at * bands + 0.37, 0.53, 3, 0.6)
        body = color(0.5 + 0.85 * stripe + 0.12 * turbulence * b)
        if storm and glow > 0:
            swirl = 0.5 + 0.5 * sin(9 * d + 2 * a)
            body = mix(body, mix(tint, times(tint, 1.25), swirl), 0.9 * glow)
        return body

    return _sphere(512, shade)


def jupiter():
    color = ramp(
        (0.0, (112, 62, 38)), (0.25, (170, 108, 70)), (0.45, (206, 160, 116)),
        (0.65, (232, 208, 172)), (0.85, (246, 236, 218)), (1.0, (222, 214, 206)),
    )
    return _banded(71, 6.3, color, 1.5, (0.9, -0.38, 0.27, 0.14, (186, 76, 48)))


def saturn():
    color = ramp(
        (0.0, (158, 122, 76)), (0.35, (204, 172, 118)), (0.65, (232, 208, 160)),
        (1.0, (250, 238, 208)),
    )
    return _banded(83, 5.2, color, 0.35)


def uranus():
    color = ramp((0.0, (118, 186, 196)), (0.5, (158, 216, 222)), (1.0, (206, 240, 240)))
    return _banded(97, 2.2, color, 0.2)


def neptune():
    color = ramp(
        (0.0, (18, 40, 128)), (0.45, (38, 84, 196)), (0.85, (70, 126, 226)), (1.25, (206, 226, 252))
    )
    return _banded(101, 3.4, color, 0.7, (2.6, -0.3, 0.2, 0.1, (16, 32, 104)))


def rings():
    """Saturn's rings: v = 0 at the inner edge, 1 at the outer; the same all round."""
    noise = Noise(113)
    color = ramp(
        (0.0, (26, 22, 18)), (0.35, (132, 112, 86)), (0.7, (206, 182, 142)), (1.0, (246, 230, 198))
    )

    def shade(_, r):
        bands = 0.64 + 0.6 * noise.fractal(0.5, r * 14, 0.5, 4, 0.65)
        gap = exp(-(((r - 0.64) / 0.03) ** 2)) + 0.7 * exp(-(((r - 0.9) / 0.014) ** 2))
        return color(bands * (0.3 + 0.7 * step(0.0, 0.3, r)) - 1.1 * gap)

    return Image.of(8, 256, shade)


def rock():
    noise = Noise(127)
    color = ramp((0.0, (44, 38, 34)), (0.5, (112, 98, 86)), (1.0, (186, 172, 154)))
    return _sphere(256, lambda x, y, z: color(0.5 + 0.7 * noise.fractal(4 * x, 4 * y, 4 * z, 6)))


def ice():
    """A comet's head: dirty ice."""
    noise = Noise(131)
    color = ramp((0.0, (86, 92, 104)), (0.45, (176, 194, 210)), (1.0, (244, 250, 255)))
    return Image.of(
        128, 128, lambda u, v: color(0.55 + 0.5 * noise.tile(u, v, 4, 5)
            + 0.1 * noise.tile(u, v, 16, 2))
    )


def tail():
    """A comet's tail: bright at the head (v = 1), nothing at the end."""
    noise = Noise(137)
    color = ramp((0.0, (2, 4, 10)), (0.4, (20, 52, 110)), (0.75, (96, 164, 224)),
        (1.0, (236, 248, 255)))
    return Image.of(
        64, 256, lambda u, v: color(v**1.3 * (1 + 0.35 * noise.tile(u, v, 8, 3) * (1 - v)))
    )
