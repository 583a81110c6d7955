#!/usr/bin/env python3
"""Lines that the unit tests run, by floor: tests/coverage.py BUILD [FLOOR...]

Reads what a build with --coverage left (gcov's JSON), prints a row a floor, and writes the lines that no test ran
to BUILD/uncovered/FLOOR.txt. scripts/test coverage builds, runs and calls it.
"""
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FLOORS = ["core", "image", "scene", "generator", "render", "interchange", "grade", "worker", "server"]


def read_counts(build, floors):
    """{file: {line: runs}} of the sources below the root: also of those that no test links (.gcno alone)."""
    counts = {}
    # Lines of headers are counted where the tests compile them, too.
    data = sorted(str(path) for floor in [*floors, "tests"] for path in (build / floor).rglob("*.gcno"))
    for start in range(0, len(data), 50):
        command = ["gcov", "--json-format", "--stdout", *data[start : start + 50]]
        output = subprocess.run(command, cwd=build, check=True, capture_output=True, text=True).stdout
        for report in filter(None, output.splitlines()):
            for file in json.loads(report)["files"]:
                path = pathlib.Path(build, file["file"]).resolve()
                if not path.is_relative_to(ROOT):
                    continue
                lines = counts.setdefault(str(path.relative_to(ROOT)), {})
                for line in file["lines"]:
                    number = line["line_number"]
                    lines[number] = lines.get(number, 0) + line["count"]
    return counts


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    floors = sys.argv[2:] or FLOORS
    counts = read_counts(build, floors)
    out = build / "uncovered"
    out.mkdir(exist_ok=True)
    print(f"{'floor':10} {'lines':>7} {'run':>7} {'share':>7}")
    for floor in floors:
        missed, total = [], 0
        for name in sorted(name for name in counts if name.startswith(floor + "/")):
            source = (ROOT / name).read_text(encoding="utf-8").splitlines()
            total += len(counts[name])
            missed += [
                f"{name}:{number}: {source[number - 1].strip()}"
                for number, runs in sorted(counts[name].items())
                if runs == 0
            ]
        (out / f"{floor}.txt").write_text("".join(line + "\n" for line in missed), encoding="utf-8")
        if total:
            print(f"{floor:10} {total:7} {total - len(missed):7} {100 * (1 - len(missed) / total):6.1f} %")
    print(f"lines that no test ran: {out.relative_to(ROOT)}/FLOOR.txt")


main()
