"""A class of 200 made-up submissions, graded by three cameras: submissions a second, the stages' times
and memory over the run."""

import io
import json
import os
import re
import resource
import shutil
import subprocess
import tarfile
import threading
import time

from bench.scenes import png

REFERENCE = """<world><window width="512" height="512"/>
<camera><position x="6" y="4" z="8"/><lookAt x="0" y="0.5" z="0"/>
<projection fov="50" near="1" far="100"/></camera>
<lights>
<light type="directional" dirx="1" diry="2" dirz="1.5"/>
<light type="point" posx="2" posy="3" posz="2" quadratic="0.05"/>
<light type="spot" posx="-3" posy="5" posz="1" dirx="0.4" diry="-1" dirz="-0.2" cutoff="30"/>
</lights>
<group>
<models><model file="plane_8_16.3d"><texture file="noise.png"/></model></models>
<group><transform><translate x="-1" y="1" z="0.6"/><rotate angle="25" x="0" y="1" z="0"/></transform>
<models><model file="box_1.5_4.3d"><texture file="noise.png"/></model></models>
<group><transform><translate x="0.4" y="1.4" z="0"/><rotate angle="-30" x="0" y="0" z="1"/><scale x="0.6" y="1.2" z="0.6"/></transform>
<models><model file="cylinder_0.5_1_24_1.3d"><color><diffuse R="60" G="120" B="200"/><specular R="255" G="255" B="255"/><shininess value="40"/></color></model></models>
</group></group>
<group><transform><translate x="1.8" y="0.9" z="0"/></transform>
<models><model file="sphere_0.9_32_24.3d"><color><diffuse R="200" G="60" B="60"/><specular R="200" G="200" B="200"/><shininess value="30"/></color></model></models></group>
<group><transform><translate x="0" y="0" z="-2"/></transform>
<models><model file="cone_0.8_2_24_4.3d"><color><diffuse R="60" G="180" B="90"/></color></model></models></group>
</group></world>"""

# What to look for, and what a student wrote instead.
MISTAKES = [
    (r'angle="25"', 'angle="-25"'),
    (r'angle="-30"', 'angle="-0.5236"'),
    (r'(<translate x="0.4"[^>]*>)(<rotate[^>]*>)', r"\2\1"),
    (r'<translate x="-1"', '<translate x="1"'),
    (r'<scale[^>]*>', ""),
    (r'<light type="point"[^>]*>', ""),
    (r'dirx="1" diry="2"', 'dirx="-1" diry="-2"'),
    (r'cutoff="30"', 'cutoff="12"'),
    (r'<position x="6"', '<position x="4.5"'),
    (r'fov="50"', 'fov="62"'),
    (r'R="200" G="60"', 'R="60" G="200"'),
    (r'(box_1.5_4.3d">)<texture[^>]*>', r"\1"),
    (r'sphere_0.9_32_24', "sphere_0.9_24_32"),
    (r'cone_0.8_2_24_4', "cone_0.8_2_8_2"),
    (r'<group><transform><translate x="0" y="0" z="-2".*?</group>', ""),
    (r'<shininess value="40"/>', '<shininess value="4"/>'),
]
BREAKS = [lambda xml: xml[:len(xml) // 2],
          lambda xml: xml.replace("noise.png", "nosuch.png"),
          lambda xml: xml.replace("sphere_0.9_32_24", "sphere_0.9_3000_3000"),
          lambda xml: "\x00\xff not a scene" * 50]


def written_anew(xml, number):
    """The same scene in another hand: spaces, and where the attributes stand."""
    xml = re.sub(r'x="([^"]*)" y="([^"]*)" z="([^"]*)"', r'z="\3" y="\2"  x="\1"', xml)
    return f"<!-- {number} -->\n" + xml


def make(folder, count):
    """`count` submissions: a quarter right, an eighth broken, the rest with one or two mistakes; half of
    them archives."""
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("reference", "class"):
        (folder / name).mkdir(parents=True)
    png(folder / "reference" / "noise.png", 256)
    (folder / "reference" / "scene.xml").write_text(REFERENCE)
    noise = (folder / "reference" / "noise.png").read_bytes()
    kinds = {"right": 0, "mistaken": 0, "broken": 0}
    for i in range(count):
        xml = written_anew(REFERENCE, i)
        if i % 8 == 7:
            xml, kind = BREAKS[i // 8 % len(BREAKS)](xml), "broken"
        elif i % 4 == 0:
            kind = "right"
        else:
            kind, plain = "mistaken", REFERENCE
            for at in {i % len(MISTAKES), (i + 7 * (i // len(MISTAKES))) % len(MISTAKES)}:
                plain = re.sub(*MISTAKES[at], plain, flags=re.S)
            xml = written_anew(plain, i)
        kinds[kind] += 1
        files = {"scene.xml": xml.encode("latin-1"), "noise.png": noise}
        if i % 2:
            with tarfile.open(folder / "class" / f"student-{i:03}.tar", "w") as tar:
                for name, data in files.items():
                    head = tarfile.TarInfo(name)
                    head.size = len(data)
                    tar.addfile(head, io.BytesIO(data))
        else:
            (folder / "class" / f"student-{i:03}").mkdir()
            for name, data in files.items():
                (folder / "class" / f"student-{i:03}" / name).write_bytes(data)
    return kinds


def resident(root):
    """MiB of the program itself and of all processes below it, pages they share counted for each."""
    parents, sizes = {}, {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat", encoding="latin-1") as file:
                    fields = file.read().rsplit(")", 1)[1].split()
            except OSError:  # it has ended
                continue
            parents[int(entry)] = int(fields[1])
            sizes[int(entry)] = int(fields[21]) * os.sysconf("SC_PAGE_SIZE") / 2**20
    below = 0.0
    for pid in parents:
        at = parents[pid]
        while at in parents and at != root:
            at = parents[at]
        below += sizes[pid] if at == root else 0.0
    return sizes.get(root, 0.0), below


def rubrics(folder):
    """The example's criteria, and all of the default ones; three cameras, 512 x 512 each."""
    example = json.loads(open("api/examples/rubric.json", encoding="utf-8").read())
    del example["$schema"]
    every = {key: example[key] for key in ("points", "picture", "views")}
    for name, rubric in (("example", example), ("default", every)):
        path = folder / f"{name}.json"
        path.write_text(json.dumps(rubric))
        yield name, path


def grade(farol, folder, rubric, jobs):
    """One run of the program over the class, nothing kept from before."""
    shutil.rmtree(folder / "report", ignore_errors=True)
    memory, before = [], resource.getrusage(resource.RUSAGE_CHILDREN)
    begin = time.monotonic()
    command = [str(farol), "grade", "--reference", str(folder / "reference"),
               str(folder / "class"), "-o", str(folder / "report"), "--rubric", str(rubric),
               "--jobs", str(jobs), "--json"]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    results = folder / "report" / "results"

    def watch():
        while child.poll() is None:
            done = len(list(results.glob("*.grade"))) if results.is_dir() else 0
            memory.append([time.monotonic() - begin, done, *resident(child.pid)])
            time.sleep(0.25)

    watcher = threading.Thread(target=watch)
    watcher.start()
    told = child.stdout.read()
    child.wait()
    watcher.join()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if child.returncode != 0:
        return None
    told = json.loads(told)
    wall = time.monotonic() - begin
    graded = told["graded"]
    report = sum(file.stat().st_size for file in (folder / "report").glob("*.*")) / 2**20
    return {"wallS": wall, "perSecond": len(told["submissions"]) / wall,
            "cpuS": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            "submissions": len(told["submissions"]), "graded": graded,
            "stagesMs": {name: told["timesMs"][name] / max(1, graded)
                         for name in ("read", "draw", "compare")},
            "reportMiB": report,
            "memory": [{"atS": at, "done": done, "parentMiB": own, "workersMiB": workers}
                       for at, done, own, workers in memory]}


def run(bench, progress):
    """Rows by rubric: every run, so that a busy minute is seen."""
    folder, rows = bench.scratch / "class", []
    count, rounds = (40, 1) if bench.quick else (200, 3)
    jobs = 2
    kinds = make(folder, count)
    named = list(rubrics(folder))
    for turn in range(rounds):
        for i, (name, rubric) in enumerate(named):
            progress.step("grade", (turn + i / len(named)) / rounds, f"rubric {name}")
            found = grade(bench.farol, folder, rubric, jobs)
            if found:
                rows.append({"rubric": name, "jobs": jobs, "kinds": kinds, **found})
                stages = ", ".join(f"{key} {ms:.1f} ms" for key, ms in found["stagesMs"].items())
                workers = [one["workersMiB"] for one in found["memory"]] or [0]
                progress.say(f"{name}: {found['perSecond']:.1f} a second, {found['cpuS']:.1f} s of CPU "
                             f"time; {stages}; workers at most {max(workers):.0f} MiB")
    return rows
