"""What the attack programs share: a service under a memory limit, a watch over it, requests that no client
library would send. Standard library only."""
import contextlib
import http.client
import io
import json
import pathlib
import resource
import socket
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "endurance"))
from daemon import Daemon, ask  # noqa: E402,F401

# A box: the smallest scene that is drawn.
BOX = ('<world><window width="64" height="64"/><group><models><model file="box_{}_1.3d"/></models></group>'
       '</world>')
# Writable private memory of the parent: far above what it needs, far below what the attacks ask for.
PARENT_LIMIT_MIB = 512
# /livez slower than this is a service that hangs; the figure itself is reported, bar 100 ms.
HUNG_MS = 2000

ATTACKS = []


class Failed(Exception):
    """The service did what it must not do."""


def attack(function):
    """Registers a function of the program's path; it returns one line of result or raises Failed."""
    ATTACKS.append(function)
    return function


def check(condition, text):
    if not condition:
        raise Failed(text)


@contextlib.contextmanager
def service(binary, *flags, **options):
    """A Daemon whose parent may take PARENT_LIMIT_MIB; must be alive and drawing at the end."""
    with Daemon(binary, *flags, **options) as daemon:
        hard = resource.prlimit(daemon.pid, resource.RLIMIT_DATA)[1]
        # The soft limit alone: workers set their own below the hard one.
        resource.prlimit(daemon.pid, resource.RLIMIT_DATA, (PARENT_LIMIT_MIB << 20, hard))
        yield daemon
        check(daemon.alive(), f"the service ended with {daemon.process.poll()}")
        status, _, body = render(daemon, BOX.format(77))
        check(status == 200, f"afterwards a box is answered {status}: {code_of(body)}")


class Watch:
    """Asks /livez ten times a second and reads the parent's memory while the block runs."""

    def __init__(self, daemon):
        self.daemon = daemon
        self.slowest_ms = 0.0
        self.base_mib = self.peak_mib = daemon.resident_mib()[0]
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._end.set()
        self._thread.join()

    def _run(self):
        while not self._end.wait(0.1):
            begin = time.monotonic()
            try:
                ask(self.daemon.connection(10), "GET", "/livez")
            except OSError:
                pass
            self.slowest_ms = max(self.slowest_ms, (time.monotonic() - begin) * 1000)
            self.peak_mib = max(self.peak_mib, self.daemon.resident_mib()[0])

    def judge(self, in_flight_mib=0.0):
        """The memory bar: 1.25 times what it had, plus the bodies in flight (twice: received and parsed)."""
        bar = 1.25 * self.base_mib + 2 * in_flight_mib + 16
        check(self.peak_mib <= bar, f"the parent grew from {self.base_mib:.0f} to {self.peak_mib:.0f} MiB")
        check(self.slowest_ms <= HUNG_MS, f"/livez took {self.slowest_ms:.0f} ms")
        return (f"parent {self.base_mib:.0f} to {self.peak_mib:.0f} MiB, "
                f"slowest /livez {self.slowest_ms:.0f} ms")


def code_of(body):
    try:
        return json.loads(body).get("code", "?")
    except ValueError:
        return repr(body[:60])


def render(daemon, xml, path="/v1/render", timeout=60):
    body = xml.encode() if isinstance(xml, str) else xml
    return ask(daemon.connection(timeout), "POST", path, body, {"Content-Type": "application/xml"})


def multipart(parts, boundary="part-boundary"):
    """(body, content type) of (field, file name or None, bytes or text)."""
    out = io.BytesIO()
    for field, name, content in parts:
        out.write(f'--{boundary}\r\nContent-Disposition: form-data; name="{field}"'.encode())
        if name is not None:
            out.write(f'; filename="{name}"'.encode())
        out.write(b"\r\n\r\n" + (content.encode() if isinstance(content, str) else content) + b"\r\n")
    out.write(f"--{boundary}--\r\n".encode())
    return out.getvalue(), f"multipart/form-data; boundary={boundary}"


def post(daemon, path, body, content_type, timeout=60, **headers):
    """(status, headers, body); 0 where the connection was closed without an answer."""
    try:
        return ask(daemon.connection(timeout), "POST", path, body,
                   {"Content-Type": content_type, **headers})
    except (OSError, http.client.HTTPException) as error:
        return 0, {}, str(error).encode()


def raw(daemon, data, timeout=5.0):
    """Sends bytes as they are and returns what comes back until the end or the timeout."""
    out = b""
    with socket.create_connection(("127.0.0.1", daemon.port), timeout=timeout) as connection:
        try:
            connection.sendall(data)
            while chunk := connection.recv(65536):
                out += chunk
        except OSError:
            pass
    return out


def status_of(answer):
    """Of a raw answer; 0 for none."""
    parts = answer.split(b" ", 2)
    return int(parts[1]) if len(parts) > 1 and parts[1].isdigit() else 0


def together(count, function):
    """Results of function(0) ... function(count - 1), all at once."""
    results = [None] * count

    def run(index):
        results[index] = function(index)

    threads = [threading.Thread(target=run, args=(index,)) for index in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results
