# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Pages of the documents: links and anchors lead somewhere, each page and picture is reached, and all keep their form."""

import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
ROOTS = ("README.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md")
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^)\s]+)\)")
README_LINES = 150


def pages():
    return [SOURCE / name for name in ROOTS] + sorted((SOURCE / "doc").rglob("*.md"))


def without_code(text):
    text = re.sub(r"^( *)```.*?^\1```$", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "`code`", text)


def anchor_of(title):
    """The anchor that GitHub and MyST give a title."""
    title = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title.strip().lower())
    return re.sub(r"[^\w\- ]", "", title).replace(" ", "-")


def anchors_of(path):
    """Anchors of a page; equal titles get a number."""
    text = re.sub(r"^( *)```.*?^\1```$", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    anchors = []
    for title in re.findall(r"^#+ (.*)$", text, re.MULTILINE):
        anchor = anchor_of(title)
        anchors.append(f"{anchor}-{anchors.count(anchor)}" if anchor in anchors else anchor)
    return anchors


def links_of(path):
    """Links of a page that lead into the project, as (target, file, anchor)."""
    for target in LINK.findall(without_code(path.read_text(encoding="utf-8"))):
        if not re.match(r"[a-z]+:", target):
            name, _, anchor = target.partition("#")
            yield target, (path.parent / name).resolve() if name else path, anchor


def find_broken_links(path):
    broken = []
    for target, file, anchor in links_of(path):
        if not file.exists():
            broken.append(f"{path}: {target}: no such file")
        elif SOURCE.resolve() not in file.resolve().parents:
            broken.append(f"{path}: {target}: leads out of the project")
        elif anchor and anchor not in anchors_of(file):
            broken.append(f"{path}: {target}: no such title")
    return broken


def reached_from(path):
    """All files that links lead to, directly or over other pages."""
    found, waiting = set(), [path]
    while waiting:
        page = waiting.pop()
        if page in found:
            continue
        found.add(page)
        if page.suffix == ".md":
            waiting += [file for _, file, _ in links_of(page) if file.exists()]
    return found


class DocumentsTest(unittest.TestCase):
    def test_links_and_anchors_exist(self):
        broken = [line for path in pages() for line in find_broken_links(path)]
        self.assertEqual(broken, [], "\n".join(broken))

    def test_each_page_and_picture_is_reached_from_the_readme(self):
        reached = reached_from((SOURCE / "README.md").resolve())
        wanted = [*pages(), *(SOURCE / "doc/figures").glob("*.png"), *(SOURCE / "doc/figures").glob("*.svg")]
        missing = [str(path.relative_to(SOURCE)) for path in wanted if path.resolve() not in reached]
        self.assertEqual(missing, [])

    def test_each_page_is_in_the_index(self):
        listed = {file for _, file, _ in links_of((SOURCE / "doc/index.md").resolve())}
        missing = [str(path) for path in (SOURCE / "doc").rglob("*/*.md") if path.resolve() not in listed]
        self.assertEqual(missing, [])

    def test_each_page_begins_with_what_its_reader_can_do(self):
        for path in (SOURCE / "doc").rglob("*.md"):
            text = re.sub(r"<!--.*?-->\n", "", path.read_text(encoding="utf-8")).lstrip()
            self.assertRegex(text, r"\A# [^\n]+\n\nAfter this page you ", str(path))

    def test_the_readme_is_read_in_a_minute(self):
        self.assertLessEqual(len((SOURCE / "README.md").read_text(encoding="utf-8").splitlines()), README_LINES)

    def test_anchors_are_those_of_github(self):
        self.assertEqual(anchor_of("5. Windows: exact results from parts"), "5-windows-exact-results-from-parts")
        self.assertEqual(anchor_of("The page: `--html FILE.html`"), "the-page---html-filehtml")


if __name__ == "__main__":
    unittest.main()
