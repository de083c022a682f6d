# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Series of DICOM slices that other programs wrote: the same results as the volume in one file, and every fault refused."""

import json
import os
import pathlib
import random
import struct
import subprocess
import unittest

import volumes
from program import CORRUPT, FAILURE, PROGRAM, USAGE
from series import SeriesTestCase, in_hounsfield_units, needs_dicom

SERIES = "1.2.826.0.1.3680043.10.1"
OTHER_SERIES = "1.2.826.0.1.3680043.10.2"


@needs_dicom
class DicomTest(SeriesTestCase):
    def write_dicom(self, volume, folder="dicom", **spec):
        spec = {"series": SERIES, "intercept": -1024, **spec}
        return self.write("dicom", "pydicom", volume, folder, **spec)

    def test_every_transfer_syntax_gives_the_results_of_the_volume(self):
        volume = in_hounsfield_units()
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume, Offset="-3 4.5 -20"))
        for syntax in ("explicit", "implicit", "big", "rle", "jpeg-ls", "jpeg", "jpeg-2000"):
            with self.subTest(syntax=syntax):
                folder = self.write_dicom(volume, syntax, syntax=syntax, origin=(-3, 4.5, -20), bits=12)
                self.assertEqual(self.results(folder), expected)
                for options in (["--threads", 1], ["--threads", 2, "--divisions", 5], ["--memory", "64M"]):
                    self.assertEqual(self.results(folder, *options), expected, options)

    def test_values_are_hounsfield_units(self):
        volume = in_hounsfield_units()
        volumes.write_meta(self.folder / "in.mha", volume)
        for bits, kind in ((12, "int16"), (16, "int32")):
            table = self.info(self.write_dicom(volume, f"bits-{bits}", bits=bits), "--values")
            self.assertEqual(table["type"], kind)
            expected = self.info("in.mha", "--values")
            for name in ("minimum", "maximum", "mean", "Otsu threshold"):
                if name in expected:
                    self.assertEqual(table[name], expected[name])
        table = self.info(self.write_dicom(volume, "half", slope=0.5), "--values")
        self.assertEqual(table["type"], "float64")
        self.assertEqual(float(table["minimum"]), min(volume.voxels))

    def test_order_follows_the_normal_and_not_names_or_numbers(self):
        volume = in_hounsfield_units()
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        folder = self.write_dicom(volume)
        self.assertEqual(self.results(folder), expected)
        # Rows from left to right and from back to front: the normal points down, and so does the order.
        flipped = self.write_dicom(volume, "down", directions=[1, 0, 0, 0, -1, 0])
        table = self.info(flipped)
        self.assertEqual(table["spacing"], "0.8 x 0.7 x 1.5")
        self.results(flipped)
        matrix = volumes.read_header(self.folder / "l.mha")[0]["TransformMatrix"]
        self.assertEqual([float(number) for number in matrix.split()], [1, 0, 0, 0, -1, 0, 0, 0, -1])
        labels = volumes.read_data(self.folder / "l.mha")
        self.results("in.mha")
        self.assertEqual(volumes.read_data(self.folder / "l.mha"), labels)

    def test_info_names_the_series_and_how_it_is_read(self):
        table = self.info(self.write_dicom(in_hounsfield_units(), origin=(1, 2, 3)))
        self.assertEqual(table["size"], "40 x 36 x 24")
        self.assertEqual(table["origin"], "1, 2, 3")
        self.assertIn(f"DICOM series {SERIES}, 24 files", table["slices"])
        self.assertIn("slices are decoded as they are needed", table["reading"])

    def test_a_range_counts_along_the_normal(self):
        volume = in_hounsfield_units()
        folder = self.write_dicom(volume)
        table = self.info(folder, "--slices", "4-9")
        self.assertEqual((table["size"], table["origin"]), ("40 x 36 x 6", "0, 0, 6"))
        part = volumes.Volume((40, 36, 6), volume.voxels[4 * 1440 : 10 * 1440], volume.spacing, volume.kind)
        volumes.write_meta(self.folder / "part.mha", part, Offset="0 0 6")
        self.assertEqual(self.results(folder, "--slices", "4-9"), self.results("part.mha"))
        self.assert_fails(USAGE, ["4 to 24", "has 24, counted from 0"], "info", folder, "--slices", "4-24")
        self.assert_fails(USAGE, ["--slices", "'9-4'"], "info", folder, "--slices", "9-4")
        self.assert_fails(USAGE, ["--slices", "'4-x'"], "info", folder, "--slices", "4-x")

    def test_faults_of_places_name_the_files(self):
        volume = in_hounsfield_units()
        spacing = 1.5
        even = [spacing * number for number in range(24)]
        moved, doubled, gap = list(even), list(even), list(even)
        moved[10] += 0.5
        doubled[10] = even[9]
        gap[12:] = [place + 2 * spacing for place in gap[12:]]
        for places, parts in (
            (moved, ["not equally spaced", "distance is 2", "that of others 1.5"]),
            (doubled, ["have the same place", "doubled"]),
            (gap, ["2 slices are missing between", "distance is 4.5", "that of others 1.5"]),
        ):
            folder = self.write_dicom(volume, "faulty", places=places)
            self.assert_fails(CORRUPT, [str(folder), "IM00", *parts], "info", folder)
        folder = self.write_dicom(volume, "gap", without=[7])
        self.assert_fails(CORRUPT, ["1 slice is missing between", "IM00"], "extract", folder, "no.mha")
        # A thousandth of the spacing is what rounding does.
        moved[10] = even[10] + spacing / 1000
        self.info(self.write_dicom(volume, "nearly", places=moved))

    def test_signed_numbers_of_few_bits_are_extended_in_every_syntax(self):
        volume = in_hounsfield_units()
        volume.voxels = [max(-1000, min(1000, value - 1000)) for value in volume.voxels]
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        for bits in (12, 13):
            for syntax in ("explicit", "implicit", "big", "rle", "jpeg-ls", "jpeg", "jpeg-2000"):
                with self.subTest(syntax=syntax, bits=bits):
                    options = {"syntax": syntax, "bits": bits, "intercept": 0, "is_signed": True}
                    folder = self.write_dicom(volume, f"{syntax}-{bits}", **options)
                    table = self.info(folder, "--values")
                    self.assertEqual((table["minimum"], table["maximum"]), ("-1000", "1000"))
                    if syntax in ("jpeg-ls", "jpeg-2000") and bits == 12:
                        self.assertEqual(self.results(folder), expected)

    def test_without_positions_numbers_give_the_order(self):
        volume = in_hounsfield_units()
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        folder = self.write_dicom(volume, has_position=False, numbers=list(range(5, 29)))
        spacing = ["--spacing", "0.8,0.7,1.5"]
        self.assertEqual(self.results(folder, *spacing), expected)
        result = self.run_program("extract", folder, "w.mha", "--lower", 1000)
        self.assertIn("in the order of their instance numbers", str(result.warnings))
        self.assertIn("unknown_slice_order", self.warnings_of(folder))
        gap = [*range(12), *range(13, 25)]
        folder = self.write_dicom(volume, "gap", has_position=False, numbers=gap)
        self.assert_fails(CORRUPT, ["slices are missing between", "11 and 13"], "info", folder)

    def warnings_of(self, source, *arguments):
        self.run_program("extract", source, "w.mha", "--lower", 1000, "--report", "w.json", "--overwrite", *arguments)
        return [warning["code"] for warning in json.loads((self.folder / "w.json").read_text())["warnings"]]

    def test_spacings_are_two_numbers_or_a_warning(self):
        volume = in_hounsfield_units()
        self.assertIn("unknown_spacing", self.warnings_of(self.write_dicom(volume, "none", missing=["PixelSpacing"])))
        self.assertNotIn("unknown_spacing", self.warnings_of(self.folder / "none", "--spacing", "0.8,0.7,1.5"))
        for text in ("0,7\\0,8", "0.7\\0.0", "-.7\\0.8", "0.7 0.8", "nan\\0.8"):
            folder = self.write_dicom(volume, "wrong", spacing_text=text)
            self.assert_fails(CORRUPT, ["PixelSpacing", "two numbers greater than 0"], "info", folder)

    def test_rounded_places_are_a_line(self):
        volume = in_hounsfield_units()
        for spacing, digits in ((0.0195, 3), (0.0625, 2), (0.625, 1)):
            places = [round(spacing * number, digits) for number in range(24)]
            folder = self.write_dicom(volume, "rounded", places=places)
            self.assertAlmostEqual(float(self.info(folder)["spacing"].split(" x ")[2]), spacing, delta=spacing / 50)
            self.assertIn("uneven_slices", self.warnings_of(folder))
            for number in (1, 12):  # one that is missing is found all the same
                without = places[:number] + [place + spacing for place in places[number:]]
                folder = self.write_dicom(volume, "missing", places=without)
                self.assert_fails(CORRUPT, ["slice"], "info", folder)
                self.info(folder, "--spacing", "1,1,1")

    def test_scales_of_slices_may_differ(self):
        volume = in_hounsfield_units()
        volume.voxels = [max(0, value) // 20 * 20 for value in volume.voxels]
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        slopes = [(1, 0.5, 2)[number % 3] for number in range(24)]
        folder = self.write_dicom(volume, intercept=0, slopes=slopes)
        self.assertEqual(self.results(folder), expected)

    def test_what_follows_the_image_is_not_read(self):
        volume = in_hounsfield_units()
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        for behind, syntax in (([0], "explicit"), ([0] * 512, "implicit"), ([10], "rle"), ([255] * 40, "explicit")):
            folder = self.write_dicom(volume, "behind", bytes_behind=behind, syntax=syntax)
            self.assertEqual(self.results(folder), expected, behind)

    def test_acquisitions_that_overlap_are_refused(self):
        volume = in_hounsfield_units()
        turns = {str(number): {"AcquisitionNumber": 1 + number % 2} for number in range(24)}
        folder = self.write_dicom(volume, "turns", changes=turns)
        self.assert_fails(CORRUPT, ["acquisitions that overlap", "IM00"], "info", folder)
        halves = {str(number): {"AcquisitionNumber": 1 + number // 12} for number in range(24)}
        self.info(self.write_dicom(volume, "halves", changes=halves))
        every = {str(number): {"AcquisitionNumber": number} for number in range(24)}
        self.info(self.write_dicom(volume, "every", changes=every))

    def test_directions_have_a_length(self):
        folder = self.write_dicom(in_hounsfield_units(), directions=[0, 0, 0, 0, 0, 0])
        self.assert_fails(CORRUPT, [str(folder)], "info", folder)

    def test_tilted_gantry_and_other_directions_are_refused(self):
        volume = in_hounsfield_units()
        folder = self.write_dicom(volume, "tilted", shear=[0, 0.2, 0])
        self.assert_fails(CORRUPT, ["is shifted by", "gantry"], "info", folder)
        turned = {"3": {"ImageOrientationPatient": ["0.8", "0.6", "0", "-0.6", "0.8", "0"]}}
        folder = self.write_dicom(volume, "turned", changes=turned)
        self.assert_fails(CORRUPT, ["different directions", "0.8"], "info", folder)
        folder = self.write_dicom(volume, "spaced", changes={"3": {"PixelSpacing": ["0.7", "0.9"]}})
        self.assert_fails(CORRUPT, ["different spacings", "0.9"], "info", folder)

    def test_several_series_are_listed_and_chosen(self):
        volume = in_hounsfield_units()
        expected = self.results(volumes.write_meta(self.folder / "in.mha", volume))
        folder = self.write_dicom(volume)
        small = volumes.box_with_plate(kind="int16")
        self.write_dicom(small, series=OTHER_SERIES, name="other{:03}", description="scout")
        listed = ["2 series", "--series", f"{SERIES} (24 slices of 40 x 36)", f"{OTHER_SERIES} (16 slices of 24 x 20, 'scout')"]
        self.assert_fails(USAGE, listed, "extract", folder, "no.mha")
        self.assert_fails(USAGE, ["no series 1.2", *listed[2:]], "info", folder, "--series", "1.2")
        self.assertEqual(self.results(folder, "--series", SERIES), expected)
        self.assertEqual(self.info(folder, "--series", OTHER_SERIES)["size"], "24 x 20 x 16")

    def test_slices_that_differ_or_are_no_gray_slices_are_refused(self):
        volume = volumes.box_with_plate(kind="int16")
        row = {"Rows": 19, "PixelData": 2 * 24 * 19}
        for name, change, parts in (
            ("size", row, ["differ", "24 x 20", "24 x 19"]),
            ("short", {"PixelData": 100}, ["cannot be in 100 bytes"]),
            ("empty", {"Rows": 0}, ["24 x 0", "cannot be"]),
            ("huge", {"Rows": 65535, "Columns": 65535}, ["65535 x 65535", "cannot be in"]),
            ("frames", {"NumberOfFrames": "3", "Rows": 2, "PixelData": 6 * 48}, ["frame 2 have the same place"]),
            (
                "color",
                {"SamplesPerPixel": 3, "PhotometricInterpretation": "RGB", "PlanarConfiguration": 0, "Rows": 5},
                ["color image", "3 values"],
            ),
            ("bits", {"BitsStored": 17, "HighBit": 16}, ["16 bits, of which 17 are stored"]),
        ):
            with self.subTest(name=name):
                folder = self.write_dicom(volume, name, bits=12, changes={"5": change})
                self.assert_fails(CORRUPT, [str(folder), "IM00", *parts], "info", folder)

    def test_slices_without_a_position_are_in_the_order_of_their_numbers_or_names(self):
        volume = volumes.box_with_plate(kind="int16")
        folder = self.write_dicom(volume, has_position=False)
        self.assertEqual(self.info(folder)["spacing"], "1 x 1 x 1")
        result = self.extract(folder, "l.mha", "--lower", 50)
        self.assertEqual(len(result.warnings), 2)
        self.assertIn("instance numbers", result.warnings[0])
        self.assertIn("--spacing", result.warnings[1])
        result = self.extract(folder, "l.mha", "--lower", 50, "--spacing", "1,1,1", "--overwrite")
        self.assertEqual(len(result.warnings), 1)
        folder = self.write_dicom(volume, "same", has_position=False, numbers=[1] * 16)
        self.assertIn("file names", self.extract(folder, "n.mha", "--lower", 50).warnings[0])

    def test_other_files_of_a_folder_are_left_out(self):
        volume = in_hounsfield_units()
        folder = self.write_dicom(volume)
        (folder / "notes.txt").write_text("no slice")
        (folder / ".hidden").write_bytes(bytes(128) + b"DICM")
        self.assertEqual(self.info(folder)["size"], "40 x 36 x 24")
        (folder / "cut.dcm").write_bytes((folder / "IM0003").read_bytes()[:500])
        self.assert_fails(CORRUPT, ["cut.dcm", "ends within an element"], "info", folder)

    def test_hostile_lengths_are_refused_before_anything_is_allocated(self):
        volume = volumes.box_with_plate(kind="int16")
        folder = self.write_dicom(volume)
        victim = folder / "IM0003"
        content = victim.read_bytes()
        for what, old, new, part in (
            ("length", b"\xe0\x7f\x10\x00OW\0\0" + struct.pack("<I", 960), b"\xe0\x7f\x10\x00OW\0\0" + b"\xf0\xff\xff\x7f", "are left"),
            ("representation", b"\x28\x00\x10\x00US", b"\x28\x00\x10\x00ZZ", "'ZZ'"),
            ("other representation", b"\x28\x00\x10\x00US", b"\x28\x00\x10\x00SS", "not one whole number"),
            ("syntax", b"1.2.840.10008.1.2.1\0", b"1.2.840.10008.1.3.1\0", "1.2.840.10008.1.3.1"),
        ):
            with self.subTest(what=what):
                self.assertIn(old, content)
                victim.write_bytes(content.replace(old, new))
                self.assert_fails(CORRUPT, ["IM0003", part], "info", folder)
        victim.write_bytes(content)
        expected = self.info(folder)
        victim.write_bytes(content.replace(b"\x20\x00\x32\x00DS", b"\x20\x00\x32\x00LO"))  # a text all the same
        self.assertEqual(self.info(folder), expected)

        end = b"\xfe\xff\xdd\xe0\0\0\0\0"
        packed = self.write_dicom(volume, "rle", syntax="rle")
        content = (packed / "IM0003").read_bytes()
        self.assertIn(end, content)
        (packed / "IM0003").write_bytes(content.replace(end, end[:4] + b"\0\0\0\7"))
        self.assert_fails(CORRUPT, ["IM0003", "117440512 bytes"], "info", packed)
        place = content.index(struct.pack("<2I", 2, 64))
        header = content[place : place + 12]
        for numbers, part in (((3, 64, 80), "3 segments"), ((2, 64, 1 << 30), "1073741824"), ((2, 60, 80), "byte 60"), ((2, 64, 64), "byte 64")):
            (packed / "IM0003").write_bytes(content.replace(header, struct.pack("<3I", *numbers)))
            self.assert_fails(CORRUPT, ["IM0003", part], "info", packed)

    def test_damaged_bytes_never_end_without_a_message(self):
        """GDCM decodes what it gets; where it would end the process, the program says why."""
        volume = in_hounsfield_units()
        rng = random.Random(11)
        for syntax in ("jpeg", "jpeg-ls", "jpeg-2000", "rle"):
            folder = self.write_dicom(volume, syntax, syntax=syntax)
            victim = folder / "IM0003"
            content = victim.read_bytes()
            begin = content.index(b"\xe0\x7f\x10\x00") + 40
            for _ in range(10):
                damaged = bytearray(content)
                for _ in range(rng.choice((1, 3, 30))):
                    damaged[rng.randrange(begin, len(damaged))] = rng.randrange(256)
                victim.write_bytes(damaged)
                result = subprocess.run(
                    [PROGRAM, "extract", folder, self.folder / f"{syntax}.mha", "--lower", "1000", "--thickness", "3", "--overwrite"],
                    capture_output=True, text=True, check=False, errors="replace",
                )  # fmt: skip
                self.assertIn(result.returncode, (0, CORRUPT), result.stderr)
                if result.returncode != 0:
                    self.assertRegex(result.stderr.splitlines()[-1], "^medialvoxel: .*IM0003")

    def test_peak_memory_keeps_to_the_plan(self):
        volume = volumes.Volume((700, 700, 40), [], kind="int16")
        volume.voxels = [100 if 300 < x < 310 else 0 for x in range(700)] * 700 * 40
        expected = None
        for syntax in ("explicit", "jpeg-ls"):
            folder = self.write_dicom(volume, syntax, syntax=syntax, intercept=0)
            for options in (["--memory", "1G"], ["--memory", "100M"], ["--memory", "64M", "--threads", 1]):
                self.extract(folder, "l.mha", "--report", "r.json", "--overwrite", *options)
                report = json.loads((self.folder / "r.json").read_text())
                self.assertLessEqual(report["peak_memory_bytes"], report["planned_peak_bytes"], (syntax, options))
                labels = volumes.read_data(self.folder / "l.mha")
                expected = expected or labels
                self.assertEqual(labels, expected)

    def test_jobs_know_all_slices(self):
        volume = in_hounsfield_units()
        folder = self.write_dicom(volume)
        self.write_dicom(volumes.box_with_plate(), series=OTHER_SERIES, name="other{}")
        options = ["--lower", 1000, "--thickness", 3]
        self.run_program("plan", folder, "l.mha", "job", *options, "--series", SERIES, "--slices", "2-21", "--divisions", 3)
        parameters = json.loads((self.folder / "job/manifest.json").read_text())["parameters"]
        self.assertEqual((parameters["--series"], parameters["--slices"]), (SERIES, "2-21"))
        self.run_program("work", "job", "--clusters", 1)
        first = self.info(folder, "--series", SERIES, "--slices", "2-21")["slices"].split(", ")[-1].split(" to ")[0]
        victim = pathlib.Path(first)
        written = victim.stat().st_mtime_ns
        os.utime(victim, ns=(1, 1))
        self.assert_fails(FAILURE, [victim.name, "written at another time"], "work", "job")
        os.utime(victim, ns=(written, written))
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        part = volumes.Volume((40, 36, 20), volume.voxels[2 * 1440 : 22 * 1440], volume.spacing, volume.kind)
        self.extract(volumes.write_meta(self.folder / "in.mha", part, Offset="0 0 3"), "expected.mha", "--lower", 1000)
        self.assertEqual((self.folder / "l.mha").read_bytes(), (self.folder / "expected.mha").read_bytes())

    def test_a_job_notices_slices_that_were_added(self):
        volume = in_hounsfield_units()
        added = self.write_dicom(volume, "added", without=list(range(20)), name="last{}")
        folder = self.write_dicom(volume, without=[20, 21, 22, 23])
        self.run_program("plan", folder, "l.mha", "job", "--lower", 1000, "--thickness", 3, "--divisions", 3)
        for path in added.iterdir():
            path.rename(folder / path.name)
        self.assert_fails(FAILURE, ["has 24 slices, it had 20"], "work", "job")


if __name__ == "__main__":
    unittest.main()
