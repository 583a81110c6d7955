#!/usr/bin/env python3
"""Runs the suites that are named and writes bench/results/NAME.json and docs/plots/NAME-*.svg."""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
from bench import front, grade, load, peers, scenes, time_error  # noqa: E402
from bench.plots import draw  # noqa: E402

QUALITY_SCENES = ["teapots", "house", "solar-system", "carousel", "forest", "primitives",
                  "robot-arm", "police-box", "torch", "can-and-pawns", "lighthouse",
                  "skybox-nebula", "mixed"]
TREND_SCENES = ["house", "teapots", "solar-system", "police-box"]


class Progress:
    """A bar with an estimate, on stderr: redrawn on a terminal, else a line a step."""

    def __init__(self, weights):
        self.weights, self.done, self.start = weights, 0.0, time.monotonic()
        self.total = sum(weights.values()) or 1.0
        self.terminal = sys.stderr.isatty()

    def step(self, suite, share, what):
        share = min(1.0, share)
        done = (self.done + share * self.weights[suite]) / self.total
        spent = time.monotonic() - self.start
        left = f", about {spent * (1 - done) / done:.0f} s left" if done > 0.02 else ""
        bar = "=" * int(25 * done)
        text = f"farol: [{bar:<25}] {100 * done:3.0f} %  {suite}: {what}{left}"
        print(("\r\x1b[K" + text[:100]) if self.terminal else text, file=sys.stderr,
              end="" if self.terminal else "\n", flush=True)

    def finish(self, suite):
        self.done += self.weights[suite]

    def say(self, text):
        print(("\r\x1b[K" if self.terminal else "") + "farol: " + text, file=sys.stderr, flush=True)


class Bench:
    def __init__(self, binaries, quick, progress):
        self.binaries, self.quick, self.progress = Path(binaries), quick, progress
        self.scratch = ROOT / "build" / "bench"
        self.scratch.mkdir(parents=True, exist_ok=True)
        self.farol = self.binaries / "farol"

    def lines(self, program, *arguments, timeout=900):
        """The JSON lines of a measuring program; None, said aloud, where it fails."""
        command = [str(self.binaries / program), *map(str, arguments)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=timeout,
                                  cwd=ROOT, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            self.progress.say(f"skipped: {program} {arguments[0]}: {type(error).__name__}")
            return None
        if done.returncode != 0:
            self.progress.say(f"skipped: {arguments[0]}: {done.stderr.strip()[-200:]}")
            return None
        return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]


def machine(preset):
    cpu = next((line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo")
                if line.startswith("model name")), platform.machine())
    commit = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short=12", "HEAD"],
                            capture_output=True, text=True, check=False).stdout.strip()
    return {"commit": commit, "cpu": cpu, "cores": os.cpu_count(),
            "LP_NUM_THREADS": os.environ.get("LP_NUM_THREADS", "unset"),
            "kernel": platform.release(), "load": [round(x, 1) for x in os.getloadavg()],
            "preset": preset, "date": time.strftime("%Y-%m-%d")}


def quality(bench, progress, suite="quality"):
    """Time against error of the example scenes, ours against fixed divisions."""
    rows = []
    names = ["teapots", "primitives", "police-box"] if bench.quick else QUALITY_SCENES
    if suite == "front":
        names = [name for name in names if name != "mixed"]  # it has no weight there
    size = (160, 120) if bench.quick else (240, 180)
    for i, name in enumerate(names):
        progress.step(suite, i / len(names), name)
        scene = name if name == "mixed" else f"scenes/{name}/scene.xml"
        arguments = [scene, "--runs", 3 if bench.quick else 5, "--cap", 16,
                     f"width={size[0]}", f"height={size[1]}"]
        found = bench.lines("bench_quality", *arguments, *(["--quick"] if bench.quick else []),
                            *(["--front"] if suite == "front" else []))
        if not found:
            continue
        if found[0]["leftOut"]:
            progress.say(f"{name}: without {', '.join(found[0]['leftOut'])}")
        rows.append({"scene": name, **found[0], "settings": found[1:]})
    return rows


def scale(bench, progress):
    """What grows with the scene: objects, their share outside, pixels, lights, texture size."""
    jobs = scenes.sweeps(bench.scratch, bench.quick)
    rounds = 2 if bench.quick else 3
    seen = [[] for _ in jobs]
    # Whole sweeps one after another: a busy minute does not fall on one size alone.
    for turn in range(rounds):
        for i, (sweep, value, path, options) in enumerate(jobs):
            progress.step("scale", (turn + i / len(jobs)) / rounds, f"{sweep} {value}")
            found = bench.lines("bench_frame", path, "--json", "--runs", 3 if bench.quick else 5,
                                *options)
            if found:
                seen[i].append(found[0])
    rows = []
    for (sweep, value, _, options), found in zip(jobs, seen):
        if found:
            numbers = {key: statistics.median(one[key] for one in found) for key in found[0]
                       if isinstance(found[0][key], (int, float))}
            rows.append({"sweep": sweep, "value": value, "options": options, **numbers,
                         "runs": sum(one["runs"] for one in found)})
    progress.step("scale", 0.98, "models outside the view")
    crowd = bench.lines("bench_crowd", "--json", "--runs", 3 if bench.quick else 7, "aa=1",
                        "width=256", "height=256") or []
    return {"sweeps": rows, "crowd": crowd}


def stages(bench, progress):
    """Where a warm frame's time goes, for the example scenes at two sizes."""
    names = ["house", "teapots", "solar-system"] if bench.quick else sorted(
        p.parent.name for p in (ROOT / "scenes").glob("*/scene.xml"))
    sizes = [(512, 512)] if bench.quick else [(512, 512), (1920, 1080)]
    rows = []
    for i, name in enumerate(names):
        for width, height in sizes:
            progress.step("stages", i / len(names), f"{name} {width} x {height}")
            found = bench.lines("bench_frame", f"scenes/{name}/scene.xml", "--json", "--runs",
                                5 if bench.quick else 7, f"width={width}", f"height={height}")
            if found:
                rows.append({"scene": name, **found[0]})
    return rows


def encoders(bench, progress):
    """Milliseconds and bytes of the encoders on one picture."""
    rows = []
    for i, (name, width, height) in enumerate(
            [("house", 512, 512)] if bench.quick else
            [("house", 512, 512), ("teapots", 512, 512), ("house", 1920, 1080)]):
        progress.step("encoders", i / 3, f"{name} {width} x {height}")
        found = bench.lines("bench_encode", f"scenes/{name}/scene.xml", "--runs",
                            5 if bench.quick else 11, f"width={width}", f"height={height}")
        rows += [{"scene": name, **one} for one in found or []]
    return rows


SUITES = {"quality": (quality, 360, 60), "scale": (scale, 240, 60), "stages": (stages, 90, 15),
          "encoders": (encoders, 40, 8), "peers": (peers.run, 90, 30),
          "time-error": (time_error.run, 400, 200),
          "load": (load.run, 260, 25), "grade": (grade.run, 90, 10)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("suites", nargs="*", metavar="SUITE", help=", ".join(SUITES))
    parser.add_argument("--quick", action="store_true",
                        help="few settings: under five minutes; results go to build/bench")
    parser.add_argument("--binaries", default=str(ROOT / "build" / "release"))
    parser.add_argument("--plots", action="store_true", help="only draws what is in bench/results")
    parser.add_argument("--trend", action="store_true",
                        help="adds a line of this commit to bench/results/trend.csv, no more")
    given = parser.parse_args()
    if given.trend:
        return add_trend(given)
    if given.suites == ["front"]:
        return write_front(given)
    names = given.suites or list(SUITES)
    for name in names:
        if name not in SUITES:
            parser.error(f"there is no suite '{name}'; there are: {', '.join(SUITES)}")
    results = ROOT / ("build/bench/results" if given.quick else "bench/results")
    plots = ROOT / ("build/bench/plots" if given.quick else "docs/plots")
    results.mkdir(parents=True, exist_ok=True)
    plots.mkdir(parents=True, exist_ok=True)
    progress = Progress({name: SUITES[name][2 if given.quick else 1] for name in names})
    bench = Bench(given.binaries, given.quick, progress)
    for name in names:
        path = results / f"{name}.json"
        if not given.plots:
            at = machine(bench.binaries.resolve().name)
            rows = SUITES[name][0](bench, progress)
            if not rows:
                progress.say(f"{name}: nothing could be measured; {path.name} stays as it was")
                continue
            at["loadAfter"] = [round(x, 1) for x in os.getloadavg()]
            path.write_text(json.dumps({"suite": name, "machine": at, "results": rounded(rows)},
                                       indent=1) + "\n")
        if path.exists():
            draw(name, json.loads(path.read_text()), plots)
        progress.finish(name)
    progress.say(f"done: {results.relative_to(ROOT)}, {plots.relative_to(ROOT)}")
    return 0


def add_trend(given):
    """CPU ms of a warm frame and PNG of four scenes, 512 x 512: compare lines of one machine."""
    bench = Bench(given.binaries, False, Progress({"trend": 30}))
    path = ROOT / "bench/results/trend.csv"
    at = machine(bench.binaries.resolve().name)
    row = [at["date"], at["commit"], at["preset"], at["cpu"], f"{at['load'][0]:g}"]
    for name in TREND_SCENES:
        found = bench.lines("bench_frame", f"scenes/{name}/scene.xml", "--json", "--runs", 21,
                            "width=512", "height=512")
        row.append(f"{found[0]['cpuMs']:.1f}" if found else "")
    if not path.exists():
        path.write_text(",".join(["date", "commit", "preset", "cpu", "load", *TREND_SCENES]) + "\n")
    with path.open("a") as file:
        file.write(",".join(word.replace(",", " ") for word in row) + "\n")
    print(path.read_text().splitlines()[-1])
    return 0


def write_front(given):
    """Measures the settings that budget_ms chooses from; writes its front, for the next build."""
    bench = Bench(given.binaries, False, Progress({"front": 120}))
    rows = rounded(quality(bench, bench.progress, suite="front"))
    scale = json.loads((ROOT / "bench/results/scale.json").read_text())
    front.write({"machine": machine(bench.binaries.resolve().name), "results": rows}, scale,
                ROOT / "render" / "plan" / "quality_front.inc")
    bench.progress.say("done: render/plan/quality_front.inc")
    return 0


def rounded(value):
    """Five figures are more than a clock says."""
    if isinstance(value, float):
        return float(f"{value:.5g}")
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    return [rounded(one) for one in value] if isinstance(value, list) else value


if __name__ == "__main__":
    sys.exit(main())
