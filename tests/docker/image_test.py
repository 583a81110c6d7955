#!/usr/bin/env python3
"""Builds the image from a debootstrapped base and runs it closed in: image_test.py SCRATCH FAROL
FAROL is the program of this machine, to compare pictures by. $FAROL_DOCKER_BASE: a folder with a
Debian 12, instead of debootstrap; $FAROL_DOCKER_IMAGE: an image that is there, instead of a build.
Buildah and podman as root; standard library only."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from cluster import ROOT, free_port, get, send, skip, wait_for

SCRATCH, HOST_FAROL = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
BASE, TAG = "localhost/farol-base", "localhost/farol:test"
SCENES = "/usr/share/farol/scenes"
CLOSED = ["--runtime", "runc", "--read-only", "--read-only-tmpfs=false", "--cap-drop", "all",
          "--security-opt", "no-new-privileges", "--ulimit", "nofile=4096:4096", "--ulimit",
          "nproc=4096:4096", "--no-healthcheck"]
TMP = ["--tmpfs", "/tmp:rw,size=64m,mode=1777"]
MOST_MB = 250
TEXTURED = ('<world><camera><position x="0" y="2" z="0.01"/><lookAt x="0" y="0" z="0"/></camera><group>'
            '<models><model file="plane_2_1.3d"><texture file="{}"/></model></models></group></world>')
HOG = (b'<world><camera><position x="0" y="0" z="4"/><lookAt x="0" y="0" z="0"/></camera><group>'
       b'<models><model file="sphere_1_1500_1500.3d"/></models></group></world>')


def run(*words, timeout=600):
    # Where memory runs out, podman's monitor leaves a file "oom" in the folder it was started in.
    SCRATCH.mkdir(parents=True, exist_ok=True)
    return subprocess.run(words, capture_output=True, text=True, timeout=timeout, cwd=SCRATCH)


def must(*words, timeout=7200):
    done = run(*words, timeout=timeout)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(words)}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def make_base():
    if run("podman", "image", "exists", BASE).returncode == 0:
        return
    folder = pathlib.Path(os.environ.get("FAROL_DOCKER_BASE", SCRATCH / "base"))
    if not (folder / "etc" / "os-release").exists():
        print("making a base by debootstrap", flush=True)
        must("debootstrap", "--variant=minbase", "bookworm", str(folder))
    with tempfile.TemporaryFile() as packed:
        subprocess.run(["tar", "-C", str(folder), "-c", "--exclude=./proc/*", "--exclude=./sys/*",
                        "."], stdout=packed, check=True)
        packed.seek(0)
        subprocess.run(["podman", "import", "-q", "-", BASE], stdin=packed, check=True)


def build(tag, *flags):
    """With what is the same in each build told to buildah: times, and no label of its own."""
    start = time.monotonic()
    must("buildah", "bud", "--isolation", "chroot", "--network", "host", "--format", "docker",
         "--layers", "--timestamp", "0", "--identity-label=false", "--build-arg", f"BASE={BASE}",
         "--build-arg", "PRESET=test", *flags, "-f", str(ROOT / "docker" / "Dockerfile"), "-t", tag,
         str(ROOT))
    print(f"{tag} built in {time.monotonic() - start:.0f} s", flush=True)


class Container:
    """A service in a container on the host's network, or on none; ends with the `with` block."""

    def __init__(self, *flags, network="host", env=None):
        self.port = free_port()
        settings = {"FAROL_HOST": "127.0.0.1", "FAROL_PORT": str(self.port), **(env or {})}
        words = [word for name, value in settings.items() for word in ("-e", f"{name}={value}")]
        self.started = time.monotonic()
        self.id = must("podman", "run", "-d", *CLOSED, *TMP, "--network", network, *words, *flags,
                       TAG).strip().splitlines()[-1]
        try:
            wait_for("the service is healthy", self.healthy, 180)
        except AssertionError:
            print(run("podman", "logs", self.id).stderr[-2000:])
            self.__exit__()
            raise
        self.start_s = time.monotonic() - self.started

    def healthy(self):
        return self.exec("health", f"http://127.0.0.1:{self.port}").returncode == 0

    def exec(self, *words):
        return run("podman", "exec", self.id, "farol", *words)

    def state(self):
        return json.loads(must("podman", "inspect", self.id))[0]["State"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        run("podman", "rm", "-f", "-t", "5", self.id)


class Image(unittest.TestCase):
    def test_what_is_in_it(self):
        facts = json.loads(must("podman", "image", "inspect", TAG))[0]
        config = facts["Config"]
        self.assertRegex(config["User"], r"^[1-9]\d*:[1-9]\d*$")
        self.assertEqual(config["StopSignal"], "SIGTERM")
        self.assertEqual(facts["HealthCheck" if "HealthCheck" in facts else "Healthcheck"]["Test"],
                         ["CMD", "farol", "health"])
        self.assertFalse(config.get("Volumes"))
        self.assertIn("org.opencontainers.image.title", config["Labels"])
        at = pathlib.Path(must("podman", "image", "mount", TAG).strip())
        try:
            names = {str(path.relative_to(at)) for path in at.rglob("*")}
            for gone in ("usr/bin/sh", "usr/bin/apt-get", "usr/bin/dpkg", "var/lib/apt",
                         "usr/bin/g++", "usr/include"):
                self.assertNotIn(gone, names)
            self.assertEqual(sorted(os.listdir(at / "usr" / "bin")), ["farol"])
            writable = [name for name in names if not (at / name).is_symlink()
                        and (at / name).stat().st_mode & 0o022 and name != "tmp"]
            self.assertEqual(writable, [])
            setuid = [name for name in names if (at / name).lstat().st_mode & 0o6000]
            self.assertEqual(setuid, [])
            sizes = sorted(((at / name).stat().st_size, name) for name in names
                           if (at / name).is_file() and not (at / name).is_symlink())
            total = sum(size for size, _ in sizes) / 1e6
            largest = ", ".join(f"{pathlib.Path(name).name} {size / 1e6:.0f}"
                                for size, name in sizes[:-7:-1])
            print(f"{total:.0f} MB in {len(sizes)} files; largest: {largest}", flush=True)
            self.assertLess(total, MOST_MB)
        finally:
            run("podman", "image", "unmount", TAG)

    def test_a_known_picture_on_no_network_and_refused_writes(self):
        done = run("podman", "run", "--rm", *CLOSED, *TMP, "--network", "none", TAG, "render",
                   f"{SCENES}/primitives/scene.xml", "-o", "/usr/share/farol/picture.png")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("/usr/share/farol/picture.png", done.stdout + done.stderr)
        with tempfile.TemporaryDirectory() as folder:
            os.chmod(folder, 0o777)
            must("podman", "run", "--rm", *CLOSED, *TMP, "--network", "none", "-v", f"{folder}:/data",
                 TAG, "render", f"{SCENES}/primitives/scene.xml", "-o", "/data/in.png")
            must(HOST_FAROL, "render", str(ROOT / "scenes" / "primitives" / "scene.xml"), "-o",
                 f"{folder}/out.png")
            told = json.loads(must(HOST_FAROL, "compare", "--json", f"{folder}/in.png",
                                   f"{folder}/out.png"))
            print(f"against this machine's: mean {told['mean']}, max {told['max']}, ssim "
                  f"{told['ssim']}", flush=True)
            # The same Mesa gives the same bytes; another's rounding moves a pixel here and there.
            self.assertLess(told["mean"], 0.05)
            self.assertGreater(told["ssim"], 0.999)

    def test_every_kind_of_picture_is_read(self):
        """Libraries that are stand-ins in the image are called for none of them."""
        with tempfile.TemporaryDirectory() as folder:
            os.chmod(folder, 0o777)
            here = pathlib.Path(folder)
            pictures = sorted((ROOT / "tests" / "fuzz" / "seeds" / "image").iterdir())
            self.assertGreaterEqual({one.suffix for one in pictures}, {
                ".bmp", ".exr", ".gif", ".hdr", ".jpg", ".png", ".ppm", ".tga", ".tif", ".webp"})
            seen = set()
            with Container("-v", f"{folder}:/data", network="none") as service:
                for one in pictures:
                    shutil.copy(one, here)
                    (here / "scene.xml").write_text(TEXTURED.format(one.name))
                    flags = ("--strict", "--width", "64", "--height", "64", "-o")
                    done = service.exec("render", "/data/scene.xml", *flags, "/data/in.png")
                    self.assertEqual(done.returncode, 0, one.name + done.stderr)
                    must(HOST_FAROL, "render", str(here / "scene.xml"), *flags, str(here / "out.png"))
                    told = json.loads(must(HOST_FAROL, "compare", "--json", str(here / "in.png"),
                                           str(here / "out.png")))
                    self.assertLess(told["mean"], 0.05, one.name)
                    seen.add((here / "in.png").read_bytes())
            self.assertGreaterEqual(len(seen), 8, "they all look alike")

    def test_built_again_it_is_the_same(self):
        if "FAROL_DOCKER_IMAGE" in os.environ:
            self.skipTest("this image was not built here")
        again = "localhost/farol:again"
        # Any other value is another step to buildah, which has no such layer yet; all is compiled.
        build(again, "--build-arg", f"CCACHE_RECACHE=at-{time.time_ns()}")
        self.addCleanup(run, "podman", "rmi", "-f", again)
        one, other = (json.loads(must("podman", "image", "inspect", tag))[0]
                      for tag in (TAG, again))
        if one["Id"] != other["Id"]:
            folders = [must("podman", "image", "mount", tag).strip() for tag in (TAG, again)]
            told = run("diff", "-rq", *folders).stdout
            run("podman", "image", "unmount", TAG, again)
            self.fail(f"{one['RootFS']} {other['RootFS']}\n{told}")
        print(f"twice {one['Id']}, layer {one['RootFS']['Layers'][-1]}", flush=True)

    def test_it_runs_closed_in_and_is_healthy_without_a_network(self):
        with Container(network="none") as service:
            print(f"healthy {service.start_s:.1f} s after podman run", flush=True)
            pid = service.state()["Pid"]
            status = dict(line.split(":\t", 1) for line in
                          pathlib.Path(f"/proc/{pid}/status").read_text().splitlines()
                          if ":\t" in line)
            self.assertEqual(status["Uid"].split()[0], "10001")
            for name in ("CapEff", "CapPrm", "CapBnd", "CapInh"):
                self.assertEqual(int(status[name], 16), 0, name)
            self.assertEqual(status["NoNewPrivs"], "1")
            self.assertNotEqual(service.exec("health", "http://127.0.0.1:1").returncode, 0)
            # The container's root is read-only, whoever writes.
            self.assertNotEqual(service.exec("render", f"{SCENES}/primitives/scene.xml", "-o",
                                             "/data/x.png").returncode, 0)

    def test_sigterm_while_a_render_is_in_flight(self):
        with Container(env={"FAROL_WORKERS": "1", "FAROL_CACHE_BYTES": "0",
                            "FAROL_DEADLINE": "60"}) as service:
            answer = []

            def ask():
                answer.append(get(service.port, "/v1/scenes/forest/image?width=2048&height=2048&aa=8",
                                  timeout=120))
                answer.append(time.monotonic())

            client = threading.Thread(target=ask)
            client.start()
            wait_for("the render has begun", lambda: b"farol_workers_busy 1\n" in
                     get(service.port, "/metrics")[2])
            asked = time.monotonic()
            must("podman", "kill", "--signal", "TERM", service.id)
            client.join()
            wait_for("the container ends", lambda: service.state()["Status"] == "exited")
            ended = time.monotonic()
            self.assertEqual(answer[0][0], 200)
            self.assertTrue(answer[0][2].startswith(b"\x89PNG"))
            self.assertEqual(service.state()["ExitCode"], 0)
            print(f"SIGTERM: answered after {answer[1] - asked:.1f} s, ended after "
                  f"{ended - asked:.1f} s", flush=True)
            self.assertLess(ended - answer[1], 5)

    def test_a_hog_fails_alone_under_a_small_memory_limit(self):
        xml = {"Content-Type": "application/xml"}
        for name, limit, cap in (("the worker's own cap", "960m", "300"),
                                 ("the container's limit", "360m", "0")):
            with self.subTest(name), Container(
                    "--memory", limit, "--memory-swap", limit,
                    env={"FAROL_WORKER_MEMORY": cap, "FAROL_WORKERS": "2", "FAROL_SPARES": "0",
                         "FAROL_WAIT": "60", "FAROL_DEADLINE": "60",
                         "FAROL_CACHE_BYTES": "0"}) as service:
                pid, ended, others = service.state()["Pid"], threading.Event(), []

                def neighbour():
                    while not ended.is_set() or len(others) < 5:
                        others.append(get(service.port, "/v1/scenes/primitives/image?width=64"
                                          f"&height=64&azimuth={len(others) % 360}")[0])

                client = threading.Thread(target=neighbour)
                client.start()
                try:
                    status, headers, body = send(service.port, "POST", "/v1/render", HOG, xml,
                                                 timeout=120)
                finally:
                    ended.set()
                    client.join()
                print(f"{name}: {status} {json.loads(body)['code'] if status != 200 else ''}, "
                      f"{len(others)} pictures beside it", flush=True)
                self.assertIn(status, (422, 503))
                if status == 503:
                    self.assertTrue(headers["Retry-After"])
                self.assertEqual(set(others), {200})
                self.assertEqual(service.state()["Pid"], pid)


if __name__ == "__main__":
    if os.geteuid() != 0:
        skip("building and running images here wants root")
    for tool in ("buildah", "podman", "runc"):
        if not shutil.which(tool):
            skip(f"there is no {tool} (scripts/setup docker)")
    if "FAROL_DOCKER_IMAGE" in os.environ:
        TAG = os.environ["FAROL_DOCKER_IMAGE"]
    else:
        make_base()
        build(TAG)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
