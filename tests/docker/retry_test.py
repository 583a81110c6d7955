#!/usr/bin/env python3
"""What docker/haproxy.cfg sends a second time: retry_test.py"""
import http.server
import shutil
import signal
import threading
import unittest

from cluster import Proxy, get, send, skip, wait_for

PATHS = [f"/v1/scenes/s{number}/image" for number in range(8)]


class Renderer(http.server.ThreadingHTTPServer):
    """Ready, but answers all other requests with `status`."""

    def __init__(self, status):
        self.status, self.asked = status, []

        class Handler(http.server.BaseHTTPRequestHandler):
            def answer(handler):
                length = int(handler.headers.get("Content-Length") or 0)
                handler.rfile.read(length)
                ready = handler.path in ("/readyz", "/livez")
                if not ready:
                    self.asked.append(handler.command)
                handler.send_response(200 if ready else self.status)
                handler.send_header("Retry-After", "1")
                handler.send_header("Content-Length", "0")
                handler.end_headers()

            do_GET = do_HEAD = do_POST = do_DELETE = answer

            def log_message(self, *_):
                pass

        super().__init__(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.serve_forever, daemon=True).start()


class Retries(unittest.TestCase):
    def setUp(self):
        self.ending, self.healthy = Renderer(503), Renderer(200)
        self.proxy = Proxy([self.ending.server_port, self.healthy.server_port], 4)
        self.addCleanup(self.proxy.end, signal.SIGTERM)
        for one in (self.ending, self.healthy):
            self.addCleanup(one.server_close)
            self.addCleanup(one.shutdown)
        # Both are known: the hash gives each some of the scenes.
        wait_for("both are asked", lambda: all(
            get(self.proxy.port, path) for path in PATHS) and
            self.ending.asked and self.healthy.asked)

    def test_a_503_is_tried_elsewhere_where_nothing_changes(self):
        for method in ("GET", "HEAD"):
            self.ending.asked.clear()
            for path in PATHS:
                self.assertEqual(send(self.proxy.port, method, path)[0], 200, path)
            self.assertIn(method, self.ending.asked)

    def test_what_changes_something_is_sent_once(self):
        for method in ("POST", "DELETE"):
            for one in (self.ending, self.healthy):
                one.asked.clear()
            statuses = {send(self.proxy.port, method, path)[0] for path in PATHS}
            self.assertEqual(statuses, {200, 503})
            self.assertEqual(len(self.ending.asked) + len(self.healthy.asked), len(PATHS))

    def test_other_failures_are_the_answer(self):
        self.ending.status = 500
        self.ending.asked.clear()
        self.assertEqual({get(self.proxy.port, path)[0] for path in PATHS}, {200, 500})


if __name__ == "__main__":
    if not shutil.which("haproxy"):
        skip("there is no haproxy (package haproxy)")
    unittest.main(verbosity=2)
