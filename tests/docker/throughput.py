#!/usr/bin/env python3
"""Pictures a second of 1, 2 and 3 renderers of one worker behind the proxy, interleaved, beside the
ideal, which is as many cores as there are: throughput.py BINARY [SECONDS each] [ROUNDS]"""
import itertools
import os
import statistics
import sys
import threading
import time

from cluster import Cluster, get, needed

PATH = "/v1/scenes/{}/image?width=256&height=256&azimuth={}"


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
    for _ in range(rounds):
        for count in rates:
            with Cluster(sys.argv[1], count, "--cache-bytes", 0) as cluster:
                ids = cluster.scene_ids()
                rate(cluster, ids, 2, 2 * count)
                rates[count].append(rate(cluster, ids, seconds, 2 * count))
    one, cores = statistics.median(rates[1]), os.cpu_count()
    for count, all_ in rates.items():
        mine, ideal = statistics.median(all_), min(count, cores)
        print(f"{count} renderers: {mine:.1f} pictures a second, {mine / one:.2f} of one's, ideal "
              f"{ideal} ({mine / one / ideal:.0%}); rounds {[round(x, 1) for x in all_]}")


main()
