"""The service under load: wrk on loopback, 1 to 256 connections, and processor time by /proc, the
client's own taken off. Called by run.py."""

import collections
import http.client
import os
import re
import resource
import shutil
import subprocess
import sys
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "endurance"))
from daemon import Daemon, ask  # noqa: E402

SCENE = "house"
SIZE = (512, 512)
PATH = f"/v1/scenes/{SCENE}/image?width={SIZE[0]}&height={SIZE[1]}"
WAIT_S = 2  # --wait


def children_s():
    """Processor seconds of the programs that ended here so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def bare_s(bench, quick):
    """Processor seconds of one warm frame and its PNG, without any service: the difference of two
    runs of different length, so that starting does not count."""
    short, long = (5, 25) if quick else (10, 110)
    spent = []
    for runs in (short, long):
        before = children_s()
        if not bench.lines("bench_frame", f"scenes/{SCENE}/scene.xml", "--runs", runs, "--json",
                           f"width={SIZE[0]}", f"height={SIZE[1]}"):
            return None
        spent.append(children_s() - before)
    return (spent[1] - spent[0]) / (long - short)


def wrk(daemon, connections, seconds, mode, header=None):
    """One run: statuses, a second's answers, latencies, and processor seconds by who spent them."""
    command = ["wrk", "-t", str(min(2, connections)), "-c", str(connections), "-d", f"{seconds}s",
               "--latency", "--timeout", "30s", "-s", str(ROOT / "bench" / "load.lua")]
    if header:
        command += ["-H", header]
    command += [f"http://127.0.0.1:{daemon.port}/", "--", PATH, mode]
    parent, workers, client = *daemon.cpu_s(), children_s()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    after = daemon.cpu_s()
    said = dict(re.findall(r"^(seconds|p50ms|p99ms) ([\d.]+)$", done.stdout, re.M))
    if done.returncode != 0 or len(said) < 3:
        raise RuntimeError(f"wrk: {done.stderr[-300:]}{done.stdout[-300:]}")
    line = re.search(r"^statuses(.*)$", done.stdout, re.M).group(1)
    statuses = {code: int(count) for code, count in re.findall(r"(\d+)=(\d+)", line)}
    errors = re.search(r"Socket errors: (.*)", done.stdout)
    return {"connections": connections, "statuses": statuses, "seconds": float(said["seconds"]),
            "p50Ms": float(said["p50ms"]), "p99Ms": float(said["p99ms"]),
            "socketErrors": errors.group(1) if errors else "none",
            "parentS": after[0] - parent, "workersS": after[1] - workers,
            "clientS": children_s() - client}


def drawn(daemon, bare, seconds, counts, step):
    """Each picture from another side: what is drawn a second against what the cores could draw if
    there were nothing but frames."""
    cores = len(os.sched_getaffinity(0))
    for connections in counts:
        step(f"{connections} connections, each picture from another side")
        row = wrk(daemon, connections, seconds, "turn")
        pictures = row["statuses"].get("200", 0)
        left = cores - row["clientS"] / row["seconds"]
        spent = row["parentS"] + row["workersS"]
        yield {"load": "drawn", **row, "perSecond": pictures / row["seconds"],
               "idealPerSecond": left / bare,
               "ofIdeal": pictures / row["seconds"] * bare / left,
               # The same without the time that other work took from the machine.
               "ofIdealByCpu": pictures * bare / spent if spent else 0.0}


def answered(daemon, seconds, counts, step):
    """Without a worker: 304 and pictures from the cache, for a processor second of the parent."""
    etag = daemon.get(PATH)[1]["ETag"]
    for name, header in (("304", f"If-None-Match: {etag}"), ("cached", None)):
        for connections in counts:
            step(f"{connections} connections, {name}")
            row = wrk(daemon, connections, seconds, "same", header)
            count = sum(row["statuses"].values())
            yield {"load": name, **row, "perSecond": count / row["seconds"],
                   "perCpuSecond": count / row["parentS"] if row["parentS"] else 0.0}


def overload(daemon, seconds, step):
    """Twice as many clients as the service takes at once: how long answers take, by status."""
    clients = 2 * (daemon.workers_asked + daemon.queue_asked)
    step(f"{clients} clients, twice what is taken at once")
    stop, lock = time.monotonic() + seconds, threading.Lock()
    times, missing = collections.defaultdict(list), [0]

    def client(number):
        connection, turn = daemon.connection(), 0
        while time.monotonic() < stop:
            turn += 1
            start = time.monotonic()
            try:
                status, headers, _ = ask(connection, "GET",
                                         f"{PATH}&azimuth={(number * 997 + turn * 1.37) % 360:.2f}")
            except (OSError, http.client.HTTPException):
                status, headers = 0, {}
            if status != 200:  # the connection is closed after a failure
                connection.close()
                connection = daemon.connection()
            with lock:
                times[status].append(1000 * (time.monotonic() - start))
                missing[0] += status == 503 and not headers.get("Retry-After")
            if status == 503:
                time.sleep(0.05)

    threads = [threading.Thread(target=client, args=(i,)) for i in range(clients)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    good = sorted(times[200])
    return {"load": "overload", "clients": clients,
            "statuses": {str(code): len(all_) for code, all_ in times.items()},
            "withoutRetryAfter": missing[0],
            "p50Ms": good[len(good) // 2] if good else 0.0,
            "p99Ms": good[min(len(good) - 1, len(good) * 99 // 100)] if good else 0.0,
            "waitMs": 1000.0 * WAIT_S}


def run(bench, progress):
    """Rows of all loads; prints them as they come, as the rows of a table for docs/benchmarks/service.md."""
    if not shutil.which("wrk"):
        progress.say("skipped: load: wrk is not installed")
        return None
    seconds, counts = (2, [1, 16]) if bench.quick else (15, [1, 4, 16, 64, 256])
    bare = bare_s(bench, bench.quick)
    if not bare:
        return None
    steps = [0]

    def step(what):
        steps[0] += 1
        progress.step("load", steps[0] / (3 * len(counts) + 2), what)

    rows = [{"load": "bare", "cpuMs": 1000 * bare}]
    workers = min(8, max(1, os.cpu_count() or 1))
    queue = max(16, 4 * workers)
    common = ("--workers", workers, "--queue", queue, "--wait", WAIT_S, "--recycle", 1_000_000)
    # One core a worker's frames: several processes with as many threads each only get in each
    # other's way, and the bare frame's processor time is the same.
    with Daemon(bench.farol, *common, "--cache-bytes", 0) as daemon:
        daemon.workers_asked, daemon.queue_asked = workers, queue
        for turn in range(4 * workers):
            daemon.get(f"{PATH}&azimuth={turn}")
        rows += drawn(daemon, bare, seconds, counts, step)
        rows.append(overload(daemon, seconds, step))
    with Daemon(bench.farol, *common) as daemon:
        daemon.get(PATH)
        rows += answered(daemon, seconds, counts, step)
    for row in rows:
        print(table_row(row), flush=True)
    return rows


def table_row(row):
    kind = row["load"]
    if kind == "bare":
        return (f"bare frame and PNG, {SCENE} at {SIZE[0]}x{SIZE[1]}: {row['cpuMs']:.1f} ms of a core\n"
                "| load | connections | answers | a second | | p50 ms | p99 ms |\n"
                "| --- | --- | --- | --- | --- | --- | --- |")
    statuses = ", ".join(f"{count} x {code}" for code, count in sorted(row["statuses"].items()))
    if kind == "overload":
        return (f"| twice the places | {row['clients']} | {statuses} | | {row['withoutRetryAfter']} "
                f"without Retry-After | {row['p50Ms']:.0f} | {row['p99Ms']:.0f} (of 200; the wait is "
                f"{row['waitMs']:.0f}) |")
    share = (f"{row['ofIdeal']:.2f} of the ideal, {row['ofIdealByCpu']:.2f} by processor time"
             if kind == "drawn" else f"{row['perCpuSecond']:.0f} a processor second of the parent")
    return (f"| {kind} | {row['connections']} | {statuses} | {row['perSecond']:.0f} | {share} | "
            f"{row['p50Ms']:.1f} | {row['p99Ms']:.1f} |")
