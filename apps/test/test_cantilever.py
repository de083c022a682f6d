# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The example examples/fem/cantilever.py on a mesh as it should be: CalculiX solves the written sections."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

WRITE_SURFACE = os.environ["MEDIALVOXEL_WRITE_SURFACE"]
EXAMPLE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "examples/fem/cantilever.py"


@unittest.skipUnless(shutil.which("ccx"), "ccx is not installed: Debian package calculix-ccx")
class CantileverTest(unittest.TestCase):
    def bend(self, strip, size, status):
        """Relative error of the deflection of a strip, as a plate of so many voxels of 0.5 mm."""
        with tempfile.TemporaryDirectory(prefix="medialvoxel-test-") as folder:
            mesh = pathlib.Path(folder) / "plate.inp"
            subprocess.run([WRITE_SURFACE, f"strip:{strip}", "0.125", mesh], check=True)
            command = [sys.executable, "-B", EXAMPLE, "--mesh", mesh, "--size", size]
            result = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, status, f"{strip}\n{result.stdout}{result.stderr}")
            return float(re.search(r"([+-][0-9.]+)%", result.stdout).group(1)) / 100

    def test_quads_follow_the_theory(self):
        for thickness in (1, 2, 4):
            strip = f"25,10,50,20,{thickness / 2},{thickness / 2}"
            self.assertLess(abs(self.bend(strip, f"50,20,{thickness}", 0)), 0.01, thickness)

    def test_a_thickness_that_is_wrong_is_noticed(self):
        # The deflection falls with the cube of the thickness.
        error = self.bend("25,10,50,20,2.1,2.1", "50,20,4", 1)
        self.assertAlmostEqual(error, 1 / 1.05**3 - 1, delta=0.01)


if __name__ == "__main__":
    unittest.main()
