#!/usr/bin/env python3
"""Example scenes as binary glTF, opened in Blender: what arrives, and FLIP against Farol's own image.

    python3 bench/blender.py PROGRAM [OUT_FOLDER [SCENE...]]

OUT_FOLDER keeps the models and images. SCENE is a folder of scenes; without one, all are opened, and
those that move a second time at 2 s. Exits with 1 if a node, name, light, camera, material, image or
motion of a file is missing in Blender. Cycles draws on the processor, without what Farol does not have:
shadows, light from surface to surface, a tone curve.
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WIDTH, HEIGHT, LATER_S = 320, 240, 2.0


def document(path):
    """Returns the JSON of a binary glTF file."""
    data = Path(path).read_bytes()
    magic, _, _, size, kind = struct.unpack_from("<4sIIII", data)
    if magic != b"glTF" or kind != 0x4E4F534A:
        raise ValueError(f"{path} is no binary glTF file")
    return json.loads(data[20:20 + size])


def plain(name):
    """Returns a name without the number that Blender puts at its end, in place of any that is there."""
    return re.sub(r"\.\d+$", "", name[:63])


def expected(path):
    """Returns the counts and names that Blender has to show for a file."""
    gltf = document(path)
    nodes = gltf.get("nodes", [])
    lights = gltf.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    moving = {channel["target"]["node"] for motion in gltf.get("animations", [])
              for channel in motion["channels"]}
    return {
        "objects": len(nodes),
        "names": sorted(plain(one["name"]) for part in (nodes, gltf.get("materials", []),
                                                      gltf.get("images", []))
                        for one in part if "name" in one),
        "lights": sorted({"directional": "SUN", "point": "POINT", "spot": "SPOT"}[one["type"]]
                         for one in lights),
        "cameras": len(gltf.get("cameras", [])),
        "materials": len(gltf.get("materials", [])),
        "images": len(gltf.get("images", [])),
        "moving": len(moving),
    }


def inside(job):
    """Runs in Blender: imports each file of the job, and prints a line of JSON for each."""
    import bpy
    import numpy

    if "bool" not in vars(numpy):  # Blender 3.4 asks for a name that numpy 1.24 has dropped
        numpy.bool = bool
    # The dialog's "Lighting Mode: Unitless"; the name is another one since Blender 3.6.
    options = bpy.ops.import_scene.gltf.get_rna_type().properties.keys()
    lighting = next(name for name in options if name.endswith("convert_lighting_mode"))

    for entry in job:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.import_scene.gltf(filepath=entry["glb"], **{lighting: "COMPAT"})
        data, scene = bpy.data, bpy.context.scene
        names = [plain(one.name) for part in (data.objects, data.materials, data.images)
                 for one in part]
        found = {
            "objects": len(data.objects), "names": names, "lights": sorted(one.type for one in data.lights),
            "cameras": len(data.cameras), "materials": len(data.materials),
            # Not those that Blender 3 computes from a material.
            "images": sum(one.source == "FILE" and not one.name.startswith("Specular")
                          for one in data.images),
            "moving": sum(1 for one in data.objects if one.animation_data is not None),
        }
        print("FOUND " + json.dumps(found), flush=True)
        scene.render.engine = "CYCLES"
        scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", 16, False
        scene.cycles.max_bounces = 0
        scene.cycles.transparent_max_bounces = 16
        scene.view_settings.view_transform = "Standard"
        scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
        scene.render.image_settings.file_format = "PNG"
        scene.camera = next(one for one in data.objects if one.type == "CAMERA")
        world = data.worlds.new("black")
        world.use_nodes = True
        world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
        scene.world = world
        for light in data.lights:
            light.cycles.cast_shadow = False
        for time_s, image in entry["images"]:
            frame = time_s * scene.render.fps
            scene.frame_set(int(frame), subframe=frame - int(frame))
            scene.render.filepath = image
            bpy.ops.render.render(write_still=True)


def run_blender(blender, job):
    """Returns the counts of each file of the job, as Blender shows them."""
    # Debian's Blender looks for its Python by PATH: with another one there, it has no numpy.
    done = subprocess.run(
        [blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__, "--",
         json.dumps(job)], capture_output=True, text=True, env={**os.environ, "PATH": os.defpath})
    found = [json.loads(line[6:]) for line in done.stdout.splitlines() if line.startswith("FOUND ")]
    if done.returncode != 0 or len(found) != len(job):
        sys.exit(f"Blender ended with {done.returncode}:\n{(done.stdout + done.stderr)[-3000:]}")
    return found


def difference(wanted, found):
    """Returns what differs, in words; an empty string if nothing does."""
    parts = [f"{key}: {wanted[key]} in the file, {found[key]} in Blender" for key in wanted
             if key != "names" and wanted[key] != found[key]]
    left = list(found["names"])
    for name in wanted["names"]:
        if name in left:
            left.remove(name)
        else:
            parts.append(f'no "{name}"')
    return "; ".join(parts)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    blender = shutil.which(os.environ.get("FAROL_BLENDER", "blender"))
    if not blender:
        sys.exit("skipped: Blender is not installed")
    farol = Path(sys.argv[1]).resolve()
    folder = Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    scenes = [ROOT / "scenes" / name / "scene.xml" for name in sys.argv[3:]]
    job = []
    for scene in scenes or sorted((ROOT / "scenes").glob("*/scene.xml")):
        name = scene.parent.name
        glb = folder / f"{name}.glb"
        subprocess.run([farol, "convert", scene, glb], check=True, capture_output=True)
        times = [0.0, LATER_S] if expected(glb)["moving"] else [0.0]
        images = [(time_s, str(folder / f"{name}-{time_s:g}-blender.png")) for time_s in times]
        job.append({"name": name, "glb": str(glb), "images": images})
        for time_s in times:
            subprocess.run([farol, "render", scene, "-o", folder / f"{name}-{time_s:g}-farol.png", "--width",
                            str(WIDTH), "--height", str(HEIGHT), "--time", str(time_s),
                            "--background", "black"], check=True, capture_output=True)
    found = run_blender(blender, job)
    failed = False
    print("| Scene | objects | lights | materials | images | moving | FLIP | FLIP at 2 s | missing |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for entry, arrived in zip(job, found):
        differs = difference(expected(entry["glb"]), arrived)
        failed = failed or bool(differs)
        flips = []
        for _, image in entry["images"]:
            ours = image.replace("-blender.png", "-farol.png")
            compared = subprocess.run([farol, "compare", ours, image, "--json"], capture_output=True,
                                      text=True, check=True)
            flips.append(f"{json.loads(compared.stdout)['flip']['mean']:.3f}")
        print(f"| {entry['name']} | {arrived['objects']} | {len(arrived['lights'])} | "
              f"{arrived['materials']} | {arrived['images']} | {arrived['moving']} | {flips[0]} | "
              f"{flips[1] if len(flips) > 1 else ''} | {differs} |")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    if "--" in sys.argv and "bpy" in sys.modules:
        inside(json.loads(sys.argv[sys.argv.index("--") + 1]))
    else:
        main()
