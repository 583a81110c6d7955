#!/usr/bin/env python3
"""Example scenes as binary glTF, drawn by three.js in Chromium beside Farol's own image: FLIP by scene.

    python3 bench/gltf.py PROGRAM [OUT_FOLDER]

OUT_FOLDER keeps the models and both images of each scene. three.js (npm install three@0.160 in
build/bench) draws with its defaults: sRGB output, no tone mapping, four samples.
"""

import http.server
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WIDTH, HEIGHT = 480, 360

PAGE = """<!doctype html><body><script type="importmap">
{"imports": {"three": "/three/build/three.module.js"}}</script><script type="module">
import * as THREE from 'three';
import { GLTFLoader } from '/three/examples/jsm/loaders/GLTFLoader.js';
const renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
renderer.setSize(WIDTH, HEIGHT);
document.body.append(renderer.domElement);
for (const name of NAMES) {
  try {
    const model = await new GLTFLoader().loadAsync(`/${name}.glb`);
    model.scene.background = new THREE.Color(0x000000);
    const camera = model.cameras[0];
    camera.aspect = WIDTH / HEIGHT;
    camera.updateProjectionMatrix();
    renderer.render(model.scene, camera);
    const image = await new Promise(done => renderer.domElement.toBlob(done, 'image/png'));
    await fetch(`/image/${name}`, {method: 'POST', body: image});
  } catch (error) {
    await fetch(`/failed/${name}`, {method: 'POST', body: String(error)});
  }
}
await fetch('/done', {method: 'POST', body: ''});
</script>"""


def serve(folder, three, names, failures, ready):
    class Handler(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *arguments):
            super().__init__(*arguments, directory=str(folder))

        def translate_path(self, path):
            if path.startswith("/three/"):
                return str(three / path[len("/three/"):])
            return super().translate_path(path)

        def do_POST(self):
            body = self.rfile.read(int(self.headers["Content-Length"]))
            if self.path.startswith("/image/"):
                (folder / f"{self.path[7:]}-three.png").write_bytes(body)
            elif self.path.startswith("/failed/"):
                failures[self.path[8:]] = body.decode()
            self.send_response(204)
            self.end_headers()
            if self.path == "/done":
                ready.set()

        def log_message(self, *_):
            pass

    (folder / "page.html").write_text(PAGE.replace("NAMES", json.dumps(names))
                                      .replace("WIDTH", str(WIDTH)).replace("HEIGHT", str(HEIGHT)))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def draw(chromium, port, ready):
    with tempfile.TemporaryDirectory() as profile:
        process = subprocess.Popen(
            [chromium, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu",
             "--enable-unsafe-swiftshader", "--no-first-run", f"--user-data-dir={profile}/p",
             "--remote-debugging-port=0", f"http://127.0.0.1:{port}/page.html"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        done = ready.wait(600)
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    return done


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    farol = Path(sys.argv[1]).resolve()
    three = Path(os.environ.get("FAROL_THREE_FOLDER",
                                ROOT / "build/bench/node_modules/three")).resolve()
    chromium = shutil.which("chromium")
    if not three.is_dir() or not chromium:
        sys.exit("skipped: three.js or Chromium is not installed")
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    scenes = {path.parent.name: path for path in sorted((ROOT / "scenes").glob("*/scene.xml"))}
    for name, scene in scenes.items():
        subprocess.run([farol, "convert", scene, folder / f"{name}.glb"], check=True,
                       capture_output=True)
        subprocess.run([farol, "render", scene, "-o", folder / f"{name}-farol.png", "--width",
                        str(WIDTH), "--height", str(HEIGHT), "--background", "black"], check=True,
                       capture_output=True)
    failures, ready = {}, threading.Event()
    server = serve(folder, three, list(scenes), failures, ready)
    if not draw(chromium, server.server_port, ready):
        print("Chromium did not finish", file=sys.stderr)
    server.shutdown()
    print("| Scene | glTF | FLIP |\n| --- | --- | --- |")
    for name in scenes:
        size = (folder / f"{name}.glb").stat().st_size
        theirs = folder / f"{name}-three.png"
        if name in failures or not theirs.is_file():
            print(f"| {name} | {size / 1e6:.2f} MB | not drawn: {failures.get(name, 'no image')} |")
            continue
        found = subprocess.run([farol, "compare", folder / f"{name}-farol.png", theirs, "--json"],
                               capture_output=True, text=True, check=True)
        print(f"| {name} | {size / 1e6:.2f} MB | {json.loads(found.stdout)['flip']['mean']:.3f} |")


if __name__ == "__main__":
    main()
