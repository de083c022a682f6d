# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""DICOM files that hold several slices or are packed as a whole: the results of the volume in one file, or a refusal."""

import json
import pathlib
import random
import subprocess
import unittest

import volumes
from program import CORRUPT, PROGRAM, USAGE
from series import SeriesTestCase, in_hounsfield_units, needs_dicom

WRITE_FRAMES = pathlib.Path(__file__).with_name("write_frames.py")
SIZE = (20, 18, 12)
SYNTAXES = ("explicit", "implicit", "big", "deflated", "rle", "jpeg-ls", "jpeg", "jpeg-2000")


def shuffled(count):
    order = list(range(count))
    random.Random(3).shuffle(order)
    return order


@needs_dicom
class DicomFramesTest(SeriesTestCase):
    def write_frames(self, volume, name="frames.dcm", groups=True, **spec):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        self.call_writer([WRITE_FRAMES], "pydicom", volume, file=str(path), groups=groups, **spec)
        return path

    def write_slices(self, volume, name, **spec):
        return self.write("dicom", "pydicom", volume, name, series="1.2.3.4", intercept=-1024, **spec)

    def codes(self, source):
        arguments = ["v.mha", "--distance", "d.mha", "--lower", 1000, "--report", "r.json", "--overwrite"]
        self.run_program("distance", source, *arguments)
        return {warning["code"] for warning in json.loads((self.folder / "r.json").read_text())["warnings"]}

    def test_every_transfer_syntax_gives_the_results_of_the_volume(self):
        volume = in_hounsfield_units(SIZE)
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume, Offset="-3 4.5 -20"))
        for syntax in SYNTAXES:
            for groups in (True, False):
                with self.subTest(syntax=syntax, groups=groups):
                    placed = {"order": shuffled(12)} if groups else {"all": self.placed(volume)}
                    file = self.write_frames(
                        volume, "frames.dcm", groups, syntax=syntax, origin=(-3, 4.5, -20), bits=12, **placed
                    )
                    self.assertEqual(self.results(file), expected)
                    if groups and syntax in ("explicit", "deflated", "jpeg-2000"):
                        for options in (["--threads", 1], ["--threads", 2, "--divisions", 5], ["--memory", "64M"]):
                            self.assertEqual(self.results(file, *options), expected, options)

    @staticmethod
    def placed(volume):
        return {
            "SpacingBetweenSlices": str(volume.spacing[2]),
            "ImagePositionPatient": ["-3", "4.5", "-20"],
            "ImageOrientationPatient": ["1", "0", "0", "0", "1", "0"],
        }

    def test_a_file_has_any_name_and_may_be_in_a_folder(self):
        volume = in_hounsfield_units(SIZE)
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        for name in ("IM0001", "1.2.840.5", "scan.DCM"):
            self.assertEqual(self.results(self.write_frames(volume, f"folder-{name}/{name}")), expected, name)
            self.assertEqual(self.results(self.folder / f"folder-{name}"), expected, name)

    def test_info_tells_of_the_frames(self):
        table = self.info(self.write_frames(in_hounsfield_units(SIZE), origin=(1, 2, 3)))
        self.assertEqual(table["size"], "20 x 18 x 12")
        self.assertEqual(table["spacing"], "0.8 x 0.7 x 1.5")
        self.assertEqual(table["origin"], "1, 2, 3")
        self.assertEqual(table["slices"], f"DICOM series 1.2.3.4, 12 frames, {self.folder / 'frames.dcm'}")
        self.assertEqual(self.info("frames.dcm", "--slices", "2-5")["size"], "20 x 18 x 4")
        self.assertEqual(self.run_program("info", "frames.dcm", "--slices", "2-2").warnings, [])

    def test_jobs_and_meshes_know_the_file(self):
        volume = in_hounsfield_units(SIZE)
        file = self.write_frames(volume, order=shuffled(12))
        self.extract(file, "whole.mha", "--lower", 1000, "--mesh", "whole.ply")
        self.extract(volumes.write_meta(self.folder / "in.mha", volume), "l.mha", "--lower", 1000, "--mesh", "in.ply")
        mesh = (self.folder / "whole.ply").read_bytes()
        self.assertIn(b" in mm\n", mesh)  # as a file of DICOM tells
        self.assertEqual(mesh.replace(b" in mm\n", b" in units of the spacing\n"), (self.folder / "in.ply").read_bytes())
        self.run_program("plan", file, "out.mha", "job", "--lower", 1000, "--thickness", 3, "--divisions", 3)
        for _ in range(3):
            self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertEqual((self.folder / "out.mha").read_bytes(), (self.folder / "whole.mha").read_bytes())

    def test_scales_of_frames_may_differ(self):
        volume = in_hounsfield_units(SIZE)
        expected = self.info(volumes.write_meta(self.folder / "in.mha", volume), "--values")
        slopes, intercepts = [1, 2, 0.5] * 4, [-1024, -2000, -1500] * 4
        volume.voxels = [2 * (value // 2) for value in volume.voxels]
        expected = self.info(volumes.write_meta(self.folder / "in.mha", volume), "--values")
        file = self.write_frames(volume, scale_is_shared=False, slopes=slopes, intercepts=intercepts)
        table = self.info(file, "--values")
        for name in ("minimum", "maximum", "mean"):
            self.assertEqual(float(table[name]), float(expected[name]), name)

    def test_negative_values_of_few_bits(self):
        volume = in_hounsfield_units(SIZE)
        volume.voxels = [max(-1000, min(2000, value)) for value in volume.voxels]
        for syntax in ("explicit", "jpeg-ls", "jpeg-2000", "rle"):
            for bits in (12, 13):
                with self.subTest(syntax=syntax, bits=bits):
                    file = self.write_frames(volume, syntax=syntax, bits=bits, is_signed=True, intercepts=[0] * 12)
                    table = self.info(file, "--values")
                    self.assertEqual(float(table["minimum"]), min(volume.voxels))
                    self.assertEqual(float(table["maximum"]), max(volume.voxels))

    def test_frames_in_several_fragments_need_a_table(self):
        volume = in_hounsfield_units(SIZE)
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        file = self.write_frames(volume, syntax="jpeg-2000", fragments=2)
        self.assertEqual(self.results(file), expected)
        content = file.read_bytes()
        table = content.index(b"\xe0\x7f\x10\x00") + 12
        self.assertEqual(content[table : table + 8], b"\xfe\xff\x00\xe0" + bytes([48, 0, 0, 0]))
        file.write_bytes(content[: table + 4] + bytes(4) + content[table + 56 :])
        self.assert_refused("12 frames are in 24 fragments, and no table tells which")

    def assert_refused(self, text, status=CORRUPT, source="frames.dcm"):
        line = self.run_program("info", source, status=status).stderr
        self.assertIn(text, line)
        self.assertIn(pathlib.Path(source).name, line)
        self.assertEqual(line.count("\n"), 1, line)

    def test_frames_at_wrong_places_are_refused(self):
        volume = in_hounsfield_units(SIZE)
        regular = [1.5 * number for number in range(12)]
        for places, text in (
            (regular[:6] + [place + 1.5 for place in regular[6:]], "1 slice is missing between"),
            (regular[:5] + regular[4:11], "a slice is doubled"),
            (regular[:5] + [6.9] + regular[6:], "not equally spaced"),
        ):
            self.write_frames(volume, places=places)
            self.assert_refused(text)
            self.assert_refused("frame ")
        self.write_frames(volume, places=regular[:6] + regular[:6], times=[1] * 6 + [2] * 6)
        self.assert_refused("acquisitions that overlap")

    def test_frames_without_places_tell_their_distance_or_it_is_a_guess(self):
        volume = in_hounsfield_units(SIZE)
        offsets = {"GridFrameOffsetVector": [str(7 + 1.5 * number) for number in range(12)]}
        for elements, spacing, is_known in (
            ({"SpacingBetweenSlices": "1.5"}, "1.5", True),
            (offsets, "1.5", True),
            ({}, "1", False),
            ({"SpacingBetweenSlices": "0"}, "1", False),
        ):
            file = self.write_frames(volume, groups=False, all=elements)
            self.assertEqual(self.info(file)["spacing"], f"0.8 x 0.7 x {spacing}")
            codes = self.codes(file)
            self.assertEqual("unknown_spacing" not in codes, is_known)
            self.assertNotIn("unknown_slice_order", codes)
        self.write_frames(volume, groups=False, all={"SpacingBetweenSlices": "-1.5"})
        self.assertEqual(self.info("frames.dcm")["origin"], "0, 0, -16.5")
        self.write_frames(volume, groups=False, all={"GridFrameOffsetVector": ["0", "1"]})
        self.assert_refused("GridFrameOffsetVector is '0\\1'; it must have 12 numbers")

    def test_a_file_of_one_slice_is_read_with_a_word(self):
        volume = in_hounsfield_units(SIZE)
        folder = self.write_slices(volume, "slices")
        file = next(folder.iterdir())
        self.assertEqual(self.info(file)["size"], "20 x 18")
        result = self.run_program("info", file)
        self.assertIn(f"give its folder, {folder}, to read the series", " ".join(result.warnings))
        self.assertIn("single_slice", self.codes(file))
        self.assertNotIn("single_slice", self.codes(folder))

    def test_deflated_slices_are_read(self):
        volume = in_hounsfield_units(SIZE)
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        for number in range(12):
            part = volumes.Volume((20, 18, 1), volume.voxels[360 * number :][:360], volume.spacing, volume.kind)
            place = {**self.placed(volume), "ImagePositionPatient": ["0", "0", str(1.5 * number)]}
            self.write_frames(part, f"slices/{number}", False, syntax="deflated", all=place)
        self.assertEqual(self.results("slices"), expected)
        content = (self.folder / "slices/3").read_bytes()
        (self.folder / "slices/3").write_bytes(content[:-20])
        self.assertIn("end early", self.run_program("info", "slices", status=CORRUPT).stderr)

    def test_padding_is_left_out_of_histograms(self):
        """Two classes at -1000 and 0, and a third of the voxels outside of the field of view."""
        size, measured = (12, 12, 6), [-1000] * 400 + [-20, 20] * 88
        for value, elements in (
            (-3024, {"PixelPaddingValue": -3024}),
            (-3024, {}),
            (-1010, {"PixelPaddingValue": -1010}),
            (-1010, {"PixelPaddingValue": -1100, "PixelPaddingRangeLimit": -1005}),
            (30000, {"PixelPaddingValue": 30000}),
            (30000, {}),
            (-500, {"PixelPaddingValue": -500}),
        ):
            for groups in (True, False):
                with self.subTest(value=value, elements=elements, groups=groups):
                    volume = volumes.Volume(size, measured + [value] * 288, (1, 1, 1), "int16")
                    spec = {"is_signed": True, "intercepts": [0] * 6, "all": elements}
                    for syntax in ("explicit", "implicit"):
                        file = self.write_frames(volume, groups=groups, syntax=syntax, **spec)
                        table = self.info(file, "--values")
                        self.assertEqual((table["otsu"], table["1 %"], table["99 %"]), ("-999", "-1000", "20"))
                        self.assertIn(", 288 voxels, left out of percentiles and otsu", table["padding"])
        volume = volumes.Volume(size, measured + [-1000] * 288, (1, 1, 1), "int16")
        folder = self.write_slices(volume, "slices", **{"all": {"PixelPaddingValue": 24}})
        self.assertEqual(self.info(folder, "--values")["padding"].split(",")[0], "-1000")

    def test_wrong_numbers_of_frames_are_refused(self):
        volume = in_hounsfield_units(SIZE)
        for number, text in (
            ("13", "cannot be in"),
            ("11", "it has 11 frames and tells of 12"),
            ("100000", "it must be 1 to 65536"),
        ):
            self.write_frames(volume, all={"NumberOfFrames": number})
            self.assert_refused(text)
        self.write_frames(volume, all={"PhotometricInterpretation": "PALETTE COLOR"})
        self.assert_refused("only gray values are read")

    def test_more_elements_than_gdcm_is_given(self):
        volume = in_hounsfield_units(size=(2, 2, 17000))
        table = self.info(self.write_frames(volume), "--values")
        self.assertEqual(table["size"], "2 x 2 x 17000")
        self.assertAlmostEqual(float(table["mean"]), sum(volume.voxels) / len(volume.voxels), 6)

    def test_damaged_bytes_never_end_without_a_message(self):
        volume = in_hounsfield_units(size=(8, 8, 3))
        generator = random.Random(5)
        for syntax in ("explicit", "deflated", "rle", "jpeg-2000"):
            content = self.write_frames(volume, syntax=syntax).read_bytes()
            for _ in range(20):
                damaged = bytearray(content)
                for _ in range(generator.choice((1, 3, 10))):
                    damaged[generator.randrange(132, len(damaged))] = generator.randrange(256)
                if generator.random() < 0.2:
                    del damaged[generator.randrange(132, len(damaged)) :]
                (self.folder / "frames.dcm").write_bytes(damaged)
                result = subprocess.run(
                    [PROGRAM, "info", "frames.dcm", "--values"],
                    cwd=self.folder, capture_output=True, text=True, check=False, errors="replace",
                )  # fmt: skip
                self.assertIn(result.returncode, (0, USAGE, CORRUPT), result.stderr)


if __name__ == "__main__":
    unittest.main()
