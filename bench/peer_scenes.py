"""What the peers draw: the same scenes, told to each program in its own words."""

import json
import math
import random
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

SLICES, STACKS, COUNT = 32, 16, 100


class Subject:
    """A scene in a folder: `document` for us, `mesh` for F3D, `page` (a script that fills `scene`)
    for three.js, `pov` for POV-Ray or None; a camera that all share, `angle` up and down."""

    def __init__(self, name, label, eye, focus, angle, near):
        self.name, self.label = name, label
        self.eye, self.focus, self.angle, self.near = eye, focus, angle, near
        self.document = self.mesh = self.pov = None
        self.page = ""


def places(count=COUNT):
    """(x, y, z, radius, colour of 0 to 255) of spheres; more of them are smaller ones."""
    chance, scale = random.Random(7), (COUNT / count) ** 0.5
    return [(chance.uniform(-6, 6), chance.uniform(-4, 4), chance.uniform(-6, 0),
             scale * chance.uniform(0.3, 0.8), [chance.randrange(60, 240) for _ in range(3)])
            for _ in range(count)]


def as_xml(balls=None):
    """Given balls are one sphere of radius 1 in many sizes, else each has its own divisions."""
    models = "".join(
        f'<group><transform><translate x="{x}" y="{y}" z="{z}"/>' +
        (f'<scale x="{r}" y="{r}" z="{r}"/>' if balls else "") + '</transform><models>'
        f'<model command="sphere {1 if balls else r} {SLICES} {STACKS}"><color><diffuse R="{c[0]}" '
        f'G="{c[1]}" B="{c[2]}"/><specular R="120" G="120" B="120"/><shininess value="30"/></color>'
        f'</model></models></group>' for x, y, z, r, c in balls or places())
    return ('<world><window width="512" height="512"/><camera><position x="0" y="0" z="12"/>'
            '<lookAt x="0" y="0" z="-3"/><projection fov="45" near="1" far="100"/></camera>'
            f'<lights><light type="directional" dirx="1" diry="2" dirz="2"/></lights>{models}'
            '</world>')


def as_pov(aspect, spheres=None):
    balls = "\n".join(
        f"sphere {{<{x},{y},{-z}>,{r} pigment {{color rgb<{c[0] / 255:.4f},{c[1] / 255:.4f},"
        f"{c[2] / 255:.4f}>}} finish {{ambient 0.2 diffuse 1 phong 0.5 phong_size 30}}}}"
        for x, y, z, r, c in spheres or places())
    # 45 degrees up and down; a square picture.
    return ('#version 3.7; global_settings {assumed_gamma 1}\n'
            f'camera {{location <0,0,-12> look_at <0,0,3> right x*{aspect:.6f} up y '
            f'angle {2 * math.degrees(math.atan(math.tan(math.radians(22.5)) * aspect)):.6f}}}\n'
            f'light_source {{<500,1000,-1000> color 1 parallel point_at <0,0,0>}}\n{balls}\n')


def as_obj():
    lines, faces, base = [], [], 1
    for x, y, z, r, _ in places():
        for i in range(STACKS + 1):
            for j in range(SLICES + 1):
                a, b = math.pi * i / STACKS, 2 * math.pi * j / SLICES
                n = (math.sin(a) * math.sin(b), math.cos(a), math.sin(a) * math.cos(b))
                lines.append(f"v {x + r * n[0]:.5f} {y + r * n[1]:.5f} {z + r * n[2]:.5f}")
                lines.append(f"vn {n[0]:.5f} {n[1]:.5f} {n[2]:.5f}")
        for i in range(STACKS):
            for j in range(SLICES):
                p = base + i * (SLICES + 1) + j
                q = p + SLICES + 1
                if i > 0:
                    faces.append(f"f {p}//{p} {q}//{q} {p + 1}//{p + 1}")
                if i < STACKS - 1:
                    faces.append(f"f {p + 1}//{p + 1} {q}//{q} {q + 1}//{q + 1}")
        base += (STACKS + 1) * (SLICES + 1)
    return "\n".join(lines + faces) + "\n"


SPHERES_PAGE = """
for (const [x, y, z, r, c] of BALLS) {
  const ball = new THREE.Mesh(new THREE.SphereGeometry(r, 32, 16), new THREE.MeshPhongMaterial(
      {color: new THREE.Color(c[0] / 255, c[1] / 255, c[2] / 255), shininess: 30}));
  ball.position.set(x, y, z);
  scene.add(ball);
}
const sun = new THREE.DirectionalLight(0xffffff, 3);
sun.position.set(1, 2, 2);
scene.add(sun, new THREE.AmbientLight(0xffffff, 0.3));
"""


def spheres(folder):
    """100 spheres of 32 x 16, some before others."""
    subject = Subject("spheres", "100 spheres", (0, 0, 12), (0, 0, -3), 45, 1)
    subject.document, subject.mesh = folder / "spheres.xml", folder / "spheres.obj"
    subject.document.write_text(as_xml())
    subject.mesh.write_text(as_obj())
    subject.pov = as_pov
    subject.page = SPHERES_PAGE.replace("BALLS", json.dumps(places()))
    return subject


MESHES_PAGE = """
for (const [file, place, normal, uv] of MESHES) {
  const geometry = new THREE.BufferGeometry();
  for (const [name, values, size] of [['position', place, 3], ['normal', normal, 3], ['uv', uv, 2]])
    geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, size));
  const map = new THREE.TextureLoader(manager).load(file);
  map.wrapS = map.wrapT = THREE.RepeatWrapping;
  scene.add(new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({map, shininess: 0})));
}
for (const place of LIGHTS) {
  const lamp = new THREE.PointLight(0xffffff, 3, 0, 0);
  lamp.position.set(...place);
  scene.add(lamp);
}
scene.add(new THREE.AmbientLight(0xffffff, 0.3));
"""


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def matrix_of(step):
    number = {axis: float(step.get(axis, 0)) for axis in "xyz"}
    x, y, z = number["x"], number["y"], number["z"]
    if step.tag == "translate":
        return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]
    if step.tag == "scale":
        return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]
    length = math.sqrt(x * x + y * y + z * z)
    x, y, z, t = x / length, y / length, z / length, math.radians(float(step.get("angle")))
    c, s = math.cos(t), math.sin(t)
    d = 1 - c
    return [[c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0],
            [y * x * d + z * s, c + y * y * d, y * z * d - x * s, 0],
            [z * x * d - y * s, z * y * d + x * s, c + z * z * d, 0], [0, 0, 0, 1]]


def models_of(group, matrix):
    """(words of the shape, matrix, texture) of a course document of still models."""
    transform = group.find("transform")
    for step in transform if transform is not None else ():
        matrix = multiply(matrix, matrix_of(step))
    for model in group.iterfind("models/model"):
        words = re.sub(r"\.3d$", "", model.get("file")).split("_")
        if words[0] == "bezier":
            words = ["patch", "teapot.patch", *words[1:]]
        yield words, matrix, model.find("texture").get("file")
    for child in group.iterfind("group"):
        yield from models_of(child, matrix)


def triangles_of(farol, words, folder):
    """Corners (place, uv, normal) of what the generator makes, three a triangle."""
    out = folder / "part.obj"
    subprocess.run([str(farol), "generate", *words, str(out)], check=True, capture_output=True)
    kinds = {"v": [], "vt": [], "vn": []}
    for line in out.read_text().splitlines():
        kind, *values = line.split()
        if kind in kinds:
            kinds[kind].append([float(value) for value in values])
        elif kind == "f":
            for corner in values:
                v, vt, vn = (int(index) - 1 for index in corner.split("/"))
                yield kinds["v"][v], kinds["vt"][vt], kinds["vn"][vn]


def course(folder, farol, document):
    """A course document of still, textured models under point lights, from its folder."""
    root = ElementTree.parse(document).getroot()
    camera = root.find("camera")
    at = lambda name: tuple(float(camera.find(name).get(axis)) for axis in "xyz")  # noqa: E731
    projection = camera.find("projection")
    subject = Subject("course-4-6", "course scene 4_6", at("position"), at("lookAt"),
                      float(projection.get("fov")), float(projection.get("near")))
    subject.document, subject.mesh = document, folder / "course.obj"
    unit = [[float(i == j) for j in range(4)] for i in range(4)]
    obj, mtl, meshes, corner = ["mtllib course.mtl"], [], [], 1
    for number, (words, matrix, texture) in enumerate(models_of(root.find("group"), unit)):
        shutil.copy(document.parent / texture, folder / texture)
        mtl.append(f"newmtl m{number}\nKd 1 1 1\nmap_Kd {texture}")
        obj.append(f"usemtl m{number}")
        mesh = [texture, [], [], []]
        for place, uv, normal in triangles_of(farol, words, folder):
            world = [sum(matrix[i][j] * (*place, 1)[j] for j in range(4)) for i in range(3)]
            # Scales are the same along all axes here: normals turn as places do.
            turned = [sum(matrix[i][j] * normal[j] for j in range(3)) for i in range(3)]
            length = math.sqrt(sum(n * n for n in turned)) or 1.0
            turned = [n / length for n in turned]
            mesh[1] += world
            mesh[2] += turned
            mesh[3] += uv
            obj += [f"v {world[0]:.6f} {world[1]:.6f} {world[2]:.6f}", f"vt {uv[0]:.6f} {uv[1]:.6f}",
                    f"vn {turned[0]:.5f} {turned[1]:.5f} {turned[2]:.5f}"]
        for first in range(corner, corner + len(mesh[1]) // 3, 3):
            obj.append("f " + " ".join(f"{i}/{i}/{i}" for i in range(first, first + 3)))
        corner += len(mesh[1]) // 3
        meshes.append(mesh)
    subject.mesh.write_text("\n".join(obj) + "\n")
    (folder / "course.mtl").write_text("\n".join(mtl) + "\n")
    lights = [[float(light.get(f"pos{axis}")) for axis in "xyz"] for light in root.find("lights")]
    subject.page = (MESHES_PAGE.replace("MESHES", json.dumps(meshes))
                    .replace("LIGHTS", json.dumps(lights)))
    return subject
