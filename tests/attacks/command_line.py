"""Files of strangers given to the command line."""
import pathlib
import subprocess
import tempfile

from common import BOX, ROOT, attack, check


def run(binary, *arguments, seconds=60):
    return subprocess.run([binary, *map(str, arguments)], capture_output=True, timeout=seconds)


@attack
def class_with_empty_files(binary):
    """One empty file of each kind is one row of the report each."""
    with tempfile.TemporaryDirectory() as place:
        hand_ins, report = pathlib.Path(place) / "hand-ins", pathlib.Path(place) / "report"
        (hand_ins / "good").mkdir(parents=True)
        (hand_ins / "good" / "scene.xml").write_text(BOX.format(2))
        for ending in ("xml", "zip", "tar", "png", "3d", "rar", "7z"):
            (hand_ins / f"empty-{ending}").mkdir()
            (hand_ins / f"empty-{ending}" / f"work.{ending}").write_bytes(b"")
        (hand_ins / "nothing").mkdir()
        reference = pathlib.Path(place) / "reference.xml"
        reference.write_text(BOX.format(2))
        for attempt in (1, 2):
            done = run(binary, "grade", "--reference", reference, hand_ins, "-o", report)
            check(done.returncode in (0, 1), f"run {attempt} ended with {done.returncode}: {done.stderr[-300:]}")
            table = next(report.glob("*.csv")).read_text()
            rows = [name for name in ("good", "empty-xml", "empty-zip", "empty-tar", "empty-png", "nothing")
                    if name in table]
            check(len(rows) == 6, f"rows in the report: {rows}")
        return f"{len(table.splitlines()) - 1} rows, twice"


@attack
def one_render_has_no_leftovers(binary):
    """A refused file leaves no output and no temporary file."""
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        for name, content in [("palette.tga", bytes([0, 1, 1, 0, 0, 1, 0, 24, 0, 0, 0, 0, 64, 0, 64, 0, 8, 0]) + b"\xff" * 9),
                              ("palette.bmp", b"BM" + (b"\xff" * 52)), ("cut.gif", b"GIF89a\1\0\1\0\xf7\0\0")]:
            (folder / name).write_bytes(content)
            done = run(binary, "compare", folder / name, ROOT / "docs/images/solar-system.png")
            check(done.returncode in (0, 1), f"{name} ended with {done.returncode}: {done.stderr[-200:]}")
            scene = folder / "scene.xml"
            scene.write_text(f'<world><group><models><model file="box_1_1.3d"><texture file="{name}"/></model>'
                             "</models></group></world>")
            done = run(binary, "render", scene, "-o", folder / "out.png")
            check(done.returncode in (0, 1), f"{name} as a texture ended with {done.returncode}")
            (folder / "out.png").unlink(missing_ok=True)
        left = sorted(path.name for path in folder.iterdir())
        check(left == ["cut.gif", "palette.bmp", "palette.tga", "scene.xml"], f"left behind: {left}")
        return "3 files, compared and as textures"
