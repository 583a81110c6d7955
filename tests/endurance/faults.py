#!/usr/bin/env python3
"""Faults under load: workers killed and stopped, clients that stall, vanish and talk nonsense.
Every answer is the right picture or an honest refusal, within a second of the fault, and the
daemon stays:
    faults.py BINARY [SECONDS a fault]"""
import collections
import os
import random
import signal
import socket
import sys
import threading
import time

from daemon import Daemon, ask, scene_ids

CLIENTS = 8
DEADLINE_S = 3       # --deadline: what a stopped worker costs its request
SLACK_S = 1.0        # "within a second of the fault"
WAIT_S = 2           # --wait


class Load:
    """Clients that ask for known pictures and hold each answer against the first."""

    def __init__(self, daemon, paths):
        self.daemon, self.paths, self.stopping = daemon, paths, False
        self.expected = {path: self.first(path) for path in paths}
        self.statuses, self.wrong, self.slowest = collections.Counter(), [], 0.0
        self.threads = [threading.Thread(target=self.client, args=(i,)) for i in range(CLIENTS)]

    def first(self, path):
        """The picture without faults; a first look at a scene may compile for seconds, past the
        deadline."""
        for _ in range(10):
            status, headers, body = self.daemon.get(path)
            if status == 200:
                return body
            time.sleep(int(headers.get("Retry-After", 1)))
        raise RuntimeError(f"{path}: {status} {body[:200]} before any fault")

    def __enter__(self):
        for thread in self.threads:
            thread.start()
        return self

    def __exit__(self, *_):
        self.stopping = True
        for thread in self.threads:
            thread.join()

    def client(self, index):
        rng = random.Random(index)
        while not self.stopping:
            connection = self.daemon.connection()
            path = rng.choice(self.paths)
            start = time.monotonic()
            try:
                status, headers, body = ask(connection, "GET", path)
            except OSError as fault:
                self.wrong.append((path, repr(fault)))
                continue
            finally:
                connection.close()
            self.slowest = max(self.slowest, time.monotonic() - start)
            self.statuses[status] += 1
            if status == 200 and body != self.expected[path]:
                self.wrong.append((path, "another picture"))
            elif status == 503 and not headers.get("Retry-After"):
                self.wrong.append((path, "503 without Retry-After"))
            elif status not in (200, 503):
                self.wrong.append((path, status))
            if status == 503:
                time.sleep(0.05)


class Progress:
    """How far it is and how long it takes yet, on stderr: redrawn on a terminal, else a line every
    ten seconds."""

    def __init__(self, load, name, before, faults, seconds):
        self.load, self.name, self.before, self.faults = load, name, before, faults
        self.seconds, self.start, self.over = seconds, time.monotonic(), threading.Event()
        self.terminal = sys.stderr.isatty()
        self.thread = threading.Thread(target=self.run)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()
        if self.terminal:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)

    def run(self):
        while not self.over.wait(0.5 if self.terminal else 10):
            share = min(1.0, (time.monotonic() - self.start) / self.seconds)
            left = self.seconds * (self.faults - self.before - share)
            counts = dict(self.load.statuses)
            text = (f"{(self.before + share) / self.faults:4.0%}  {self.name}: {counts.get(200, 0)} "
                    f"pictures, {counts.get(503, 0)} refusals, {len(self.load.wrong)} wrong; "
                    f"{left:.0f} s left")
            print(("\r\x1b[K" + text) if self.terminal else text, file=sys.stderr,
                  end="" if self.terminal else "\n", flush=True)


def kill_workers(daemon, seconds, rng):
    end, killed = time.monotonic() + seconds, 0
    while time.monotonic() < end:
        workers = daemon.workers()
        if workers:
            try:
                os.kill(rng.choice(workers), signal.SIGKILL)
                killed += 1
            except ProcessLookupError:
                pass
        time.sleep(0.1)
    return f"{killed} killed"


def stop_workers(daemon, seconds, rng):
    end, stopped = time.monotonic() + seconds, 0
    while time.monotonic() < end:
        workers = daemon.workers()
        if workers:
            try:
                os.kill(rng.choice(workers), signal.SIGSTOP)
                stopped += 1
            except ProcessLookupError:
                pass
        time.sleep(DEADLINE_S)
    return f"{stopped} stopped"


def bad_clients(daemon, seconds, rng):
    """Slow heads, bodies that end early, answers that nobody reads, noise."""
    end, opened, held = time.monotonic() + seconds, 0, []
    body = b"<world><group/></world>"
    head = (b"POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Type: text/xml\r\n"
            b"Content-Length: %d\r\n\r\n")
    while time.monotonic() < end:
        one = socket.create_connection(("127.0.0.1", daemon.port), 10)
        opened += 1
        kind = rng.randrange(5)
        if kind == 0:                       # slowloris: kept open with half a head
            one.sendall(b"GET /v1/scenes HTTP/1.1\r\nHost:")
            held.append(one)
            continue
        if kind == 1:                       # gone in the middle of the body
            one.sendall(head % 1000 + body)
        elif kind == 2:                     # gone before the answer
            one.sendall(b"GET /v1/scenes/%s/image?width=512&height=512&azimuth=%d HTTP/1.1\r\n"
                        b"Host: x\r\n\r\n" % (daemon.some_scene.encode(), rng.randrange(360)))
            time.sleep(0.002)
        elif kind == 3:                     # noise
            one.sendall(rng.randbytes(rng.randrange(1, 2000)))
        else:                               # asks a lot, reads nothing
            try:
                one.sendall(b"GET /openapi.yaml HTTP/1.1\r\nHost: x\r\n\r\n" * 200)
            except OSError:
                pass
            held.append(one)
            continue
        one.close()
        time.sleep(0.005)
    for one in held:
        one.close()
    return f"{opened} bad clients, {len(held)} of them held"


def main():
    binary, seconds = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 60
    rng, bad = random.Random(1), False
    faults = (kill_workers, stop_workers, bad_clients)
    for number, fault in enumerate(faults):
        with Daemon(binary, "--workers", 2, "--deadline", DEADLINE_S, "--wait", WAIT_S,
                    "--quarantine", 1, "--cache-bytes", 0) as daemon:
            ids = scene_ids(daemon)[:6]
            daemon.some_scene = ids[0]
            paths = [f"/v1/scenes/{one}/image?width=128&height=128&azimuth={angle}&aa=1"
                     for one in ids for angle in (0, 90)]
            with Load(daemon, paths) as load, \
                    Progress(load, fault.__name__, number, len(faults), seconds):
                said = fault(daemon, seconds, rng)
            slowest = DEADLINE_S + WAIT_S + SLACK_S
            time.sleep(1)
            after = daemon.get(paths[0])
            healthy = daemon.alive() and after[0] == 200 and after[2] == load.expected[paths[0]]
            print(f"{fault.__name__}: {said}; answers {dict(load.statuses)}; slowest "
                  f"{load.slowest:.2f} s; wrong {len(load.wrong)} {load.wrong[:3]}; "
                  f"healthy after: {healthy}")
            bad = bad or bool(load.wrong) or not healthy or load.slowest > slowest \
                or load.statuses[200] == 0
    sys.exit(1 if bad else 0)


main()
