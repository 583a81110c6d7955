#!/usr/bin/env python3
"""Three renderers behind a real proxy and a real Redis: cluster_test.py BINARY"""
import collections
import json
import os
import pathlib
import re
import signal
import sys
import tempfile
import threading
import time
import unittest

from cluster import ROOT, Cluster, Proxy, get, many, needed, send, wait_for

SIZE = "width=32&height=32&aa=1"
# As compose and Kubernetes have it.
DRAIN_S = int(re.search(r'FAROL_DRAIN: "(\d+)"', (ROOT / "docker/compose.yaml").read_text()).group(1))


def scene(number):
    return (f'<world><camera><position x="{3 + number % 7}" y="2" z="4"/><lookAt x="0" y="0" z="0"/>'
            f'</camera><group><transform><scale x="{1 + number / 1000}" y="1" z="1"/></transform>'
            '<models><model file="box_1_1.3d"/></models></group></world>').encode()


class Clients:
    """Ask for images of these scenes until the `with` block ends. `drawn` counts them by renderer,
    `lost` has every other answer whole."""

    def __init__(self, cluster, ids, count):
        self.cluster, self.ids = cluster, ids
        self.drawn, self.lost, self.stopping = collections.Counter(), [], threading.Event()
        self.threads = [threading.Thread(target=self._ask, args=(i * 5,)) for i in range(count)]

    def _ask(self, turn):
        while not self.stopping.is_set():
            turn += 1
            path = f"/v1/scenes/{self.ids[turn % len(self.ids)]}/image?{SIZE}&azimuth={turn % 360}"
            status, headers, body = self.cluster.get(path)
            if status == 200:
                self.drawn[headers["X-Farol-Renderer"]] += 1
            else:
                self.lost.append((time.monotonic(), status, dict(headers), body))

    def __enter__(self):
        for thread in self.threads:
            thread.start()
        return self

    def __exit__(self, *_):
        self.stopping.set()
        for thread in self.threads:
            thread.join()


class Behind(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        for number in range(12):
            (pathlib.Path(cls.folder.name) / f"s{number}.xml").write_bytes(scene(9000 + number))
        cls.cluster = Cluster(sys.argv[1], 3, "--cache-bytes", 0, "--drain", DRAIN_S,
                              scenes=cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.cluster.__exit__()
        cls.folder.cleanup()

    def placed(self, ids, angle=0):
        """Which renderer draws each scene; every answer must be a picture."""
        where = {}
        for one in ids:
            status, headers, _ = self.cluster.get(
                f"/v1/scenes/{one}/image?{SIZE}&azimuth={angle}")
            self.assertEqual(status, 200, one)
            where[one] = headers["X-Farol-Renderer"]
        return where

    def test_1_a_scene_stays_on_its_renderer(self):
        ids = self.cluster.scene_ids()
        self.assertGreaterEqual(len(ids), 10)
        first = self.placed(ids)
        self.assertGreaterEqual(len(set(first.values())), 2, first)
        for angle in (40, 80):
            self.assertEqual(self.placed(ids, angle), first)
        # What names no scene goes round.
        seen = {self.cluster.post(f"/v1/render?{SIZE}", scene(i))[1]["X-Farol-Renderer"]
                for i in range(9)}
        self.assertEqual(len(seen), 3)

    def test_2_an_upload_is_drawn_by_all(self):
        status, headers, _ = send(self.cluster.ports[0], "POST", "/v1/scenes", scene(1),
                                  {"Content-Type": "application/xml"})
        self.assertEqual(status, 201)
        pictures = {get(port, f"{headers['Location']}/image?{SIZE}")[2]
                    for port in self.cluster.ports}
        self.assertEqual(len(pictures), 1)
        self.assertTrue(pictures.pop().startswith(b"\x89PNG"))
        self.assertEqual(send(self.cluster.ports[1], "POST", "/v1/scenes", scene(1),
                              {"Content-Type": "application/xml"})[0], 200)
        self.assertEqual(send(self.cluster.ports[2], "DELETE", headers["Location"])[0], 204)
        for port in self.cluster.ports:
            self.assertEqual(get(port, f"{headers['Location']}/image?{SIZE}")[0], 404)

    def test_3_a_renderer_that_is_killed_moves_its_scenes_only(self):
        ids = self.cluster.scene_ids()
        before = self.placed(ids)
        victim = int(collections.Counter(before.values()).most_common(1)[0][0][len("renderer"):])
        with Clients(self.cluster, ids, 4) as clients:
            wait_for("some images", lambda: clients.drawn.total() > 20)
            self.cluster.kill(victim)
            seen = clients.drawn.total()
            wait_for("images without it", lambda: clients.drawn.total() > seen + 40)
        self.assertEqual(clients.lost, [])

        after = self.placed(ids)
        name = f"renderer{victim}"
        self.assertNotIn(name, after.values())
        moved = {one for one in ids if after[one] != before[one]}
        self.assertEqual(moved, {one for one in ids if before[one] == name})

        self.cluster.start(victim)
        self.cluster.all_ready()
        wait_for("its scenes are home again", lambda: self.placed(ids) == before)

    def test_4_renderers_are_replaced_one_by_one_and_nothing_is_lost(self):
        ids = self.cluster.scene_ids()
        steps = []
        with Clients(self.cluster, ids, 3) as clients:
            for index, one in enumerate(self.cluster.renderers):
                name = f"renderer{index}"
                steps.append((time.monotonic(), f"{name} ends"))
                one.process.send_signal(signal.SIGTERM)
                self.assertEqual(one.process.wait(60), 0)
                steps.append((time.monotonic(), f"{name} has ended"))
                self.cluster.start(index)
                # As docs/how-to/operator-run-in-containers.md has it.
                wait_for("the proxy has it back", lambda name=name: name in self.cluster.proxy.up())
                seen = clients.drawn[name]
                wait_for("images of it", lambda name=name, seen=seen:
                         clients.drawn[name] > seen + 10)
        print(f"three renderers replaced: {dict(clients.drawn)}", flush=True)
        self.assertEqual(clients.lost, [], steps)

    def test_5_a_burst_waits_and_an_overload_is_told_when_to_come_again(self):
        ids = self.cluster.scene_ids()
        burst = many([lambda i=i: self.cluster.get(
            f"/v1/scenes/{ids[0]}/image?{SIZE}&azimuth={i}") for i in range(12)], 12)
        self.assertEqual([one[0] for one in burst], [200] * 12)
        # Workers that stand still are as good as any overload, and depend on no clock; a proxy with
        # the shipped wait.
        impatient = Proxy(self.cluster.ports, 1, queue_s=3)
        self.addCleanup(impatient.end, signal.SIGTERM)
        wait_for("it knows a renderer", lambda: get(impatient.port, "/readyz")[0] == 200)
        workers = [pid for one in self.cluster.renderers for pid in one.workers()]
        self.assertGreaterEqual(len(workers), 3)
        for pid in workers:
            os.kill(pid, signal.SIGSTOP)
        try:
            answers = many([lambda i=i: get(
                impatient.port, f"/v1/scenes/{ids[i % len(ids)]}/image?{SIZE}&azimuth={i}&fov=50",
                timeout=200) for i in range(24)], 24)
        finally:
            for pid in workers:
                try:
                    os.kill(pid, signal.SIGCONT)
                except ProcessLookupError:
                    pass
        codes = collections.Counter()
        for status, headers, body in answers:
            if status == 200:  # past the deadline, tried again by the proxy where a worker is new
                codes["drawn"] += 1
                continue
            self.assertEqual(status, 503)
            self.assertGreaterEqual(int(headers["Retry-After"]), 1)
            self.assertEqual(headers["Content-Type"], "application/problem+json")
            codes[json.loads(body)["code"]] += 1
        self.assertGreater(codes["busy.queue"], 0)
        print(f"overload: {dict(codes)}", flush=True)
        # What docker/alerts.yaml asks the proxy for.
        metrics = get(impatient.operator, "/metrics")[2].decode()
        rules = (ROOT / "docker" / "alerts.yaml").read_text()
        for asked in set(re.findall(r"haproxy_\w+{[^}]*", rules)):
            told = re.search(f"^{re.escape(asked)}}} (\\d+)$", metrics, re.M)
            self.assertTrue(told, asked)
            self.assertGreaterEqual(int(told.group(1)), codes["busy.queue"])
        self.cluster.all_ready()
        wait_for("pictures again", lambda: set(
            self.cluster.get(f"/v1/scenes/{one}/image?{SIZE}")[0] for one in ids) == {200})

    def test_6_a_redis_that_is_killed_has_all_that_was_acknowledged(self):
        ids, acknowledged, refused = self.cluster.scene_ids(), [], collections.Counter()
        stopping = threading.Event()

        def client(start):
            number = start
            while not stopping.is_set():
                number += 1
                status, headers, body = self.cluster.post("/v1/scenes", scene(number))
                if status == 201:
                    acknowledged.append(headers["Location"])
                else:
                    refused[(status, json.loads(body)["code"],
                             int(headers["Retry-After"] or 0) > 0)] += 1

        threads = [threading.Thread(target=client, args=(1000 * i,)) for i in (1, 2, 3)]
        for thread in threads:
            thread.start()
        wait_for("uploads", lambda: len(acknowledged) > 20)
        self.cluster.redis.end(signal.SIGKILL)
        wait_for("refused uploads", lambda: refused.total() > 5)
        stopping.set()
        for thread in threads:
            thread.join()
        self.assertEqual(set(refused), {(503, "store.unreachable", True)}, refused)

        for port in self.cluster.ports:  # away, and said so; what needs no store goes on
            status, headers, body = get(port, "/v1/scenes/~00000000000000000000000000000000")
            self.assertEqual((status, json.loads(body)["code"]), (503, "store.unreachable"))
            self.assertTrue(headers["Retry-After"])
            status, _, body = get(port, "/readyz")
            self.assertEqual((status, json.loads(body)["store"]), (200, "unreachable"))
            self.assertEqual(get(port, f"/v1/scenes/{ids[0]}/image?{SIZE}")[0], 200)
            self.assertIn(b"farol_store_up 0\n", get(port, "/metrics")[2])
        self.assertEqual(self.cluster.post(f"/v1/render?{SIZE}", scene(5))[0], 200)

        self.cluster.redis.start()
        wait_for("uploads again", lambda: self.cluster.post("/v1/scenes", scene(7))[0] in (200, 201))
        time.sleep(1)  # a renderer tries once a second
        for place in acknowledged:
            self.assertEqual(self.cluster.get(f"{place}/source")[0], 200, place)
        for port in self.cluster.ports:
            self.assertEqual(get(port, f"{acknowledged[0]}/image?{SIZE}")[0], 200)
            self.assertIn(b"farol_store_up 1\n", get(port, "/metrics")[2])
        print(f"{len(acknowledged)} uploads acknowledged, none lost", flush=True)


if __name__ == "__main__":
    needed()
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
