#!/usr/bin/env python3
"""Makes every texture and mesh of the example scenes: python3 scenes/make_textures.py [scene...]

Everything is procedural and deterministic: a run rewrites the very same bytes. Only the standard
library is used; it takes some minutes. Where two scenes use one picture, both get it, since a
scene cannot reach outside its folder."""

import sys
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

sys.dont_write_bytecode = True

from make import hare, image, meshes, planets, see_through, signs, skies, surfaces  # noqa: E402

HERE = Path(__file__).resolve().parent

# scene -> file -> its maker
SCENES = {
    "can-and-pawns": {
        "can-body.ply": meshes.can_body,
        "can-bottom.ply": meshes.can_bottom,
        "can-top.ply": meshes.can_top,
        "label.jpg": signs.label,
        "lid.jpg": signs.lid,
        "pawn.ply": meshes.pawn,
        "planks.jpg": surfaces.planks,
        "wood.jpg": surfaces.wood,
    },
    "chess-hare": {"hare.ply": hare.hare},
    "house": {
        "bricks.jpg": surfaces.bricks,
        "day.jpg": skies.day,
        "door.jpg": surfaces.door,
        "flagstones.jpg": surfaces.flagstones,
        "grass.jpg": surfaces.grass,
        "plaster.jpg": surfaces.plaster,
        "tiles.jpg": surfaces.tiles,
        "windows.jpg": surfaces.windows,
    },
    "lighthouse": {
        "asteroid.ply": meshes.asteroid,
        "beam.jpg": surfaces.beam,
        "beam.obj": meshes.beam,
        "crag.jpg": surfaces.crag,
        "door.jpg": surfaces.door,
        "island.obj": meshes.island,
        "moon.jpg": planets.moon,
        "night.jpg": skies.night,
        "plaster.jpg": surfaces.plaster,
        "sea.jpg": surfaces.sea,
        "stripes.jpg": surfaces.stripes,
        "windows.jpg": surfaces.windows,
    },
    "police-box": {
        "box_front.jpg": signs.box_front,
        "box_side.jpg": signs.box_side,
        "box_sign.png": signs.box_sign,
        "box_window.jpg": signs.box_window,
        "bricks.jpg": surfaces.bricks,
        "cobbles.jpg": surfaces.cobbles,
        "crate.jpg": signs.crate,
    },
    "primitives": {"compass.png": signs.compass, "vase.ply": meshes.vase},
    "robot-arm": {
        "concrete.jpg": surfaces.concrete,
        "crate.jpg": signs.crate,
        "hazard.png": signs.hazard,
        "metal.jpg": surfaces.metal,
        "rust.jpg": surfaces.rust,
    },
    "see-through": {
        "clouds.png": see_through.clouds,
        "lattice.png": see_through.lattice,
        "leaf.png": see_through.leaf,
        "planks.jpg": surfaces.planks,
        "rings.png": see_through.veil_rings,
        "rock.jpg": planets.mars,
    },
    "skybox-nebula": {
        "asteroid.ply": meshes.asteroid,
        "hull.jpg": signs.hull,
        "moon.jpg": planets.moon,
        "nebula.jpg": skies.nebula,
        "neptune.jpg": planets.neptune,
        "rings.png": planets.rings,
    },
    "solar-system": {
        "asteroid.ply": meshes.asteroid,
        "comet.patch": meshes.comet_head,
        "earth.jpg": planets.earth,
        "ice.jpg": planets.ice,
        "jupiter.jpg": planets.jupiter,
        "mars.jpg": planets.mars,
        "mercury.jpg": planets.mercury,
        "moon.jpg": planets.moon,
        "neptune.jpg": planets.neptune,
        "rings.png": planets.rings,
        "saturn.jpg": planets.saturn,
        "stars.jpg": skies.stars,
        "sun.jpg": planets.sun,
        "tail.jpg": planets.tail,
        "tail.patch": meshes.comet_tail,
        "uranus.jpg": planets.uranus,
        "venus.jpg": planets.venus,
    },
    "third-person-ship": {
        "asteroid.ply": meshes.asteroid,
        "earth.jpg": planets.earth,
        "hull.jpg": signs.hull,
        "moon.jpg": planets.moon,
        "stars.jpg": skies.stars,
    },
    "torch": {
        "bricks.jpg": surfaces.bricks,
        "crate.jpg": signs.crate,
        "planks.jpg": surfaces.planks,
    },
}


def make(maker, paths):
    """Runs one maker and writes its file, the same for each of the paths."""
    made = maker()
    for path in paths:
        path.parent.mkdir(exist_ok=True)
        if isinstance(made, bytes):
            path.write_bytes(made)
        else:
            image.write(path, made)
    return paths


def main(chosen):
    unknown = sorted(set(chosen) - set(SCENES))
    if unknown:
        sys.exit(f"no such scene with assets: {', '.join(unknown)}")
    jobs = {}
    for scene, files in SCENES.items():
        for name, maker in files.items():
            if not chosen or scene in chosen:
                jobs.setdefault(maker, []).append(HERE / scene / name)
    with ProcessPoolExecutor() as pool:
        waiting = [pool.submit(make, maker, paths) for maker, paths in jobs.items()]
        for count, job in enumerate(as_completed(waiting), start=1):
            for path in job.result():
                print(f"[{count}/{len(waiting)}] {path.relative_to(HERE)}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
