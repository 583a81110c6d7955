#!/usr/bin/env python3
"""Draws N pictures (default 100,000) over the gallery with changing cameras, and fails where memory
or descriptors grow after the warm-up or a worker is restarted for any reason but recycling:
    soak.py BINARY [RENDERS]"""
import itertools
import math
import sys
import threading
import time

from daemon import Daemon, ask, scene_ids

GROWTH = 1.05  # of resident memory, from the end of the warm-up to the end
CLIENTS = 4


def path_of(ids, number):
    angle = number * 0.61803398875 * 360 % 360
    size = 64 + 32 * (number % 5)
    return (f"/v1/scenes/{ids[number % len(ids)]}/image?width={size}&height={size}"
            f"&azimuth={angle:.3f}&elevation={40 * math.sin(number):.3f}&distance=12"
            f"&format={('png', 'jpeg', 'webp')[number % 3]}")


def main():
    binary, renders = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 100_000
    numbers, failures, done = itertools.count(), [], [0]
    with Daemon(binary, "--recycle", 1_000_000, "--queue", 64) as daemon:
        ids = scene_ids(daemon)

        def client():
            connection = daemon.connection()
            for number in numbers:
                if number >= renders:
                    return
                status, _, body = ask(connection, "GET", path_of(ids, number))
                done[0] += 1
                if status != 200:
                    failures.append((path_of(ids, number), status, body[:200]))

        threads = [threading.Thread(target=client) for _ in range(CLIENTS)]
        start = time.monotonic()
        for thread in threads:
            thread.start()
        samples, warm = [], renders // 5
        while any(thread.is_alive() for thread in threads):
            time.sleep(1)
            parent, worker = daemon.resident_mib()
            samples.append((done[0], parent, worker, daemon.descriptors()))
            print(f"\r{done[0]:>7} of {renders}  parent {parent:.0f} MiB  worker {worker:.0f} MiB  "
                  f"descriptors {samples[-1][3]}", end="", file=sys.stderr, flush=True)
        seconds = time.monotonic() - start
        restarts = daemon.metric("farol_worker_restarts_total")
        print(file=sys.stderr)
    after = [one for one in samples if one[0] >= warm]
    if len(after) < 4:
        sys.exit("too short to tell: ask for more renders")
    third = max(1, len(after) // 3)

    def mean(part, column):
        return sum(one[column] for one in part) / len(part)
    print(f"{renders} pictures in {seconds:.0f} s: {renders / seconds:.0f} a second")
    bad = bool(failures) or restarts > 0
    for name, column in (("parent MiB", 1), ("worker MiB", 2), ("descriptors", 3)):
        first, last = mean(after[:third], column), mean(after[-third:], column)
        print(f"{name}: {first:.1f} after the warm-up, {last:.1f} at the end ({last / first:.3f})")
        bad = bad or last > first * GROWTH
    print(f"failures: {len(failures)} {failures[:3]}; restarts: {restarts:.0f}")
    sys.exit(1 if bad else 0)


main()
