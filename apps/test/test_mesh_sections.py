# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Sections by thickness in meshes for solvers."""

import re
import unittest

import volumes
from program import USAGE, ProgramTestCase


def steps():
    """Plates of two, three and four voxels side by side, which leave the image."""
    volume = volumes.Volume((30, 12, 14), [], (0.5, 0.5, 0.5))
    volume.voxels = [1 if 5 <= z < 7 + x // 10 else 0 for x, _, z in volume.indices()]
    return volume


class MeshSectionsTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", steps())

    def mesh(self, target, *arguments):
        """The text of a mesh."""
        self.run_program("mesh", "in.mha", target, "--thickness", 1, "--overwrite", *arguments)
        return (self.folder / target).read_text(encoding="ascii")

    def thicknesses(self, *arguments):
        """Of the sections, the same in both formats."""
        abaqus = re.findall(r"^\*SHELL SECTION, .*\n(\S+)$", self.mesh("m.inp", *arguments), re.MULTILINE)
        nastran = re.findall(r"^PSHELL\* +\d+ +1 +(\S+)", self.mesh("m.bdf", *arguments), re.MULTILINE)
        self.assertEqual(list(map(float, abaqus)), list(map(float, nastran)))
        return list(map(float, abaqus))

    def test_default_is_a_quarter_of_the_spacing(self):
        self.assertEqual(self.thicknesses(), self.thicknesses("--section-width", 0.125))
        thicknesses = self.thicknesses()
        self.assertEqual(thicknesses, sorted(thicknesses))
        for whole in (1.0, 1.5, 2.0):
            self.assertLess(min(abs(thickness - whole) for thickness in thicknesses), 0.03, thicknesses)

    def test_width(self):
        self.assertLess(len(self.thicknesses("--section-width", 0.5)), len(self.thicknesses()))
        (one,) = self.thicknesses("--section-width", 100)
        self.assertTrue(1 < one < 2, one)

    def test_beside_the_labels(self):
        one = self.mesh("m.inp", "--section-width", 0.5)
        arguments = ("--mesh", "beside.inp", "--section-width", 0.5)
        self.extract("in.mha", "labels.mha", *arguments, thickness=1)
        self.assertEqual((self.folder / "beside.inp").read_text(encoding="ascii"), one)
        self.assert_fails(
            USAGE, ["width"], "extract", "in.mha", "x.mha", "--mesh", "x.inp", "--thickness", 1, "--section-width=0"
        )

    def test_widths_that_make_no_sense(self):
        for width in ("0", "-1", "nan", "inf", "x"):
            self.assert_fails(
                USAGE, [width], "mesh", "in.mha", "m.inp", "--thickness", 1, f"--section-width={width}"
            )


if __name__ == "__main__":
    unittest.main()
