# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""--resample: voxels between those of the file, made while it is read, are those of a volume resampled beforehand."""

import json
import math
import unittest

import volumes
from program import READS_TIFF, USAGE, ProgramTestCase

OUTPUTS = ["--vectors", "v.mha", "--thickness-map", "t.mha", "--distance", "d.mha"]
NAMES = ("out.mha", "v.mha", "t.mha", "d.mha")


def tilted_wall(size=(26, 22, 9), spacing=(0.5, 0.5, 2.0), kind="int16"):
    """A tilted wall with voxels that hold a part of metal, 0 to 1000; the threshold is 500."""
    volume = volumes.Volume(size, [], spacing, kind)
    for index in volume.indices():
        x, y, z = (i * s for i, s in zip(index, spacing))
        distance = 0.83 * (x - 6.1) + 0.2 * (y - 5.3) + 0.52 * (z - 8.2)
        share = (math.erf((1.4 - distance) / 0.6) + math.erf((1.4 + distance) / 0.6)) / 2
        volume.voxels.append(round(1000 * share))
    return volume


def steps(size, spacing, target):
    """Of each voxel along a resampled axis: the voxel before it, and how far behind that it lies."""
    if size == 1 or spacing == target:
        return [(i, 0.0) for i in range(size)]
    count = math.floor((size - 1) * (spacing / target) + 1e-9) + 1
    positions = [min(size - 1, i * (target / spacing)) for i in range(count)]
    rounded = [round(p) if abs(p - round(p)) < 1e-9 else p for p in positions]
    return [(math.floor(p), p - math.floor(p)) for p in rounded]


def resampled(volume, target, interpolates):
    """Another way to the same volume: one axis after the other, in whole."""
    size, voxels = list(volume.size), [float(v) for v in volume.voxels]
    for axis, spacing in enumerate(volume.spacing):
        stride = math.prod(size[:axis])
        made = steps(size[axis], spacing, target)
        lines = len(voxels) // (stride * size[axis])
        result = []
        for line in range(lines):
            for lower, weight in made:
                if not interpolates:
                    lower, weight = (lower + 1, 0.0) if weight > 0.5 else (lower, 0.0)
                first = (line * size[axis] + lower) * stride
                for i in range(first, first + stride):
                    value = voxels[i] if weight == 0 else (1 - weight) * voxels[i] + weight * voxels[i + stride]
                    result.append(value)
        voxels, size[axis] = result, len(made)
    spacing = [s if n == 1 else target for s, n in zip(volume.spacing, volume.size)]
    return volumes.Volume(size, voxels, spacing, "float64")


class ResampleTest(ProgramTestCase):
    def results(self, source, *arguments):
        self.run_program("extract", source, "out.mha", *OUTPUTS, "--overwrite", *arguments)
        return {name: (self.folder / name).read_bytes() for name in NAMES}

    def assert_same(self, actual, expected, what=None):
        for name in NAMES:
            self.assertEqual(actual[name], expected[name], (what, name))

    def test_like_a_volume_resampled_before(self):
        volume = tilted_wall()
        volumes.write_meta(self.folder / "in.mha", volume)
        # Sums of the other way may differ in the last digit, which these thresholds do not see.
        cases = (("auto", 500.123), (0.5, 431.7), (0.7, 500.123), (2, 500.123), (3.1, 350.3), (0.25, 600.7))
        for target, threshold in cases:
            length = 0.5 if target == "auto" else target
            volumes.write_meta(self.folder / "before.mha", resampled(volume, length, True))
            for options in (["--thickness", 2], []):
                options = [*options, "--lower", threshold]
                self.assert_same(
                    self.results("in.mha", "--resample", target, *options),
                    self.results("before.mha", *options),
                    (target, options),
                )

    def test_masks_keep_their_values(self):
        """Without a threshold there is nothing between object and background: the nearest voxel counts."""
        volume = volumes.box_with_plate((14, 12, 9), (1, 1.5, 3))
        volume.voxels = [1 if v == 100 else 0 for v in volume.voxels]
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_meta(self.folder / "before.mha", resampled(volume, 1.0, False))
        for options in (["--thickness", 2], ["--max-pore-size", 0]):
            self.assert_same(self.results("in.mha", "--resample", 1, *options), self.results("before.mha", *options))

    def test_labels_are_not_mixed(self):
        """Between 0 and 2 there is no 1."""
        volume = volumes.Volume((9, 8, 7), [], (1, 1, 4))
        volume.voxels = [2 * (z % 2) if x < 5 else 1 for x, _, z in volume.indices()]
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_meta(self.folder / "before.mha", resampled(volume, 1.0, False))
        options = ["--lower", 1, "--upper", 1]
        self.assert_same(self.results("in.mha", "--resample", 1, *options), self.results("before.mha", *options))

    def test_label_that_resampled_values_do_not_hold(self):
        volume = volumes.Volume((9, 8, 7), [2**53 + 1] * (9 * 8 * 7), (1, 1, 4), kind="int64")
        volumes.write_meta(self.folder / "in.mha", volume)
        command = ["extract", "in.mha", "out.mha", "--label"]
        self.assert_fails(USAGE, [2**53 + 1, "--resample"], *command, 2**53 + 1, "--resample", "auto")
        self.run_program(*command, 2**53 + 1)
        self.run_program(*command, 2**53, "--resample", "auto", "--overwrite")

    def test_any_division_and_any_way_of_reading(self):
        volume = tilted_wall(kind="uint16")
        options = ["--resample", "auto", "--lower", 500]
        volumes.write_meta(self.folder / "in.mha", volume)
        expected = self.results("in.mha", *options)
        for cut in (["--divisions", 5], ["--divisions", 33, "--threads", 3], ["--memory", "64M"], ["--threads", 1]):
            self.assert_same(self.results("in.mha", *options, *cut), expected, cut)
        sources = [
            volumes.write_meta(self.folder / "packed.mha", volume, compressed=True),
            volumes.write_nrrd(self.folder / "packed.nrrd", volume, compressed=True, big_endian=True),
            volumes.write_nrrd(self.folder / "plain.nhdr", volume),
            volumes.write_nifti(self.folder / "scaled.nii", volume, scl_slope=2.0, scl_inter=-7.0),
            *([volumes.write_tiff(self.folder / "a.tif", volume, packing="deflate")] if READS_TIFF else []),
        ]
        for source in sources:
            changes = ["--lower", 993] if source.name == "scaled.nii" else ["--lower", 500]
            changes += ["--spacing", "0.5,0.5,2"] if source.suffix == ".tif" else []
            self.results(source, "--resample", "auto", *changes)
            for name in NAMES:
                self.assertTrue(expected[name].endswith(volumes.read_data(self.folder / name)), (source.name, name))

    def test_geometry(self):
        volume = tilted_wall()
        direction = "0 1 0 -1 0 0 0 0 1"
        volumes.write_meta(self.folder / "in.mha", volume, Offset="3 -4 5.5", TransformMatrix=direction)
        self.run_program("distance", "in.mha", "v.mha", "--lower", 500, "--resample", "auto", "--report", "r.json")
        fields = volumes.read_header(self.folder / "v.mha")[0]
        self.assertEqual(fields["Offset"], "3 -4 5.5")
        self.assertEqual(fields["TransformMatrix"], direction)
        self.assertEqual(fields["ElementSpacing"], "0.5 0.5 0.5")
        self.assertEqual(fields["DimSize"], "26 22 33")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["size"], [26, 22, 33])
        self.assertEqual(report["input"]["spacing"], [0.5, 0.5, 2])
        self.assertEqual(report["input"]["type"], "int16")
        self.assertEqual(report["input"]["bytes"], len(volume.data()))
        self.assertEqual(report["parameters"]["resampled_spacing"], [0.5, 0.5, 0.5])
        text = self.run_program("info", "in.mha", "--resample", "auto").stdout
        self.assertRegex(text, r"size +26 x 22 x 9\n")
        self.assertRegex(text, r"resampled +26 x 22 x 33 at 0.5 x 0.5 x 0.5\n")

    def test_equal_spacing_stays(self):
        volume = tilted_wall(size=(12, 11, 10), spacing=(0.7, 0.7, 0.7))
        volumes.write_meta(self.folder / "in.mha", volume)
        self.assert_same(
            self.results("in.mha", "--lower", 500, "--resample", "auto"), self.results("in.mha", "--lower", 500)
        )

    def test_planes(self):
        volume = tilted_wall(size=(30, 9, 1), spacing=(0.5, 1.5, 7))
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_meta(self.folder / "before.mha", resampled(volume, 0.5, True))
        options = ["--lower", 500.123, "--thickness", 1.5]
        self.assert_same(self.results("in.mha", "--resample", "auto", *options), self.results("before.mha", *options))
        flat = volumes.Volume((30, 9), volume.voxels, volume.spacing[:2], volume.kind)
        volumes.write_meta(self.folder / "flat.mha", flat)
        volumes.write_meta(self.folder / "before.mha", resampled(flat, 0.5, True))
        self.assert_same(self.results("flat.mha", "--resample", "auto", *options), self.results("before.mha", *options))

    def test_not_a_number(self):
        """A voxel in which one that is not a number has a share is background."""
        volume = volumes.Volume((6, 6, 4), [1.0] * 144, (1, 1, 3), "float32")
        volume.voxels[2 * 36 + 14] = math.nan
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_meta(self.folder / "before.mha", resampled(volume, 1.0, True))
        options = ["--lower", 0.5, "--max-pore-size", 0]
        self.assert_same(self.results("in.mha", "--resample", 1, *options), self.results("before.mha", *options))

    def test_sub_voxel_and_mesh(self):
        volume = tilted_wall()
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_meta(self.folder / "before.mha", resampled(volume, 0.5, True))
        options = ["--lower", 500.123, "--sub-voxel"]
        self.assert_same(self.results("in.mha", "--resample", "auto", *options), self.results("before.mha", *options))
        for source, name, more in (("in.mha", "a.ply", ["--resample", "auto"]), ("before.mha", "b.ply", [])):
            self.run_program("mesh", source, name, *options, *more)
        self.assertEqual((self.folder / "a.ply").read_bytes(), (self.folder / "b.ply").read_bytes())

    def test_jobs(self):
        volumes.write_meta(self.folder / "in.mha", tilted_wall())
        options = ["--lower", 500, "--resample", "auto"]
        self.run_program("extract", "in.mha", "whole.mha", *options)
        self.run_program("plan", "in.mha", "out.mha", "job", "--divisions", 4, *options)
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertEqual((self.folder / "out.mha").read_bytes(), (self.folder / "whole.mha").read_bytes())

    def test_wrong_values(self):
        volumes.write_meta(self.folder / "in.mha", tilted_wall())
        for value in ("0", "-1", "nan", "x"):
            self.assert_fails(USAGE, ["--resample", value], "extract", "in.mha", "out.mha", "--resample", value)
        for value in ("inf", "1e+13"):
            self.assert_fails(USAGE, ["--resample", value], "extract", "in.mha", "out.mha", "--resample", value)
        message = ["in.mha", "resampled spacing 1e-10", "size along axis", "2147483647"]
        self.assert_fails(USAGE, message, "extract", "in.mha", "out.mha", "--resample", "1e-10")


if __name__ == "__main__":
    unittest.main()
