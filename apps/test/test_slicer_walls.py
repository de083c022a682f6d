# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The module MedialVoxelWalls of 3D Slicer, outside of it. Needs an interpreter with VTK, such as scripts/mesh-readers."""

import pathlib
import subprocess
import unittest

from interpreters import python_with


class WallsModuleTest(unittest.TestCase):
    def test_with_stand_ins(self):
        python = python_with("vtk")
        if not python:
            self.skipTest("no interpreter has VTK; scripts/mesh-readers makes one")
        result = subprocess.run(
            [python, "-B", "-m", "unittest", "slicer_walls"],
            cwd=pathlib.Path(__file__).parent,
            capture_output=True,
            check=False,
            text=True,
        )
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertRegex(result.stderr, r"Ran [1-9]\d tests")


if __name__ == "__main__":
    unittest.main()
