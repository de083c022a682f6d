# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Series of pictures that other programs wrote: the same results as the volume in one file, and every fault refused."""

import json
import os
import struct
import unittest
import zlib

import volumes
from program import CORRUPT, FAILURE, USAGE, needs_tiff
from series import SeriesTestCase

READS_PICTURES = os.environ.get("MEDIALVOXEL_READS_PICTURES", "1") == "1"

needs_pictures = unittest.skipUnless(READS_PICTURES, "the program was built without readers of pictures")


class PictureTest(SeriesTestCase):
    """Images that say nothing of space, in the order of the numbers in their names."""

    SPACING = ["--spacing", "0.8,0.7,1.5"]

    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(spacing=(0.8, 0.7, 1.5))
        self.extract(volumes.write_meta(self.folder / "in.mha", self.volume), "expected.mha", "--lower", 50)
        self.expected = (self.folder / "expected.mha").read_bytes()

    def write_pillow(self, name, folder="pictures", volume=None, **spec):
        return self.write("pillow", "PIL", volume or self.volume, folder, name=name, **spec)

    def write_tifffile(self, name="slice_{:03}.tif", folder="tiff", volume=None, **spec):
        return self.write("tifffile", "tifffile", volume or self.volume, folder, name=name, **spec)

    def assert_same(self, source, *arguments):
        result = self.extract(source, "l.mha", "--lower", 50, "--overwrite", *self.SPACING, *arguments)
        self.assertEqual((self.folder / "l.mha").read_bytes(), self.expected, source)
        self.assertEqual(result.warnings, [])

    @needs_tiff
    def test_stacks_of_tiff(self):
        for name, options in (
            ("plain", {}),
            ("big", {"byteorder": ">"}),
            ("packed", {"compression": "zlib"}),
            ("bigtiff", {"bigtiff": True}),
        ):
            self.assert_same(self.write_tifffile(folder=name, options=options))
        for kind in ("uint16", "int16", "float32"):
            folder = self.write_tifffile(folder=kind, volume=self.volume.as_type(kind))
            self.assert_same(folder)
            self.assertEqual(self.info(folder)["type"], kind)

    @needs_pictures
    def test_stacks_of_pictures(self):
        for name, spec in (
            ("a{}.png", {}),
            ("a{}.bmp", {}),
            ("a{}.jpg", {"options": {"quality": 95}}),
            ("a{}.jpeg", {"options": {"quality": 95, "progressive": True}}),
        ):
            self.assert_same(self.write_pillow(name, folder=name[4:], **spec))
        folder = self.write_pillow("a{}.png", "deep", self.volume.as_type("uint16"))
        self.assert_same(folder)
        self.assertEqual(self.info(folder)["type"], "uint16")

    @needs_pictures
    def test_patterns_and_ranges(self):
        folder = self.write_pillow("s_{:04}.png", first=98)
        self.write_pillow("other{}.png")
        (folder / "notes.txt").write_text("no slice")
        for pattern in ("s_*.png", "s_0???.png", "s_%04d.png"):
            self.assert_same(folder / pattern)
        self.assert_fails(CORRUPT, ["s_%d.png", "no slices"], "info", folder / "s_%d.png")
        self.assert_same(folder / "s_%04d.png", "--slices", "98-113")
        self.assertEqual(self.info(folder / "s_%04d.png", "--slices", "100-101")["size"], "24 x 20 x 2")
        self.assertEqual(self.info(folder / "s_*.png", "--slices", "2-3")["size"], "24 x 20 x 2")
        self.assertEqual(self.info(folder / "s_*.png", "--slices", "2-2")["size"], "24 x 20")
        self.assert_fails(
            FAILURE, ["s_0114.png", "missing", "98 to 114"], "info", folder / "s_%04d.png", "--slices", "98-114"
        )
        self.assert_fails(CORRUPT, ["notes.txt", "not an image"], "info", folder / "n*")
        self.assert_fails(CORRUPT, ["x*.png", "no slices", "DICOM", "PNG"], "info", folder / "x*.png")
        self.assert_fails(FAILURE, ["nowhere"], "info", "nowhere/*.png")
        self.assert_fails(USAGE, ["--slices", "MetaImage"], "info", "in.mha", "--slices", "1-2")
        self.assert_fails(USAGE, ["--series", "MetaImage"], "info", "in.mha", "--series", "1.2")
        self.assert_fails(USAGE, ["'scan/*.png'"], "info", folder / "notes.txt")

    @needs_pictures
    def test_numbers_count_as_numbers(self):
        self.assert_same(self.write_pillow("a{}.png", first=95))
        folder = self.write_pillow("b{}.png", "tens", options={})
        for number in reversed(range(16)):
            (folder / f"b{number}.png").rename(folder / f"b{10 * number + 5}.png")
        self.assert_same(folder)

    @needs_pictures
    def test_missing_and_doubled_numbers_name_the_files(self):
        folder = self.write_pillow("a{:02}.png")
        (folder / "a07.png").rename(folder / "a7.png")
        self.assert_same(folder)
        (folder / "a07.png").write_bytes((folder / "a06.png").read_bytes())
        self.assert_fails(CORRUPT, ["a07.png", "a7.png", "doubled"], "info", folder)
        (folder / "a07.png").unlink()
        (folder / "a7.png").unlink()
        for source in (folder, folder / "*.png", folder / "a%02d.png"):
            self.assert_fails(CORRUPT, ["missing between", "a06.png", "a08.png"], "info", source)

    @needs_pictures
    def test_slices_that_differ_or_are_no_gray_pictures_are_refused(self):
        folder = self.write_pillow("a{:02}.png")
        good = (folder / "a07.png").read_bytes()
        smaller = self.write_pillow("a{:02}.png", "small", volumes.box_with_plate((24, 19, 16)))
        deep = self.write_pillow("a{:02}.png", "deep", self.volume.as_type("uint16"))
        color = self.write_pillow("a{:02}.png", "color", mode="RGB")
        palette = self.write_pillow("a{:02}.bmp", "palette", mode="P", options={})
        for other, parts in ((smaller, ["24 x 20", "24 x 19"]), (deep, ["uint8", "uint16"]), (color, ["color image", "color type 2"])):
            (folder / "a07.png").write_bytes((other / "a07.png").read_bytes())
            self.assert_fails(CORRUPT, ["a07.png", *parts], "info", folder)
        (folder / "a07.png").write_bytes(good)
        (folder / "a07.bmp").write_bytes((palette / "a07.bmp").read_bytes())
        self.assert_fails(CORRUPT, ["PNG", "BMP", "a07.bmp", "pattern"], "info", folder)
        self.assert_same(folder / "*.png")

    @needs_pictures
    def test_damaged_pictures_are_refused(self):
        for name in ("a{:02}.png", "a{:02}.bmp", "a{:02}.jpg"):
            folder = self.write_pillow(name, name[7:])
            victim = folder / name.format(7)
            good = victim.read_bytes()
            for content, sees in ((good[: len(good) * 2 // 3], False), (good[:20], True), (b"", True), (b"MZ" + good[2:], True)):
                victim.write_bytes(content)
                if sees:
                    self.assert_fails(CORRUPT, [victim], "info", folder)
                self.assert_fails(CORRUPT, [victim], "extract", folder, "no.mha", "--lower", 50, "--thickness", 3)
            victim.write_bytes(good)
            self.assert_same(folder)

    @needs_pictures
    def test_hostile_sizes_are_refused(self):
        folder = self.write_pillow("a{:02}.png")
        victim = folder / "a07.png"
        good = victim.read_bytes()
        header = struct.pack(">II", 900000, 900000) + good[24:29]
        checksum = struct.pack(">I", zlib.crc32(b"IHDR" + header))
        victim.write_bytes(good[:16] + header + checksum + good[33:])
        self.assert_fails(CORRUPT, ["a07.png", "900000 x 900000", "cannot be in"], "info", folder)
        folder = self.write_pillow("a{:02}.bmp", "bmp")
        victim = folder / "a07.bmp"
        good = victim.read_bytes()
        for place, value, part in ((18, 9999, "its size needs"), (22, 1 << 30, "1048576"), (30, 1, "compression 1")):
            victim.write_bytes(good[:place] + struct.pack("<I", value) + good[place + 4 :])
            self.assert_fails(CORRUPT, ["a07.bmp", part], "info", folder)

    @needs_pictures
    def test_outputs_do_not_replace_slices(self):
        folder = self.write_pillow("a{:02}.png")
        self.assert_fails(
            USAGE,
            ["a03.png", "would replace the input"],
            *("extract", folder, "l.mha", "--preview", folder / "a03.png", "--overwrite", "--lower", 50),
        )
        self.extract(folder / "*.png", folder / "l.mha", "--lower", 50, *self.SPACING)
        self.assert_same(folder)

    @needs_pictures
    def test_no_distance_of_slices_is_a_warning(self):
        result = self.extract(self.write_pillow("a{:02}.png"), "l.mha", "--lower", 50, "--report", "r.json")
        self.assertIn("how far they are from each other", result.warnings[0])
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["warnings"][0]["code"], "unknown_spacing")
        self.assertIsNone(report["input"]["unit"])

    def test_empty_folders_are_refused(self):
        (self.folder / "empty").mkdir()
        self.assert_fails(CORRUPT, ["empty", "there are no slices", "DICOM"], "info", "empty")


if __name__ == "__main__":
    unittest.main()
