# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The pages of doc/reference are those that the program's own tables make."""

import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from program import PROGRAM, ProgramTestCase, needs_tiff

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
SCHEMA = json.loads((SOURCE / "doc/report.schema.json").read_text(encoding="utf-8"))


class ReferenceTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.run_program("generate", ".")
        self.catalog = json.loads((self.folder / "catalog.json").read_text())

    # A program without libtiff lists fewer formats.
    @needs_tiff
    def test_pages_are_up_to_date(self):
        command = [sys.executable, "-B", str(SOURCE / "doc/make_reference.py"), PROGRAM, "--check"]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_each_option_of_a_command_is_one_row(self):
        for command in self.catalog["commands"]:
            names = [option["usage"].split()[0] for option in command["options"]]
            self.assertEqual(len(names), len(set(names)), command["name"])
            self.assertTrue(all(option["description"] for option in command["options"]), command["name"])

    def test_the_schema_describes_all_warnings(self):
        described = SCHEMA["properties"]["warnings"]["items"]["properties"]["code"]["oneOf"]
        self.assertEqual({row["const"] for row in described}, set(self.catalog["warnings"]))

    def test_views_show_values_that_the_schema_describes(self):
        """A place or condition whose path no report has would stay empty, and nobody would miss it."""
        keys = set(find_keys(SCHEMA))
        page = (SOURCE / "apps/job/reports/page/report.html").read_text(encoding="utf-8")
        texts = [page, *(row["name"] + row["value"] + f"[{row['condition']}?]" for row in self.catalog["views"])]
        texts += ["{%s}" % row["list"][1:].replace("/", ".") for row in self.catalog["views"] if row["list"]]
        shown = 0
        for text in texts:
            for place, condition in re.findall(r"\{([^{}]+)\}|\[([^?:{}<\[\]]+)[?:]", text):
                words = [] if place.startswith("part ") else place.split()[-1 if " " not in place else 1 :]
                paths = words + [re.split("[=>*]", word)[0] for word in re.split("[|&!]", condition)]
                for key in ".".join(paths).split("."):
                    if re.search("[a-z]", key) and key != "unit":
                        shown += 1
                        self.assertIn(key, keys, f"{key!r} in {text!r}")
        self.assertGreater(shown, 200)


def find_keys(schema):
    """Names of members at any depth."""
    if isinstance(schema, dict):
        yield from schema.get("properties", {})
        for value in schema.values():
            yield from find_keys(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from find_keys(value)


if __name__ == "__main__":
    unittest.main()
