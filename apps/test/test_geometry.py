# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Where voxels lie: sheared grids are refused, nearly equal spacings are equal, units become millimeters."""

import json
import math
import struct
import unittest

import volumes
from program import CORRUPT, ProgramTestCase

SIZE = (24, 22, 20)


def plate():
    volume = volumes.Volume(SIZE, [])
    volume.voxels = [100 if 3 <= x < 20 and 3 <= y < 19 and 7 <= z < 13 else 0 for x, y, z in volume.indices()]
    return volume


def nifti(voxels, pixdim=(1, 1, 1), sform=None, qform=None, codes=(0, 0), units=2):
    """A file of NIfTI-1 with voxels of 8 bits. sform: rows of four; qform: offsets of an unturned grid; codes: of both."""
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *SIZE, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)
    struct.pack_into("<4f", header, 76, 1, *pixdim)
    struct.pack_into("<f", header, 108, 352)
    header[123] = units
    struct.pack_into("<2h", header, 252, codes[1], codes[0])
    struct.pack_into("<3f", header, 268, *(qform or (0, 0, 0)))
    for row, numbers in enumerate(sform or [(0, 0, 0, 0)] * 3):
        struct.pack_into("<4f", header, 280 + 16 * row, *numbers)
    header[344:348] = b"n+1\0"
    return bytes(header) + bytes(voxels)


class GeometryTest(ProgramTestCase):
    def sheared(self, degrees):
        """The same volume in files whose z axis is turned towards y."""
        y, z = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
        part = plate()
        yield volumes.write_meta(self.folder / "s.mha", part, TransformMatrix=f"1 0 0 0 1 0 0 {y} {z}")
        size = " ".join(map(str, SIZE))
        text = (
            f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {size}\nencoding: raw\nspace: left-posterior-superior\n"
            f"space directions: (1,0,0) (0,1,0) (0,{y},{z})\nspace origin: (0,0,0)\n\n"
        )
        path = self.folder / "s.nrrd"
        path.write_bytes(text.encode() + bytes(part.voxels))
        yield path
        path = self.folder / "s.nii"
        path.write_bytes(nifti(part.voxels, sform=[(1, 0, 0, 0), (0, 1, y, 0), (0, 0, z, 0)], codes=(1, 0)))
        yield path

    def test_sheared_grids_are_refused(self):
        for degrees in (1, 25, -30):
            for path in self.sheared(degrees):
                for command in (["extract", path, "o.mha"], ["info", path], ["distance", path, "v.mha"],
                                ["surface", path, "s.ply", "--lower", 50], ["mesh", path, "m.vtp"]):  # fmt: skip
                    angle = f"axes y and z are at {90 - degrees} degrees"
                    self.assert_fails(CORRUPT, [path.name, angle, "straight grid"], *command)
        for path in self.sheared(0.3):
            self.run_program("info", path)

    def cells(self, source, *options):
        self.run_program("extract", source, "l.mha", "--overwrite", "--lower", 50, *options)
        return volumes.read_data(self.folder / "l.mha")

    def test_nearly_equal_spacings_are_equal(self):
        part = plate()
        for x in range(5, 9):  # a dent makes ties
            part.voxels[(7 * SIZE[1] + 9) * SIZE[0] + x] = 0
        volumes.write_meta(self.folder / "in.mha", part)
        for equal, others in (
            ("1,1,1", ("1.0000001,1,1", "1,1.000000015,1", "1,1,0.9999999")),
            ("0.9570312,0.9570312,1.5", ("0.9570312,0.95703119,1.5", "0.95703121,0.9570312,1.5")),
        ):
            expected = self.cells("in.mha", "--spacing", equal)
            for other in others:
                self.assertEqual(self.cells("in.mha", "--spacing", other), expected, other)
        self.assertEqual(self.cells("in.mha", "--spacing", "1,1,1.0000001", "--thickness", 3), self.cells("in.mha", "--thickness", 3))

    def table(self, path):
        lines = self.run_program("info", path).stdout.splitlines()
        return {line.split("  ", 1)[0]: line.split("  ", 1)[1].strip() for line in lines}

    def warnings_of(self, path):
        self.run_program("extract", path, "l.mha", "--overwrite", "--lower", 50, "--report", "r.json")
        return [warning["code"] for warning in json.loads((self.folder / "r.json").read_text())["warnings"]]

    def test_units_of_nrrd_become_millimeters(self):
        size = " ".join(map(str, SIZE))
        for units, spacing, is_known in (
            ('"mm" "mm" "mm"', "0.5 x 0.5 x 0.8", True),
            ('"microns" "microns" "microns"', "0.0005 x 0.0005 x 0.0008", True),
            ('"mm" "mm" "cm"', "0.5 x 0.5 x 8", True),
            ('"parsec" "mm" "mm"', "0.5 x 0.5 x 0.8", False),
        ):
            text = (
                f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {size}\nencoding: raw\nspace dimension: 3\n"
                f"space directions: (0.5,0,0) (0,0.5,0) (0,0,0.8)\nspace units: {units}\n\n"
            )
            (self.folder / "u.nrrd").write_bytes(text.encode() + bytes(plate().voxels))
            numbers = [float(number) for number in self.table("u.nrrd")["spacing"].split(" x ")]
            self.assertEqual(numbers, [float(number) for number in spacing.split(" x ")])
            self.assertEqual("unknown_spacing" in self.warnings_of("u.nrrd"), not is_known, units)

    def test_the_unit_is_told_everywhere(self):
        size = " ".join(map(str, SIZE))
        for told, unit, text in (('space units: "um" "um" "um"\n', "mm", "mm"), ("", None, "units of the spacing")):
            header = f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {size}\nencoding: raw\nspace dimension: 3\n"
            header += f"space directions: (500,0,0) (0,500,0) (0,0,800)\n{told}\n"
            (self.folder / "u.nrrd").write_bytes(header.encode() + bytes(plate().voxels))
            self.assertEqual(self.table("u.nrrd")["unit"], unit or "not told")
            length = 500 if unit is None else 0.5
            run = ["l.mha", "--overwrite", "--lower", 50, "--thickness", 3 * length, "--html", "p.html", "--report", "r.json"]
            table = self.run_program("extract", "u.nrrd", *run).stdout
            self.assertRegex(table, rf"\nwalls .*, in {text}, by area\n")
            self.assertEqual(json.loads((self.folder / "r.json").read_text())["input"]["unit"], unit)
            self.assertIn(f"The scale bar is in {text}.", (self.folder / "p.html").read_text())
            for name in ("m.obj", "m.ply", "m.vtk", "m.vtp", "m.vtu", "m.stl", "m.inp", "m.bdf", "m.k"):
                self.run_program("mesh", "u.nrrd", name, "--overwrite", "--lower", 50, "--thickness", 3 * length)
                title = f"Medial surface by MedialVoxel, coordinates and thickness in {text}"
                self.assertIn(title.encode(), (self.folder / name).read_bytes(), name)

    def test_forms_of_nifti(self):
        sform = [(-0.5, 0, 0, 10), (0, -0.6, 0, 20), (0, 0, 0.7, 30)]
        for options, spacing, origin, contradicts in (
            (dict(sform=sform, codes=(1, 0), pixdim=(0.5, 0.6, 0.7)), "0.5 x 0.6 x 0.7", "-10, -20, 30", False),
            (dict(sform=sform, codes=(1, 0)), "0.5 x 0.6 x 0.7", "-10, -20, 30", True),
            (dict(qform=(1, 2, 3), codes=(0, 1), pixdim=(0.5, 0.6, 0.7)), "0.5 x 0.6 x 0.7", "-1, -2, 3", False),
            (dict(sform=sform, qform=(1, 2, 3), codes=(2, 1)), "0.5 x 0.6 x 0.7", "-10, -20, 30", True),
            (dict(pixdim=(0.5, 0.6, 0.7)), "0.5 x 0.6 x 0.7", "0, 0, 0", False),
            (dict(sform=[(1, 0, 0, 9), (0, 1, 0.4, 9), (0, 0, 1, 9)], qform=(1, 2, 3), codes=(2, 1)),
             "1 x 1 x 1", "-1, -2, 3", True),
        ):  # fmt: skip
            (self.folder / "f.nii").write_bytes(nifti(plate().voxels, **options))
            table = self.table("f.nii")
            numbers = [round(float(number), 6) for number in table["spacing"].split(" x ")]
            self.assertEqual(numbers, [float(number) for number in spacing.split(" x ")], options)
            self.assertEqual(table["origin"], origin, options)
            self.assertEqual("contradicting_forms" in self.warnings_of("f.nii"), contradicts, options)

    def test_default_of_local_thickness_is_within_its_limit(self):
        volumes.write_meta(self.folder / "in.mha", plate())
        for ratio in (7.9, 8.1, 20, 900):
            options = ["--lower", 50, "--spacing", f"1,1,{ratio}", "--overwrite"]
            self.run_program("extract", "in.mha", "l.mha", "--local-thickness", "t.mha", *options)
            self.run_program("surface", "in.mha", "s.ply", *options)


if __name__ == "__main__":
    unittest.main()
