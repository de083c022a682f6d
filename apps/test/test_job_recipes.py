# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The recipes of doc/how-to/jobs.md for GNU parallel and Snakemake, word by word."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

import volumes
from jobs import JobTestCase
from program import PROGRAM
from test_identity import rough_shell

PAGE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "doc/how-to/jobs.md"


def recipe(title, language):
    """The first block of code of that language behind a title."""
    return re.search(rf"^### {title}\n.*?^```{language}\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)[1]


class JobRecipesTest(JobTestCase):
    def setUp(self):
        super().setUp()
        part = rough_shell((30, 30, 70))
        part.voxels = [100 * value for value in part.voxels]
        volumes.write_meta(self.target / "part.mha", part)
        self.in_target("extract", "part.mha", "../expected.mha", "--lower", 72)

    def run_in_target(self, *command):
        path = os.pathsep.join([str(pathlib.Path(PROGRAM).parent), os.environ["PATH"]])
        environment = {**os.environ, "PATH": path, "HOME": str(self.folder)}
        result = subprocess.run(
            command, env=environment, capture_output=True, text=True, check=False, cwd=self.target
        )
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertEqual((self.target / "medial.mha").read_bytes(), (self.folder / "expected.mha").read_bytes())
        return result

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed: Debian package parallel")
    def test_gnu_parallel(self):
        out = self.run_in_target("sh", "-e", "-c", recipe("GNU parallel", "sh")).stdout
        self.assertEqual(len(re.findall(r"^clusters done     1$", out, re.MULTILINE)), 64)

    @unittest.skipUnless(shutil.which("snakemake"), "Snakemake is not installed: Debian package snakemake")
    def test_snakemake(self):
        (self.target / "Snakefile").write_text(recipe("Snakemake", "python"))
        command = re.search(r"`(snakemake [^`]*)`", PAGE.read_text())[1]
        out = self.run_in_target(*command.split()).stdout
        self.assertEqual(len(re.findall(r"^clusters done     8$", out, re.MULTILINE)), 8)


if __name__ == "__main__":
    unittest.main()
