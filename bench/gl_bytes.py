#!/usr/bin/env python3
"""Digests of images drawn by OSMesa and by EGL on the processor, and the time of a first image by each.

    python3 bench/gl_bytes.py PROGRAM FOLDER...     a row for each scene of scenes/, one for each FOLDER
    python3 bench/gl_bytes.py PROGRAM --time        CPU time of a first image, medians of pairs
"""

import hashlib
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ("osmesa", "egl")


def drawn(farol, scene, source):
    """The bytes of the scene's image, or None and nothing where it is refused."""
    command = [farol, "render", scene, "-o", "-", "--gl", source, "--width", "320", "--height",
               "240", "--missing", "placeholder"]
    return subprocess.run(command, capture_output=True).stdout


def digest(data):
    return hashlib.sha256(data).hexdigest()[:16] if data else "refused"


def compare(farol, scenes):
    """Digests of each scene by both sources."""
    return [(scene, [digest(drawn(farol, scene, source)) for source in SOURCES])
            for scene in scenes]


def cpu_seconds(command, environment):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def time(farol):
    print("| Scene | OSMesa | EGL | Median of ratios |\n| --- | --- | --- | --- |")
    for name in ("primitives", "house", "teapots"):
        seconds = {source: [] for source in SOURCES}
        for turn in range(12):
            for source in SOURCES if turn % 2 == 0 else SOURCES[::-1]:
                command = [farol, "render", ROOT / "scenes" / name / "scene.xml", "-o", "-", "--gl",
                           source]
                spent = cpu_seconds(command, os.environ)
                if turn > 0:  # the first fills the shader cache
                    seconds[source].append(spent)
        ratios = [b / a for a, b in zip(seconds["osmesa"], seconds["egl"])]
        print(f"| {name} | {1e3 * statistics.median(seconds['osmesa']):.0f} ms | "
              f"{1e3 * statistics.median(seconds['egl']):.0f} ms | "
              f"{statistics.median(ratios):.2f} |")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    farol = Path(sys.argv[1]).resolve()
    if "--time" in sys.argv:
        return time(farol)
    print("| Scene | OSMesa | EGL |\n| --- | --- | --- |")
    for scene, found in compare(farol, sorted((ROOT / "scenes").glob("*/scene.xml"))):
        print(f"| {scene.parent.name} | {found[0]} | {found[1]} |")
    print("\n| Folder | Scenes | Drawn | Equal | Digest of all digests |\n"
          "| --- | --- | --- | --- | --- |")
    for folder in map(Path, sys.argv[2:]):
        rows = compare(farol, sorted(folder.rglob("*.xml")))
        equal = sum(a == b for _, (a, b) in rows)
        images = sum(a != "refused" for _, (a, _) in rows)
        both = [hashlib.sha256("".join(found[i] for _, found in rows).encode()).hexdigest()[:16]
                for i in range(2)]
        print(f"| {folder.name} | {len(rows)} | {images} | {equal} | {both[0]}, {both[1]} |")


if __name__ == "__main__":
    main()
