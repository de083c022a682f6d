# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The page of the architecture draws the folders that exist, and the files that it names exist."""

import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
PAGE = SOURCE / "doc/explanation/architecture.md"


def drawn_folders(page):
    """Folders of the drawing, in its order, with the indentation as the depth."""
    (drawing,) = re.findall(r"^```\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    folders, path = [], []
    for line in drawing.splitlines():
        indent, name = re.match(r"( *)(\w[\w-]*)/ +\S", line).groups()
        path[len(indent) // 2 :] = [name]
        folders.append("/".join(path))
    return folders


def has_files(folder):
    """What was left by Python or is hidden does not count."""
    return any(
        path.is_file() and not any(part.startswith((".", "__")) for part in path.relative_to(SOURCE).parts)
        for path in folder.rglob("*")
    )


def folders_of_the_project():
    """All folders beside those that builds make; of a corpus, the folder itself."""
    found = []
    for folder, names, _ in os.walk(SOURCE):
        relative = pathlib.Path(folder).relative_to(SOURCE)
        built = () if relative.parts else ("demo-output", "dist")
        names[:] = [name for name in names if not name.startswith((".", "__", "build")) and name not in built]
        if relative.name in ("corpus", "figures"):
            names.clear()
        if relative.parts and has_files(pathlib.Path(folder)):
            found.append(relative.as_posix())
    return found


class ArchitecturePageTest(unittest.TestCase):
    def setUp(self):
        self.page = PAGE.read_text(encoding="utf-8")

    def test_the_drawing_shows_all_folders_and_no_others(self):
        drawn = drawn_folders(self.page)
        self.assertEqual(len(drawn), len(set(drawn)))
        self.assertEqual(sorted(drawn), sorted(folders_of_the_project()))

    def test_the_files_that_the_page_names_exist(self):
        names = re.findall(r"`((?:apps|bench|cmake|doc|fuzz|include|scripts|shell|src|test)/[\w./-]*)`", self.page)
        self.assertGreater(len(names), 10)
        for name in names:
            self.assertTrue((SOURCE / name).exists(), name)

    def test_folders_are_drawn_in_the_order_of_the_layers(self):
        """What stands lower in the drawing may include what stands above it, which the check of layers enforces."""
        layers = (SOURCE / "test/CheckLayers.cmake").read_text(encoding="utf-8")
        drawn = drawn_folders(self.page)
        for table, parent in (("library", "src/"), ("program", "")):
            (names, *_) = re.findall(rf"^set\({table}([^)]*)\)", layers, re.MULTILINE)
            folders = [parent + name for name in names.split()]
            self.assertGreater(len(folders), 5)
            self.assertEqual([name for name in drawn if name in folders], folders)


if __name__ == "__main__":
    unittest.main()
