# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""One volume in all formats and types gives the same bytes, and outputs read back in all formats."""

import unittest

import volumes
from program import ProgramTestCase


class FormatsTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(spacing=(0.5, 0.625, 1.25))
        self.expected = self.labels(volumes.write_meta(self.folder / "reference.mha", self.volume))
        self.assertGreater(self.expected.count(2) + self.expected.count(3), 100)

    def labels(self, source, *arguments, target="labels.mha"):
        self.extract(source, target, "--lower", 72, "--overwrite", *arguments, thickness=2)
        return volumes.read_data(self.folder / target)

    def test_header_formats(self):
        for big_endian in (False, True):
            volume = self.volume.as_type("int16")
            for suffix in ("mha", "mhd"):
                path = volumes.write_meta(self.folder / f"in.{suffix}", volume, big_endian)
                self.assertEqual(self.labels(path), self.expected, path)
            for suffix in ("nrrd", "nhdr"):
                path = volumes.write_nrrd(self.folder / f"in.{suffix}", volume, big_endian)
                self.assertEqual(self.labels(path), self.expected, path)

    def test_compressed_formats(self):
        for big_endian in (False, True):
            for kind in ("uint8", "int16", "int64", "float64"):
                volume = self.volume.as_type(kind)
                for path in (
                    volumes.write_meta(self.folder / "in.mha", volume, big_endian, compressed=True),
                    volumes.write_meta(self.folder / "in.mhd", volume, big_endian, compressed=True),
                    volumes.write_nrrd(self.folder / "in.nrrd", volume, big_endian, compressed=True),
                    volumes.write_nrrd(self.folder / "in.nhdr", volume, big_endian, compressed=True),
                ):
                    self.assertEqual(self.labels(path), self.expected, (path, kind))
                    self.assertIn("does not stream", self.run_program("info", path).stdout)

    def test_all_types(self):
        for kind in volumes.TYPES:
            volume = self.volume.as_type(kind)
            path = volumes.write_meta(self.folder / "in.mha", volume)
            self.assertEqual(self.labels(path), self.expected, kind)
            path = volumes.write_nrrd(self.folder / "in.nrrd", volume)
            self.assertEqual(self.labels(path), self.expected, kind)
            for big_endian in (False, True):
                path = volumes.write_raw(self.folder / "in.raw", volume, big_endian)
                options = volumes.raw_options(volume, ":big" * big_endian)
                self.assertEqual(self.labels(path, *options), self.expected, (kind, big_endian))

    def test_bytes_before_the_voxels(self):
        header = b"header of seventeen"[:17]
        path = volumes.write_raw(self.folder / "in.raw", self.volume, header=header)
        self.assertEqual(self.labels(path, *volumes.raw_options(self.volume, ":17")), self.expected)
        data_file = self.folder / "in.img"
        data_file.write_bytes(b"one\ntwo\n" + header + self.volume.data())
        (self.folder / "in.nhdr").write_bytes(
            volumes.nrrd_header(self.volume, "in.img", line_skip=2, byte_skip=len(header))
        )
        self.assertEqual(self.labels("in.nhdr"), self.expected)
        (self.folder / "in.nhdr").write_bytes(volumes.nrrd_header(self.volume, "in.img", byte_skip=-1))
        self.assertEqual(self.labels("in.nhdr"), self.expected)
        for size in (len(header) + 8, -1):
            (self.folder / "in.mhd").write_bytes(volumes.meta_header(self.volume, "in.img", HeaderSize=size))
            self.assertEqual(self.labels("in.mhd"), self.expected)

    def test_compressed_bytes_before_the_voxels(self):
        (self.folder / "in.img").write_bytes(b"line\n" + volumes.gzip(b"skipped" + self.volume.data()))
        (self.folder / "in.nhdr").write_bytes(
            volumes.nrrd_header(self.volume, "in.img", encoding="gz", line_skip=1, byte_skip=7)
        )
        self.assertEqual(self.labels("in.nhdr"), self.expected)

    def test_streams_that_follow_each_other(self):
        data = self.volume.data()
        (self.folder / "in.img").write_bytes(volumes.gzip(data[:5000]) + volumes.gzip(data[5000:]))
        (self.folder / "in.nhdr").write_bytes(volumes.nrrd_header(self.volume, "in.img", encoding="gzip"))
        self.assertEqual(self.labels("in.nhdr"), self.expected)

    def test_lines_may_end_as_on_windows(self):
        header = volumes.meta_header(self.volume).replace(b"\n", b"\r\n")
        (self.folder / "in.mha").write_bytes(header + self.volume.data())
        self.assertIn("24 x 20 x 16", self.run_program("info", "in.mha").stdout)

    def test_output_formats(self):
        for target in ("a.mha", "a.mhd", "a.nrrd", "a.nhdr"):
            self.assertEqual(self.labels("reference.mha", target=target), self.expected, target)
            self.assertEqual(self.run_program("info", target).stdout.count("24 x 20 x 16"), 1)

    def test_output_geometry(self):
        """Labels lie half a voxel further along every axis; vectors and distances lie where the input lies."""
        volumes.write_nrrd(
            self.folder / "in.nrrd",
            self.volume,
            spacings=None,
            space="left-posterior-superior",
            space_directions="(0,0.5,0) (-0.625,0,0) (0,0,1.25)",
            space_origin="(10,20,30)",
        )
        self.labels("in.nrrd", "--vectors", "v.mha", "--distance", "d.nrrd", target="l.mha")
        fields = volumes.read_header(self.folder / "l.mha")[0]
        numbers = {name: list(map(float, fields[name].split())) for name in ("Offset", "ElementSpacing", "TransformMatrix")}
        self.assertEqual(numbers["ElementSpacing"], [0.5, 0.625, 1.25])
        self.assertEqual(numbers["TransformMatrix"], [0, 1, 0, -1, 0, 0, 0, 0, 1])
        self.assertEqual(numbers["Offset"], [10 - 0.3125, 20 + 0.25, 30 + 0.625])
        fields = volumes.read_header(self.folder / "v.mha")[0]
        self.assertEqual(list(map(float, fields["Offset"].split())), [10, 20, 30])
        self.assertEqual(fields["ElementNumberOfChannels"], "3")
        fields = volumes.read_header(self.folder / "d.nrrd")[0]
        self.assertEqual(fields["space origin"], "(10,20,30)")
        self.assertEqual(fields["space directions"], "(0,0.5,0) (-0.625,0,0) (0,0,1.25)")

    def test_volume_of_two_dimensions(self):
        size = (30, 20)
        volume = volumes.Volume(size, [], (0.5, 0.5))
        volume.voxels = [100 if 8 <= y < 12 else 0 for x, y in volume.indices()]
        for path in (
            volumes.write_meta(self.folder / "in.mha", volume),
            volumes.write_nrrd(self.folder / "in.nrrd", volume),
        ):
            self.extract(path, "out.nrrd", "--vectors", "v.nrrd", "--preview", "p.png", "--overwrite")
            labels = volumes.read_data(self.folder / "out.nrrd")
            rows = [labels[30 * y : 30 * y + 29] for y in range(20)]
            self.assertEqual([y for y, row in enumerate(rows) if any(label >= 2 for label in row)], [9])
            self.assertTrue(all(label >= 2 for label in rows[9]))
            self.assertEqual(volumes.read_header(self.folder / "v.nrrd")[0]["sizes"], "2 30 20")
        raw = volumes.write_raw(self.folder / "in.raw", volume)
        self.extract(raw, "raw.nrrd", *volumes.raw_options(volume))
        self.assertEqual(volumes.read_data(self.folder / "raw.nrrd"), labels)

    def test_info(self):
        path = volumes.write_nrrd(self.folder / "in.nhdr", self.volume.as_type("int16"))
        text = self.run_program("info", path).stdout
        for part in ("NRRD", "24 x 20 x 16", "0.5 x 0.625 x 1.25", "int16", "7680", "15360", "in.img", "streams"):
            self.assertIn(part, text)


if __name__ == "__main__":
    unittest.main()
