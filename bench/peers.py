"""The same scenes in other renderers, where they are installed: F3D, POV-Ray, three.js in Chromium.

Cold: a whole command line, from nothing to the PNG. Warm: the next frame and its PNG in a program
that runs. Only our translation of the scenes is ours; programs and their pictures are not kept.
"""

import http.server
import json
import os
import shutil
import statistics
import subprocess
import tempfile
import threading
import time
from pathlib import Path

from bench import peer_scenes

COURSE = (Path(__file__).resolve().parents[2] /
          "shared/data/course/phase_4/test_4_6.xml")  # the data pack, where it lies beside

PAGE = """<!doctype html><body><script src="three.min.js"></script><script>
const [W, H, RUNS] = location.search.slice(1).split(',').map(Number);
const scene = new THREE.Scene();
const manager = new THREE.LoadingManager();
let loaded = Promise.resolve();
manager.onStart = () => { loaded = new Promise(done => { manager.onLoad = done; }); };
FILL
const camera = new THREE.PerspectiveCamera(ANGLE, W / H, NEAR, 1000);
camera.position.set(...EYE);
camera.lookAt(...FOCUS);
const renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
renderer.setSize(W, H);
document.body.append(renderer.domElement);
const frame = () => { renderer.render(scene, camera);
  return new Promise(done => renderer.domElement.toBlob(done, 'image/png')); };
(async () => {
  await loaded;
  const first = await frame();
  await frame();
  const ms = [];
  for (let i = 0; i < RUNS; ++i) {
    const start = performance.now();
    await frame();
    ms.push(performance.now() - start);
  }
  const picture = await frame();
  await fetch('/picture', {method: 'POST', body: picture});
  await fetch('/done', {method: 'POST', body: JSON.stringify({ms, bytes: first.size})});
})();
</script>"""


def page_of(subject):
    return (PAGE.replace("FILL", subject.page).replace("ANGLE", str(subject.angle))
            .replace("NEAR", str(subject.near)).replace("EYE", json.dumps(subject.eye))
            .replace("FOCUS", json.dumps(subject.focus)))


def three_script():
    """three.min.js: of FAROL_THREE, or of node_modules here or in the folder above bench/."""
    root = Path(__file__).resolve().parent.parent
    named = os.environ.get("FAROL_THREE")
    for path in ([Path(named)] if named else []) + [
            root / folder / "node_modules/three/build/three.min.js"
            for folder in ("", "build/bench", "web")]:
        if path.is_file():
            return path
    return None


class Browser:
    """A page in headless Chromium, asked for its frames again and again."""

    def __init__(self, folder, script, chromium, subject):
        shutil.copy(script, folder / "three.min.js")
        (folder / "page.html").write_text(page_of(subject))
        self.chromium, self.folder, self.answer = chromium, folder, None
        outer = self

        class Handler(http.server.SimpleHTTPRequestHandler):
            def __init__(self, *arguments):
                super().__init__(*arguments, directory=str(folder))

            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                if self.path == "/picture":
                    (folder / "three.png").write_bytes(body)
                else:
                    outer.answer = json.loads(body)
                self.send_response(204)
                self.end_headers()
                if self.path == "/done":
                    outer.ready.set()

            def log_message(self, *_):
                pass

        self.ready = threading.Event()
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def frames(self, width, height, runs):
        self.ready.clear()
        with tempfile.TemporaryDirectory() as profile:
            page = (f"http://127.0.0.1:{self.server.server_port}/page.html?{width},{height},{runs}")
            process = subprocess.Popen(
                [self.chromium, "--headless", "--no-sandbox", "--disable-dev-shm-usage",
                 "--disable-gpu", "--enable-unsafe-swiftshader", "--no-first-run",
                 f"--user-data-dir={profile}/p", "--remote-debugging-port=0", page],
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            found = self.ready.wait(90)
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            time.sleep(0.3)  # its children leave the profile
            shutil.rmtree(f"{profile}/p", ignore_errors=True)
        return self.answer if found else None


def timed(command, output, **more):
    """Milliseconds of a command that leaves a picture; None without one."""
    output.unlink(missing_ok=True)
    start = time.perf_counter()
    try:
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              timeout=120, check=False, **more)
    except (OSError, subprocess.TimeoutExpired):
        return None
    ms = 1000 * (time.perf_counter() - start)
    return ms if done.returncode == 0 and output.exists() and output.stat().st_size > 0 else None


def display():
    """An X display of our own, where Xvfb is there: F3D wants one. (process, environment)"""
    if not shutil.which("Xvfb"):
        return None, dict(os.environ)
    read, write = os.pipe()
    process = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1920x1080x24",
                                "-nolisten", "tcp"], pass_fds=(write,),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    return process, {**os.environ, "DISPLAY": f":{number}"}


def run(bench, progress):
    folder = bench.scratch / "peers"
    folder.mkdir(exist_ok=True)
    subjects = [peer_scenes.spheres(folder)]
    if COURSE.is_file():
        subjects.append(peer_scenes.course(folder, bench.farol, COURSE))
    else:
        progress.say(f"skipped: course scene 4_6 ({COURSE} is not there)")
    rows, runs = [], 3 if bench.quick else 9
    sizes = [(512, 512)] if bench.quick else [(512, 512), (1920, 1080)]
    turns = [(subject, *size) for subject in subjects for size in sizes]
    server, environment = display()
    try:
        for number, (subject, width, height) in enumerate(turns):
            share = number / len(turns)
            rows += cold(bench, progress, folder, environment, subject, width, height, runs, share)
            rows += warm(bench, progress, folder, subject, width, height, runs, share)
    finally:
        if server:
            server.terminate()
            server.wait()
    return [{"scene": subject_name, **row} for subject_name, row in rows]


def words(place):
    return ",".join(str(value) for value in place)


def cold(bench, progress, folder, environment, subject, width, height, runs, share):
    out = {name: folder / f"{name}.png" for name in ("farol", "f3d", "povray")}
    commands = {
        "farol": [str(bench.farol), "render", str(subject.document), "-o", str(out["farol"]),
                  "--width", str(width), "--height", str(height)],
        "f3d": ["f3d", "--output", str(out["f3d"]), "--resolution", f"{width},{height}",
                "--camera-position", words(subject.eye), "--camera-focal-point",
                words(subject.focus), "--camera-view-angle", str(subject.angle), "--quiet",
                "--config", "none", str(subject.mesh)]}
    if subject.pov:
        document = folder / f"{subject.name}.pov"
        document.write_text(subject.pov(width / height))
        commands["povray"] = ["povray", "-D", "-GA", "+A0.3", "+FN", f"+W{width}", f"+H{height}",
                              f"+I{document}", f"+O{out['povray']}"]
    times = {name: [] for name in commands}
    for turn in range(runs):
        for name, command in list(commands.items()):
            progress.step("peers", share, f"{subject.label}, {width} x {height} cold: {name}")
            missing = name != "farol" and not shutil.which(name)
            ms = None if missing else timed(command, out[name], env=environment)
            if ms is None:
                why = "is not installed" if missing else "made no picture"
                progress.say(f"skipped: {name} {why}")
                del commands[name]
                continue
            if turn > 0 or runs == 1:  # the first fills caches of files and shaders
                times[name].append(ms)
    return [(subject.name, {"kind": "cold", "program": name, "width": width, "height": height,
             "ms": statistics.median(ms), "bytes": out[name].stat().st_size, "runs": len(ms)})
            for name, ms in times.items() if ms]


def warm(bench, progress, folder, subject, width, height, runs, share):
    progress.step("peers", share, f"{subject.label}, {width} x {height} warm")
    script, chromium = three_script(), shutil.which("chromium")
    browser = None
    if not script:
        progress.say("skipped: three.js is not installed (npm install three@0.160, or FAROL_THREE)")
    elif not chromium:
        progress.say("skipped: Chromium is not installed")
    else:
        browser = Browser(folder, script, chromium, subject)
    ours, theirs, size = [], [], {}
    for _ in range(2 if bench.quick else 3):  # turn by turn
        found = bench.lines("bench_frame", subject.document, "--json", "--runs", runs,
                            f"width={width}", f"height={height}")
        if found:
            ours.append(found[0]["totalMs"])
            size["farol"] = int(found[0]["bytes"])
        answer = browser.frames(width, height, runs) if browser else None
        if answer:
            theirs.append(statistics.median(answer["ms"]))
            size["three.js"] = answer["bytes"]
    if browser:
        browser.server.shutdown()
        if not theirs:
            progress.say("skipped: Chromium drew nothing")
    return [(subject.name, {"kind": "warm", "program": name, "width": width, "height": height,
             "ms": statistics.median(ms), "bytes": size[name], "runs": runs * len(ms)})
            for name, ms in (("farol", ours), ("three.js", theirs)) if ms]
