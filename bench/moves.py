#!/usr/bin/env python3
"""A sphere whose mesh file lies far from the origin, moved back by its group, against the sphere at
the origin: bench/moves.py FAROL prints a table by distance. Coordinates are multiples of 2^-20, so
that doubles hold them at all distances up to 1e9."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

SCENE = """<world><window width="256" height="256"/>
<camera><position x="2" y="1.5" z="3"/><lookAt x="0" y="0" z="0"/>
<projection fov="40" near="0.1" far="100"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group><transform><translate x="{0}" y="{0}" z="{0}"/></transform>
<models><model file="{1}"/></models></group></world>"""


def moved(lines, distance):
    for line in lines:
        words = line.split()
        if words[:1] == ["v"]:
            line = " ".join(["v"] + [repr(round(float(w) * 2**20) / 2**20 + distance)
                                     for w in words[1:4]])
        yield line


def main():
    farol = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def run(*words):
            return subprocess.run([farol, *map(str, words)], capture_output=True, text=True,
                                  check=True, cwd=folder).stdout

        run("generate", "sphere", 1, 32, 16, "sphere.obj")
        lines = (folder / "sphere.obj").read_text().split("\n")

        def draw(distance, image):
            (folder / "mesh.obj").write_text("\n".join(moved(lines, distance)))
            (folder / "scene.xml").write_text(SCENE.format(-distance, "mesh.obj"))
            run("render", "scene.xml", "-o", image)

        draw(0.0, "origin.png")
        print("| Distance | Largest difference, levels | Pixels that differ |\n| --- | --- | --- |")
        for exponent in range(13):
            draw(10.0**exponent, "moved.png")
            found = json.loads(run("compare", "origin.png", "moved.png", "--json"))
            equal = found["within"][0]["share"]
            print(f"| 1e{exponent} | {found['max']} | {round((1 - equal) * 256 * 256)} |")


if __name__ == "__main__":
    main()
