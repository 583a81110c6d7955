#!/usr/bin/env python3
"""What a picture costs by scene and size: processor seconds of the service and its worker, warm, each
picture from another side: capacity.py BINARY [PICTURES each]. For the capacity model in
docs/benchmarks/service.md. Processor time, so that a busy machine tells nearly the same."""
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "endurance"))
from daemon import Daemon, ask  # noqa: E402

CLASSES = {  # a small scene, a lit and textured one, a large one
    "wireframe": "solar-system-wireframe",
    "lit": "teapots",
    "textured": "chess-hare",
    "large": "forest",
}
SIZES = [(320, 240, "jpeg"), (512, 512, "png"), (1280, 720, "png"), (1920, 1080, "png")]


def main():
    pictures = int(sys.argv[2]) if len(sys.argv) > 2 else 40
    os.environ["LP_NUM_THREADS"] = "0"  # all on one core
    print("| scene | " + " | ".join(f"{w}x{h} {f}" for w, h, f in SIZES) + " |")
    print("| --- |" + " --- |" * len(SIZES))
    with Daemon(sys.argv[1], "--workers", 1, "--spares", 0, "--cache-bytes", 0, "--deadline",
                60) as daemon:
        connection = daemon.connection()
        for name, scene in CLASSES.items():
            cells = []
            for width, height, kind in SIZES:
                path = f"/v1/scenes/{scene}/image?width={width}&height={height}&format={kind}"

                def draw(turn):
                    status, _, body = ask(connection, "GET", f"{path}&azimuth={turn * 7 % 360}")
                    assert status == 200, (path, status, body[:200])
                for turn in range(3):
                    draw(360 + turn)
                before = sum(daemon.cpu_s())
                for turn in range(pictures):
                    draw(turn)
                cost = (sum(daemon.cpu_s()) - before) / pictures
                cells.append(f"{1 / cost:.0f} ({cost * 1000:.1f} ms)")
            print(f"| {name} (`{scene}`) | " + " | ".join(cells) + " |", flush=True)


main()
