"""Which plots each suite gives."""

from collections import defaultdict

from bench.plot import Bars, Plot


def note(data):
    at = data["machine"]
    return (f"{at['cpu']}, {at['cores']} cores, load {at['load'][0]:g} to "
            f"{at.get('loadAfter', at['load'])[0]:g}; {at['commit']}, {at['date']}")


def draw(suite, data, folder):
    for name, plot in {"quality": quality, "scale": scale, "stages": stages,
                       "encoders": encoders, "peers": peers, "time-error": time_error, "load": load,
                       "grade": grade}[suite](data):
        (folder / f"{name}.svg").write_text(plot.svg())


def front(points):
    """Of (cost, error, label): those that no other beats in both, cheapest first."""
    best, kept = float("inf"), []
    for point in sorted(points):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


def label(s):
    how = f"n {s['divisions']}" if s["divisions"] else f"{s['error']:g} px"
    return f"{how}, {s['shading'][0]}, aa {s['aa']}" + (", " + s["filter"] if "filter" in s else "")


def time_error(data):
    for scene in dict.fromkeys(row["scene"] for row in data["results"]):
        plot = Plot(f"{scene}, 512 x 512: error against CPU time of a frame", "CPU time, ms",
                    "mean FLIP against the program's limit", True, True, note=note(data))
        rows = [row for row in data["results"] if row["scene"] == scene and row["flip"] > 0]
        for program in dict.fromkeys(row["program"] for row in rows):
            points = [(row["cpuMs"], row["flip"], row["setting"]) for row in rows
                      if row["program"] == program and row["cpuMs"] > 0]
            edge = front(points)
            plot.add(program, [p[:2] for p in edge], labels=[p[2] for p in edge])
        yield f"time-error-{scene.replace(' ', '-')}", plot


def quality(data):
    def cloud(scene, x, error, want):
        return [(s[x], s[error], label(s)) for s in scene["settings"] if want(s) and s[error] > 0]

    def two(scene, title, x, error, xname, yname, want):
        plot = Plot(f"{scene['scene']}: {title}", xname, yname, True, True, note=note(data))
        for name, mine in (("divisions chosen", True), ("divisions fixed", False)):
            points = cloud(scene, x, error,
                           lambda s, mine=mine: want(s) and (s["divisions"] == 0) == mine)
            edge = front(points)
            plot.add(f"{name}: front", [p[:2] for p in edge], labels=[p[2] for p in edge],
                     dash=not mine)
            plot.add(f"{name}: all", [p[:2] for p in points], line=False)
        return plot

    for scene in data["results"]:
        name = scene["scene"]
        yield f"quality-{name}-time", two(
            scene, "time against error", "frameMs", "flip", "warm frame, ms",
            "mean FLIP against the exact areas (R2)", lambda s: True)
        yield f"quality-{name}-triangles", two(
            scene, "triangles against error", "triangles", "flip", "triangles drawn",
            "mean FLIP against R2, 4 samples", lambda s: s["aa"] == 4 and s["shading"] == "phong"
            and "filter" not in s)


def scale(data):
    sweeps = defaultdict(list)
    for row in data["results"]["sweeps"]:
        sweeps[row["sweep"]].append(row)
    for sweep, rows in sweeps.items():
        linear = sweep == "percent outside"
        # A size of 0 stands at a half on a logarithmic axis: no texture.
        at = [row["value"] if linear or row["value"] > 0 else 0.5 for row in rows]
        plot = Plot(f"Cost by {sweep}", sweep, "ms", not linear, True, note=note(data))
        for key, name in (("firstMs", "first picture"), ("totalMs", "warm frame and PNG"),
                          ("drawMs", "of it drawing"), ("geometryMs", "of it the plan")):
            plot.add(name, [(x, row[key]) for x, row in zip(at, rows)])
        yield "scale-" + sweep.replace(" ", "-"), plot
    rows = data["results"]["crowd"]
    if rows:
        plot = Plot("100 models in view, the rest behind the viewer", "models", "ms", True, True,
                    note=note(data))
        for key, name in (("firstMs", "first frame"), ("frameMs", "warm frame"),
                          ("aloneMs", "the 100 alone"), ("planMs", "the plan")):
            plot.add(name, [(row["objects"], row[key]) for row in rows])
        yield "scale-crowd", plot


def stages(data):
    sizes = defaultdict(list)
    for row in data["results"]:
        sizes[f"{row['width']}x{row['height']}"].append(row)
    for size, rows in sizes.items():
        yield f"stages-{size}", Bars(
            f"A warm frame by stage, {size}", "ms (medians)",
            [(row["scene"], {"parse": row["parseMs"], "plan": row["geometryMs"],
                             "draw": row["drawMs"], "read back": row["readbackMs"],
                             "encode": row["encodeMs"]}) for row in rows], note=note(data))


def encoders(data):
    pictures = defaultdict(list)
    for row in data["results"]:
        pictures[f"{row['scene']}-{row['width']}x{row['height']}"].append(row)
    for name, rows in pictures.items():
        plot = Plot(f"Encoders: {name}", "ms", "bytes", True, True, note=note(data))
        kinds = defaultdict(list)
        for row in rows:
            kinds[row["encoder"].split()[0]].append(row)
        for kind, own in kinds.items():
            own.sort(key=lambda row: row["bytes"])
            plot.add(kind, [(row["ms"], row["bytes"]) for row in own], line=kind != "libpng",
                     labels=[row["encoder"] for row in own])
        yield f"encoders-{name}", plot


PEER_SCENES = {"spheres": "100 spheres", "course-4-6": "course scene 4_6"}


def peers(data):
    groups = defaultdict(list)
    for row in data["results"]:
        groups[row["scene"], row["kind"], f"{row['width']}x{row['height']}"].append(row)
    for (scene, kind, size), rows in groups.items():
        what = "from nothing to a PNG" if kind == "cold" else "next frame and its PNG"
        yield f"peers-{scene}-{kind}-{size}", Bars(
            f"{PEER_SCENES[scene]}, {size}: {what}", "ms (medians)",
            [(row["program"], {"ms": row["ms"]}) for row in rows], note=note(data))


def load(data):
    rows = data["results"]
    pictures = Plot("Pictures a second, each from another side", "connections", "a second", True,
                    note=note(data))
    drawn = [row for row in rows if row["load"] == "drawn"]
    pictures.add("served", [(row["connections"], row["perSecond"]) for row in drawn], line=True)
    pictures.add("bare frames and PNGs on the same cores",
                 [(row["connections"], row["idealPerSecond"]) for row in drawn], dash=True)
    yield "load-drawn", pictures
    cheap = Plot("Answers without a worker", "connections", "a processor second of the parent", True,
                 note=note(data))
    for kind in ("304", "cached"):
        cheap.add(kind, [(row["connections"], row["perCpuSecond"]) for row in rows
                         if row["load"] == kind], line=True)
    yield "load-answered", cheap


def grade(data):
    plot = Plot("memory while a class is graded", "time, s", "resident, MiB", False, False,
                note=note(data))
    last = {row["rubric"]: row for row in data["results"]}
    for name, row in last.items():
        for key, what in (("workersMiB", f"both workers, {name} rubric"), ("parentMiB", "the rest")):
            if key == "workersMiB" or name == "default":
                plot.add(what, [(one["atS"], one[key]) for one in row["memory"]])
    yield "grade-memory", plot
