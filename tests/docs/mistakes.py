#!/usr/bin/env python3
"""Compares docs/reference/student-mistakes.md with the output of `farol validate`, or writes it anew.

    FAROL=build/test/farol tests/docs/mistakes.py [--write]

Each mistake replaces lines of one scene; the page shows the replaced lines and the findings of the program."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "reference" / "student-mistakes.md"
FAROL = os.environ.get("FAROL", "build/test/farol")

SCENE = """<world>
  <window width="300" height="200"/>
  <camera>
    <position x="3" y="2" z="5"/>
    <lookAt x="0" y="1" z="0"/>
    <up x="0" y="1" z="0"/>
    <projection fov="60" near="1" far="1000"/>
  </camera>
  <lights>
    <light type="point" posX="0" posY="10" posZ="4"/>
  </lights>
  <group>
    <transform>
      <translate x="0" y="1" z="0"/>
      <rotate angle="45" x="0" y="1" z="0"/>
    </transform>
    <models>
      <model file="sphere_1_16_16.3d">
        <texture file="letter.png"/>
        <color>
          <diffuse R="200" G="200" B="0"/>
          <ambient R="0" G="0" B="0"/>
        </color>
      </model>
    </models>
  </group>
</world>
"""

MODEL = '<model file="sphere_1_16_16.3d">'

# Title of the table: (mistake, first line, count of lines that are replaced, new lines).
TABLES = {
    "XML": [
        ("`<group>` is not closed", 26, 1, ""),
        ("`<translate>` is not closed", 14, 1, '<translate x="0" y="1" z="0">'),
        ("`<lookAt>` is not closed", 5, 1, '<lookAt x="0" y="1" z="0">'),
        ("elements are closed in the wrong order", 16, 2, "<models>\n</transform>"),
        ("the closing tag has another case", 25, 1, "</Models>"),
        ("a quote is missing", 14, 1, '<translate x="0 y="1" z="0"/>'),
        ('the ">" of a tag is missing', 6, 1, '<up x="0" y="1" z="0" /'),
        ("a comment is not closed", 3, 0, "<!-- the camera"),
        ('"&" in a text', 2, 0, "<title>A & B</title>"),
        ("a comment of another language", 3, 0, "// the camera"),
        ("a value is written as text", 22, 1, "<shininess>50</shininess>"),
    ],
    "Names": [
        ("the name of an element is misspelt", 14, 1, '<tranlate x="0" y="1" z="0"/>'),
        ("the name of an attribute is misspelt", 15, 1, '<rotate angel="45" x="0" y="1" z="0"/>'),
        ("an element is in the wrong parent", 17, 1, '<models>\n<translate x="1" y="0" z="0"/>'),
        ("a camera's element is in the lights", 10, 0, '<position x="1" y="1" z="1"/>'),
        ("a model is outside of any group", 3, 1, '<camera>\n<model file="box_1_1.3d"/>'),
        ("a second camera", 9, 0, '<camera><position x="9" y="9" z="9"/><lookAt x="0" y="0" z="0"/></camera>'),
        ("a second `<transform>`", 17, 0, '<transform><scale x="2" y="2" z="2"/></transform>'),
        ("a second `<translate>`", 15, 0, '<translate x="1" y="0" z="0"/>'),
        ("a word of another language", 18, 1, '<model file="sphere_1_16_16.3d" transparency="0.5">'),
        ("an option as an element", 9, 0, "<shadows/>"),
        ("a lamp that casts", 10, 1, '<light type="point" posX="0" posY="10" posZ="4" castShadows="true"/>'),
        ("a model without a file", 18, 1, '<model name="sphere_1_16_16.3d">'),
    ],
    "Numbers": [
        ("a decimal comma", 4, 1, '<position x="3" y="2,5" z="5"/>'),
        ("points for thousands, and a decimal comma", 4, 1, '<position x="3" y="2" z="1.000,5"/>'),
        ("a unit", 7, 1, '<projection fov="60deg" near="1" far="1000"/>'),
        ("radians", 15, 1, '<rotate angle="1.57" x="0" y="1" z="0"/>'),
        ("an empty value", 4, 1, '<position x="3" y="" z="5"/>'),
        ("a field of view out of range", 7, 1, '<projection fov="200" near="1" far="1000"/>'),
        ("near is 0", 7, 1, '<projection fov="60" near="0" far="1000"/>'),
        ("near and far are exchanged", 7, 1, '<projection fov="60" near="1000" far="1"/>'),
        ("a rotation without an angle", 15, 1, '<rotate x="0" y="1" z="0"/>'),
        ("a rotation about no axis", 15, 1, '<rotate angle="45" x="0" y="0" z="0"/>'),
        ("a curve of three points", 14, 1,
         '<translate time="10"><point x="0" y="0" z="0"/><point x="1" y="0" z="0"/><point x="1" y="1" z="0"/></translate>'),
    ],
    "Colours and textures": [
        ("colours of 0 to 1", 21, 1, '<diffuse R="0.8" G="0.8" B="0"/>'),
        ("a colour over 255", 21, 1, '<diffuse R="300" G="200" B="0"/>'),
        ("colours on `<color>`", 20, 4, '<color R="255" G="200" B="0"/>'),
        ("a colour on `<model>`, without #", 18, 1, '<model file="sphere_1_16_16.3d" color="ff8800">'),
        ("a diffuse colour on `<model>`, without #", 18, 1, '<model file="sphere_1_16_16.3d" diffuse="ff8800">'),
        ("a diffuse colour on `<color>`", 20, 4, '<color diffuse="#ff8800"/>'),
        ("a colour as the value of `<diffuse>`", 21, 1, '<diffuse value="#ff8800"/>'),
        ("a colour name that does not exist", 18, 1, '<model file="sphere_1_16_16.3d" color="bleu">'),
        ("a background of 0 to 1", 3, 0, '<background color="0.5 0.5 1"/>'),
        ("the file of a texture as text", 19, 1, "<texture>letter.png</texture>"),
        ("a skybox that is not a cross of 4 x 3 squares", 3, 0, '<skybox texture="letter.png"/>'),
    ],
    "Files": [
        ("the name of a texture is misspelt", 19, 1, '<texture file="leter.png"/>'),
        ("a texture is missing, and the document has another error", 5, 15,
         '<lookAt x="0" y="abc" z="0"/>\n</camera>\n<group>\n<models>\n' + MODEL + '\n<texture file="wood.png"/>'),
        ("the name of a shape is misspelt", 18, 1, '<model file="shpere_1_16_16.3d">'),
        ("a shape with a decimal comma", 18, 1, '<model file="sphere_0,5_16_16.3d">'),
        ("a shape with an argument out of range", 18, 1, '<model file="sphere_1_2_16.3d">'),
        ("a shape without sizes", 18, 1, '<model file="sphere.3d">'),
        ("a backslash and another case", 19, 1, '<texture file="textures\\Letter.PNG"/>'),
    ],
    "Lights": [
        ("the type of a light is misspelt", 10, 1, '<light type="pointlight" posX="0" posY="10" posZ="4"/>'),
        ("a directional light without a direction", 10, 1, '<light type="directional"/>'),
        ("a spot light without a direction", 10, 1, '<light type="spot" posX="0" posY="10" posZ="0" cutoff="45"/>'),
        ("a spot light without a cutoff", 10, 1,
         '<light type="spot" posX="0" posY="10" posZ="0" dirX="0" dirY="-1" dirZ="0"/>'),
        ("a cutoff out of range", 10, 1,
         '<light type="spot" posX="0" posY="10" posZ="0" dirX="0" dirY="-1" dirZ="0" cutoff="270"/>'),
        ("the sun shines from below", 10, 1, '<light type="directional" dirX="0" dirY="-1" dirZ="0"/>'),
        ("a light in a group without models", 12, 0, '<group><light type="point" posX="0" posY="3" posZ="0"/></group>'),
    ],
    "Images that show nothing": [
        ("no model", 17, 9, ""),
        ("the models are behind the camera", 5, 1, '<lookAt x="6" y="3" z="10"/>'),
        ("the models are beside the view", 5, 1, '<lookAt x="9" y="2" z="5"/>'),
        ("the camera looks along its up vector", 4, 3,
         '<position x="0" y="5" z="0"/>\n<lookAt x="0" y="1" z="0"/>\n<up x="0" y="1" z="0"/>'),
        ("eye and target are the same point", 4, 1, '<position x="0" y="1" z="0"/>'),
        ("the camera is inside a model", 4, 1, '<position x="0" y="1" z="0.2"/>'),
        ("the models are nearer than near", 7, 1, '<projection fov="60" near="50" far="1000"/>'),
        ("the models are beyond far", 7, 1, '<projection fov="60" near="1" far="2"/>'),
        ("the models are far too small", 18, 1, '<model file="sphere_0.001_16_16.3d">'),
        ("a factor of 0", 15, 1, '<scale x="0" y="0" z="0"/>'),
        ("no light reaches the models", 10, 1,
         '<light type="spot" posX="0" posY="10" posZ="0" dirX="0" dirY="1" dirZ="0" cutoff="30"/>'),
        ("a black material", 19, 5, '<color><diffuse R="0" G="0" B="0"/><ambient R="0" G="0" B="0"/></color>'),
        ("the only light is inside the model", 10, 1, '<light type="point" posX="0" posY="1" posZ="0"/>'),
        ("a plane seen from below", 4, 15,
         '<position x="0" y="-3" z="2"/>\n<lookAt x="0" y="1" z="0"/>\n</camera>\n<group>\n<models>\n<model command="plane 4">'),
    ],
}

HEAD = """# Mistakes of students

This page answers: which message does a mistake in a scene get?

The messages are those of `farol validate scene.xml`, in the order of the document: line, column, severity, message and
code. [errors.md](../../api/errors.md) explains each code. A warning does not stop the render.

Each mistake replaces one line or a few of this scene, which has no mistake:

```xml
{scene}```
"""


def scene_with(first, count, text):
    """The scene with `count` lines from line `first` on (from 1) replaced."""
    lines = SCENE.split("\n")
    lines[first - 1:first - 1 + count] = text.split("\n") if text else []
    return "\n".join(lines)


def findings(document):
    """The errors and warnings of `farol validate`, without the name of the file."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.xml").write_text(document)
        shutil.copy(ROOT / "docs" / "examples" / "letter.png", folder)
        run = subprocess.run([pathlib.Path(FAROL).absolute(), "validate", "scene.xml"], cwd=folder, check=False,
                             capture_output=True, text=True, timeout=60)
    lines = (run.stdout + run.stderr).splitlines()
    return [line.removeprefix("scene.xml:") for line in lines if ": error: " in line or ": warning: " in line]


def code(text):
    return "`" + text.replace("|", "\\|").replace("`", "'") + "`"


def page():
    out = HEAD.format(scene=SCENE)
    for title, mistakes in TABLES.items():
        out += f"\n## {title}\n\n| mistake | written | message |\n| --- | --- | --- |\n"
        for mistake, first, count, text in mistakes:
            written = " ".join(code(line) for line in text.split("\n")) if text else "(left out)"
            messages = " ".join(code(line) for line in findings(scene_with(first, count, text))) or "(none)"
            out += f"| {mistake} | {written} | {messages} |\n"
    return out


if __name__ == "__main__":
    if findings(SCENE):
        sys.exit(f"the scene has findings: {findings(SCENE)}")
    current = page()
    if "(none)" in current:
        sys.exit("a mistake without a message: " + next(line for line in current.split("\n") if "(none)" in line))
    if "--write" in sys.argv:
        PAGE.write_text(current)
    elif PAGE.read_text() != current:
        before, after = PAGE.read_text().split("\n"), current.split("\n")
        print("\n".join(line for line in after if line not in before))
        sys.exit(f"{PAGE.relative_to(ROOT)} is not current: run tests/docs/mistakes.py --write")
