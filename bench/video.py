#!/usr/bin/env python3
"""Animations of 60 frames in each format: CPU time, bytes, and how decoded frames differ from drawn ones.

    python3 bench/video.py PROGRAM [SCENE...] [--runs N] [--errors]
    python3 bench/video.py PROGRAM [SCENE...] [--runs N] --processes 1 2 3 [--threads 0 2]

Times are the CPU time of the program, medians of N runs (3), the formats in turn. --errors decodes every
tenth frame (ffmpeg) and prints mean PSNR (dB) and mean FLIP against PNG frames. --processes compares numbers
of processes (MP4 and WebP), with --threads for each number of llvmpipe's threads, in turn; medians and
least wall time, and the load of the machine meanwhile.
"""

import argparse
import itertools
import json
import os
import resource
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SCENES = ["robot-arm", "chess-hare", "skybox-nebula"]
FORMATS = ["mp4", "webm", "webp", "gif", "png"]
FRAMES, STEP = 60, 10


def draw(program, scene, output, processes=None, threads=None):
    """Returns (CPU s, wall s)."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([program, "render", ROOT / "scenes" / scene / "scene.xml", "-o", output, "--frames",
                    str(FRAMES), "--width", "640", "--height", "480", "--json"] +
                   (["--jobs", str(processes)] if processes else []), check=True, stdout=subprocess.DEVNULL,
                   env=os.environ | ({} if threads is None else {"LP_NUM_THREADS": str(threads)}))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            time.monotonic() - start)


def compare_processes(program, flags):
    print("| Scene | Format | Processes | LP_NUM_THREADS | CPU s | Wall s, median | least | Load |")
    for scene, ending in itertools.product(flags.scenes, ["mp4", "webp"]):
        cases = list(itertools.product(flags.processes, flags.threads or [None]))
        runs, loads, digests = {case: [] for case in cases}, {case: [] for case in cases}, set()
        with tempfile.TemporaryDirectory() as name:
            output = Path(name) / f"loop.{ending}"
            for _, case in itertools.product(range(flags.runs), cases):
                runs[case].append(draw(program, scene, output, *case))
                loads[case].append(os.getloadavg()[0])
                digests.add(output.read_bytes())
        assert len(digests) == 1, "the bytes differ"
        for case in cases:
            cpu, wall = (statistics.median(run[k] for run in runs[case]) for k in (0, 1))
            print(f"| {scene} | {ending} | {case[0]} | {'default' if case[1] is None else case[1]} | {cpu:.2f} | "
                  f"{wall:.2f} | {min(run[1] for run in runs[case]):.2f} | {statistics.median(loads[case]):.1f} |",
                  flush=True)


def errors(program, folder, ending):
    """Returns means over the decoded frames, numbers 0, 1, 2 and so on: (PSNR, FLIP)."""
    video = folder / f"loop.{ending}"
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", video, "-vf", f"select=not(mod(n\\,{STEP}))", "-vsync",
                    "0", "-start_number", "0", folder / f"{ending}-%d.png"], check=True)
    found = []
    for i in range(FRAMES // STEP):
        # The program's exit code says that the images differ.
        done = subprocess.run([program, "compare", folder / f"{ending}-{i}.png", folder / f"s-{i}.png", "--json"],
                              capture_output=True, text=True, check=False)
        found.append(json.loads(done.stdout))
    return tuple(statistics.mean(values) for values in zip(*((one["psnr"], one["flip"]["mean"]) for one in found)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", default=SCENES)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--errors", action="store_true")
    parser.add_argument("--processes", type=int, nargs="+")
    parser.add_argument("--threads", type=int, nargs="+")
    flags = parser.parse_args()
    program = Path(flags.program).resolve()
    if flags.processes:
        compare_processes(program, flags)
        return
    print("| Scene | Format | CPU s | Wall s | Bytes |" + (" PSNR dB | FLIP |" if flags.errors else ""))
    for scene in flags.scenes:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            times = {ending: [] for ending in FORMATS}
            for _ in range(flags.runs):
                for ending in FORMATS:
                    times[ending].append(draw(program, scene, folder / f"loop.{ending}"))
            if flags.errors:
                draw(program, scene, folder / "f-%d.png")
                for i in range(FRAMES // STEP):
                    (folder / f"f-{i * STEP}.png").rename(folder / f"s-{i}.png")
            for ending in FORMATS:
                cpu, wall = (statistics.median(run[k] for run in times[ending]) for k in (0, 1))
                row = f"| {scene} | {ending} | {cpu:.2f} | {wall:.2f} | {(folder / f'loop.{ending}').stat().st_size:,} |"
                # FFmpeg reads no animated WebP; PNG is exact.
                if flags.errors and ending not in ("webp", "png"):
                    row += " {:.1f} | {:.4f} |".format(*errors(program, folder, ending))
                print(row, flush=True)


if __name__ == "__main__":
    main()
