# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The maximum thickness rises where walls are thicker, by the voxels alone, and whoever reads the result is told."""

import json
import unittest

import volumes
from program import REFUSED, ProgramTestCase


def hollow_box(wall, edge=56, spacing=1.0, kind="uint8", offset=0):
    """Walls of one thickness on all sides."""
    volume = volumes.Volume((edge,) * 3, [], [spacing] * 3, kind)

    def is_inside(index, margin):
        return all(margin <= at - offset < edge - 6 - margin for at in index)

    volume.voxels = [100 * (is_inside(index, 2) and not is_inside(index, 2 + wall)) for index in volume.indices()]
    return volume


class ThickWallsTest(ProgramTestCase):
    def report(self, command, *arguments):
        result = self.run_program(command, *arguments, "--report", "r.json", "--overwrite")
        self.table = result.stdout
        return json.loads((self.folder / "r.json").read_text("utf-8"))

    def maximum(self, *arguments, command="extract"):
        """That in effect, and what it was raised from."""
        parameters = self.report(command, *arguments)["parameters"]
        return parameters["max_thickness"], parameters["raised_from"]

    def read(self, name):
        return (self.folder / name).read_bytes()

    def test_the_result_is_that_of_the_maximum_that_is_told(self):
        for spacing in (1.0, 0.25):
            volumes.write_meta(self.folder / "in.mha", hollow_box(20, spacing=spacing))
            outputs = ("--thickness-map", "t.mha", "--html", "p.html")
            raised, default = self.maximum("in.mha", "l.mha", *outputs)
            self.assertEqual(default, 16 * spacing)
            self.assertTrue(20 * spacing <= raised <= 28 * spacing, raised)
            self.assertRegex(self.table, rf"decided .*, walls up to {raised:g}, raised from {default:g} as walls are thicker")
            self.assertIn(f"{raised:g}, raised from {default:g}", self.read("p.html").decode())
            found = self.read("l.mha"), self.read("t.mha")
            self.assertEqual(self.maximum("in.mha", "l.mha", *outputs, "--max-thickness", raised), (raised, None))
            self.assertNotIn("raised from", self.table)
            self.assertEqual((self.read("l.mha"), self.read("t.mha")), found)
            self.assertEqual(self.maximum("in.mha", "l.mha", *outputs, "--max-thickness", default), (default, None))
            self.assertNotEqual(self.read("l.mha"), found[0])

    def test_nothing_but_the_voxels_decides(self):
        volume = hollow_box(20, kind="int16")
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_meta(self.folder / "packed.mha", volume, compressed=True)
        volumes.write_nifti(self.folder / "in.nii", volume)
        expected = self.maximum("in.mha", "l.mha", "--lower", 50), self.read("l.mha")
        self.assertEqual(expected[0][1], 16)
        for arguments in (
            ("packed.mha", "l.mha", "--lower", 50),
            ("in.nii", "l.mha", "--lower", 50),
            ("in.mha", "l.mha", "--lower", "otsu"),
            ("in.mha", "l.mha", "--lower", 50, "--divisions", 7, "--threads", 3),
            ("in.mha", "l.mha", "--lower", 50, "--memory", "100M"),
            ("in.mha", "l.mha", "--lower", 50, "--smooth", "off"),
            ("in.mha", "l.mha", "--lower", 50, "--mesh", "m.ply", "--local-thickness", "o.mha"),
            ("in.mha", "l.mha", "--lower", 50, "--resume"),
        ):
            with self.subTest(arguments=arguments):
                self.assertEqual((self.maximum(*arguments), self.read("l.mha")), expected)
        self.run_program("plan", "in.mha", "j.mha", "job", "--lower", 50, "--report", "j.json", "--divisions", 3)
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        parameters = json.loads(self.read("j.json"))["parameters"]
        self.assertEqual(((parameters["max_thickness"], parameters["raised_from"]), self.read("j.mha")), expected)

    def test_surfaces_have_the_same_walls(self):
        volumes.write_meta(self.folder / "in.mha", hollow_box(20))
        maximum = self.maximum("in.mha", "l.mha")
        self.assertEqual(self.maximum("in.mha", "s.ply", command="surface"), maximum)
        self.assertRegex(self.table, "decided .*raised from")
        self.assertEqual(self.maximum("in.mha", "s.ply", "--local-thickness-method", "sphere", command="surface")[1], None)
        self.assertEqual(self.maximum("in.mha", "m.ply", command="mesh"), maximum)

    def test_other_walls_keep_it(self):
        for wall in (5, 12, 16):
            for offset in range(0, 4):
                volumes.write_meta(self.folder / "in.mha", hollow_box(wall, edge=90, offset=offset))
                self.assertEqual(self.maximum("in.mha", "l.mha"), (16, None), (wall, offset))
        volumes.write_meta(self.folder / "in.mha", hollow_box(20))
        self.assertNotIn("max_thickness", self.report("extract", "in.mha", "l.mha", "--thickness", 3)["parameters"])
        self.assertIsNone(self.report("extract", "in.mha", "l.mha", "--thickness", 3)["parameters"]["raised_from"])
        self.assertEqual(self.maximum("in.mha", "l.mha", "--labels", "100"), (16, None))

    def test_lack_of_memory_is_an_error(self):
        """Fewer bytes must not change the result."""
        volumes.write_meta(self.folder / "in.mha", hollow_box(28, edge=80))
        least = self.find_least_memory("extract", "in.mha", "l.mha", "--max-thickness", 16)
        self.assert_fails(REFUSED, ["walls are so thick", "--memory"], "extract", "in.mha", "l.mha", "--memory", least)


if __name__ == "__main__":
    unittest.main()
