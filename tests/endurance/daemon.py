"""A `farol serve` under test, and what the kernel tells of it. Standard library only."""
import http.client
import json
import os
import pathlib
import signal
import subprocess
import threading

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Daemon:
    """The program on a port of 127.0.0.1 (0: a free one); ends with the `with` block."""

    def __init__(self, binary, *flags, scenes=ROOT / "scenes", port=0):
        self.log = []
        self.process = subprocess.Popen(
            [str(binary), "serve", "--port", str(port), "--scenes", str(scenes), *map(str, flags)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        if not line.startswith("listening on "):
            raise RuntimeError(f"the service did not start: {self.process.stderr.read()[-2000:]}")
        self.port = int(line.rsplit(":", 1)[1])
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stderr:
            self.log.append(line)
            if len(self.log) > 5000:
                del self.log[:2500]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            self.process.wait(30)

    @property
    def pid(self):
        return self.process.pid

    def alive(self):
        return self.process.poll() is None

    def workers(self):
        return [pid for pid, parent, _ in processes() if parent == self.pid]

    def connection(self, timeout=30):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)

    def get(self, path, headers=None):
        return ask(self.connection(), "GET", path, headers=headers)

    def json(self, path):
        return json.loads(self.get(path)[2])

    def metric(self, name):
        """The sum of a metric over its labels."""
        text = self.get("/metrics")[2].decode()
        return sum(float(line.rsplit(" ", 1)[1]) for line in text.splitlines()
                   if line.split("{")[0].split(" ")[0] == name)

    def cpu_s(self):
        """(of the parent, of its workers now alive), user and system."""
        mine, theirs = 0.0, 0.0
        for pid, parent, fields in processes():
            seconds = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
            if pid == self.pid:
                mine += seconds
            elif parent == self.pid:
                theirs += seconds
        return mine, theirs

    def resident_mib(self):
        """(of the parent, the largest worker)."""
        def of(pid):
            try:
                for line in open(f"/proc/{pid}/status"):
                    if line.startswith("VmRSS"):
                        return int(line.split()[1]) / 1024
            except OSError:
                pass
            return 0.0
        return of(self.pid), max([of(pid) for pid in self.workers()], default=0.0)

    def descriptors(self):
        return len(os.listdir(f"/proc/{self.pid}/fd"))


def ask(connection, method, path, body=None, headers=None):
    """(status, headers, body)"""
    connection.request(method, path, body=body, headers=headers or {})
    answer = connection.getresponse()
    return answer.status, answer.headers, answer.read()


def processes():
    """(pid, parent, the fields of /proc/PID/stat after the name) of all that are no zombies."""
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            text = open(f"/proc/{name}/stat").read()
        except OSError:
            continue
        fields = text[text.rindex(")") + 2:].split()
        if fields[0] != "Z":
            yield int(name), int(fields[1]), fields


def scene_ids(daemon):
    """Those that can be drawn."""
    return [one["id"] for one in daemon.json("/v1/scenes")["scenes"] if one["valid"]]
