#!/usr/bin/env python3
"""Tests the documents: pages_test.py [commands | text]

commands: each runs as it stands (pages.py). text: links lead somewhere, images have a source, each page
says which question it answers, and words are those of the field."""
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import pages
from pages import ROOT

sys.path.insert(0, str(ROOT))
from bench.plots import draw  # noqa: E402

# Blocks that are not run, by reason. A new one is a decision: change the number with it.
NOT_RUN = {"root": 16, "network": 2, "container": 9, "build": 52}

# Words that have a plainer form, outside quotations and code.
BANNED = [r"tell", r"tells", r"told", r"said", r"says of", r"mend(?:s|ed)?", r"cures?", r"len[dt]s?", r"is taken(?! over)",
          r"cannot be had", r"of its own", r"by hand of", r"aloud", r"the likes", r"so that it", r"hold to"]

# Images that no test compares: drawn by graphviz from floors.dot; taken in a browser by
# tests/web/screenshots.mjs.
UNCOMPARED = {"docs/images/floors.svg"} | {
    f"docs/images/web-{view}{kind}.webp"
    for view in ("gallery", "viewer", "editor", "grade", "share", "time") for kind in ("", "-dark", "-phone")}

# "Picture" is a word for students; elsewhere it is an image, a render or a texture.
FOR_STUDENTS = ("docs/tutorial", "docs/how-to/student")


def documents():
    """All Markdown files of the project."""
    found = [path for path in ROOT.glob("*.md")]
    for folder in ("docs", "scenes", "api", "docker", "packaging"):
        found += (ROOT / folder).rglob("*.md")
    return sorted(path.relative_to(ROOT) for path in found if "node_modules" not in path.parts)


def of_docs():
    """Pages that answer a question of a reader."""
    return [page for page in pages.pages() if page.parts[0] == "docs"]


def prose(text):
    """A document without blocks, generated sections, code, targets of links, comments and quotations."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    text = re.sub(r"<!-- generated: .*?<!-- end -->", "", text, flags=re.S)
    text = re.sub(r"<!-- (\w+):begin -->.*?<!-- \1:end -->", "", text, flags=re.S)  # of scripts/grade-calibration
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"`[^`]*`", "`", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return re.sub(r"\"[^\"\n]*\"|\u201c[^\u201d]*\u201d", '"', text)


def slug(heading):
    """The anchor of a heading, as forges make it."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip())
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def anchors(path):
    text = re.sub(r"^```.*?^```$", "", path.read_text(), flags=re.M | re.S)
    return {slug(heading) for heading in re.findall(r"^#+ (.*)$", text, flags=re.M)}


def skip(reason):
    """As test::skipMissing: a failure under CI=true."""
    if os.environ.get("CI") == "true":
        sys.exit(reason)
    print(f"SKIPPED: {reason}")
    sys.exit(77)


class commands(unittest.TestCase):
    def test_every_command_runs_as_it_stands(self):
        for page in pages.pages():
            with self.subTest(page=str(page)):
                self.assertEqual(pages.check(page), [])

    def test_the_blocks_that_are_not_run_are_counted(self):
        counts, ran = dict.fromkeys(NOT_RUN, 0), 0
        for page in pages.pages():
            for block in pages.blocks(page):
                if block.language in ("bash", "shell", "console") and "file" not in block.markers:
                    self.fail(f"{page}:{block.line}: a block of commands is ```sh")
                if block.language != "sh":
                    continue
                if block.reason is None:
                    ran += 1
                else:
                    self.assertIn(block.reason, pages.REASONS, f"{page}:{block.line}")
                    counts[block.reason] += 1
        print(f"blocks of commands: {ran} run, not run: {counts}")
        self.assertEqual(counts, NOT_RUN)
        self.assertGreater(ran, 40)

    def test_a_command_that_fails_is_found(self):
        page = pathlib.Path("tests/docs/planted.md")
        found = pages.check(page)
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith(f"{page}:10: exit code 1\n"), found[0])

    def test_an_output_that_is_not_printed_and_an_image_that_nothing_makes_are_found(self):
        page = pathlib.Path("tests/docs/planted-output.md")
        self.assertRegex(pages.check(page)[0], rf"^{page}:9: not printed: two\n")
        page = pathlib.Path("tests/docs/planted-image.md")
        self.assertEqual(pages.check(page), [f"{page}: no command makes tests/docs/nothing.png"])


class text(unittest.TestCase):
    def test_links_lead_to_files_and_headings(self):
        links = 0
        for page in documents():
            body = re.sub(r"^```.*?^```$", "", (ROOT / page).read_text(), flags=re.M | re.S)
            for target in re.findall(r"\]\(([^)\s]+)\)", body):
                if "://" in target or target.startswith("mailto:"):
                    continue
                links += 1
                name, _, anchor = target.partition("#")
                path = (ROOT / page).parent / name if name else ROOT / page
                self.assertTrue(path.exists(), f"{page} links to {target}")
                if anchor and path.suffix == ".md":
                    self.assertIn(anchor, anchors(path), f"{page} links to {target}")
        self.assertGreater(links, 150)

    def test_plots_are_those_of_the_results(self):
        kept = ROOT / "docs" / "plots"
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for results in sorted((ROOT / "bench" / "results").glob("*.json")):
                draw(results.stem, json.loads(results.read_text()), folder)
            self.assertEqual({path.name for path in folder.iterdir()}, {path.name for path in kept.iterdir()})
            for path in folder.iterdir():
                self.assertEqual(path.read_bytes(), (kept / path.name).read_bytes(),
                                 f"{path.name} is not current: run scripts/bench --plots")

    def test_each_image_has_a_test_that_compares_it(self):
        shown = {str(image) for page in pages.pages() for image in pages.images(page)}
        for path in sorted((ROOT / "docs").rglob("*")):
            name = str(path.relative_to(ROOT))
            if path.suffix not in (".png", ".svg", ".webp", ".jpg"):
                continue
            if name.startswith(("docs/pictures/", "docs/examples/", "docs/plots/")):
                continue  # tests/golden/docs_test.cpp; the test above
            if name not in UNCOMPARED:
                self.assertIn(name, shown, "no page shows it, so no command makes it")
        linked = {((ROOT / page).parent / target).resolve() for page in documents()
                  for target in re.findall(r"(?:\]\(|src=\")([^)\s\"]+)", (ROOT / page).read_text())}
        for name in UNCOMPARED:
            self.assertTrue((ROOT / name).exists(), name)
            self.assertIn((ROOT / name).resolve(), linked, f"no page shows {name}")

    def test_each_page_says_which_question_it_answers(self):
        for page in of_docs():
            lines = (ROOT / page).read_text().split("\n")
            self.assertRegex(lines[0], "^# ", page)
            first = " ".join(lines[2:4])
            self.assertRegex(first, r"^This page answers: .*\?", page)

    def test_each_page_is_in_the_index(self):
        index = (ROOT / "docs" / "README.md").read_text()
        for page in pages.pages():
            if page.parts[0] == "docs" and page.name != "README.md":
                self.assertIn(f"]({page.relative_to('docs')})", index)

    def test_words_are_those_of_the_field(self):
        pattern = re.compile(r"\b(" + "|".join(BANNED) + r")\b", re.I)
        wrong = []
        decisions = [path.relative_to(ROOT) for path in (ROOT / "docs" / "decisions").glob("*.md")]
        for page in map(pathlib.Path, ("README.md", "CHANGELOG.md", "scenes/README.md", *of_docs(), *decisions)):
            body = prose((ROOT / page).read_text())
            wrong += [f"{page}: {found[0]}" for found in pattern.finditer(body)]
            if not str(page).startswith(FOR_STUDENTS):
                wrong += [f"{page}: {found[0]}" for found in re.finditer(r"\bpictures?\b", body, re.I)]
        self.assertEqual(wrong, [])

    def test_the_interface_has_images_not_pictures(self):
        # But for the names of parameters and members: pictures=2, picture: {...}.
        wrong = [f"{page}: {line.strip()}" for page in ("api/errors.md", "api/openapi.yaml")
                 for line in (ROOT / page).read_text().split("\n")
                 if re.search(r"(?<!name: )\bpictures?\b(?![=:])", line, re.I) and not line.startswith("| ")]
        self.assertEqual(wrong, [])

    def test_cells_of_tables_are_short(self):
        wrong = []
        for page in of_docs():
            for line in prose((ROOT / page).read_text()).split("\n"):
                if line.startswith("|"):
                    wrong += [f"{page}: {cell.strip()}" for cell in line.split("|") if len(cell.strip()) > 120]
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    for needed in ("bash", "curl"):
        if not shutil.which(needed):
            skip(f"no {needed} (package {needed})")
    unittest.main()
