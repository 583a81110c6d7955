"""Gradient noise in space (for spheres and skies: seamless because it is a function of the point)
and on a tile (periodic), fractal sums of both, cells, and colour ramps. No library state: the same
seed gives the same numbers everywhere."""

from math import cos, floor, pi, sin, sqrt


class Random:
    """A 64-bit linear congruential generator (Knuth's MMIX constants), top bits only."""

    def __init__(self, seed):
        self.state = (seed * 2654435761 + 12345) & 0xFFFFFFFFFFFFFFFF
        for _ in range(4):
            self.next()

    def next(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) & 0xFFFFFFFFFFFFFFFF
        return self.state >> 33

    def unit(self):
        return self.next() / 2147483648.0

    def between(self, low, high):
        return low + (high - low) * self.unit()

    def shuffled(self, items):
        items = list(items)
        for i in range(len(items) - 1, 0, -1):
            j = self.next() % (i + 1)
            items[i], items[j] = items[j], items[i]
        return items

    def direction(self):
        """A point of the unit sphere, uniform by area."""
        y, lon = self.between(-1, 1), self.between(0, 2 * pi)
        r = sqrt(1 - y * y)
        return r * sin(lon), y, r * cos(lon)


_EDGES = [
    (1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0), (1, 0, 1), (-1, 0, 1), (1, 0, -1), (-1, 0, -1),
    (0, 1, 1), (0, -1, 1), (0, 1, -1), (0, -1, -1), (1, 1, 0), (0, -1, 1), (-1, 1, 0), (0, -1, -1),
]


class Noise:
    def __init__(self, seed):
        order = Random(seed).shuffled(range(256))
        self.order = order + order + order[:2]
        self.gradient = [_EDGES[i & 15] for i in self.order]

    def at(self, x, y, z):
        """Gradient noise (Perlin 2002), about -1..1, zero at integer points."""
        fx, fy, fz = floor(x), floor(y), floor(z)
        x -= fx
        y -= fy
        z -= fz
        order, gradient = self.order, self.gradient
        i, j, k = fx & 255, fy & 255, fz & 255
        a, b = order[i] + j, order[i + 1] + j
        aa, ab, ba, bb = order[a] + k, order[a + 1] + k, order[b] + k, order[b + 1] + k
        u = x * x * x * (x * (x * 6 - 15) + 10)
        v = y * y * y * (y * (y * 6 - 15) + 10)
        w = z * z * z * (z * (z * 6 - 15) + 10)
        x1, y1, z1 = x - 1, y - 1, z - 1
        g, h = gradient[aa], gradient[ba]
        p = g[0] * x + g[1] * y + g[2] * z
        p += u * (h[0] * x1 + h[1] * y + h[2] * z - p)
        g, h = gradient[ab], gradient[bb]
        q = g[0] * x + g[1] * y1 + g[2] * z
        q += u * (h[0] * x1 + h[1] * y1 + h[2] * z - q)
        p += v * (q - p)
        g, h = gradient[aa + 1], gradient[ba + 1]
        r = g[0] * x + g[1] * y + g[2] * z1
        r += u * (h[0] * x1 + h[1] * y + h[2] * z1 - r)
        g, h = gradient[ab + 1], gradient[bb + 1]
        q = g[0] * x + g[1] * y1 + g[2] * z1
        q += u * (h[0] * x1 + h[1] * y1 + h[2] * z1 - q)
        r += v * (q - r)
        return p + w * (r - p)

    def fractal(self, x, y, z, octaves, gain=0.5):
        """Sum of octaves, about -1..1."""
        total, weight, norm = 0.0, 1.0, 0.0
        for _ in range(octaves):
            total += weight * self.at(x, y, z)
            norm += weight
            weight *= gain
            x, y, z = 2.03 * x + 17.1, 2.03 * y + 31.7, 2.03 * z + 5.3
        return total / norm * 1.6

    def ridged(self, x, y, z, octaves, gain=0.5):
        """Sharp crests, 0..1."""
        total, weight, norm = 0.0, 1.0, 0.0
        for _ in range(octaves):
            total += weight * (1 - abs(self.at(x, y, z)) * 1.6)
            norm += weight
            weight *= gain
            x, y, z = 2.03 * x + 11.9, 2.03 * y + 3.1, 2.03 * z + 23.3
        return max(0.0, total / norm)

    def tile(self, u, v, cells, octaves=1, gain=0.5, stretch=1):
        """Periodic over u, v in 0..1, `cells` lattice cells along u and `cells*stretch` along v."""
        total, weight, norm = 0.0, 1.0, 0.0
        nx, ny = cells, cells * stretch
        for octave in range(octaves):
            total += weight * self._periodic(u * nx, v * ny, nx, ny, octave * 37)
            norm += weight
            weight *= gain
            nx, ny = nx * 2, ny * 2
        return total / norm * 1.6

    def _periodic(self, x, y, nx, ny, layer):
        fx, fy = floor(x), floor(y)
        x -= fx
        y -= fy
        order, gradient = self.order, self.gradient
        i0, i1 = (fx % nx + layer) & 255, ((fx + 1) % nx + layer) & 255
        j0, j1 = fy % ny & 255, (fy + 1) % ny & 255
        u = x * x * x * (x * (x * 6 - 15) + 10)
        v = y * y * y * (y * (y * 6 - 15) + 10)
        g00, g10 = gradient[order[i0] + j0], gradient[order[i1] + j0]
        g01, g11 = gradient[order[i0] + j1], gradient[order[i1] + j1]
        x1, y1 = x - 1, y - 1
        p = g00[0] * x + g00[1] * y
        p += u * (g10[0] * x1 + g10[1] * y - p)
        q = g01[0] * x + g01[1] * y1
        q += u * (g11[0] * x1 + g11[1] * y1 - q)
        return p + v * (q - p)


class Cells:
    """Worley cells on a tile of n x n: nearest and second distances and the nearest's number."""

    def __init__(self, n, seed, jitter=0.8):
        random = Random(seed)
        self.n = n
        self.points = [
            (0.5 + jitter * (random.unit() - 0.5), 0.5 + jitter * (random.unit() - 0.5))
            for _ in range(n * n)
        ]

    def at(self, u, v):
        x, y = u * self.n, v * self.n
        i, j = floor(x), floor(y)
        first, second, which = 9.0, 9.0, 0
        for dj in (-1, 0, 1):
            for di in (-1, 0, 1):
                at = (j + dj) % self.n * self.n + (i + di) % self.n
                px, py = self.points[at]
                d = (i + di + px - x) ** 2 + (j + dj + py - y) ** 2
                if d < first:
                    first, second, which = d, first, at
                elif d < second:
                    second = d
        return sqrt(first), sqrt(second), which


def ramp(*stops):
    """A colour by a number: stops (at, (r, g, b)) ascending; beyond the ends the end's colour."""

    def color(t):
        if t <= stops[0][0]:
            return stops[0][1]
        for (a, ca), (b, cb) in zip(stops, stops[1:]):
            if t < b:
                return mix(ca, cb, (t - a) / (b - a))
        return stops[-1][1]

    return color


def mix(a, b, t):
    return a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t


def times(a, k):
    return a[0] * k, a[1] * k, a[2] * k


def step(low, high, x):
    """0 below low, 1 above high, smooth between."""
    t = (x - low) / (high - low)
    if t <= 0:
        return 0.0
    if t >= 1:
        return 1.0
    return t * t * (3 - 2 * t)


def on_sphere(u, v):
    """The direction that a sphere's texture coordinate means: u = 0 at +Z towards +X, v up."""
    lon, lat = 2 * pi * u, pi * (v - 0.5)
    c = cos(lat)
    return sin(lon) * c, sin(lat), cos(lon) * c
