# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The example examples/fem/cantilever.py: CalculiX solves meshes as they should be, and those of voxels."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["MEDIALVOXEL_PROGRAM"]
WRITE_SURFACE = os.environ["MEDIALVOXEL_WRITE_SURFACE"]
EXAMPLE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "examples/fem/cantilever.py"


@unittest.skipUnless(shutil.which("ccx"), "ccx is not installed: Debian package calculix-ccx")
class CantileverTest(unittest.TestCase):
    def run_example(self, *arguments, status=0):
        """Relative error of the deflection of a plate with voxels of 0.5 mm."""
        command = [sys.executable, "-B", EXAMPLE, *map(str, arguments)]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, status, f"{arguments}\n{result.stdout}{result.stderr}")
        return float(re.search(r"([+-][0-9.]+)%", result.stdout).group(1)) / 100

    def bend(self, strip, size, status):
        """The same of a perfect mesh."""
        with tempfile.TemporaryDirectory(prefix="medialvoxel-test-") as folder:
            mesh = pathlib.Path(folder) / "plate.inp"
            subprocess.run([WRITE_SURFACE, f"strip:{strip}", "0.125", mesh], check=True)
            return self.run_example("--mesh", mesh, "--size", size, status=status)

    def test_quads_follow_the_theory(self):
        for thickness in (1, 2, 4):
            strip = f"25,10,50,20,{thickness / 2},{thickness / 2}"
            self.assertLess(abs(self.bend(strip, f"50,20,{thickness}", 0)), 0.01, thickness)

    def test_plate_of_voxels(self):
        # The sheet of 60 voxels has 58: 3.4 % softer.
        for thickness in (2, 3):
            error = self.run_example("--program", PROGRAM, "--size", f"70,60,{thickness}")
            self.assertAlmostEqual(error, 60 / 58 - 1, delta=0.005)

    def test_a_thickness_that_is_wrong_is_noticed(self):
        # The deflection falls with the cube of the thickness.
        error = self.bend("25,10,50,20,2.1,2.1", "50,20,4", 1)
        self.assertAlmostEqual(error, 1 / 1.05**3 - 1, delta=0.01)


if __name__ == "__main__":
    unittest.main()
