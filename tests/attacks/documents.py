"""Documents that are small to send and costly to read: JSON, scenes, archives, options."""
import http.client
import io
import random
import tarfile
import time
import zipfile
import zlib

from common import BOX, Watch, ask, attack, check, code_of, multipart, post, render, service, together

MIB = 1 << 20


def options_body(options):
    return multipart([("scene", None, BOX.format(1)), ("options", None, options)])


def json_attack(binary, make, count=1):
    """`make(index)` is a part "options" that must be refused."""
    bodies = [options_body(make(index)) for index in range(count)]
    with service(binary) as daemon, Watch(daemon) as watch:
        answers = together(count, lambda index: post(daemon, "/v1/render", *bodies[index]))
        time.sleep(0.3)
        statuses = sorted({answer[0] for answer in answers})
        check(all(status in (0, 400, 413, 422, 429, 503) for status in statuses), f"answered {statuses}")
        return f"{statuses} {watch.judge(sum(len(body) for body, _ in bodies) / MIB)}"


@attack
def json_deep(binary):
    return json_attack(binary, lambda _: b"[" * int(15.9 * MIB))


@attack
def json_deep_four(binary):
    return json_attack(binary, lambda _: b"[" * int(15.9 * MIB), 4)


@attack
def json_deep_objects(binary):
    return json_attack(binary, lambda _: b'{"a":' * (3 * MIB))


@attack
def json_many_numbers(binary):
    return json_attack(binary, lambda _: b'{"eye":[' + b"1," * (7 * MIB) + b"1]}", 2)


@attack
def json_many_keys(binary):
    return json_attack(binary, lambda _: ("{" + ",".join(f'"k{i}":0' for i in range(900_000)) + "}").encode(), 2)


@attack
def json_long_string(binary):
    return json_attack(binary, lambda _: b'{"background":"' + b"a" * (15 * MIB) + b'"}', 2)


@attack
def rubric_deep(binary):
    body = multipart([("reference", "scene.xml", BOX.format(1)), ("submission", "scene.xml", BOX.format(1)),
                      ("rubric", "rubric.json", b'{"criteria":' + b"[" * (12 * MIB))])
    with service(binary) as daemon, Watch(daemon) as watch:
        status, _, answer = post(daemon, "/v1/grade", *body)
        check(status in (400, 413, 422), f"answered {status}: {code_of(answer)}")
        return f"{status} {watch.judge(len(body[0]) / MIB)}"


def scene_attack(binary, xml, flags=(), deadline_s=12.0):
    """The scene is drawn or refused within the deadline, and a neighbour is served meanwhile."""
    with service(binary, "--workers", 2, *flags) as daemon, Watch(daemon) as watch:
        begin = time.monotonic()
        status, _, answer = render(daemon, xml)
        took = time.monotonic() - begin
        check(status in (200, 400, 413, 422), f"answered {status}: {code_of(answer)} after {took:.1f} s")
        check(took < deadline_s, f"took {took:.1f} s")
        what = "drawn" if status == 200 else code_of(answer)
        return f"{status} {what} in {took:.2f} s, {watch.judge(len(xml) / MIB)}"


def in_model(text):
    return f'<world><group><models><model file="box_1_1.3d">{text}</model></models></group></world>'


@attack
def many_texgens(binary):
    return scene_attack(binary, in_model("<texgen/>" * 49_000))


@attack
def many_attributes(binary):
    attributes = " ".join(f'a{i}="1"' for i in range(40_000))
    return scene_attack(binary, f"<world><group {attributes}/></world>")


@attack
def many_unclosed(binary):
    return scene_attack(binary, "<world>" + "<group>" * 40_000)


@attack
def many_wrong_words(binary):
    return scene_attack(binary, "<world>" + "".join(f"<grop{i}/>" for i in range(40_000)) + "</world>")


@attack
def many_missing_meshes(binary):
    models = "".join(f'<model file="missing{i}.3d"/>' for i in range(15_000))
    return scene_attack(binary, f"<world><group><models>{models}</models></group></world>")


@attack
def entities(binary):
    lines = ['<!ENTITY a0 "aaaaaaaaaa">'] + [f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 12)]
    return scene_attack(binary, f"<!DOCTYPE world [{''.join(lines)}]><world><title>&a11;</title></world>")


@attack
def nested_scatters(binary):
    inner = '<models><model file="box_1_1.3d"/></models>'
    for _ in range(6):
        inner = f'<group><scatter count="1000" radius="10"/>{inner}</group>'
    return scene_attack(binary, f"<world>{inner}</world>")


@attack
def long_curve(binary):
    points = "".join(f'<point x="{i % 7}" y="{i % 5}" z="{i % 3}"/>' for i in range(20_000))
    return scene_attack(binary, "<world><group><transform>"
                        f'<translate time="10" align="true">{points}</translate></transform>'
                        '<models><model file="box_1_1.3d"/></models></group></world>')


@attack
def costly_pictures(binary):
    """Documented requests at the upper end of every range: drawn or refused, never a closed scene."""
    with service(binary, "--workers", 2) as daemon, Watch(daemon) as watch:
        def hog(index):
            path = f"/v1/scenes/house/image?width=4096&height=4096&aa=16&azimuth={index}&elevation=20"
            status, _, answer = daemon.get(path)
            return status, code_of(answer) if status != 200 else "drawn"
        answers = together(4, hog)
        check(all(status in (200, 422, 503) for status, _ in answers), f"answered {answers}")
        for path in ("/v1/scenes/house/thumbnail", "/v1/scenes/house", "/v1/scenes"):
            status, _, answer = daemon.get(path)
            check(status == 200, f"{path} is answered {status}: {code_of(answer)}")
        return f"{sorted(set(answers))} {watch.judge(64)}"


def archive_attack(binary, body, content_type, path="/v1/render"):
    with service(binary, "--workers", 1) as daemon, Watch(daemon) as watch:
        begin = time.monotonic()
        status, _, answer = post(daemon, path, body, content_type)
        took = time.monotonic() - begin
        check(status in (200, 201, 400, 413, 415, 422), f"answered {status}: {code_of(answer)}")
        check(took < 12, f"took {took:.1f} s")
        return f"{status} in {took:.2f} s for {len(body) >> 10} KiB, {watch.judge(len(body) / MIB)}"


def tar_of(entries, compressions=1):
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w") as tar:
        for name, content, kind in entries:
            info = tarfile.TarInfo(name)
            info.type = kind
            info.size = len(content)
            tar.addfile(info, io.BytesIO(content))
    data = out.getvalue()
    for _ in range(compressions):
        packer = zlib.compressobj(9, zlib.DEFLATED, 31)
        data = packer.compress(data) + packer.flush()
    return data


@attack
def archive_clutter(binary):
    """A million entries that are left out, compressed twice."""
    entries = [("scene.xml", BOX.format(1).encode(), tarfile.REGTYPE)]
    entries += [(f"__MACOSX/{i}", b"", tarfile.DIRTYPE) for i in range(120_000)]
    return archive_attack(binary, tar_of(entries, 2), "application/x-tar")


@attack
def archive_zeros(binary):
    entries = [("scene.xml", BOX.format(1).encode(), tarfile.REGTYPE),
               ("notes.bin", b"\0" * (256 * MIB), tarfile.REGTYPE)]
    return archive_attack(binary, tar_of(entries, 2), "application/x-tar")


@attack
def archive_many_empty(binary):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        archive.writestr("scene.xml", BOX.format(1))
        for i in range(100_000):
            archive.writestr(f"d{i}/", "")
    return archive_attack(binary, out.getvalue(), "application/zip")


@attack
def archive_noise(binary):
    """Archives with bytes changed here and there: each drawn or refused, no worker lost."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("scene.xml", BOX.format(1))
        archive.writestr("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" * 50)
    good, chance = out.getvalue(), random.Random(5)
    with service(binary, "--workers", 1) as daemon:
        statuses = {}
        for _ in range(300):
            bad = bytearray(good)
            for _ in range(chance.randint(1, 6)):
                bad[chance.randrange(len(bad))] = chance.randrange(256)
            status, _, _ = post(daemon, "/v1/render", bytes(bad), "application/zip")
            statuses[status] = statuses.get(status, 0) + 1
        check(set(statuses) <= {200, 400, 413, 415, 422}, f"answered {statuses}")
        return str(statuses)


@attack
def evicting_uploads(binary):
    """The uploads of one client (127.0.0.1) do not push out those of another (127.0.0.2)."""
    with service(binary, "--workers", 1, "--store-bytes", 4 * MIB) as daemon:
        neighbour = http.client.HTTPConnection("127.0.0.1", daemon.port, timeout=30,
                                               source_address=("127.0.0.2", 0))
        status, headers, _ = ask(neighbour, "POST", "/v1/scenes", BOX.format(5).encode(),
                                 {"Content-Type": "application/xml"})
        check(status in (200, 201), f"the neighbour's upload is answered {status}")
        statuses = {}
        for index in range(12):
            body = multipart([("scene", "scene.xml", BOX.format(6)),
                              ("f", "notes.bin", random.Random(index).randbytes(MIB))])
            status = post(daemon, "/v1/scenes", *body)[0]
            statuses[status] = statuses.get(status, 0) + 1
        status = daemon.get(headers["Location"])[0]
        check(status == 200, f"the neighbour's upload is answered {status} afterwards; uploads: {statuses}")
        return f"uploads answered {statuses}, the neighbour's is still there"
