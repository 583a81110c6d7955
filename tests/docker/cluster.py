"""Renderers behind the shipped proxy configuration and a Redis, all on loopback. Standard library
only."""
import concurrent.futures
import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "endurance"))
from daemon import Daemon, ask  # noqa: E402

SKIPPED = 77  # ctest's SKIP_RETURN_CODE


def skip(why):
    """Ends the program as skipped; as failed under CI=true, where every tool must be present."""
    required = os.environ.get("CI") == "true"
    print(f"{'FAILED' if required else 'SKIPPED'}: {why}", flush=True)
    sys.exit(1 if required else SKIPPED)


def redis_program():
    # Debian's redis-tools has the server under another name, and starts no service.
    return shutil.which("redis-server") or shutil.which("redis-check-rdb")


def needed():
    if not shutil.which("haproxy"):
        skip("there is no haproxy (package haproxy)")
    if not redis_program():
        skip("there is no redis-server (package redis-tools)")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def wait_for(what, condition, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            if condition():
                return
        except (OSError, http.client.HTTPException, ValueError):
            pass
        time.sleep(0.1)
    raise AssertionError(f"not in {seconds} s: {what}")


def get(port, path, headers=None, timeout=60):
    return send(port, "GET", path, None, headers, timeout)


def send(port, method, path, body=None, headers=None, timeout=60):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=timeout)
    try:
        return ask(connection, method, path, body, headers)
    finally:
        connection.close()


def many(calls, at_once=16):
    with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
        return list(pool.map(lambda call: call(), calls))


class Process:
    """Ends with the `with` block."""

    def __init__(self):
        self.process = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end(signal.SIGTERM)

    def end(self, number):
        if self.process and self.process.poll() is None:
            self.process.send_signal(number)
            try:
                self.process.wait(20)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.process = None


class Redis(Process):
    """Writes every change to the disk before it answers, as docker/compose.yaml has it."""

    def __init__(self, folder):
        super().__init__()
        self.folder, self.port = folder, free_port()
        self.start()

    @property
    def url(self):
        return f"redis://127.0.0.1:{self.port}/0"

    def start(self):
        self.process = subprocess.Popen(
            ["redis-server", "--port", str(self.port), "--bind", "127.0.0.1", "--dir",
             str(self.folder), "--appendonly", "yes", "--appendfsync", "always", "--save", "",
             "--maxmemory-policy", "noeviction", "--loglevel", "warning", "--logfile", "/dev/null"],
            executable=redis_program())
        wait_for("Redis answers", self.answers)

    def answers(self):
        with socket.create_connection(("127.0.0.1", self.port), 2) as one:
            one.sendall(b"PING\r\n")
            return one.recv(16) == b"+PONG\r\n"


class Proxy(Process):
    """HAProxy with docker/haproxy.cfg, whose servers are these ports instead of a name's, and whose
    timeouts are longer."""

    def __init__(self, ports, slots, queue_s=60):
        super().__init__()
        self.port, self.operator = free_port(), free_port()
        lines = []
        for line in (ROOT / "docker" / "haproxy.cfg").read_text().splitlines():
            if line.strip().startswith("server-template "):
                lines += [f"    server renderer{i} 127.0.0.1:{port}"
                          for i, port in enumerate(ports)]
            else:
                for shipped, here in ((':8080"', f':{self.port}"'), (':8404"', f':{self.operator}"'),
                                      ("timeout server 15s", "timeout server 130s"),
                                      ("timeout client 30s", "timeout client 130s"),
                                      ("timeout check 5s", "timeout check 60s"),
                                      ("timeout queue 3s", f"timeout queue {queue_s}s")):
                    line = line.replace(shipped, here)
                lines.append(line)
        self.file = tempfile.NamedTemporaryFile("w", suffix=".cfg")
        self.file.write("\n".join(lines) + "\n")
        self.file.flush()
        self.process = subprocess.Popen(
            ["haproxy", "-q", "-db", "-f", self.file.name], stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "FAROL_BIND": "127.0.0.1", "FAROL_SLOTS": str(slots),
                 "FAROL_RENDERERS": "localhost"})
        wait_for("the proxy answers", lambda: get(self.port, "/livez")[0] == 200)

    def up(self):
        """Names of the renderers that get requests."""
        text = get(self.operator, "/metrics")[2].decode()
        return set(re.findall(
            r'^haproxy_server_status{proxy="renderers",server="(\w+)",state="UP"} 1$', text, re.M))


class Cluster:
    """`count` renderers of one worker each; `flags` go to each of them. They are patient: a machine
    that does other work, too, is no fault of theirs."""

    def __init__(self, binary, count, *flags, scenes=ROOT / "scenes"):
        self.binary, self.slots, self.scenes = binary, 1, scenes
        self.flags = ("--wait", 60, "--deadline", 60, *flags)
        self.folder = tempfile.TemporaryDirectory()
        self.ports = [free_port() for _ in range(count)]
        self.renderers, self.proxy = [None] * count, None
        self.redis = Redis(self.folder.name)
        try:
            for index in range(count):
                self.start(index)
            self.proxy = Proxy(self.ports, self.slots)
            self.all_ready()
        except BaseException:
            self.__exit__()
            raise

    def start(self, index):
        self.renderers[index] = Daemon(
            self.binary, "--workers", 1, "--spares", 0, "--store", self.redis.url,
            "--trust-proxy", *self.flags, port=self.ports[index], scenes=self.scenes)

    def kill(self, index):
        one = self.renderers[index]
        one.process.kill()
        one.process.wait()

    def all_ready(self):
        for port in self.ports:
            wait_for("a renderer is ready", lambda port=port: get(port, "/readyz")[0] == 200)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.proxy:
            self.proxy.end(signal.SIGTERM)
        started = [one for one in self.renderers if one]
        for one in started:
            if one.alive():
                one.process.send_signal(signal.SIGTERM)
        for one in started:
            one.process.wait(60)
        self.redis.end(signal.SIGTERM)
        self.folder.cleanup()

    def get(self, path, headers=None):
        return get(self.proxy.port, path, headers)

    def post(self, path, body, content_type="application/xml"):
        return send(self.proxy.port, "POST", path, body, {"Content-Type": content_type})

    def scene_ids(self):
        _, _, body = self.get("/v1/scenes")
        return [one["id"] for one in json.loads(body)["scenes"]
                if one["valid"] and not one["upload"]]
