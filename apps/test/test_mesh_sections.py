# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Sections by thickness in meshes for solvers."""

import os
import pathlib
import re
import shutil
import sys
import unittest

import volumes
from program import USAGE, ProgramTestCase

sys.path.append(str(pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "examples/fem"))

from shell_model import ShellModel, solve  # noqa: E402


def steps():
    """Plates of two, three and four voxels side by side, which leave the image."""
    volume = volumes.Volume((30, 12, 14), [], (0.5, 0.5, 0.5))
    volume.voxels = [1 if 5 <= z < 7 + x // 10 else 0 for x, _, z in volume.indices()]
    return volume


def plate():
    """Of four voxels."""
    volume = volumes.Volume((60, 24, 14), [], (0.5, 0.5, 0.5))
    volume.voxels = [1 if 5 <= z < 9 and 4 <= x < 56 and 4 <= y < 20 else 0 for x, y, z in volume.indices()]
    return volume


class MeshSectionsTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", steps())

    def mesh(self, target, *arguments):
        """The text of a mesh."""
        size = ("--element-size", "voxel")
        self.run_program("mesh", "in.mha", target, "--thickness", 1, "--overwrite", *size, *arguments)
        return (self.folder / target).read_text(encoding="ascii")

    def thicknesses(self, *arguments):
        """Of the sections, the same in both formats."""
        abaqus = re.findall(r"^\*SHELL SECTION, .*\n(\S+)$", self.mesh("m.inp", *arguments), re.MULTILINE)
        nastran = re.findall(r"^PSHELL\* +\d+ +1 +(\S+)", self.mesh("m.bdf", *arguments), re.MULTILINE)
        self.assertEqual(list(map(float, abaqus)), list(map(float, nastran)))
        return list(map(float, abaqus))

    def test_default_is_a_quarter_of_the_spacing(self):
        self.assertEqual(self.thicknesses(), self.thicknesses("--sections", 0.125))
        thicknesses = self.thicknesses()
        self.assertEqual(thicknesses, sorted(thicknesses))
        for whole in (1.0, 1.5, 2.0):
            self.assertLess(min(abs(thickness - whole) for thickness in thicknesses), 0.03, thicknesses)

    def test_width(self):
        self.assertLess(len(self.thicknesses("--sections", 0.5)), len(self.thicknesses()))
        (one,) = self.thicknesses("--sections", 100)
        self.assertTrue(1 < one < 2, one)

    def test_beside_the_labels(self):
        one = self.mesh("m.inp", "--sections", 0.5)
        arguments = ("--mesh", "beside.inp", "--element-size", "voxel", "--sections", 0.5)
        self.extract("in.mha", "labels.mha", *arguments, thickness=1)
        self.assertEqual((self.folder / "beside.inp").read_text(encoding="ascii"), one)
        self.assert_fails(
            USAGE, ["--sections", "'0'", "or nodes"], "extract", "in.mha", "x.mha", "--mesh", "x.inp", "--thickness", 1, "--sections=0"
        )

    def test_thickness_at_nodes(self):
        """Steps of 1, 1.5 and 2 along x, away from the rims too."""
        text = self.mesh("m.inp", "--sections", "nodes")
        self.extract("in.mha", "l.mha", "--mesh", "beside.inp", "--element-size", "voxel", "--sections", "nodes", thickness=1)
        self.assertEqual((self.folder / "beside.inp").read_text(encoding="ascii"), text)
        nodes = re.findall(r"^\d+, (\S+), \S+, \S+$", text[: text.index("*ELEMENT")], re.MULTILINE)
        thicknesses = re.findall(r"^\d+, (\S+)$", text[text.index("*NODAL") :], re.MULTILINE)
        self.assertEqual(len(nodes), len(thicknesses))
        for x, thickness in zip(map(float, nodes), map(float, thicknesses)):
            for begin, end, expected in ((0, 4, 1.0), (6, 9, 1.5), (11, 15, 2.0)):
                if begin <= x <= end:
                    self.assertAlmostEqual(thickness, expected, delta=0.03)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed: Debian package calculix-ccx")
    def test_bends_the_same_with_both(self):
        volumes.write_meta(self.folder / "in.mha", plate())
        deflections = []
        for sections in (0.125, "nodes"):
            options = ("--sections", sections, "--element-size", "auto", "--overwrite")
            self.run_program("mesh", "in.mha", "m.inp", *options)
            model = ShellModel(self.folder / "m.inp")
            x = {number: point[0] for number, point in model.nodes.items()}
            held = [number for number, value in x.items() if value < min(x.values()) + 0.5]
            loaded = [number for number, value in x.items() if value > max(x.values()) - 0.5]
            moved = solve(model, (70000.0, 0.3), held, {number: (0.0, 0.0, 1 / len(loaded)) for number in loaded}, self.folder)
            deflections.append(sum(move[2] for move in moved.values()) / len(moved))
        self.assertAlmostEqual(deflections[0] / deflections[1], 1, delta=0.01)
        # A beam as wide as the plate, and as long as from where it is held to where it is loaded.
        length, width, thickness = max(x.values()) - min(x.values()) - 0.25, 8, 2
        self.assertAlmostEqual(deflections[0] / (4 * length**3 / (70000 * width * thickness**3)), 1, delta=0.1)

    def test_widths_that_make_no_sense(self):
        for width in ("0", "-1", "nan", "inf", "x"):
            self.assert_fails(
                USAGE, [width], "mesh", "in.mha", "m.inp", "--thickness", 1, f"--sections={width}"
            )


if __name__ == "__main__":
    unittest.main()
