# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Keywords of the functions are the options that the program's own table names for them."""

import inspect
import json
import unittest

import medialvoxel

from support import Folder, run

# What an array has in place of options, and keywords that say whether an output is made.
OF_ARRAYS = {"array", "spacing", "progress", "uncertainty", "importance", "vectors"}
OTHER_NAMES = {"local_thickness_method": "method"}


class KeywordTest(Folder):
    def test_keywords_are_options(self):
        run(["generate", self.folder])
        commands = json.loads((self.folder / "catalog.json").read_text())["commands"]
        for function in (medialvoxel.extract, medialvoxel.mesh, medialvoxel.distance, medialvoxel.local_thickness):
            options = {
                option["usage"].split()[0].removeprefix("--").replace("-", "_")
                for command in commands
                for option in command["options"]
                if function.__name__ in option.get("python", ())
            }
            keywords = {OTHER_NAMES.get(name, name) for name in options}
            self.assertEqual(set(inspect.signature(function).parameters) - OF_ARRAYS, keywords - OF_ARRAYS, function.__name__)


if __name__ == "__main__":
    unittest.main()
