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
        code = "".join(path.read_text(encoding="utf-8") for path in (SOURCE / "apps/job/reports").glob("*Warnings.cxx"))
        codes = set(re.findall(r'\{ "([a-z]+(?:_[a-z]+)+)",\s+(?:Check|\[\])', code))
        for path in (SOURCE / "apps/job/formats").rglob("*.cxx"):
            text = path.read_text(encoding="utf-8")
            codes |= set(re.findall(r'warnings\.push_back\(\s*\{ "([a-z]+(?:_[a-z]+)+)"', text))
            codes |= {"unknown_spacing"} if "WarnOfUnknownSpacing(" in text else set()
        schema = json.loads((SOURCE / "doc/report.schema.json").read_text(encoding="utf-8"))
        described = schema["properties"]["warnings"]["items"]["properties"]["code"]["oneOf"]
        self.assertEqual({row["const"] for row in described}, codes)


if __name__ == "__main__":
    unittest.main()
