# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Every input format, and every variant of it, gives the same label bytes and the same counts."""

import json
import random
import unittest

import volumes
from program import CORRUPT, USAGE, ProgramTestCase, needs_tiff


def noisy_box(kind):
    """A box with walls whose gray values are noise, so that packing has something to do."""
    numbers = random.Random(7)
    volume = volumes.box_with_plate(size=(70, 40, 12), kind=kind)
    volume.voxels = [numbers.randint(60, 120) if v == 100 else numbers.randint(0, 40) for v in volume.voxels]
    return volume


class InputIdentityTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = noisy_box("int16")
        self.expected = self.result(volumes.write_meta(self.folder / "reference.mha", self.volume))
        self.assertGreater(self.expected[1]["medial_cells"], 100)

    def result(self, source, *arguments, lower=50):
        self.extract(source, "l.mha", "--report", "r.json", "--lower", lower, "--overwrite", "--divisions", 5, *arguments)
        report = json.loads((self.folder / "r.json").read_text())
        return volumes.read_data(self.folder / "l.mha"), report["counts"]

    def assert_same(self, source, *arguments, **options):
        self.assertEqual(self.result(source, *arguments, **options), self.expected, (source, arguments))

    def assert_reading(self, source, what):
        self.assertRegex(self.run_program("info", source).stdout, rf"\nreading +{what}")

    def write_files(self, count, name="part%02d.img", **changes):
        """A detached NRRD with its voxels in several files; returns the names of these."""
        data = self.volume.data()
        share = len(data) // count
        names = [name % number for number in range(count)]
        for number, part in enumerate(names):
            (self.folder / part).write_bytes(b"junk" + data[number * share : (number + 1) * share])
        header = volumes.nrrd_header(self.volume, f"{name} 0 {count - 1} 1 3", byte_skip=4, **changes)
        (self.folder / "in.nhdr").write_bytes(header)
        return names

    def test_meta_image(self):
        for big_endian in (False, True):
            for compressed in (False, True):
                for name in ("in.mha", "in.mhd"):
                    path = self.folder / name
                    self.assert_same(volumes.write_meta(path, self.volume, big_endian, compressed=compressed))

    def test_nrrd(self):
        for big_endian in (False, True):
            for compressed in (False, True):
                for name in ("in.nrrd", "in.nhdr"):
                    path = self.folder / name
                    self.assert_same(volumes.write_nrrd(path, self.volume, big_endian, compressed=compressed))

    def test_headerless(self):
        for big_endian in (False, True):
            path = volumes.write_raw(self.folder / "in.raw", self.volume, big_endian, header=b"seventeen bytes..")
            options = volumes.raw_options(self.volume, ":17" + ":big" * big_endian)
            self.assert_same(path, *options)

    def test_nrrd_of_several_files(self):
        for count in (2, 3, 12):
            self.write_files(count)
            self.assert_reading("in.nhdr", "streams")
            self.assert_same("in.nhdr")
        names = self.write_files(4, "list%d.img")
        header = volumes.nrrd_header(self.volume, byte_skip=4)[:-1] + b"data file: LIST 3\n"
        (self.folder / "in.nhdr").write_bytes(header + "\n".join(names).encode() + b"\n")
        self.assert_same("in.nhdr")

    def test_damaged_nrrd_of_several_files(self):
        names = self.write_files(4)
        run = ("extract", "in.nhdr", "out.mha", "--thickness", 3)
        content = (self.folder / names[2]).read_bytes()
        (self.folder / names[2]).write_bytes(content[:-1])
        self.assert_fails(CORRUPT, [names[2], len(content) - 1], *run)
        (self.folder / names[2]).unlink()
        self.assert_fails(CORRUPT, [names[2], "missing"], *run)
        self.write_files(4)
        for count in (3, 5):
            header = volumes.nrrd_header(self.volume, f"part%02d.img 0 {count - 1} 1", byte_skip=4)
            (self.folder / "in.nhdr").write_bytes(header)
            self.assert_fails(CORRUPT, ["in.nhdr", count], *run)
        self.write_files(4, encoding="gzip")
        self.assert_fails(CORRUPT, ["in.nhdr", "several files", "gzip"], *run)

    def test_output_over_one_of_several_files(self):
        names = self.write_files(4, "part%d.mha")
        for name in names:
            self.assert_fails(USAGE, [name, "input"], "extract", "in.nhdr", name, "--thickness", 3, "--overwrite")

    def test_nifti(self):
        for big_endian in (False, True):
            path = volumes.write_nifti(self.folder / "in.nii", self.volume, big_endian)
            self.assert_reading(path, "streams")
            self.assert_same(path)
            path = volumes.write_nifti(self.folder / "in.nii.gz", self.volume, big_endian)
            self.assert_reading(path, "does not stream: it is compressed")
            self.assert_same(path)
        self.assert_same(volumes.write_nifti(self.folder / "in.NII.GZ", self.volume, dim=(5, 70, 40, 12, 1, 1, 1, 1)))

    def test_nifti_of_the_second_version(self):
        for big_endian in (False, True):
            self.assert_same(volumes.write_nifti(self.folder / "in.nii", self.volume, big_endian, version=2))
            self.assert_same(volumes.write_nifti(self.folder / "in.nii.gz", self.volume, big_endian, version=2))
            scale = {"scl_slope": 0.25, "scl_inter": -5}
            path = volumes.write_nifti(self.folder / "in.nii", self.volume, big_endian, version=2, **scale)
            self.assert_reading(path, "streams")
            self.assert_same(path, lower=10)

    def test_both_versions_of_nifti_have_one_place(self):
        for changes in (
            {"pixdim": (1, 0.5, 0.25, 2, 1, 1, 1, 1), "xyzt_units": 3},
            {"qform_code": 1, "quatern": (0.5, 0.5, 0.5), "qoffset": (1, -2, 3.5)},
            {"pixdim": (-1, 0.5, 0.25, 2, 1, 1, 1, 1), "qform_code": 2, "quatern": (0, 0, 1), "qoffset": (1, -2, 3.5)},
            {"sform_code": 2, "srow": (0, 0.25, 0, 10, -0.5, 0, 0, 20, 0, 0, 2, 30)},
        ):
            headers = []
            for version in (1, 2):
                path = volumes.write_nifti(self.folder / "in.nii", self.volume, version=version, **changes)
                self.extract(path, "place.mha", "--overwrite", "--lower", 50, "--resample", "off")
                headers.append(volumes.read_header(self.folder / "place.mha"))
            self.assertEqual(*headers)

    def test_nifti_pairs(self):
        for version in (1, 2):
            for big_endian in (False, True):
                path = volumes.write_nifti(self.folder / "in.hdr", self.volume, big_endian, version=version)
                self.assert_reading(path, "streams")
                self.assert_same(path)
            volumes.write_nifti(self.folder / "in.hdr", self.volume, version=version, vox_offset=16)
            path.with_suffix(".img").write_bytes(bytes(16) + self.volume.data())
            self.assert_same(path)

    def test_mrc(self):
        for big_endian in (False, True):
            for kind in ("int8", "int16", "uint16", "float32"):
                path = volumes.write_mrc(self.folder / "in.mrc", self.volume.as_type(kind), big_endian, b"extended")
                self.assert_reading(path, "streams")
                self.assert_same(path)
        bright = self.volume.as_type("uint8")
        bright.voxels = [voxel + 100 for voxel in self.volume.voxels]
        for flags in (0, 2):
            path = volumes.write_mrc(self.folder / "in.rec", bright, imod=(1146047817, flags))
            self.assertIn("uint8", self.run_program("info", path).stdout)
            self.assert_same(path, lower=150)
        for imod in ((1146047817, 1), (0, 0)):
            path = volumes.write_mrc(self.folder / "in.map", self.volume.as_type("int8"), imod=imod)
            self.assertRegex(self.run_program("info", path).stdout, r"type +int8")

    def test_nifti_of_all_types(self):
        volume = volumes.box_with_plate(size=(30, 20, 12))
        self.expected = self.result(volumes.write_meta(self.folder / "reference.mha", volume))
        for kind in volumes.NIFTI_TYPES:
            self.assert_same(volumes.write_nifti(self.folder / "in.nii", volume.as_type(kind)))
            scaled = volumes.write_nifti(self.folder / "in.nii", volume.as_type(kind), scl_slope=0.5, scl_inter=-30)
            self.assert_reading(scaled, "streams")
            self.assert_same(scaled, lower=0)

    def test_scaled_nifti(self):
        """Thresholds are those of the values: 60 * 0.25 - 5 = 10 is the lowest of the object."""
        for name in ("in.nii", "in.nii.gz"):
            path = volumes.write_nifti(self.folder / name, self.volume, True, scl_slope=0.25, scl_inter=-5)
            self.assert_same(path, lower=10)
            self.assertNotEqual(self.result(path, lower=10.01), self.expected)
        none = volumes.write_nifti(self.folder / "in.nii", self.volume, scl_slope=float("nan"), scl_inter=float("nan"))
        self.assert_reading(none, "streams")
        self.assert_same(none)

    @needs_tiff
    def test_tiff(self):
        for big_endian in (False, True):
            for big in (False, True):
                for rows in (1, 7, 40):
                    path = self.folder / "in.tif"
                    volumes.write_tiff(path, self.volume, big_endian, rows_per_strip=rows, big=big)
                    self.assert_reading(path, "streams")
                    self.assert_same(path)

    @needs_tiff
    def test_compressed_tiff(self):
        for rows in (7, 40):
            for big_endian in (False, True):
                path = self.folder / "in.tiff"
                volumes.write_tiff(path, self.volume, big_endian, "deflate", rows)
                self.assert_reading(path, "does not stream: it is compressed")
                self.assert_same(path)

    @needs_tiff
    def test_tiles(self):
        for big in (False, True):
            for big_endian in (False, True):
                for tile in ((16, 16), (32, 48), (128, 64)):
                    options = {"big": big, "tile": tile}
                    path = volumes.write_tiff(self.folder / "in.tif", self.volume, big_endian, **options)
                    self.assert_reading(path, "streams")
                    self.assert_same(path)
                    path = volumes.write_tiff(self.folder / "in.tif", self.volume, big_endian, "deflate", **options)
                    self.assert_reading(path, "does not stream: it is compressed")
                    self.assert_same(path)

    @needs_tiff
    def test_values_and_jobs_of_tiles(self):
        volumes.write_tiff(self.folder / "in.tif", self.volume, tile=(32, 16))
        values, maps = [], []
        for name in ("in.tif", "reference.mha"):
            values.append(self.run_program("info", name, "--values").stdout.split("\nvalues ")[1])
            self.extract(name, "sub.mha", "--thickness-map", "t.mha", "--sub-voxel", "--lower", 50, "--overwrite")
            maps.append(volumes.read_data(self.folder / "t.mha"))
        self.assertEqual(*values)
        self.assertEqual(*maps)
        self.run_program("plan", "in.tif", "out.mha", "job", "--lower", 50, "--thickness", 3)
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertEqual(volumes.read_data(self.folder / "out.mha"), self.expected[0])

    @needs_tiff
    def test_tiff_of_all_types(self):
        volume = volumes.box_with_plate(size=(30, 20, 12))
        self.expected = self.result(volumes.write_meta(self.folder / "reference.mha", volume))
        for kind in volumes.TYPES:
            for packing in ("none", "deflate"):
                for tile in (None, (16, 16)):
                    path = self.folder / "in.tif"
                    self.assert_same(volumes.write_tiff(path, volume.as_type(kind), packing=packing, tile=tile))

    @needs_tiff
    def test_tiff_that_lists_one_slice_of_many(self):
        """As ImageJ writes stacks of more than 4 GB."""
        content = volumes.write_tiff(
            self.folder / "in.tif",
            volumes.Volume((70, 40), self.volume.voxels[: 70 * 40], kind="int16"),
            True,
            rows_per_strip=40,
            tag_273=[8 + 70 * 40 * 2 + 1000],
            tag_270=b"ImageJ=1.53t\nimages=12\nslices=12\n\0",
        ).read_bytes()
        begin = 8 + 70 * 40 * 2
        content = content[:8] + bytes(70 * 40 * 2) + content[begin:].ljust(1000, b"\0") + self.volume.data(True)
        (self.folder / "in.tif").write_bytes(content)
        self.assertIn("70 x 40 x 12", self.run_program("info", "in.tif").stdout)
        self.assert_same("in.tif")
        (self.folder / "in.tif").write_bytes(content[:-1])
        self.assert_fails(CORRUPT, ["in.tif"], "extract", "in.tif", "out.mha", "--thickness", 3)


if __name__ == "__main__":
    unittest.main()
