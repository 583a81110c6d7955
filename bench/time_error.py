"""Time against error of Farol, fixed divisions, POV-Ray and three.js (WebGL and WebGPU) on the same
spheres.

Each program is measured against its own limit, for their shading models differ: Farol against the
ray caster of tests/support, POV-Ray against 81 samples a pixel, three.js against 64 samples a pixel
and finer spheres. The error is mean FLIP. The time is CPU time of all threads for a further frame
with its pixels in memory, without encoding: of POV-Ray that of the command less that of 16 x 16 px.
"""

import functools
import http.server
import json
import os
import resource
import shutil
import statistics
import subprocess
import tempfile
import threading
import time
from pathlib import Path

from bench import peer_scenes

SIDE = 512
POV_LIMIT = ["+A0.0", "+AM1", "+R9"]
POV_SETTINGS = [["-A"], ["+A0.3"], ["+A0.1"], ["+A0.1", "+AM2"], ["+A0.05", "+AM2", "+R4"],
                ["+A0.0", "+AM1", "+R2"], ["+A0.0", "+AM1", "+R3"], ["+A0.0", "+AM1", "+R4"]]
# Spheres of three.js in each scene: those measured, and those of the limit. The limit errs by less than
# 0.01 px.
SEGMENTS = {100: ((16, 32, 64, 128), 512), 1000: ((8, 16, 32, 64), 128)}


def three_settings(count):
    """The limit comes last."""
    measured, limit = SEGMENTS[count]
    return [{"segments": segments, "scale": scale, "msaa": msaa} for segments in measured
            for scale, msaa in ((1, False), (1, True), (2, False), (3, False), (2, True))
            ] + [{"segments": limit, "scale": 8, "msaa": False}]


PAGE = """<!doctype html><body><script type="module">
import * as THREE from './MODULE';
const post = (path, body) => fetch(path, {method: 'POST', body});
addEventListener('unhandledrejection', () => post('/failed'));
const BALLS = DATA;
function build(segments) {
  const scene = new THREE.Scene(), sphere = new THREE.SphereGeometry(1, segments, segments / 2);
  for (const [x, y, z, r, c] of BALLS) {
    const ball = new THREE.Mesh(sphere,
        new THREE.MeshPhongMaterial({color: new THREE.Color(...c.map(v => v / 255)), shininess: 30}));
    ball.position.set(x, y, z);
    ball.scale.setScalar(r);
    scene.add(ball);
  }
  const sun = new THREE.DirectionalLight(0xffffff, 3);
  sun.position.set(1, 2, 2);
  scene.add(sun, new THREE.AmbientLight(0xffffff, 0.3));
  return scene;
}
const camera = new THREE.PerspectiveCamera(45, 1, 1, 100);
camera.position.set(0, 0, 12);
camera.lookAt(0, 0, -3);
BACKEND
/** One frame of SIDE x SIDE px: each pixel the mean of scale x scale samples. */
async function frame(renderer, scene, scale, large, small) {
  renderer.render(scene, camera);
  const width = SIDE * scale;
  await read(renderer, width, large);
  if (scale === 1) return large;
  for (let y = 0; y < SIDE; ++y)
    for (let x = 0; x < SIDE; ++x)
      for (let c = 0; c < 3; ++c) {
        let sum = 0;
        for (let j = 0; j < scale; ++j)
          for (let i = 0; i < scale; ++i)
            sum += large[((y * scale + j) * width + x * scale + i) * 4 + c];
        small[(y * SIDE + x) * 4 + c] = sum / (scale * scale) + 0.5;
      }
  return small;
}
for (const [number, {segments, scale, msaa, runs}] of SETTINGS.entries()) {
  const renderer = await make(msaa, SIDE * scale);
  renderer.setSize(SIDE * scale, SIDE * scale);
  const scene = build(segments), small = new Uint8Array(SIDE * SIDE * 4);
  const large = new Uint8Array(SIDE * SIDE * scale * scale * 4);
  await frame(renderer, scene, scale, large, small);
  await post('/mark');
  let pixels;
  for (let i = 0; i < runs; ++i) pixels = await frame(renderer, scene, scale, large, small);
  await post('/mark');
  await post('/pixels/' + (FIRST + number), pixels);
  end(renderer);
}
await post('/done');
</script>"""
# How each backend begins, gives the pixels of its last frame, and ends.
BACKENDS = {
    "WebGL": ("three.module.js", ["--disable-gpu", "--enable-unsafe-swiftshader"], """
const make = async (antialias) => new THREE.WebGLRenderer({antialias, preserveDrawingBuffer: true});
const read = (renderer, width, large) => {
  const gl = renderer.getContext();
  gl.readPixels(0, 0, width, width, gl.RGBA, gl.UNSIGNED_BYTE, large);
};
const end = (renderer) => { renderer.dispose(); renderer.forceContextLoss(); };"""),
    "WebGPU": ("three.webgpu.js", ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"], """
const make = async (antialias, width) => {
  const renderer = new THREE.WebGPURenderer({antialias});
  await renderer.init();
  if (!renderer.backend.isWebGPUBackend) throw new Error('no WebGPU');
  // The texture's format writes sRGB; pixels of a canvas by SwiftShader cannot be read.
  target = new THREE.RenderTarget(width, width, {samples: antialias ? 4 : 0, colorSpace: THREE.SRGBColorSpace});
  renderer.setRenderTarget(target);
  return renderer;
};
let target;
const read = async (renderer, width, large) => {
  const bytes = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, width);
  // Rows are padded to 256 bytes.
  const row = Math.ceil(width * 4 / 256) * 256;
  for (let y = 0; y < width; ++y) large.set(bytes.subarray(y * row, y * row + width * 4), y * width * 4);
};
const end = (renderer) => renderer.dispose();"""),
}


def three_folder():
    """Folder of three.module.js: FAROL_THREE_MODULES, or build/bench/node_modules/three/build."""
    root = Path(__file__).resolve().parent.parent
    folder = Path(os.environ.get("FAROL_THREE_MODULES", root / "build/bench/node_modules/three/build"))
    return folder if (folder / "three.module.js").is_file() else None


def cpu_ms(root):
    """CPU time of a process and all below it."""
    parents, times = {}, {}
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        parents[int(entry.name)] = int(fields[1])
        times[int(entry.name)] = int(fields[11]) + int(fields[12])
    total = 0
    for pid, ticks in times.items():
        at = pid
        while at in parents and at != root:
            at = parents[at]
        total += ticks if at == root else 0
    return 1000 * total / os.sysconf("SC_CLK_TCK")


def write_ppm(path, rgba, flip):
    rows = [rgba[i:i + SIDE * 4] for i in range(0, SIDE * SIDE * 4, SIDE * 4)]
    pixels = bytearray()
    for row in reversed(rows) if flip else rows:
        for x in range(0, SIDE * 4, 4):
            pixels += row[x:x + 3]
    path.write_bytes(f"P6 {SIDE} {SIDE} 255\n".encode() + pixels)


class Page(http.server.SimpleHTTPRequestHandler):
    """Serves the page; takes its marks of time and its pixels."""

    def __init__(self, run, *arguments):
        self.run = run
        super().__init__(*arguments, directory=str(run.folder))

    def do_POST(self):
        body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        if self.path == "/mark":
            self.run.marks.append(cpu_ms(self.run.process.pid))
        elif self.path.startswith("/pixels/"):
            write_ppm(self.run.folder / f"three-{int(self.path.rsplit('/', 1)[1])}.ppm", body, True)
        else:
            self.run.complete = self.path == "/done"
            self.run.done.set()
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        pass


class ThreeRun:
    """Settings in one Chromium, one after another. Their pixels are named by numbers from `first`."""

    def __init__(self, folder, chromium, backend, balls, settings, first=0):
        self.folder, self.marks, self.done, self.complete = folder, [], threading.Event(), False
        module, words, script = BACKENDS[backend]
        (folder / "time.html").write_text(
            PAGE.replace("MODULE", module).replace("BACKEND", script)
            .replace("DATA", json.dumps(balls)).replace("SETTINGS", json.dumps(settings))
            .replace("FIRST", str(first)).replace("SIDE", str(SIDE)))
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Page, self))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        with tempfile.TemporaryDirectory() as profile:
            self.process = subprocess.Popen(
                [chromium, "--headless", "--no-sandbox", "--disable-dev-shm-usage", *words,
                 "--no-first-run", f"--user-data-dir={profile}/p", "--remote-debugging-port=0",
                 f"http://127.0.0.1:{server.server_port}/time.html"],
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.done.wait(600)
            self.process.terminate()
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
            time.sleep(0.3)  # its children leave the profile
            shutil.rmtree(f"{profile}/p", ignore_errors=True)
        server.shutdown()
        server.server_close()


def flip(bench, image, limit):
    found = subprocess.run([str(bench.farol), "compare", str(image), str(limit), "--json"],
                           capture_output=True, text=True, check=False)
    return json.loads(found.stdout)["flip"]["mean"]


def farol_rows(bench, document, runs):
    found = bench.lines("bench_quality", document, "--runs", runs, "--cap", 16, f"width={SIDE}",
                        f"height={SIDE}", *(["--quick"] if bench.quick else []))
    rows = []
    for s in (found or [])[1:]:
        if s["shading"] != "phong" or "filter" in s:
            continue
        fixed = s["divisions"] > 0
        rows.append({"program": "fixed divisions" if fixed else "Farol",
                     "setting": f"{s['divisions']} divisions, aa {s['aa']}" if fixed
                     else f"error {s['error']:g}, aa {s['aa']}",
                     "cpuMs": s["cpuMs"], "flip": s["flip"]})
    return rows


def pov_rows(bench, progress, folder, document, runs):
    if not shutil.which("povray"):
        progress.say("skipped: POV-Ray is not installed")
        return []

    def cost(side, words, out):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(["povray", "-D", "-GA", "-J", "+FN", f"+W{side}", f"+H{side}", *words,
                        f"+I{document}", f"+O{out}"], check=True, capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return 1000 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)

    cost(SIDE, POV_LIMIT, folder / "pov-limit.png")
    times = [[] for _ in POV_SETTINGS]
    for _ in range(runs):
        start = cost(16, ["-A"], folder / "pov-start.png")
        for i, words in enumerate(POV_SETTINGS):
            times[i].append(cost(SIDE, words, folder / f"pov-{i}.png") - start)
    return [{"program": "POV-Ray", "setting": " ".join(words), "cpuMs": statistics.median(ms),
             "flip": flip(bench, folder / f"pov-{i}.png", folder / "pov-limit.png")}
            for i, (words, ms) in enumerate(zip(POV_SETTINGS, times))]


def three_rows(bench, progress, folder, balls, runs):
    build, chromium = three_folder(), shutil.which("chromium")
    if not build or not chromium:
        progress.say("skipped: three.js or Chromium is not installed (npm install three in "
                     "build/bench, or FAROL_THREE_MODULES)")
        return []
    for name in ("three.module.js", "three.core.js", "three.webgpu.js", "three.tsl.js"):
        shutil.copy(build / name, folder / name)
    settings = [{**s, "runs": runs} for s in three_settings(len(balls))]
    rows = []
    for backend in BACKENDS:
        # Chromium's WebGPU by SwiftShader ends with the second renderer of a process.
        alone = backend == "WebGPU"
        parts = [(i, [s]) for i, s in enumerate(settings)] if alone else [(0, settings)]
        marks = []
        for first, part in parts:
            run = ThreeRun(folder, chromium, backend, balls, part, first)
            if not run.complete:
                break
            marks += run.marks
        if len(marks) < 2 * len(settings):
            progress.say(f"skipped: three.js by {backend} did not finish in Chromium")
            continue
        rows += [{"program": "three.js" if backend == "WebGL" else f"three.js, {backend}",
                  "setting": f"{s['segments']} segments, {s['scale']} x {s['scale']}" +
                  (", MSAA" if s["msaa"] else ""),
                  "cpuMs": (marks[2 * i + 1] - marks[2 * i]) / s["runs"],
                  "flip": flip(bench, folder / f"three-{i}.ppm",
                               folder / f"three-{len(settings) - 1}.ppm")}
                 for i, s in enumerate(settings[:-1])]
    return rows


def run(bench, progress):
    folder = bench.scratch / "time-error"
    folder.mkdir(exist_ok=True)
    runs, rows = (3 if bench.quick else 5), []
    for share, count in enumerate(SEGMENTS):
        progress.step("time-error", share / 2, f"{count} spheres")
        balls = peer_scenes.places(count)
        document, pov = folder / "spheres.xml", folder / "spheres.pov"
        document.write_text(peer_scenes.as_xml(balls))
        pov.write_text(peer_scenes.as_pov(1.0, balls))
        for part in (lambda: farol_rows(bench, document, runs),
                     lambda: pov_rows(bench, progress, folder, pov, runs),
                     lambda: three_rows(bench, progress, folder, balls, runs)):
            rows += [{"scene": f"{count} spheres", **row} for row in part()]
    return rows
