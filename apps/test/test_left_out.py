# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Formats and libraries that the program was built without: what stays is read as before, and errors say what to build
the program with."""

import os
import pathlib
import re
import struct
import subprocess
import unittest

import volumes
import zarr_folder
from program import PROGRAM, USAGE, ProgramTestCase

TEXT, ZARR, SLICES = (f"MedialVoxel_FORMAT_{name}=ON" for name in ("TEXT", "ZARR", "SLICES"))


class LeftOutFormatsTest(ProgramTestCase):
    PROGRAM = os.environ["MEDIALVOXEL_WITHOUT_FORMATS"]

    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def assert_left_out(self, name, format_, remedy):
        for command in (["info", name], ["extract", name, "out.mha", "--lower", 50]):
            self.assert_fails(USAGE, [name, f"built without {format_};", remedy], *command)

    def test_plain_formats_are_read_and_written_as_by_the_whole_program(self):
        for name, write, options in (
            ("a.mha", volumes.write_meta, {"compressed": True}),
            ("b.mhd", volumes.write_meta, {}),
            ("c.nrrd", volumes.write_nrrd, {"compressed": True}),
            ("d.nii", volumes.write_nifti, {}),
            ("e.nii.gz", volumes.write_nifti, {}),
            ("f.raw", volumes.write_raw, {}),
        ):
            write(self.folder / name, self.volume, **options)
            raw = ["--raw-size", ",".join(map(str, self.volume.size)), "--raw-type", "uint8"] if "raw" in name else []
            for output in ("labels.mha", "labels.nrrd", "labels.nii.gz"):
                arguments = ["extract", name, output, "--lower", "50", "--compress", *raw, "--overwrite"]
                self.run_program(*arguments)
                labels = (self.folder / output).read_bytes()
                subprocess.run([PROGRAM, *arguments], cwd=self.folder, check=True, capture_output=True)
                self.assertEqual((self.folder / output).read_bytes(), labels, (name, output))

    def test_files_of_formats_that_are_left_out(self):
        volumes.write_tiff(self.folder / "a.tif", self.volume)
        self.assert_left_out("a.tif", "TIFF", f"{SLICES} and libtiff")
        volumes.write_mrc(self.folder / "a.mrc", self.volume)
        self.assert_left_out("a.mrc", "MRC", TEXT)
        for name in ("a.vol", "a.vol.info", "a.vgi"):
            (self.folder / name).write_bytes(b"[file1]\n")
            self.assert_left_out(name, "VOL", TEXT)
        for name in ("a.dcm", "a.PNG"):
            (self.folder / name).write_bytes(b"one slice")
            self.assert_left_out(name, "series of slices", SLICES)
        (self.folder / "IM0001").write_bytes(bytes(128) + b"DICM")
        self.assert_left_out("IM0001", "series of slices", SLICES)

    def test_folders_and_patterns_of_formats_that_are_left_out(self):
        (self.folder / "scan").mkdir()
        (self.folder / "scan" / "a1.png").write_bytes(b"slice")
        for name in ("scan", "scan/*.png", "scan/a%d.png", "scan/a%04d.png", "scan/a?.tif"):
            self.assert_left_out(name, "series of slices", SLICES)
        for name in ("named.zarr", "unnamed"):
            zarr_folder.write_image(self.folder / name, self.volume, (8, 8, 8))
            self.assert_left_out(name, "Zarr", ZARR)

    def test_all_extensions_of_the_reference_are_known(self):
        page = (pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "doc/reference/formats.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| `(\.[\w.]+)` \| (\w+) \| (?:yes|no) \| (?:yes|no) \|", page, re.MULTILINE)
        self.assertGreater(len(rows), 15)
        for extension, format_ in rows:
            name = "a" + extension
            (self.folder / name).write_bytes(b"")
            if format_ in ("MetaImage", "NRRD", "NIfTI"):
                self.assert_fails(4, [name], "info", name)
            else:
                self.assert_fails(USAGE, [name, f"built without {format_};"], "info", name)

    def test_unknown_names_are_told_apart(self):
        (self.folder / "a.xyz").write_bytes(b"")
        message = self.run_program("info", "a.xyz", status=USAGE).stderr
        self.assertRegex(message, "unknown format '.xyz'; .* files that end with .mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz, .hdr ")
        self.assert_fails(1, ["none.xyz", "no such file"], "info", "none.xyz")
        os.mkfifo(self.folder / "pipe")
        self.assert_fails(1, ["pipe", "not a regular file"], "info", "pipe")

    def test_outputs_of_formats_that_are_left_out(self):
        for command in ("extract", "distance"):
            self.assert_fails(USAGE, ["out.zarr", "built without Zarr;", ZARR], command, "in.mha", "out.zarr", "--lower", 50)
            message = self.run_program(command, "in.mha", "out.xyz", "--lower", 50, status=USAGE).stderr
            self.assertRegex(message, r"written as .mha or .mhd or .nrrd or .nhdr or .nii or .nii.gz \(")


class LeftOutLibrariesTest(ProgramTestCase):
    PROGRAM = os.environ["MEDIALVOXEL_WITHOUT_LIBRARIES"]

    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()

    def test_images_without_their_libraries(self):
        volumes.write_tiff(self.folder / "a.tif", self.volume)
        self.assert_fails(USAGE, ["a.tif", "built without TIFF;", "libtiff 4.5"], "info", "a.tif")
        for name, format_, library in (("s.tif", "TIFF", "libtiff"), ("s.png", "PNG", "libpng"), ("s.jpg", "JPEG", "libjpeg")):
            folder = self.folder / name[2:]
            folder.mkdir()
            (folder / name).write_bytes(b"slice")
            for source in (folder, folder / "s.*"):
                self.assert_fails(USAGE, [name, f"built without {format_};", library], "info", source)
        (self.folder / "empty").mkdir()
        self.assert_fails(4, ["there are no slices; those are images of DICOM, BMP"], "info", "empty")

    def test_bmp_needs_no_library(self):
        width, height, slices = self.volume.size
        data = self.volume.data()
        palette = b"".join(bytes((color, color, color, 0)) for color in range(256))
        for number in range(slices):
            rows = [data[(number * height + y) * width :][:width] for y in range(height)]
            begin = struct.pack("<2sIHHI", b"BM", 0, 0, 0, 54 + len(palette))
            # The first slice counts its rows from above.
            header = struct.pack("<IiiHHIIiiII", 40, width, height if number else -height, 1, 8, 0, 0, 0, 0, 0, 0)
            voxels = b"".join(row + bytes(-width % 4) for row in (reversed(rows) if number else rows))
            (self.folder / f"s{number:03}.bmp").write_bytes(begin + header + palette + voxels)
        volumes.write_meta(self.folder / "in.mha", self.volume)
        for name in ("s*.bmp", "in.mha"):
            self.run_program("extract", name, name[0] + ".nrrd", "--lower", 50, "--spacing", "1,1,1")
        self.assertEqual((self.folder / "s.nrrd").read_bytes(), (self.folder / "i.nrrd").read_bytes())

    def test_chunks_without_their_libraries(self):
        for packer in ("blosc", "zstd"):
            zarr_folder.write_image(self.folder / packer, self.volume, (8, 8, 8), compressor={"id": packer})
            self.assert_fails(4, [f"lib{packer}"], "info", packer)
        volumes.write_meta(self.folder / "in.mha", self.volume)
        self.assert_fails(
            USAGE,
            ["out.zarr", "built without libblosc"],
            *("extract", "in.mha", "out.zarr", "--lower", 50, "--compress", "blosc-zstd"),
        )


if __name__ == "__main__":
    unittest.main()
