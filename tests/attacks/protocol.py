"""What arrives before a request is understood: floods, slow clients, foreign pages, a log that nobody reads."""
import os
import signal
import socket
import subprocess
import time

from common import ROOT, BOX, Watch, ask, attack, check, multipart, post, raw, service, status_of


def flood(binary, data, seconds=3.0):
    """One connection sends `data` again and again; the service stays answerable."""
    with service(binary) as daemon, Watch(daemon) as watch:
        sent, end, state = 0, time.monotonic() + seconds, "still connected"
        with socket.create_connection(("127.0.0.1", daemon.port)) as connection:
            connection.settimeout(seconds)
            try:
                while time.monotonic() < end:
                    sent += connection.send(data)
            except OSError:
                state = "disconnected"
        return f"{state} after {sent >> 10} KiB, {watch.judge()}"


@attack
def blank_lines(binary):
    return flood(binary, b"\r\n" * 32768)


@attack
def endless_header(binary):
    return flood(binary, b"X-Header-Line: aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\r\n" * 1024)


@attack
def endless_chunk_extension(binary):
    head = (b"POST /v1/render HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/xml\r\n"
            b"Transfer-Encoding: chunked\r\n\r\n1;")
    return flood(binary, head + b"e=1;" * 65536)


@attack
def tiny_chunks(binary):
    head = (b"POST /v1/render HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/xml\r\n"
            b"Transfer-Encoding: chunked\r\n\r\n")
    return flood(binary, head + b"1\r\na\r\n" * 65536)


@attack
def pipelined(binary):
    return flood(binary, b"GET /livez HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n" * 1024)


@attack
def slow_heads(binary):
    """200 connections that send a byte a quarter of a second."""
    with service(binary) as daemon, Watch(daemon) as watch:
        connections = [socket.create_connection(("127.0.0.1", daemon.port)) for _ in range(200)]
        for byte in b"GET /livez HT":
            for connection in connections:
                try:
                    connection.send(bytes([byte]))
                except OSError:
                    pass
            time.sleep(0.25)
        for connection in connections:
            connection.close()
        return watch.judge()


@attack
def idle_connections(binary):
    """One client holds every connection that it is given; a client of another address is served."""
    with service(binary) as daemon, Watch(daemon) as watch:
        held = []
        for _ in range(1500):
            connection = socket.socket()
            connection.settimeout(0.5)
            connection.bind(("127.0.0.3", 0))
            try:
                connection.connect(("127.0.0.1", daemon.port))
            except OSError:
                break
            held.append(connection)
        time.sleep(0.5)
        status = ask(daemon.connection(5), "GET", "/v1/scenes")[0]
        for connection in held:
            connection.close()
        check(status == 200, f"another client is answered {status}")
        return f"{len(held)} connections opened, {watch.judge()}"


@attack
def cross_site(binary):
    """(request, expected) for what a page of another origin can make a browser send."""
    body, kind = multipart([("scene", "scene.xml", BOX.format(1))])
    with service(binary) as daemon:
        own = f"127.0.0.1:{daemon.port}"
        cases = [({"Origin": "https://evil.example", "Sec-Fetch-Site": "cross-site"}, 403),
                 ({"Origin": "https://evil.example"}, 403), ({"Origin": "null"}, 403),
                 ({"Origin": f"http://localhost:{daemon.port}"}, 403),
                 ({"Origin": f"http://127.0.0.1:{daemon.port + 1}"}, 403),
                 ({"Sec-Fetch-Site": "same-site"}, 403), ({"Sec-Fetch-Site": "cross-site"}, 403),
                 ({"Origin": f"http://{own}", "Sec-Fetch-Site": "same-origin"}, 201),
                 ({"Sec-Fetch-Site": "none"}, 200), ({}, 200)]
        for headers, expected in cases:
            status = post(daemon, "/v1/scenes", body, kind, **headers)[0]
            check(status == expected, f"{headers} is answered {status} instead of {expected}")
        for host, path, expected in [("rebound.example", "/v1/scenes", 421), (own, "/v1/scenes", 200),
                                     ("LOCALHOST", "/v1/scenes", 200), ("[::1]:80", "/v1/scenes", 200),
                                     ("10.0.0.9", "/livez", 200), ("rebound.example", "/readyz", 200),
                                     ("127.0.0.1.rebound.example", "/v1/scenes", 421),
                                     ("rebound.example:" + str(daemon.port), "/v1/scenes", 421)]:
            answer = raw(daemon, f"GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode())
            check(status_of(answer) == expected, f"Host {host} {path} is answered {status_of(answer)}")
        answer = raw(daemon, b"GET /v1/scenes HTTP/1.1\r\nConnection: close\r\n\r\n")
        check(status_of(answer) == 400, f"a request without Host is answered {status_of(answer)}")
        return f"{len(cases) + 9} cases"


@attack
def stalled_log(binary):
    """Nobody reads stderr: the service answers, and ends when it is told to."""
    read, write = os.pipe()
    process = subprocess.Popen([binary, "serve", "--port", "0", "--scenes", ROOT / "scenes"],
                               stdout=subprocess.PIPE, stderr=write, text=True)
    os.close(write)
    try:
        port = int(process.stdout.readline().rsplit(":", 1)[1])
        for index in range(8000):
            with socket.create_connection(("127.0.0.1", port), timeout=5) as connection:
                connection.sendall(b"GET /livez HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n")
                check(b"200" in connection.recv(65536)[:20], f"request {index} is not answered")
        process.send_signal(signal.SIGTERM)
        code = process.wait(30)
        check(code == 0, f"ended with {code}")
        return "8000 requests answered, ended with 0"
    finally:
        os.close(read)
        if process.poll() is None:
            process.kill()


@attack
def closed_descriptors(binary):
    """Started with its standard descriptors closed; no log line gets into a worker's socket."""
    for closed in ("2>&-", "1>&- 2>&-", "0<&- 1>&- 2>&-"):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        process = subprocess.Popen(["bash", "-c", f'exec "$0" serve --port {port} --scenes "$1" {closed}',
                                    binary, ROOT / "scenes"])
        try:
            status = 0
            for _ in range(100):
                time.sleep(0.1)
                try:
                    with socket.create_connection(("127.0.0.1", port), timeout=20) as connection:
                        body = BOX.format(3).encode()
                        connection.sendall(b"POST /v1/render HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n"
                                           b"Content-Type: application/xml\r\nContent-Length: %d\r\n\r\n"
                                           % len(body) + body)
                        status = status_of(connection.recv(65536))
                        break
                except OSError:
                    continue
            check(status == 200, f"{closed}: a box is answered {status}")
            process.send_signal(signal.SIGTERM)
            check(process.wait(30) == 0, f"{closed}: ended with {process.returncode}")
        finally:
            if process.poll() is None:
                process.kill()
    return "3 ways of starting"
