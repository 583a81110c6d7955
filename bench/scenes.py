"""The scenes of the suites that are made up: one thing grows, the rest stays."""

import random
import struct
import zlib

HEAD = ('<world><window width="512" height="512"/><camera><position x="0" y="0" z="0"/>'
        '<lookAt x="0" y="0" z="-1"/><projection fov="60" near="0.5" far="2000"/></camera>')
SUN = '<lights><light type="directional" dirx="1" diry="1" dirz="1"/></lights>'
PLAIN = '<color><diffuse R="90" G="140" B="200"/></color>'


def spheres(count, radius, behind=0):
    """Copies at random places of a cylinder of 9 x 8 that is in view; `behind` more at our back."""

    def ring(number, z, reach, seed):
        return (f'<group><transform><translate x="0" y="0" z="{z}"/></transform>'
                f'<scatter count="{number}" xzMin="0" xzMax="{reach}" yMin="-8" yMax="8" '
                f'seed="{seed}"/><models><model file="sphere_{radius:.5f}.3d">{PLAIN}</model>'
                f'</models></group>') if number else ""

    return ring(count, -25, 9, 1) + ring(behind, 300, 250, 2)


def png(path, side):
    """Noise over waves, RGB."""
    chance = random.Random(side)
    row = bytes(chance.randrange(256) for _ in range(3 * side))
    raw = b"".join(b"\0" + row[3 * (y % side):] + row[:3 * (y % side)] for y in range(side))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(raw, 1)) + chunk(b"IEND", b""))


def sweeps(folder, quick):
    """(sweep, value, path of the scene, options) of every measurement."""
    jobs = []

    def add(sweep, value, body, *options, lights=SUN):
        path = folder / f"{sweep.replace(' ', '-')}-{value}.xml"
        path.write_text(HEAD + lights + "<group>" + body + "</group></world>")
        jobs.append((sweep, value, str(path), list(options)))

    for count in (1, 100, 10_000) if quick else (1, 10, 100, 1000, 10_000, 100_000):
        # About as much of the picture is covered, whatever the number.
        add("objects in view", count, spheres(count, 4 / count**0.5))
    for share in (0, 99) if quick else (0, 50, 90, 99):
        outside = 10_000 * share // 100
        add("percent outside", share, spheres(10_000 - outside, 0.04, outside))
    still = spheres(200, 0.7)
    for side in (64, 512, 2048) if quick else (64, 128, 256, 512, 1024, 2048, 4096):
        add("pixels a side", side, still, f"width={side}", f"height={side}")
    for count in (1, 8, 64) if quick else (1, 2, 4, 8, 16, 32, 64):
        lights = "".join(f'<light type="point" posx="{8 * (i % 8) - 28}" posy="{8 * (i // 8) - 28}" '
                         f'posz="0" quadratic="0.02"/>' for i in range(count))
        add("lights", count, still, lights=f"<lights>{lights}</lights>")
    for side in (0, 256, 1024) if quick else (0, 64, 256, 1024, 2048, 4096):
        dress = PLAIN
        if side:
            png(folder / f"noise-{side}.png", side)
            dress += f'<texture file="noise-{side}.png"/>'
        add("texture side", side, '<transform><translate x="0" y="0" z="-3"/></transform><models>'
            f'<model file="sphere_1.4.3d">{dress}</model></models>')
    return jobs
