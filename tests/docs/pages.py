#!/usr/bin/env python3
"""Runs the commands of the documents as they stand, in order, and compares the images they make.

  pages.py [--update] [PAGE...]    default: every page; --update writes the images that differ

A block of shell commands (```sh) runs in a fresh folder with copies of scenes/ and api/ and links to the
rest of the project. One shell runs all blocks of a page. An HTML comment on the line before a block says
more:

  <!-- not run: REASON -->   it is counted only; REASON is one of REASONS
  <!-- file: NAME -->        the block, of any language, becomes that file
  <!-- output -->            its lines are among those that the block before printed

A comment at a command's end says what is expected of it: "# exit code 1", "# status 422" (of curl). All
other commands must succeed, and curl must get a status below 400. "farol serve" runs in the background
until the page ends or the next one starts; 127.0.0.1:8080 becomes a free port. The program is $FAROL,
else build/test/farol or build/release/farol.
"""
import argparse
import json
import os
import pathlib
import re
import shlex
import shutil
import socket
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Why a block is not run.
REASONS = {
    "root": "installs packages or needs the rights of root",
    "network": "fetches something from the internet",
    "container": "needs Docker, Podman or a cluster",
    "build": "compiles or measures the project itself",
}

PRELUDE = r"""
set -uo pipefail
service=
stop_service() {
    [ -z "$service" ] || { kill "$service" 2>/dev/null; wait "$service" 2>/dev/null; service=; }
}
farol() {
    local url=http://127.0.0.1:$DOCS_PORT tries
    case " $* " in
        *" --help "* | *" -h "*) command farol "$@" && return ;;
        " serve "*) ;;
        " health "*http*) command farol "$@"; return ;;
        " health "*) command farol "$@" "$url"; return ;;
        *) command farol "$@"; return ;;
    esac
    stop_service
    command farol "$@" --port "$DOCS_PORT" >>"$DOCS_OUT/service.log" 2>&1 &
    service=$!
    for tries in $(seq 1200); do
        command farol health "$url" >/dev/null 2>&1 && return 0
        kill -0 "$service" 2>/dev/null || break
        sleep 0.1
    done
    tail -n 5 "$DOCS_OUT/service.log" >&2
    return 1
}
curl() {
    local status code=0 log="$DOCS_OUT/curl.$BASHPID"
    case " $* " in *" -w "*) command curl "$@"; return ;; esac
    command curl "$@" --show-error --max-time 120 -w '%{stderr}\nstatus %{http_code}\n' 2>"$log" || code=$?
    cat "$log" >&2
    status=$(sed -n 's/^status //p' "$log" | tail -n 1)
    if [ -n "${DOCS_STATUS:-}" ]; then [ "$status" = "$DOCS_STATUS" ]; return; fi
    [ "$code" -ne 0 ] || [ "$status" -lt 400 ] || code=22
    return "$code"
}
expect() { # LINE WANTED ACTUAL
    [ "$3" -eq "$2" ] && return
    echo "$1 $3" >"$DOCS_OUT/failed"
    exit 1
}
trap stop_service EXIT
"""


class Block:
    """A fenced block: its language, its text, the number of its first line, and its markers."""

    def __init__(self, language, line, markers):
        self.language, self.line, self.markers, self.lines = language, line, markers, []

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"

    @property
    def reason(self):
        return self.markers.get("not run")

    def commands(self):
        """(number of the first line, text) of each command; comments and empty lines are none."""
        pending, first, here = "", 0, None
        for number, line in enumerate(self.lines, self.line):
            if not pending:
                if not line.strip() or line.lstrip().startswith("#"):
                    continue
                first = number
            pending += line + "\n"
            if here:
                if line.strip() != here:
                    continue
                here = None
            else:
                started = re.search(r"<<-?\s*'?(\w+)'?", line)
                if started:
                    here = started[1]
                    continue
                if re.search(r"(\\|\||&&)$", line) or not balanced(pending):
                    continue
            yield first, pending
            pending = ""
        if pending:
            raise ValueError(f"line {first}: the command has no end")


def balanced(text):
    try:
        shlex.split(text, comments=True)
    except ValueError:
        return False
    return True


def pages():
    """All documents, by their path from the root. Records of decisions are no instructions."""
    found = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md", "scenes/README.md")]
    found += sorted((ROOT / "docs").rglob("*.md"))
    return [path.relative_to(ROOT) for path in found if "decisions" not in path.parts]


def blocks(page):
    """The fenced blocks of a page, with the markers of the line before."""
    found, block, markers = [], None, {}
    for number, line in enumerate((ROOT / page).read_text().split("\n"), 1):
        if block is None and line.startswith("```"):
            block = Block(line[3:].strip(), number + 1, markers)
        elif block is not None and line == "```":
            found.append(block)
            block = None
        elif block is not None:
            block.lines.append(line)
        marker = re.fullmatch(r"<!-- (not run|file|output)(?:: (.*))? -->", line)
        markers = {marker[1]: marker[2] or ""} if marker and block is None else {}
    return found


def program():
    named = os.environ.get("FAROL")
    for path in [named] if named else [ROOT / "build" / preset / "farol" for preset in ("test", "release")]:
        if os.access(path, os.X_OK):
            return pathlib.Path(path).resolve()
    sys.exit("there is no program: build it, or name one by FAROL=...")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


LEFT_OUT, COPIED = (".git", "build", "shared"), ("scenes", "api")


def prepare(folder):
    """The project as a reader has it: what commands may change is a copy."""
    for entry in ROOT.iterdir():
        if entry.name in LEFT_OUT:
            continue
        if entry.name in COPIED:
            shutil.copytree(entry, folder / entry.name, ignore=shutil.ignore_patterns("node_modules"))
        else:
            (folder / entry.name).symlink_to(entry)


def linked_files():
    """The files of the folders that prepare() links: a command that writes there writes into the project."""
    return {path for entry in ROOT.iterdir() if entry.is_dir() and entry.name not in LEFT_OUT + COPIED
            for path in entry.rglob("*") if path.is_file() and "__pycache__" not in path.parts}


def script_of(page, folder, out):
    """The shell script of a page; writes nothing where no block is run."""
    lines, port = [PRELUDE], free_port()
    run = [block for block in blocks(page) if block.reason is None]
    if not any(block.language == "sh" for block in run):
        return None, port
    for block in run:
        if "file" in block.markers:
            target = folder / block.markers["file"]
            kept = out / f"file-{block.line}"
            kept.write_text(block.text)
            lines.append(f"mkdir -p '{target.parent}' && cp '{kept}' '{target}'")
        elif block.language == "sh":
            lines.append(f"exec >'{out}/{block.line}.log' 2>&1 </dev/null")
            for number, command in block.commands():
                wanted = re.search(r"# exit code (\d+)\s*$", command)
                status = re.search(r"# status (\d+)\s*$", command)
                lines.append(f"DOCS_STATUS={status[1] if status else ''}")
                lines.append(re.sub(r"(127\.0\.0\.1|localhost):8080", rf"\1:{port}", command).rstrip("\n"))
                lines.append(f"expect {number} {wanted[1] if wanted else 0} $?")
    return "\n".join(lines) + "\n", port


def run(page, folder, out):
    """Runs a page in the folder. Returns a list of what went wrong."""
    script, port = script_of(page, folder, out)
    if script is None:
        return []
    (out / "bin").mkdir()
    (out / "bin" / "farol").symlink_to(program())
    environment = dict(os.environ, PATH=f"{out}/bin:{os.environ['PATH']}", DOCS_OUT=str(out),
                       DOCS_PORT=str(port), LC_ALL="C.UTF-8")
    for name in list(environment):
        if name.startswith("FAROL"):
            del environment[name]
    (out / "script").write_text(script)
    done = subprocess.run(["bash", str(out / "script")], cwd=folder, env=environment, timeout=1500,
                          capture_output=True, text=True, stdin=subprocess.DEVNULL)
    if (out / "failed").exists():
        line, code = (out / "failed").read_text().split()
        log = max(out.glob("[0-9]*.log"), key=lambda path: path.stat().st_mtime_ns)
        return [f"{page}:{line}: exit code {code}\n" + log.read_text(errors="replace")[-2000:]]
    if done.returncode != 0:
        return [f"{page}: the shell ended with {done.returncode}\n{done.stderr}"]
    return wrong_outputs(page, out)


def wrong_outputs(page, out):
    wrong, before = [], None
    for block in blocks(page):
        if block.language == "sh" and block.reason is None:
            before = (out / f"{block.line}.log").read_text(errors="replace")
        elif "output" in block.markers:
            printed = {line.strip() for line in (before or "").split("\n")}
            wrong += [f"{page}:{block.line + i}: not printed: {line}\n{before}"
                      for i, line in enumerate(block.lines) if line.strip() not in printed]
    return wrong


def images(page):
    """The images that a page shows: paths from the root."""
    text = (ROOT / page).read_text()
    for target in re.findall(r"!\[[^\]]*\]\(([^)\s]+)\)", text):
        if "://" not in target:
            path = pathlib.Path(os.path.normpath(pathlib.Path(page).parent / target))
            yield path


def frames(path):
    """The number of frames of an animated PNG, 1 of others."""
    data = path.read_bytes()
    at = data.find(b"acTL")
    return struct.unpack(">I", data[at + 4:at + 8])[0] if at >= 0 else 1


def alike(kept, made):
    """Whether two images show the same. Other processors' software GL rounds differently: up to 2 levels
    of 255, and in one pixel of a thousand more."""
    if kept.read_bytes() == made.read_bytes():
        return True
    if frames(kept) != frames(made):
        return False
    done = subprocess.run([program(), "compare", kept, made, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        return False
    within = {row["levels"]: row["share"] for row in json.loads(done.stdout)["within"]}
    return within[2] >= 0.999


def stale_images(page, folder, update):
    """The images of a page that no command of it makes, or that look otherwise than made now."""
    wrong = []
    for path in images(page):
        if path.suffix != ".png" or path.is_relative_to("docs/pictures") or path.is_relative_to("docs/examples"):
            continue  # scripts/docs-pictures has docs/pictures; drawings and screenshots are no renders
        made = folder / path.name
        if not made.exists():
            wrong.append(f"{page}: no command makes {path}")
        elif update:
            if not (ROOT / path).exists() or not alike(ROOT / path, made):
                (ROOT / path).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(made, ROOT / path)
                print(f"{path} is new")
        elif not (ROOT / path).exists() or not alike(ROOT / path, made):
            wrong.append(f"{page}: {path} is not current: run scripts/docs-pictures")
    return wrong


def check(page, update=False):
    """Runs a page. Returns a list of what went wrong."""
    with tempfile.TemporaryDirectory(prefix="farol-docs-") as name:
        folder, out = pathlib.Path(name, "reader"), pathlib.Path(name, "out")
        folder.mkdir()
        out.mkdir()
        prepare(folder)
        before = linked_files()
        wrong = run(page, folder, out)
        written = sorted(linked_files() - before)
        wrong += [f"{page}: a command wrote {path.relative_to(ROOT)} into the project" for path in written]
        return wrong or stale_images(page, folder, update)


def main():
    parser = argparse.ArgumentParser(description="Runs the commands of the documents.")
    parser.add_argument("--update", action="store_true", help="writes the images that differ")
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    words = parser.parse_args()
    wrong = []
    for page in words.pages or pages():
        found = check(page, words.update)
        wrong += found
        print(f"{page}: {'wrong' if found else 'runs'}", file=sys.stderr)
    print("\n".join(wrong), end="\n" if wrong else "")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
