# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Voxels that a text of keys and values describes: the labels of other formats, and clear errors."""

import shutil
import unittest

import text_headers
import volumes
from program import CORRUPT, FAILURE, ProgramTestCase

NAMES = ("in.vgi", "in.pcr", "in.vol.info")


class TextHeadersTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(spacing=(0.5, 0.5, 0.5), kind="uint16")
        self.expected = self.labels(volumes.write_meta(self.folder / "reference.mha", self.volume))
        self.assertGreater(self.expected[1].count(2) + self.expected[1].count(3), 100)

    def labels(self, source):
        self.extract(source, "labels.mha", "--lower", 72, "--overwrite", "--divisions", 3, thickness=2)
        return volumes.read_header(self.folder / "labels.mha")[0], volumes.read_data(self.folder / "labels.mha")

    def write(self, name, *changes, **options):
        return text_headers.write(self.folder / name, options.pop("volume", self.volume), changes=changes, **options)

    def assert_same(self, source):
        self.assertEqual(self.labels(source), self.expected, source)

    def assert_refused(self, name, *parts, changes=()):
        path = self.write(name, *changes)
        for command in (("info", path), ("extract", path, "out.mha")):
            self.assert_fails(CORRUPT, [name, *parts], *command)

    def test_all_types(self):
        for name, kinds in zip(
            NAMES,
            (
                ("uint8", "uint16", "uint32", "int8", "int16", "int32", "float32"),
                ("uint8", "uint16", "float32"),
                ("uint8", "uint16", "int16", "uint32", "int32", "float32", "float64"),
            ),
        ):
            for kind in kinds:
                self.assert_same(self.write(name, volume=self.volume.as_type(kind)))
                text = self.run_program("info", name).stdout
                self.assertRegex(text, rf"type +{kind}\n")
                self.assertRegex(text, r"reading +streams")
                self.assertRegex(text, r"format +VOL\n")

    def test_names_that_windows_wrote(self):
        """An umlaut is one byte in the header, and two in the name of the file."""
        data = self.folder / "Pr\u00fcfung.raw"
        data.write_bytes(self.volume.data())
        header = volumes.write_meta(self.folder / "in.mhd", self.volume, ElementDataFile=data.name)
        for source, name in ((header, data.name), (self.write("in.vgi"), "in.vol")):
            content = source.read_bytes()
            self.assertIn(name.encode(), content)
            source.write_bytes(content.replace(name.encode(), data.name.encode("latin-1")))
            self.assert_same(source.name)

    def test_either_file_may_be_named(self):
        for name in NAMES:
            header = self.write(name)
            self.assert_same("in.vol")
            header.rename(self.folder / name.upper())
            if "vol" not in name:
                self.assert_same(name.upper())
            (self.folder / name.upper()).unlink()

    def test_jobs(self):
        """All processes of a job read the voxels; a change of either file ends it."""
        for name in ("in.vgi", "in.vol"):
            self.write("in.vgi")
            self.run_program("plan", name, "out.mha", "job", "--lower", 72, "--thickness", 2, "--overwrite")
            self.run_program("work", "job")
            self.run_program("finalize", "job")
            self.assertEqual(volumes.read_data(self.folder / "out.mha"), self.expected[1])
            shutil.rmtree(self.folder / "job")
            for changed in ("in.vgi", "in.vol"):
                self.run_program("plan", name, "out.mha", "job", "--lower", 72, "--overwrite")
                path = self.folder / changed
                content = path.read_bytes()
                path.write_bytes(content + b"\n")
                self.assert_fails(FAILURE, [changed, "has changed since the job was planned"], "work", "job")
                path.write_bytes(content)
                shutil.rmtree(self.folder / "job")

    def test_what_may_be_left_out(self):
        self.write("in.vol.info", ("DATA_TYPE = float32\n", ""), volume=self.volume.as_type("float32"))
        self.assert_same("in.vol.info")
        self.assert_same(self.write("in.pcr", ("VOL_File=D:\\scans\\in.vol\n", "")))
        self.write("in.pcr", ("VoxelSizeRec=0.5\n", ""))
        self.assertRegex(self.run_program("info", "in.pcr").stdout, r"spacing +1 x 1 x 1\n")
        path = self.write("in.vol.info", ("LOWBYTEFIRST", "HIGHBYTEFIRST"), big_endian=True)
        self.assert_same(path)

    def test_bytes_before_the_voxels(self):
        self.assert_same(self.write("in.vgi", ("SkipHeader = 0", "SkipHeader = 17"), before=b"seventeen bytes.."))

    def test_units(self):
        for unit, value in (("um", 500), ("\xb5m", 500), ("cm", 0.05), ("m", 0.0005), ("inch", 0.5 / 25.4)):
            self.write("in.vgi", ("unit = mm", f"unit = {unit}"), ("0.5 0.5 0.5", f"{value} {value} {value}"))
            text = self.run_program("info", "in.vgi").stdout
            spacing = [float(part) for part in text.split("spacing")[1].split("\n")[0].split(" x ")]
            for found in spacing:
                self.assertAlmostEqual(found, 0.5, places=9)

    def test_names_with_folders_of_other_machines(self):
        for name in ("D:\\data\\in.vol", "/data/in.vol", "..\\in.vol"):
            self.assert_same(self.write("in.vgi", ("Name = in.vol", f"Name = {name}")))

    def test_lines_may_end_as_on_windows(self):
        for name in NAMES:
            path = self.write(name)
            path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
            self.assert_same(path)

    def test_refusals(self):
        for name, parts, old, new in (
            ("in.vgi", ["[file1]size", "'0'", "from 1 on"], "\nSize = 24", "\nSize = 0"),
            ("in.vgi", ["[file1]size", "more voxels"], "\nSize = 24 20 16", f"\nSize = {2**62} {2**62} 4"),
            ("in.vgi", ["[file1]size", "2 values, not 3"], "\nSize = 24 20 16", "\nSize = 24 20"),
            ("in.vgi", ["lacks the field [file1]size"], "\nSize = 24 20 16", ""),
            ("in.vgi", ["lacks the field [file1]datatype"], "\nDatatype = unsigned integer", ""),
            ("in.vgi", ["unsigned integer 12", "unsigned integer 16"], "\nBitsPerElement = 16", "\nBitsPerElement = 12"),
            ("in.vgi", ["rgba 16"], "\nDatatype = unsigned integer", "\nDatatype = rgba"),
            ("in.vgi", ["skipheader", "'-1'", "from 0 on"], "SkipHeader = 0", "SkipHeader = -1"),
            ("in.vgi", ["15360", "bytes of header"], "SkipHeader = 0", "SkipHeader = 16"),
            ("in.vgi", ["fileformat", "'jpeg'", "raw"], "FileFormat = raw", "FileFormat = jpeg"),
            ("in.vgi", ["resolution", "'0'", "greater than 0"], "resolution = 0.5", "resolution = 0"),
            ("in.vgi", ["resolution", "2 values"], "resolution = 0.5 0.5 0.5", "resolution = 0.5 0.5"),
            ("in.vgi", ["unit", "'furlong'"], "unit = mm", "unit = furlong"),
            ("in.vgi", ["[file2]", "one file"], "{volumeprimitive12}", "[file2]"),
            ("in.vgi", ["in.vol", "'other.vol'", "one volume"], "{volumeprimitive12}", "Name = other.vol"),
            ("in.vgi", ["other.vol", "missing"], "Name = in.vol", "Name = other.vol"),
            ("in.pcr", ["volume_sizex", "'x'"], "SizeX=24", "SizeX=x"),
            ("in.pcr", ["lacks", "volume_sizez"], "Volume_SizeZ=16", ""),
            ("in.pcr", ["format", "'7'", "1, 5, 10"], "Format=5", "Format=7"),
            ("in.pcr", ["voxelsizerec", "'-1'"], "VoxelSizeRec=0.5", "VoxelSizeRec=-1"),
            ("in.vol.info", ["num_x", "from 1 on"], "NUM_X =  24", "NUM_X =  -24"),
            ("in.vol.info", ["byteorder", "'MIDDLE'", "HIGHBYTEFIRST"], "LOWBYTEFIRST", "MIDDLE"),
            ("in.vol.info", ["data_type", "'PACKED_BINARY'", "float32"], "= uint16", "= PACKED_BINARY"),
            ("in.vol.info", ["voxelsize", "'nan'"], "voxelSize =  500.0", "voxelSize = nan"),
        ):
            with self.subTest(new):
                if "bytes of header" in parts or "in.vol.info" != name and "missing" in parts:
                    path = self.write(name, (old, new))
                    self.assert_fails(CORRUPT, parts, "info", path)
                else:
                    self.assert_refused(name, *parts, changes=[(old, new)])

    def test_voxels_of_another_size(self):
        for name in NAMES:
            path = self.write(name)
            for content in (self.volume.data()[:-1], self.volume.data() + b"\0"):
                (self.folder / "in.vol").write_bytes(content)
                self.assert_fails(CORRUPT, ["in.vol", len(content), "no more and no less"], "info", path)

    def test_voxels_without_their_header(self):
        (self.folder / "in.vol").write_bytes(self.volume.data())
        self.assert_fails(CORRUPT, ["in.vol", "header is missing", *NAMES], "info", "in.vol")
        self.write("in.vgi", ("Name = in.vol", "Name = other.vol"))
        (self.folder / "other.vol").write_bytes(self.volume.data())
        self.assert_fails(CORRUPT, ["in.vgi", "other.vol, not", "in.vol"], "info", "in.vol")
        self.assert_fails(FAILURE, ["none.vol", "no such file"], "info", "none.vol")
        self.assert_fails(FAILURE, ["none.vgi", "no such file"], "info", "none.vgi")

    def test_endless_headers(self):
        (self.folder / "in.vgi").write_bytes(b"[file1]\nSize = " + b"1" * 10**6)
        self.assert_fails(CORRUPT, ["in.vgi", "line 2"], "info", "in.vgi")
        (self.folder / "in.vgi").write_bytes(b"key = value\n" * 10**5)
        self.assert_fails(CORRUPT, ["in.vgi", "more than 1048576 bytes"], "info", "in.vgi")


if __name__ == "__main__":
    unittest.main()
