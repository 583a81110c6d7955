"""The front of budget_ms, fitted to what `scripts/bench front` measures: render/plan/quality_front.inc.

A frame's CPU time on all cores is modelled as fixed + pixels * fill(samples) + triangles *
cost(samples), by least squares of relative errors with nothing negative. The order of candidates is
that of mean FLIP over the scenes; one that is not better than a cheaper one is left out.
"""

import math
import statistics

SAMPLES = [1, 4, 8, 16]


def rows_of(data):
    for scene in data["results"]:
        if scene["scene"] == "mixed":
            continue  # one scene of the set has no weight of its own
        for s in scene["settings"]:
            if (s["divisions"] == 0 and s["shading"] == "phong" and "filter" not in s
                    and "cpuMs" in s):
                # As the plan does: more samples resolve finer outlines.
                finest = 1 / s["aa"] if s["aa"] > 4 else math.inf
                yield scene, {**s, "error": min(s["error"], finest)}


def non_negative(equations, count):
    """Coordinate descent on sum (a x - 1)^2, x >= 0."""
    x = [0.0] * count
    rest = [1.0] * len(equations)
    for _ in range(4000):
        for j in range(count):
            norm = sum(a[j] * a[j] for a in equations)
            if norm == 0:
                continue
            step = max(-x[j], sum(a[j] * r for a, r in zip(equations, rest)) / norm)
            x[j] += step
            rest = [r - step * a[j] for a, r in zip(equations, rest)]
    return x


def fit(data, cores):
    equations, ratios = [], []
    for scene, s in rows_of(data):
        ms = s["cpuMs"] / cores
        pixels = scene["width"] * scene["height"]
        row = [0.0] * (1 + 2 * len(SAMPLES))
        at = SAMPLES.index(s["aa"])
        row[0] = 1 / ms
        row[1 + at] = 1e-6 * pixels / ms
        row[1 + len(SAMPLES) + at] = 1e-6 * s["triangles"] / ms
        equations.append(row)
        ratios.append(s["triangles"] * s["error"] / math.sqrt(pixels * s["models"]))
    x = non_negative(equations, len(equations[0]))
    # More samples never cost less: where noise says so, the cost of fewer is kept.
    fill, mesh = x[1:1 + len(SAMPLES)], x[1 + len(SAMPLES):]
    for i in range(1, len(SAMPLES)):
        fill[i], mesh[i] = max(fill[i], fill[i - 1]), max(mesh[i], mesh[i - 1])
    return x[0], fill, mesh, statistics.median(ratios)


def order(data):
    """(samples, error) of the front, best first, by means over the scenes."""
    found = {}
    for scene, s in rows_of(data):
        found.setdefault((s["aa"], s["error"]), []).append((s["flip"], s["cpuMs"]))
    scenes = len({scene["scene"] for scene, _ in rows_of(data)})
    points = [(statistics.geometric_mean([c for _, c in v]), statistics.mean([f for f, _ in v]), key)
              for key, v in found.items() if len(v) >= scenes]
    kept, best = [], math.inf
    for _, flip, key in sorted(points):
        if flip < 0.99 * best:  # less is no gain
            best = flip
            kept.append((key, flip))
    chain = []  # neither of the two gets better as the budget shrinks
    for (samples, error), flip in reversed(kept):
        if not chain or (samples <= chain[-1][0][0] and error >= chain[-1][0][1]):
            chain.append(((samples, error), flip))
    # Where noise makes a finer error seem the cheaper of two nearly equal ones, the chain would end
    # before the fewest samples.
    means = {key: (cost, flip) for cost, flip, key in points}
    for samples in sorted(SAMPLES, reverse=True):
        (last, error), _ = chain[-1]
        if samples < last and (samples, error) in means:
            if means[samples, error][0] < means[last, error][0]:
                chain.append(((samples, error), means[samples, error][1]))
    return chain


def per_light(scale):
    """What a light adds to a frame of one light, of that frame's drawing."""
    rows = {r["value"]: r["drawMs"] for r in scale["results"]["sweeps"] if r["sweep"] == "lights"}
    most = max(rows)
    return max(0.0, (rows[most] / rows[1] - 1) / (most - 1))


def write(data, scale, path):
    machine = data["machine"]
    fixed, fill, mesh, ratio = fit(data, machine["cores"])
    lines = ["// Made by `scripts/bench front`; not written by hand.",
             f"// Measured on {machine['cores']} cores of {machine['cpu']}; CPU time over cores.",
             f"constexpr double kFixedMs = {fixed:.3g};",
             f"constexpr double kTrianglesOpen = {ratio:.3g};",
             f"constexpr double kPerLight = {per_light(scale):.3g};",
             f"constexpr std::array<SampleCost, {len(SAMPLES)}> kCosts{{{{"]
    lines += [f"    {{{s}, {f:.4g}, {m:.4g}}}," for s, f, m in zip(SAMPLES, fill, mesh)]
    front = order(data)
    lines += ["}};", f"constexpr std::array<Candidate, {len(front)}> kFront{{{{"]
    lines += [f"    {{{s}, {e:g}}},  // mean FLIP {flip:.4f}" for (s, e), flip in front]
    path.write_text("\n".join(lines + ["}};", ""]))
