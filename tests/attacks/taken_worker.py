"""A worker that a hostile file has taken over answers in ways of its own. Needs root and Linux 5.6 (pidfd_getfd)."""
import ctypes
import os
import random
import signal
import socket
import struct
import threading
import time

from common import BOX, Failed, Watch, attack, check, render, service

PIDFD_GETFD = 438  # the same on every architecture
WORKER_SOCKET = 3  # the descriptor that a worker is started with


class TakenWorker:
    """Stops a worker and speaks in its place: frames of a 64-bit length and that many bytes."""

    def __init__(self, pid):
        self.pid = pid
        os.kill(pid, signal.SIGSTOP)
        libc = ctypes.CDLL(None, use_errno=True)
        fd = libc.syscall(PIDFD_GETFD, os.pidfd_open(pid), WORKER_SOCKET, 0)
        if fd < 0:
            raise OSError(ctypes.get_errno(), "pidfd_getfd")
        self.socket = socket.socket(fileno=fd)
        self.socket.setblocking(True)
        self.socket.settimeout(20)

    def request(self):
        size = struct.unpack("<Q", self._exactly(8))[0]
        return self._exactly(size)

    def _exactly(self, size):
        out = bytearray()
        while len(out) < size:
            chunk = self.socket.recv(min(1 << 20, size - len(out)))
            if not chunk:
                raise OSError("the service hung up")
            out += chunk
        return bytes(out)

    def send(self, size, body=b"", repeat=1):
        """`repeat` bodies after the length `size`, until the service hangs up."""
        try:
            self.socket.sendall(struct.pack("<Q", size))
            for _ in range(repeat):
                self.socket.sendall(body)
        except OSError:
            pass


def count(number):
    return struct.pack("<Q", number)


MIB = 1 << 20
NOISE = random.Random(11)
ANSWERS = [
    ("cut off", lambda worker: worker.send(1, b"\0")),
    ("empty", lambda worker: worker.send(0)),
    ("length 2^63", lambda worker: worker.send(1 << 63)),
    ("length 2^40", lambda worker: worker.send(1 << 40, b"\0" * MIB, 64)),
    ("600 MiB of zeros", lambda worker: worker.send(600 * MIB, b"\0" * MIB, 600)),
    ("2^60 diagnostics", lambda worker: worker.send(9, b"\0" + count(1 << 60))),
    ("64 MiB of empty diagnostics", lambda worker: worker.send(64 * MIB + 9, b"\1" + count(2 * MIB) + b"\0" * (64 * MIB))),
    ("a string of 2^50", lambda worker: worker.send(17, b"\0" + count(0) + count(1 << 50))),
] + [(f"noise {index}", lambda worker, index=index: worker.send(4096, NOISE.randbytes(4096))) for index in range(6)]


@attack
def wrong_replies(binary):
    """Each is a 503 for the request that the worker had, and costs the parent nothing."""
    if os.geteuid() != 0:
        return "not tried: needs root"
    results = []
    for name, answer in ANSWERS:
        with service(binary, "--workers", 1, "--spares", 0, "--deadline", 5) as daemon, Watch(daemon) as watch:
            worker = TakenWorker(daemon.workers()[0])
            status = []
            asking = threading.Thread(target=lambda: status.append(render(daemon, BOX.format(4))[0]))
            asking.start()
            worker.request()
            answer(worker)
            asking.join(30)
            check(status and status[0] == 503, f"{name}: answered {status}")
            time.sleep(0.2)
            try:
                watch.judge(64)  # the scene's window decides the size, so a reply may be the largest image
            except Failed as fault:
                raise Failed(f"{name}: {fault}") from None
            results.append(f"{watch.peak_mib - watch.base_mib:+.0f}")
    return f"{len(ANSWERS)} replies, 503 each; parent MiB {' '.join(results)}"
