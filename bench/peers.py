"""The same spheres in other renderers, where they are installed: F3D, POV-Ray, three.js in Chromium.

Cold: a whole command line, from nothing to the PNG. Warm: the next frame and its PNG in a program
that runs. Only our translation of the scene is ours; programs and their pictures are not kept.
"""

import http.server
import json
import math
import os
import random
import re
import shutil
import statistics
import subprocess
import tempfile
import threading
import time
from pathlib import Path

SLICES, STACKS, COUNT = 32, 16, 100


def places():
    chance = random.Random(7)
    return [(chance.uniform(-6, 6), chance.uniform(-4, 4), chance.uniform(-6, 0),
             chance.uniform(0.3, 0.8), [chance.randrange(60, 240) for _ in range(3)])
            for _ in range(COUNT)]


def as_xml():
    models = "".join(
        f'<group><transform><translate x="{x}" y="{y}" z="{z}"/></transform><models>'
        f'<model command="sphere {r} {SLICES} {STACKS}"><color><diffuse R="{c[0]}" G="{c[1]}" '
        f'B="{c[2]}"/><specular R="120" G="120" B="120"/><shininess value="30"/></color></model>'
        f'</models></group>' for x, y, z, r, c in places())
    return ('<world><window width="512" height="512"/><camera><position x="0" y="0" z="12"/>'
            '<lookAt x="0" y="0" z="-3"/><projection fov="45" near="1" far="100"/></camera>'
            f'<lights><light type="directional" dirx="1" diry="2" dirz="2"/></lights>{models}'
            '</world>')


def as_pov():
    balls = "\n".join(
        f"sphere {{<{x},{y},{-z}>,{r} pigment {{color rgb<{c[0] / 255:.4f},{c[1] / 255:.4f},"
        f"{c[2] / 255:.4f}>}} finish {{ambient 0.2 diffuse 1 phong 0.5 phong_size 30}}}}"
        for x, y, z, r, c in places())
    # 45 degrees up and down; a square picture.
    return ('#version 3.7; global_settings {assumed_gamma 1}\n'
            'camera {location <0,0,-12> look_at <0,0,3> right x*ASPECT up y angle ANGLE}\n'
            f'light_source {{<500,1000,-1000> color 1 parallel point_at <0,0,0>}}\n{balls}\n')


def as_obj():
    lines, faces, base = [], [], 1
    for x, y, z, r, _ in places():
        for i in range(STACKS + 1):
            for j in range(SLICES + 1):
                a, b = math.pi * i / STACKS, 2 * math.pi * j / SLICES
                n = (math.sin(a) * math.sin(b), math.cos(a), math.sin(a) * math.cos(b))
                lines.append(f"v {x + r * n[0]:.5f} {y + r * n[1]:.5f} {z + r * n[2]:.5f}")
                lines.append(f"vn {n[0]:.5f} {n[1]:.5f} {n[2]:.5f}")
        for i in range(STACKS):
            for j in range(SLICES):
                p = base + i * (SLICES + 1) + j
                q = p + SLICES + 1
                if i > 0:
                    faces.append(f"f {p}//{p} {q}//{q} {p + 1}//{p + 1}")
                if i < STACKS - 1:
                    faces.append(f"f {p + 1}//{p + 1} {q}//{q} {q + 1}//{q + 1}")
        base += (STACKS + 1) * (SLICES + 1)
    return "\n".join(lines + faces) + "\n"


PAGE = """<!doctype html><body><script src="three.min.js"></script><script>
const [W, H, RUNS] = location.search.slice(1).split(',').map(Number);
const scene = new THREE.Scene();
for (const [x, y, z, r, c] of BALLS) {
  const ball = new THREE.Mesh(new THREE.SphereGeometry(r, 32, 16), new THREE.MeshPhongMaterial(
      {color: new THREE.Color(c[0] / 255, c[1] / 255, c[2] / 255), shininess: 30}));
  ball.position.set(x, y, z);
  scene.add(ball);
}
const sun = new THREE.DirectionalLight(0xffffff, 3);
sun.position.set(1, 2, 2);
scene.add(sun, new THREE.AmbientLight(0xffffff, 0.3));
const camera = new THREE.PerspectiveCamera(45, W / H, 1, 100);
camera.position.set(0, 0, 12);
camera.lookAt(0, 0, -3);
const renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
renderer.setSize(W, H);
document.body.append(renderer.domElement);
const frame = () => { renderer.render(scene, camera);
  return new Promise(done => renderer.domElement.toBlob(done, 'image/png')); };
(async () => {
  const first = await frame();
  await frame();
  const ms = [];
  for (let i = 0; i < RUNS; ++i) {
    const start = performance.now();
    await frame();
    ms.push(performance.now() - start);
  }
  await fetch('/done', {method: 'POST', body: JSON.stringify({ms, bytes: first.size})});
})();
</script>"""


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

    def __init__(self, folder, script, chromium):
        shutil.copy(script, folder / "three.min.js")
        (folder / "page.html").write_text(PAGE.replace("BALLS", json.dumps(places())))
        self.chromium, self.folder, self.answer = chromium, folder, None
        outer = self

        class Handler(http.server.SimpleHTTPRequestHandler):
            def __init__(self, *arguments):
                super().__init__(*arguments, directory=str(folder))

            def do_POST(self):
                size = int(self.headers["Content-Length"])
                outer.answer = json.loads(self.rfile.read(size))
                self.send_response(204)
                self.end_headers()
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
    (folder / "spheres.xml").write_text(as_xml())
    (folder / "spheres.obj").write_text(as_obj())
    rows, runs = [], 3 if bench.quick else 7
    sizes = [(512, 512)] if bench.quick else [(512, 512), (1920, 1080)]
    server, environment = display()
    try:
        for number, (width, height) in enumerate(sizes):
            rows += cold(bench, progress, folder, environment, width, height, runs,
                         number / len(sizes))
            rows += warm(bench, progress, folder, width, height, runs,
                         (number + 0.6) / len(sizes))
    finally:
        if server:
            server.terminate()
            server.wait()
    return rows


def cold(bench, progress, folder, environment, width, height, runs, share):
    aspect = width / height
    (folder / "spheres.pov").write_text(
        as_pov().replace("ASPECT", f"{aspect:.6f}").replace(
            "ANGLE", f"{2 * math.degrees(math.atan(math.tan(math.radians(22.5)) * aspect)):.6f}"))
    out = {name: folder / f"{name}.png" for name in ("farol", "f3d", "povray")}
    commands = {
        "farol": [str(bench.farol), "render", str(folder / "spheres.xml"), "-o", str(out["farol"]),
                  "--width", str(width), "--height", str(height)],
        "f3d": ["f3d", "--output", str(out["f3d"]), "--resolution", f"{width},{height}",
                "--camera-position", "0,0,12", "--camera-focal-point", "0,0,-3",
                "--camera-view-angle", "45", "--quiet", "--config", "none",
                str(folder / "spheres.obj")],
        "povray": ["povray", "-D", "-GA", "+A0.3", "+FN", f"+W{width}", f"+H{height}",
                   f"+I{folder / 'spheres.pov'}", f"+O{out['povray']}"]}
    times = {name: [] for name in commands}
    for turn in range(runs):
        for name, command in list(commands.items()):
            progress.step("peers", share, f"{width} x {height} cold: {name}")
            missing = name != "farol" and not shutil.which(name)
            ms = None if missing else timed(command, out[name], env=environment)
            if ms is None:
                why = "is not installed" if missing else "made no picture"
                progress.say(f"skipped: {name} {why}")
                del commands[name]
                continue
            if turn > 0 or runs == 1:  # the first fills caches of files and shaders
                times[name].append(ms)
    return [{"kind": "cold", "program": name, "width": width, "height": height,
             "ms": statistics.median(ms), "bytes": out[name].stat().st_size, "runs": len(ms)}
            for name, ms in times.items() if ms]


def warm(bench, progress, folder, width, height, runs, share):
    progress.step("peers", share, f"{width} x {height} warm")
    script, chromium = three_script(), shutil.which("chromium")
    browser = None
    if not script:
        progress.say("skipped: three.js is not installed (npm install three@0.160, or FAROL_THREE)")
    elif not chromium:
        progress.say("skipped: Chromium is not installed")
    else:
        browser = Browser(folder, script, chromium)
    ours, theirs, size = [], [], {}
    for _ in range(2 if bench.quick else 3):  # turn by turn
        found = bench.lines("bench_frame", folder / "spheres.xml", "--json", "--runs", runs,
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
    return [{"kind": "warm", "program": name, "width": width, "height": height,
             "ms": statistics.median(ms), "bytes": size[name], "runs": runs * len(ms)}
            for name, ms in (("farol", ours), ("three.js", theirs)) if ms]
