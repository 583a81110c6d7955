"""Files that a scene names or a folder holds: textures, meshes, a store and a folder in trouble."""
import json
import os
import pathlib
import resource
import shutil
import signal
import socket
import struct
import tempfile
import time
import zlib

from common import (BOX, ROOT, Daemon, Watch, ask, attack, check, code_of, multipart, post, render, service)


def png(width, height, rows=None, extra=b""):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    pixels = zlib.compress((b"\0" + b"\x80\x40\xff" * width) * (height if rows is None else rows), 9)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + extra
            + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def textured(name, number):
    return (f'<world><window width="64" height="64"/><group><models><model file="plane_{number}_1.3d">'
            f'<texture file="{name}"/></model></models></group></world>')


def draw_with(daemon, name, content, number=1):
    """Status and code of a plane with that texture."""
    body = multipart([("scene", "scene.xml", textured(name, number)), ("t", name, content)])
    status, _, answer = post(daemon, "/v1/render", *body)
    return status, code_of(answer) if status != 200 else "drawn"


@attack
def odd_textures(binary):
    """Textures beyond the GL's limits and files cut off; whoever comes next is served."""
    jpeg_head = b"\xff\xd8" + b"\xff\xdb\0\x43\0" + b"\1" * 64
    cases = [("cut.ppm", b"P6\n65536 1\n255\nab"), ("wide.png", png(20000, 2)), ("high.png", png(2, 20000)),
             ("claims.png", png(60000, 1000, rows=1)), ("empty.png", b""), ("cut.png", png(64, 64)[:90]),
             ("cut.jpg", jpeg_head), ("no.gif", b"GIF89a\xff\xff\xff\xff\0\0\0"),
             ("big.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n"),
             ("big.pgm", b"P5 99999 99999 255\n"), ("big.tif", b"II*\0\xff\xff\xff\x7f")]
    with service(binary, "--workers", 1) as daemon, Watch(daemon) as watch:
        results = []
        for number, (name, content) in enumerate(cases):
            result = draw_with(daemon, name, content, 2 * number + 1)
            check(result[0] in (200, 413, 422), f"{name} is answered {result}")
            after = draw_with(daemon, "good.png", png(4, 4), 2 * number + 2)
            check(after[0] == 200, f"after {name} a good texture is answered {after}")
            results.append(f"{name} {result[0]}")
        return f"{', '.join(results)}; {watch.judge(16)}"


@attack
def jpeg_scans(binary):
    """A progressive JPEG of 62 megapixels with thousands of empty scans."""
    def segment(marker, body):
        return b"\xff" + bytes([marker]) + struct.pack(">H", len(body) + 2) + body
    out = b"\xff\xd8" + segment(0xDB, b"\0" + b"\1" * 64)
    out += segment(0xC2, struct.pack(">BHHB", 8, 7900, 7900, 1) + b"\1\x11\0")
    for table in (b"\0", b"\x10"):
        out += segment(0xC4, table + b"\0\1" + b"\0" * 14 + b"\0")
    out += segment(0xDA, b"\1\1\0\0\0\0") + segment(0xDA, b"\1\1\0\1\x3f\0") * 4000 + b"\xff\xd9"
    with service(binary, "--workers", 1) as daemon:
        begin = time.monotonic()
        status, code = draw_with(daemon, "scans.jpg", out)
        took = time.monotonic() - begin
        check(status in (200, 422), f"answered {status}: {code} after {took:.1f} s")
        return f"{status} {code} in {took:.2f} s"


@attack
def png_comments(binary):
    """Compressed text chunks that unpack to a gigabyte."""
    text = b"Comment\0\0" + zlib.compress(b"a" * (64 << 20), 9)
    chunk = struct.pack(">I", len(text)) + b"zTXt" + text + struct.pack(">I", zlib.crc32(b"zTXt" + text))
    with service(binary, "--workers", 1) as daemon:
        begin = time.monotonic()
        status, code = draw_with(daemon, "comments.png", png(8, 8, extra=chunk * 16))
        check(status in (200, 422), f"answered {status}: {code}")
        return f"{status} {code} in {time.monotonic() - begin:.2f} s"


@attack
def odd_meshes(binary):
    """Meshes whose counts, lists and indices lie."""
    ply = "ply\nformat ascii 1.0\n"
    vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    rows = "0 0 0\n1 0 0\n0 1 0\n"
    ring = "".join(f"v {i} 0 0\n" for i in range(50_000))
    cases = [("two.ply", ply + vertex + vertex.replace("3", "30000") + face + rows + "3 0 1 2\n"),
             ("far.ply", ply + vertex + face + rows + "3 0 1 200000000\n"),
             ("less.ply", ply + vertex + face + rows + "3 0 1 -2\n"),
             ("many.ply", ply + vertex.replace("3", "4000000000") + face + rows + "3 0 1 2\n"),
             ("nan.ply", ply + vertex + face + "nan 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n"),
             ("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"),
             ("far.obj", "v 0 0 0\nf 1 2 900000000\n"),
             ("line.obj", ring + "f " + " ".join(map(str, range(1, 50_001))) + "\n"),
             ("count.stl", b"\0" * 80 + struct.pack("<I", 4_000_000_000)),
             ("count.off", "OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n"),
             ("count.3d", "4000000000\n0 0 0\n"), ("count.patch", "4000000000\n0, 1, 2\n")]
    with service(binary, "--workers", 1) as daemon, Watch(daemon) as watch:
        results = []
        for name, content in cases:
            scene = f'<world><window width="64" height="64"/><group><models><model file="{name}"/></models></group></world>'
            body = multipart([("scene", "scene.xml", scene), ("m", name, content)])
            begin = time.monotonic()
            status, _, answer = post(daemon, "/v1/render", *body)
            took = time.monotonic() - begin
            check(status in (200, 413, 422), f"{name} is answered {status}: {code_of(answer)}")
            check(took < 5, f"{name} took {took:.1f} s")
            results.append(f"{name} {status}")
        check(daemon.metric("farol_worker_restarts_total") == 0, "a worker was lost")
        return f"{', '.join(results)}; {watch.judge(4)}"


@attack
def few_descriptors(binary):
    """An upload stays when its file cannot be opened for want of descriptors."""
    with tempfile.TemporaryDirectory() as data:
        with Daemon(binary, "--data", data, "--workers", 1) as daemon:
            status, _, answer = render(daemon, BOX.format(9), "/v1/scenes")
            check(status == 201, f"the upload is answered {status}")
            source = "/v1/scenes/" + json.loads(answer)["id"] + "/source"
        with Daemon(binary, "--data", data, "--workers", 1) as daemon:
            first = daemon.connection()
            ask(first, "GET", "/livez")
            used = daemon.descriptors()
            hard = resource.prlimit(daemon.pid, resource.RLIMIT_NOFILE)[1]
            resource.prlimit(daemon.pid, resource.RLIMIT_NOFILE, (used, hard))
            during = ask(first, "GET", source)[0]
            check(during in (200, 503), f"without descriptors the source is answered {during}")
            resource.prlimit(daemon.pid, resource.RLIMIT_NOFILE, (hard, hard))
            after = ask(first, "GET", source)[0]
            check(after == 200, f"later it is answered {after}")
        aside = os.listdir(pathlib.Path(data) / "aside") if (pathlib.Path(data) / "aside").is_dir() else []
        check(not aside, f"moved aside: {aside}")
        with Daemon(binary, "--data", data, "--workers", 1) as daemon:
            status = daemon.get(source)[0]
            check(status == 200, f"after a restart it is answered {status}")
        return f"{during} without descriptors, 200 later and after a restart"


@attack
def folder_replaced(binary):
    """The served folder is moved away and put back as another one."""
    with tempfile.TemporaryDirectory() as place:
        scenes = pathlib.Path(place) / "scenes"
        shutil.copytree(ROOT / "scenes" / "house", scenes / "house")
        with Daemon(binary, "--workers", 1, scenes=scenes) as daemon:
            check(daemon.get("/v1/scenes/house/image?width=50")[0] == 200, "not drawn before")
            scenes.rename(pathlib.Path(place) / "old")
            shutil.copytree(pathlib.Path(place) / "old", scenes)
            for attempt in range(100):
                status = daemon.get(f"/v1/scenes/house/image?width={60 + attempt}")[0]
                if status == 200:
                    return f"drawn again at attempt {attempt + 1}"
                time.sleep(0.1)
            check(False, f"still answered {status} after 10 s")


@attack
def bad_scenes_in_folder(binary):
    """Each bad file is one row of the gallery."""
    with tempfile.TemporaryDirectory() as place:
        scenes = pathlib.Path(place)
        shutil.copytree(ROOT / "scenes" / "house", scenes / "house")
        inner = '<models><model file="box_1_1.3d"/></models>'
        for _ in range(6):
            inner = f'<group><scatter count="1000" radius="10"/>{inner}</group>'
        for name, content in [("empty", ""), ("noise", "\0\1\2"), ("scatters", f"<world>{inner}</world>"),
                              ("cut", "<world><gro")]:
            (scenes / name).mkdir()
            (scenes / name / "scene.xml").write_text(content)
        (scenes / "pipe").mkdir()
        os.mkfifo(scenes / "pipe" / "scene.xml")
        (scenes / "gone").mkdir()
        (scenes / "gone" / "scene.xml").symlink_to("/nowhere.xml")
        (scenes / "folder" / "scene.xml").mkdir(parents=True)
        with service(binary, "--workers", 1, scenes=scenes) as daemon, Watch(daemon) as watch:
            status, _, answer = daemon.get("/v1/scenes")
            check(status == 200, f"the list is answered {status}: {code_of(answer)}")
            rows = {row["id"]: row["valid"] for row in json.loads(answer)["scenes"]}
            check(rows.get("house") is True, f"the good scene is not there: {rows}")
            check(rows.get("scatters") is False, f"the bad scene is no row: {rows}")
            return f"{len(rows)} rows, {watch.judge()}"


@attack
def stopped_workers(binary):
    """Workers stopped and killed from outside strike no scene."""
    with service(binary, "--workers", 1, "--deadline", 2) as daemon:
        for number, sent in enumerate([signal.SIGSTOP, signal.SIGKILL, signal.SIGSTOP, signal.SIGSEGV]):
            workers = daemon.workers()
            for pid in workers:
                try:
                    os.kill(pid, sent)
                except ProcessLookupError:
                    pass
            daemon.get(f"/v1/scenes/house/image?width={70 + number}")
            for pid in workers:
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
        for attempt in range(100):
            status, _, answer = daemon.get("/v1/scenes/house/image?width=64")
            if status == 200:
                return f"drawn at attempt {attempt + 1}"
            check(code_of(answer) != "worker.quarantine", "the scene is closed")
            time.sleep(0.1)
        check(False, f"still answered {status}")
