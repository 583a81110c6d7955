#!/usr/bin/env python3
"""Invents whole projects as students hand them in, draws their scenes and prints what was found:
  bench/projects.py [FILES...]      default 300 2000 20000
Each project has four scenes, a fifth in an archive in an archive, code, build folders with copies of the files,
an older phase with other files of the same names, .git, node_modules, a PDF and a video. It is drawn as a folder
(each scene with --assets), and as a zip, a tar.gz and, where bsdtar is there, a 7z.
The program is build/release/farol, or what $FAROL names."""
import json
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
FAROL = os.environ.get("FAROL", str(ROOT / "build/release/farol"))


def png(color, size=32):
    rows = b"".join(b"\0" + bytes(color) * size for _ in range(size))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


MESH = "0 0 0\n1 0 0\n0 1 0\n0 0 0\n0 1 0\n0 0 1\n"
# How a scene in work/phase4/scenes may write its files; all of them are there.
REFERENCES = ["../tex/wood.png", "tex/wood.png", "wood.png", "C:\\Users\\ana\\cg\\tex\\stone.png", "Tex\\STONE.PNG",
              "/home/rui/cg/phase4/tex/leaf.png", "ma%C3%A7%C3%A3.png", "mac\u0327a\u0303.png", "../../../tex/leaf.png",
              "phase4/tex/sky.png", "beside.png"]


def scene(references):
    models = "".join(f'<model file="{mesh}"><texture file="{one}"/></model>'
                     for mesh, one in zip(["../models/part.3d", "part.3d"] * len(references), references))
    return f"<world><group><models>{models}</models></group></world>"


def zipped(files):
    import io
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            archive.writestr(path, content)
    return out.getvalue()


def project(count):
    """The files of a project by their paths, `count` of them."""
    rng = random.Random(count)
    color = {name: (40 + 40 * i, 200 - 30 * i, 90) for i, name in enumerate(["wood", "stone", "leaf", "sky"])}
    now = {f"work/phase4/tex/{name}.png": png(one) for name, one in color.items()}
    now["work/phase4/tex/ma\u00e7\u00e3.png"] = png((200, 20, 20))
    now["work/phase4/models/part.3d"] = MESH.encode()
    files = dict(now)
    files["work/phase4/scenes/beside.png"] = png((9, 99, 199))
    files["work/phase4/scenes/scene.xml"] = scene(REFERENCES).encode()
    for i in range(2, 5):
        files[f"work/phase4/scenes/test_4_{i}.xml"] = scene(rng.sample(REFERENCES, 4)).encode()
    for path, content in now.items():  # copies that the build made, and an older phase with other files
        files["work/build/Release/" + path.split("/", 2)[2]] = content
        files["work/phase3/" + path.split("/", 2)[2]] = (png((1, 2, 3)) if path.endswith(".png") else content + b"\n")
    inner = zipped({"tex/old.png": png((5, 5, 5)), "test_1.xml": scene(["tex/old.png"])})
    files["work/hand-ins/phase1.zip"] = zipped({"phase1/final.zip": inner, "phase1/report.pdf": b"%PDF" + bytes(5000)})
    files["work/report/report.pdf"] = b"%PDF" + rng.randbytes(1 << 20)
    files["work/report/demo.mp4"] = rng.randbytes(4 << 20)
    files["work/engine/pom.xml"] = b"<project><name>engine</name></project>"
    kinds = [("work/.git/objects/{0:02x}/{1:08x}", 400), ("work/build/CMakeFiles/engine.dir/o{1}.o", 900),
             ("work/node_modules/lib{0}/index{1}.js", 200), ("work/engine/src/file{1}.cpp", 300),
             ("work/build/Debug/tex/pad{1}.png", 150)]
    for i in range(count - len(files)):
        path, size = kinds[i % len(kinds)]
        files[path.format(i % 251, i)] = rng.randbytes(size)
    return files


def run(arguments):
    """Seconds, peak memory in MiB, diagnostics, and whether a picture came out."""
    with tempfile.TemporaryDirectory() as folder:
        picture = os.path.join(folder, "p.png")
        began = time.monotonic()
        child = subprocess.Popen([FAROL, "render", *arguments, "--json", "-o", picture, "--width", "160", "--height",
                                  "120"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        out = child.stdout.read()
        child.stdout.close()
        _, _, usage = os.wait4(child.pid, 0)
        seconds = time.monotonic() - began
        return seconds, usage.ru_maxrss / 1024, json.loads(out or b"{}").get("diagnostics", []), os.path.exists(picture)


def row(form, references, scenes, results):
    missing = sum(one["code"] in ("asset.missing", "asset.ambiguous") for result in results for one in result[2])
    drawn = sum(result[3] for result in results)
    print(f"| {form} | {references - missing} of {references} | {drawn} of {scenes} | "
          f"{sum(one[0] for one in results):.2f} | {max(one[1] for one in results):.0f} |", flush=True)


def main():
    print("| project | references found | scenes drawn | seconds | peak MiB |\n| --- | --- | --- | --- | --- |")
    for count in [int(one) for one in sys.argv[1:]] or [300, 2000, 20000]:
        files = project(count)
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder, "hand-in")
            for path, content in files.items():
                full = root / path
                full.parent.mkdir(parents=True, exist_ok=True)
                full.write_bytes(content)
            scenes = sorted(root.glob("work/phase4/scenes/*.xml"))
            written = sum(one.read_text().count("<texture") * 2 for one in scenes)
            row(f"{count} files, folder", written, len(scenes),
                [run([str(one), "--assets", str(root)]) for one in scenes])
            main_only = len(REFERENCES) * 2
            packed = pathlib.Path(folder, "hand-in.zip")
            with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
                for path in files:
                    archive.write(root / path, path)
            row(f"{count} files, zip ({packed.stat().st_size >> 20} MiB)", main_only, 1, [run([str(packed)])])
            packed = pathlib.Path(folder, "hand-in.tar.gz")
            with tarfile.open(packed, "w:gz") as archive:
                archive.add(root, "hand-in")
            row(f"{count} files, tar.gz", main_only, 1, [run([str(packed)])])
            if shutil.which("bsdtar"):
                packed = pathlib.Path(folder, "hand-in.7z")
                subprocess.run(["bsdtar", "--format=7zip", "-cf", packed, "-C", root, "."], check=True)
                row(f"{count} files, 7z", main_only, 1, [run([str(packed)])])


if __name__ == "__main__":
    main()
