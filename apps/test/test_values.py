# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Statistics of values, the threshold of Otsu, and labels: against fractions, sorted lists and counts of Python."""

import fractions
import json
import math
import random
import re
import signal
import subprocess
import unittest

import volumes
from processes import PATIENCE
from program import PROGRAM, REFUSED, USAGE, ProgramTestCase
from stops import stop, wait_for_work

PERCENTS = (1, 5, 25, 50, 75, 95, 99)

# Whole numbers of these ranges have a bin each.
RANGES = {
    "uint8": (0, 255), "int8": (-128, 127), "uint16": (0, 65535), "int16": (-32768, 32767), "int32": (-30000, 30000),
    "uint32": (2**32 - 60000, 2**32 - 1), "int64": (-(2**40), -(2**40) + 999), "uint64": (2**50, 2**50 + 65535),
}  # fmt: skip


def otsu(values):
    """The lowest of the whole numbers that split the values with the largest variance between both parts."""
    values = sorted(values)
    total, below, best, threshold = sum(values), 0, 0, None
    for i, value in enumerate(values[:-1], 1):
        below += value
        if value != values[i]:
            rest = len(values) - i
            variance = i * rest * fractions.Fraction(below * rest - (total - below) * i, i * rest) ** 2
            if variance > best:
                best, threshold = variance, value + 1
    return threshold


def two_peaks(generator, low, high, count):
    """Values around two places of a range, with noise between."""
    width = high - low
    peaks = [low + int(width * share) for share in (generator.uniform(0, 0.4), generator.uniform(0.5, 1))]
    values = [int(generator.gauss(generator.choice(peaks), width / 9)) for _ in range(count)]
    return [min(max(value, low), high) for value in values]


class ValuesTest(ProgramTestCase):
    def info(self, name, *arguments):
        """Names and numbers that are printed of the values."""
        text = self.run_program("info", name, "--values", *arguments).stdout
        found = dict(re.split(r"  +", line, maxsplit=1) for line in text.splitlines())
        return {name: value.split(",")[0] for name, value in found.items()}

    def assert_statistics(self, found, values):
        ordered = sorted(values)
        self.assertEqual(int(found["values"]), len(ordered))
        self.assertEqual((float(found["minimum"]), float(found["maximum"])), (ordered[0], ordered[-1]))
        self.assertTrue(math.isclose(float(found["mean"]), sum(ordered) / len(ordered), rel_tol=1e-12))
        for percent in PERCENTS:
            rank = -(-len(ordered) * percent // 100)
            self.assertEqual(float(found[f"{percent} %"]), ordered[rank - 1], percent)
        self.assertEqual(float(found["otsu"]), otsu(ordered))

    def test_against_fractions(self):
        generator = random.Random(7)
        for kind, (low, high) in RANGES.items():
            for size in ((7, 5, 3), (33, 9), (2, 1, 1), (11, 13, 40)):
                values = two_peaks(generator, low, high, math.prod(size))
                values[0], values[-1] = low, high
                volume = volumes.Volume(size, values, kind=kind)
                volumes.write_meta(self.folder / "in.mha", volume)
                found = self.info("in.mha")
                self.assert_statistics(found, values)
                self.assertNotIn("bin width", found)

    def test_the_lowest_of_equal_thresholds(self):
        """Three values, the outer ones as often as each other: both thresholds are as good."""
        for often, middle in ((3, 5), (70001, 33), (99999, 54321)):
            values = [64998] * often + [64999] * middle + [65000] * often
            volumes.write_meta(self.folder / "in.mha", volumes.Volume((len(values), 1, 1), values, kind="uint16"))
            self.assertEqual(self.info("in.mha")["otsu"], "64999")

    def test_any_format(self):
        generator = random.Random(8)
        values = two_peaks(generator, -900, 3000, 31 * 29 * 37)
        volume = volumes.Volume((31, 29, 37), values, kind="int16")
        files = [
            (volumes.write_meta(self.folder / "a.mha", volume, big_endian=True), []),
            (volumes.write_meta(self.folder / "b.mha", volume, compressed=True), []),
            (volumes.write_nrrd(self.folder / "c.nhdr", volume), []),
            (volumes.write_raw(self.folder / "d.raw", volume), volumes.raw_options(volume)),
            (volumes.write_nifti(self.folder / "e.nii.gz", volume), []),
        ]
        for path, arguments in files:
            self.assert_statistics(self.info(path, *arguments), values)
        # Values that are scaled are real numbers.
        volumes.write_nifti(self.folder / "f.nii", volume, scl_slope=[0.5], scl_inter=[3.0])
        found = self.info("f.nii")
        self.assertAlmostEqual(float(found["otsu"]), 0.5 * otsu(values) + 3, delta=0.5)
        self.assertEqual(float(found["maximum"]), 0.5 * max(values) + 3)

    def test_wide_ranges_share_bins(self):
        generator = random.Random(9)
        for kind, low, high in (
            ("int32", -(2**31), 2**31 - 1), ("uint64", 0, 2**64 - 1), ("int64", -(2**63), 2**63 - 1),
            ("float32", -3, 70), ("float64", -1e308, 1e308), ("float64", 1, 1.000001),
        ):  # fmt: skip
            real = kind.startswith("float")
            spread = [generator.gauss(generator.choice((0.2, 0.7)), 0.1) for _ in range(2000)]
            shares = [0.0, 1.0, *(min(max(share, 0.0), 1.0) for share in spread)]
            values = [low * (1 - share) + high * share for share in shares]
            values = values if real else [low, high, *(min(max(int(value), low), high) for value in values[2:])]
            if kind == "float32":
                values = [volumes.struct.unpack("f", volumes.struct.pack("f", value))[0] for value in values]
            volumes.write_meta(self.folder / "in.mha", volumes.Volume((2002, 1, 1), values, kind=kind))
            found = self.info("in.mha")
            half = [value / 2 for value in values] if real else None
            width = 2 * (max(half) - min(half)) / 65536 if real and high < 1e300 else (high / 65536 - low / 65536)
            # The bins as whole numbers, in which the threshold is exact.
            base, range_ = min(values), fractions.Fraction(max(values)) - fractions.Fraction(min(values))
            step = range_ / 65536 if real else int(range_) // 65536 + 1
            bins = [min(int((fractions.Fraction(value) - fractions.Fraction(base)) / step), 65535) for value in values]
            expected = fractions.Fraction(base) + otsu(bins) * step
            self.assertLessEqual(abs(fractions.Fraction(float(found["otsu"])) - expected), fractions.Fraction(width) * 2, kind)
            median = sorted(values)[len(values) // 2 - 1]
            self.assertLessEqual(abs(float(found["50 %"]) / 2 - median / 2), width, kind)
            if real:
                self.assertEqual(float(found["mean"]), float(sum(map(fractions.Fraction, values)) / len(values)), kind)

    def test_not_a_number_and_infinite(self):
        values = [1.0, 2.0, 9.0, 10.0, math.nan, math.inf, -math.inf, 2.0]
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((2, 2, 2), values, kind="float32"))
        found = self.info("in.mha")
        self.assertEqual((found["values"], found["minimum"], found["maximum"]), ("5", "1", "10"))
        self.assertEqual(found["excluded"], "3 not a number or infinite")
        self.assertTrue(2 < float(found["otsu"]) <= 9)
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((2, 1, 1), [math.nan, math.inf], kind="float64"))
        self.assertEqual(self.info("in.mha")["values"], "0")

    def test_another_implementation(self):
        try:
            import numpy
            from skimage.filters import threshold_otsu
        except ImportError:
            self.skipTest("scikit-image is not installed")
        for seed in range(10):
            values = two_peaks(random.Random(seed), 0, 255, 20 * 21 * 22)
            volumes.write_meta(self.folder / "in.mha", volumes.Volume((20, 21, 22), values))
            image = numpy.array(values, dtype=numpy.uint8)
            # There the upper class begins behind the threshold.
            self.assertEqual(float(self.info("in.mha")["otsu"]), threshold_otsu(image) + 1, seed)

    def test_extraction_takes_the_threshold(self):
        volume = volumes.blurred_wall()
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_meta(self.folder / "packed.mha", volume, compressed=True)
        threshold = self.info("in.mha")["otsu"]
        runs = {
            "l.mha": ["extract", "in.mha", "l.mha", "--distance", "d.mha"],
            "v.nrrd": ["distance", "in.mha", "v.nrrd"],
            "m.ply": ["mesh", "in.mha", "m.ply"],
        }
        for output, command in runs.items():
            self.run_program(*command, "--lower", threshold)
            expected = (self.folder / output).read_bytes()
            for options in (["--divisions", 5, "--threads", 1], ["--threads", 3], ["--memory", "128M"]):
                for source in ("in.mha", "packed.mha"):
                    command[1] = source
                    report = ["--report", "r.json", "--overwrite"]
                    result = self.run_program(*command, "--lower", "Otsu", *options, *report)
                    self.assertEqual((self.folder / output).read_bytes(), expected, (command, options))
                    self.assertIn(f"{threshold}, of Otsu", result.stdout)
                    parameters = json.loads((self.folder / "r.json").read_text())["parameters"]
                    self.assertEqual((parameters["lower"], parameters["lower_otsu"]), (float(threshold), True))

    def test_jobs_take_the_threshold(self):
        volumes.write_meta(self.folder / "in.mha", volumes.blurred_wall())
        threshold = self.info("in.mha")["otsu"]
        self.run_program("extract", "in.mha", "expected.mha", "--lower", threshold)
        self.run_program("plan", "in.mha", "out.mha", "job", "--lower", "otsu", "--divisions", 3, "--report", "r.json")
        parameters = json.loads((self.folder / "job/manifest.json").read_text())["parameters"]
        self.assertEqual((float(parameters["--lower"]), parameters["lower_otsu"]), (float(threshold), True))
        self.run_program("work", "job")
        self.assertIn(f"{threshold}, of Otsu", self.run_program("finalize", "job").stdout)
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["parameters"]["lower"], float(threshold))
        self.run_program("plan", "in.mha", "r.mha", "r.mha.job", "--lower", "otsu")
        self.run_program("work", "r.mha.job", "--clusters", 0)
        self.run_program("extract", "in.mha", "r.mha", "--lower", "otsu", "--resume")
        for name in ("out.mha", "r.mha"):
            self.assertEqual((self.folder / name).read_bytes(), (self.folder / "expected.mha").read_bytes())

    def test_no_threshold(self):
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((3, 3, 3), [7] * 27))
        self.assertEqual(self.info("in.mha")["otsu"], "-")
        for command in (["extract", "in.mha", "out.mha"], ["distance", "in.mha", "out.mha"], ["plan", "in.mha", "o.mha", "j"]):
            self.assert_fails(REFUSED, ["in.mha: all its values are 7"], *command, "--lower", "otsu")
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((3, 3, 3), [7, 9, 20] * 9))
        parts = ["in.mha: its threshold of Otsu, 10, is greater than upper threshold 8"]
        self.assert_fails(USAGE, parts, "extract", "in.mha", "out.mha", "--lower", "otsu", "--upper", 8)

    def test_stops(self):
        size = (2000, 2000, 20000)
        with open(self.folder / "in.raw", "wb") as file:
            file.truncate(math.prod(size))
        raw = ["--raw-size", ",".join(map(str, size)), "--raw-type", "uint8"]
        for command in (["info", "in.raw", "--values"], ["extract", "in.raw", "out.mha", "--lower", "otsu", "--sparse"]):
            process = subprocess.Popen([PROGRAM, *command, *raw], cwd=self.folder, stderr=subprocess.PIPE)
            self.assertTrue(wait_for_work(process, 0.5), "the work ended before it could be stopped")
            seconds = stop(process, signal.SIGTERM)
            process.communicate()
            self.assertEqual(process.returncode, 128 + signal.SIGTERM)
            self.assertLess(seconds, 2 * PATIENCE)


class LabelTest(ProgramTestCase):
    def count(self, name, label, *arguments):
        """Object voxels."""
        self.run_program("extract", name, "out.mha", "--label", label, "--report", "r.json", "--overwrite", "--smooth", "off", *arguments)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["parameters"]["label"], label)
        return report["counts"]["object_voxels"]

    def test_exactly_one_value(self):
        generator = random.Random(3)
        kinds = {
            "uint8": [0, 1, 254, 255], "int8": [-128, -1, 0, 127], "int16": [-32768, 5, 6, 32767],
            "uint64": [0, 2**53, 2**53 + 1, 2**63, 2**64 - 2, 2**64 - 1],
            "int64": [-(2**63), -(2**63) + 1, -(2**53) - 1, -(2**53), 2**53 + 1, 2**63 - 1],
            "float32": [-3, 0, 2**24, 2**30], "float64": [-5, 7, 2**53, -(2**62)],
        }  # fmt: skip
        for kind, labels in kinds.items():
            values = [generator.choice(labels) for _ in range(12 * 11 * 10)]
            volume = volumes.Volume((12, 11, 10), values, kind=kind)
            volumes.write_meta(self.folder / "in.mha", volume)
            volumes.write_nrrd(self.folder / "packed.nrrd", volume, compressed=True)
            for label in labels:
                for name in ("in.mha", "packed.nrrd"):
                    found = self.count(name, label, "--max-pore-size", 0, "--divisions", 3)
                    self.assertEqual(found, values.count(label), (kind, label, name))

    def test_same_as_thresholds(self):
        volume = volumes.box_with_plate()
        volumes.write_meta(self.folder / "in.mha", volume)
        for command, output in ((["extract", "in.mha"], "l.mha"), (["distance", "in.mha"], "v.mha"), (["mesh", "in.mha"], "m.ply")):
            self.run_program(*command, output, "--label", 100)
            found = (self.folder / output).read_bytes()
            self.run_program(*command, output, "--lower", 100, "--upper", 100, "--overwrite")
            self.assertEqual(found, (self.folder / output).read_bytes())
        self.run_program("plan", "in.mha", "j.mha", "job", "--label", 100)
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertEqual((self.folder / "j.mha").read_bytes(), (self.folder / "l.mha").read_bytes())

    def test_what_is_no_label(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        volumes.write_meta(self.folder / "real.mha", volumes.box_with_plate(kind="float32"))
        command = ["extract", "in.mha", "out.mha"]
        for text in ("x", "1.5", "1e3", str(2**64), str(-(2**63) - 1), "--5", "+5", "0x10", "1,2"):
            self.assert_fails(USAGE, ["--label", f"'{text}'"], *command, f"--label={text}")
        for label in (256, -1, 2**63):
            parts = ["in.mha: the label", label, "is not a value of its type, uint8"]
            self.assert_fails(USAGE, parts, *command, "--label", label)
            self.assert_fails(USAGE, parts, "distance", "in.mha", "v.mha", "--label", label)
        parts = [2**24 + 1, "not a value of its type, float32"]
        self.assert_fails(USAGE, parts, "extract", "real.mha", "out.mha", "--label", 2**24 + 1)
        for option in (["--lower", 3], ["--upper", 3], ["--lower", "otsu"]):
            self.assert_fails(USAGE, ["the label 100 and a threshold are given"], *command, "--label", 100, *option)


class StandardOutputTest(ProgramTestCase):
    def test_report_alone(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        commands = (["extract", "in.mha", "out.mha"], ["mesh", "in.mha", "out.ply"], ["distance", "in.mha", "v.mha"])
        for command in commands:
            for quiet in ([], ["--quiet"]):
                self.run_program(*command, "--lower", "otsu", "--report", "r.json", "--overwrite")
                expected = json.loads((self.folder / "r.json").read_text())
                found = json.loads(self.run_program(*command, "--lower", "otsu", "--report", "-", "--overwrite", *quiet).stdout)
                self.assertEqual(expected["outputs"].pop("report"), "r.json")
                for name in ("outputs", "parameters", "counts", "size"):
                    self.assertEqual(found[name], expected[name])
                self.assertEqual(found.get("thickness"), expected.get("thickness"))
        self.assertFalse((self.folder / "-").exists())
        parts = ["--report - and --progress slicer both write to the standard output"]
        self.assert_fails(USAGE, parts, *commands[0], "--report", "-", "--progress", "slicer", "--overwrite")

    def test_jobs(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        self.run_program("plan", "in.mha", "out.mha", "job", "--report", "-")
        self.run_program("work", "job")
        self.assertEqual(json.loads(self.run_program("finalize", "job").stdout)["outputs"], {"labels": "out.mha"})
        result = self.run_program("extract", "in.mha", "r.mha", "--resume", "--report", "-")
        self.assertEqual(json.loads(result.stdout)["outputs"], {"labels": "r.mha"})
        self.assertFalse((self.folder / "-").exists())


if __name__ == "__main__":
    unittest.main()
