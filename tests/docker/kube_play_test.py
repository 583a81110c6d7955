#!/usr/bin/env python3
"""The renderer's pod, as kustomize makes it of docker/, played by podman in a network and mount
namespace of its own, beside a Redis: kube_play_test.py IMAGE
As root; wants kubectl for its kustomize."""
import http.client
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from cluster import ROOT, get, redis_program, send, skip, wait_for

INSIDE = "FAROL_OWN_NAMESPACES"
SCENE = (b'<world><group><models><model file="box_1_1.3d"/></models></group></world>')
# What `podman run` is told by flags elsewhere in these tests.
SETTINGS = """[containers]
default_ulimits = ["nofile=4096:4096", "nproc=4096:4096"]
[engine]
runtime = "runc"
"""


def must(*words):
    done = subprocess.run(words, capture_output=True, text=True, timeout=300)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(words)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def played(image):
    """The Deployment's pod and its ConfigMap. Without probes by HTTP, which podman makes by curl in the
    container, and ports, which it does not know on the host's network."""
    objects = list(yaml.safe_load_all(must("kubectl", "kustomize", str(ROOT / "docker"))))
    template = next(one for one in objects if one["kind"] == "Deployment"
                    and one["metadata"]["name"] == "farol-renderer")["spec"]["template"]
    container = template["spec"]["containers"][0]
    for field in ("startupProbe", "readinessProbe", "livenessProbe", "ports"):
        container.pop(field)
    container["image"] = image
    used = {one["configMap"]["name"] for one in template["spec"]["volumes"] if "configMap" in one}
    settings = [one for one in objects
                if one["kind"] == "ConfigMap" and one["metadata"]["name"] in used]
    template["metadata"]["name"] = "farol-played"
    return settings + [{"apiVersion": "v1", "kind": "Pod", **template}]


class Played(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.manifest = pathlib.Path(folder.name) / "pod.yaml"
        self.manifest.write_text(yaml.safe_dump_all(played(sys.argv[1])))
        settings = pathlib.Path(folder.name) / "containers.conf"
        settings.write_text(SETTINGS)
        os.environ["CONTAINERS_CONF"] = str(settings)
        # The name of the Redis, which a cluster would know; podman takes the host's file.
        names = pathlib.Path(folder.name) / "hosts"
        names.write_text("127.0.0.1 localhost farol-store\n")
        must("mount", "--bind", str(names), "/etc/hosts")
        self.addCleanup(must, "umount", "/etc/hosts")
        redis = subprocess.Popen(["redis-server", "--bind", "127.0.0.1", "--save", "", "--logfile",
                                  "/dev/null"], executable=redis_program())
        self.addCleanup(redis.wait)
        self.addCleanup(redis.terminate)

    def test_the_pod_of_the_manifests(self):
        self.addCleanup(subprocess.run, ["podman", "pod", "rm", "-f", "-t", "5", "farol-played"],
                        capture_output=True)
        must("podman", "kube", "play", "--network", "host", str(self.manifest))
        name = "farol-played-farol"

        def state():
            return json.loads(must("podman", "inspect", name))[0]["State"]
        wait_for("the pod is ready", lambda: get(8080, "/readyz")[0] == 200, 120)
        self.assertEqual(json.loads(get(8080, "/readyz")[2])["store"], "reachable")
        # The settings are the ConfigMap's.
        self.assertIn(b"farol_workers 2\n", get(8080, "/metrics")[2])
        status = dict(line.split(":\t", 1) for line in
                      pathlib.Path(f"/proc/{state()['Pid']}/status").read_text().splitlines()
                      if ":\t" in line)
        self.assertEqual(status["Uid"].split()[0], "10001")
        self.assertEqual(int(status["CapBnd"], 16), 0)
        self.assertEqual(status["NoNewPrivs"], "1")
        refused = subprocess.run(["podman", "exec", name, "farol", "generate", "box", "1", "1",
                                  "/usr/share/farol/box.obj"], capture_output=True, text=True)
        self.assertNotEqual(refused.returncode, 0)
        must("podman", "exec", name, "farol", "generate", "box", "1", "1", "/tmp/box.obj")

        code, headers, _ = send(8080, "POST", "/v1/scenes", SCENE,
                                {"Content-Type": "application/xml"})
        self.assertEqual(code, 201)
        code, _, picture = get(8080, f"{headers['Location']}/image?width=64&height=64")
        self.assertEqual((code, picture[:4]), (200, b"\x89PNG"))
        must("podman", "pod", "stop", "-t", "20", "farol-played")
        self.assertEqual(state()["ExitCode"], 0)
        with self.assertRaises((OSError, http.client.HTTPException)):
            get(8080, "/livez")


if __name__ == "__main__":
    if os.geteuid() != 0:
        skip("playing pods here wants root")
    for tool in ("podman", "runc", "catatonit", "unshare", "kubectl"):
        if not shutil.which(tool):
            skip(f"there is no {tool} (scripts/setup docker)")
    if subprocess.run(["podman", "image", "exists", sys.argv[1]]).returncode != 0:
        skip(f"there is no image {sys.argv[1]} (image_test.py builds it)")
    if not redis_program():
        skip("there is no redis-server (package redis-tools)")
    try:
        import yaml
    except ImportError:
        skip("there is no yaml for Python (package python3-yaml)")
    if INSIDE not in os.environ:
        os.environ[INSIDE] = "1"
        os.execvp("unshare", ["unshare", "--net", "--mount", "sh", "-c", 'ip link set lo up && exec "$@"',
                              "sh", sys.executable, "-W", "ignore", *sys.argv])
    unittest.main(argv=sys.argv[:1], verbosity=2)
