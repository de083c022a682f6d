# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The example examples/fem/cantilever.py: CalculiX solves meshes as they should be, and those of voxels."""

import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import volumes

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

    @unittest.skipUnless(importlib.util.find_spec("numpy"), "numpy is not installed")
    def test_a_column_from_scan_to_result(self):
        """A plate that stands on a side and is pressed, beside a piece that nothing holds."""
        width, thickness, height, force = 40, 4, 60, 1000
        volume = volumes.Volume((50, 14, 70), [])
        ends = ((5, 5 + width), (3, 3 + thickness), (5, 5 + height)), ((0, 40), (9, 12), (40, 70))
        volume.voxels = [
            int(any(all(low <= i < high for i, (low, high) in zip(index, box)) for box in ends)) for index in volume.indices()
        ]
        with tempfile.TemporaryDirectory(prefix="medialvoxel-test-") as folder:
            part = volumes.write_meta(pathlib.Path(folder) / "part.mha", volume)
            command = [sys.executable, "-B", EXAMPLE.parent / "solve_part.py", part, "--lower", "1", "--force", str(force)]
            command += ["--program", PROGRAM]
            result = subprocess.run(command, capture_output=True, text=True, check=True)
        printed = re.findall(r"^(displacement|stress) +([0-9.e+-]+)", result.stdout, re.MULTILINE)
        found = {name: float(value) for name, value in printed}
        # The sheet is as large as the plate; a row of elements is held, and one loaded. Corners move more than the others.
        stress = force / (thickness * width)
        self.assertAlmostEqual(found["displacement"] / (stress / 70000 * (height - 1.5 * thickness)), 1.1, delta=0.1)
        self.assertAlmostEqual(found["stress"] / stress, 1.1, delta=0.3)


if __name__ == "__main__":
    unittest.main()
