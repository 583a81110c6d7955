#!/usr/bin/env python3
"""Pictures a second of 1, 2 and 3 renderers of one worker behind the proxy, interleaved, beside the
ideal, which is as many cores as there are: throughput.py BINARY [SECONDS each] [ROUNDS]
Scenes that cost the same, warm where they are placed, every picture from another side; more clients
than the workers can answer, so that none waits for work."""
import itertools
import os
import pathlib
import statistics
import sys
import tempfile
import threading
import time

from cluster import Cluster, get, needed

PATH = "/v1/scenes/{}/image?width=256&height=256&azimuth={}"
SCENES = 48  # enough for the hash to share them out
SCENE = ('<world><camera><position x="3" y="2" z="4"/><lookAt x="0" y="0" z="0"/></camera><group>'
         '<transform><scale x="{}" y="1" z="1"/></transform><models>'
         '<model file="torus_1_0.4_64_32.3d"/></models></group></world>')


def rate(cluster, ids, seconds, clients):
    done, turns, stop = [], itertools.count(), time.monotonic() + seconds

    def client():
        while time.monotonic() < stop:
            turn = next(turns)
            if get(cluster.proxy.port, PATH.format(ids[turn % len(ids)], turn * 7 % 360))[0] == 200:
                done.append(time.monotonic())

    threads = [threading.Thread(target=client) for _ in range(clients)]
    start = time.monotonic()
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return len(done) / (time.monotonic() - start)


def main():
    needed()
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 5
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    # One thread a frame, so that a renderer is one core's worth.
    os.environ["LP_NUM_THREADS"] = "0"
    rates = {count: [] for count in (1, 2, 3)}
    with tempfile.TemporaryDirectory() as scenes:
        for number in range(SCENES):
            (pathlib.Path(scenes) / f"s{number}.xml").write_text(SCENE.format(1 + number / 1000))
        for _, count in itertools.product(range(rounds), rates):
            with Cluster(sys.argv[1], count, "--cache-bytes", 0, scenes=scenes) as cluster:
                ids = cluster.scene_ids()
                for one in ids:
                    get(cluster.proxy.port, PATH.format(one, 1))
                rates[count].append(rate(cluster, ids, seconds, 6 * count))
    one, cores = statistics.median(rates[1]), os.cpu_count()
    for count, all_ in rates.items():
        mine, ideal = statistics.median(all_), min(count, cores)
        print(f"{count} renderers: {mine:.1f} pictures a second, {mine / one:.2f} of one's, ideal "
              f"{ideal} ({mine / one / ideal:.0%}); rounds {[round(x, 1) for x in all_]}")


main()
