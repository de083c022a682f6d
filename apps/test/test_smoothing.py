# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Labels of a smoothed object are those of a mask that was smoothed by the definition, for any input and division."""

import hashlib
import json
import math
import random
import unittest

import volumes
from program import USAGE, ProgramTestCase


def step(values, size):
    """[1 2 1] along x, y and z; beyond a face of the image its voxel repeats."""
    stride = 1
    for length in size:
        before = values
        values = [
            before[i - stride if i // stride % length > 0 else i]
            + before[i + stride if i // stride % length < length - 1 else i]
            + 2 * before[i]
            for i in range(len(before))
        ]
        stride *= length
    return values


def smooth(values, size):
    """3 B^2 - 2 B^4 times 64^4."""
    two = step(step(values, size), size)
    four = step(step(two, size), size)
    scale = 4 ** (2 * len(size))
    return [(3 * scale * b2 - 2 * b4) * 4 ** (4 * (3 - len(size))) for b2, b4 in zip(two, four)]


SCALE = 64**4


def level(values, is_object):
    """The middle between the nearest values of object and background, where one side is above the other."""
    sides = [sorted({v for v in values if is_object(v) == side}) for side in (False, True)]
    background, material = sides if sides[0][0] < sides[1][0] else sides[::-1]
    return (background[-1] + material[0]) / 2


def measure_roughness(mask, size):
    """Rough voxels and those at the border."""
    strides = [1, size[0], size[0] * size[1]]
    inner = [[n for n in range(length) if length == 1 or 0 < n < length - 1] for length in size]
    active = [axis for axis, length in enumerate(size) if length > 1]
    offsets = [0]
    for axis in active:
        offsets = [offset + n * strides[axis] for offset in offsets for n in (-1, 0, 1)]
    rough = border = 0
    for z in inner[2]:
        for y in inner[1]:
            for x in inner[0]:
                i = x + y * strides[1] + z * strides[2]
                if any(mask[i + offset] != mask[i] for offset in offsets):
                    border += 1
                    others = [mask[i + n * strides[axis]] != mask[i] for axis in active for n in (-1, 1)]
                    rough += others.count(False) <= 1
    return rough, border


def noisy_wall(size=(40, 36, 33), noise=0.3, seed=4, level=200):
    """Values of a tilted wall of 3 voxels."""
    dice = random.Random(seed)
    normal = [1 / math.sqrt(30), 2 / math.sqrt(30), 5 / math.sqrt(30)]
    volume = volumes.Volume(size, [], (0.5, 0.5, 0.8), "uint16")

    def value(index):
        distance = sum(n * (i - length / 2) for n, i, length in zip(normal, index, size))
        return round(1000 + level * min(1, max(0, 2 - abs(distance))) + dice.gauss(0, noise * level))

    volume.voxels = [value(index) for index in volume.indices()]
    return volume


class SmoothingTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = noisy_wall()

    def run_extract(self, name, *arguments):
        """Labels and report."""
        self.run_program("extract", name, "out.mha", "--overwrite", "--report", "r.json", *arguments)
        report = json.loads((self.folder / "r.json").read_text(encoding="utf-8"))
        return volumes.read_data(self.folder / "out.mha"), report

    def write_mask(self, mask):
        volume = self.volume.as_type("uint8")
        volume.voxels = [int(is_object) for is_object in mask]
        volumes.write_meta(self.folder / "mask.mha", volume)

    def smoothed_mask(self, threshold=1100):
        limit = level(self.volume.voxels, lambda v: v >= threshold) * SCALE
        return [v >= limit for v in smooth(self.volume.voxels, self.volume.size)]

    def expect(self, mask, *arguments):
        self.write_mask(mask)
        return self.run_extract("mask.mha", "--smooth", "off", *arguments)

    def check(self, name, mask, *arguments):
        fixed = ("--max-thickness", 16)  # thick walls are looked for before smoothing
        expected, wanted = self.expect(mask, *fixed)
        found, report = self.run_extract(name, *fixed, *arguments)
        self.assertEqual(found, expected, arguments)
        self.assertEqual(report["counts"], wanted["counts"])
        self.assertTrue(report["smoothed"])

    def test_values_and_masks(self):
        values, size = self.volume.voxels, self.volume.size
        volumes.write_meta(self.folder / "in.mha", self.volume)
        on = ("--smooth", "on")
        self.check("in.mha", self.smoothed_mask(1100.25), "--lower", 1100.25, *on)
        limit = level(values, lambda v: v <= 1050) * SCALE
        self.check("in.mha", [v <= limit for v in smooth(values, size)], "--upper", 1050, *on)
        mask = [2 * v >= SCALE for v in smooth([1090 <= v <= 1300 for v in values], size)]
        self.check("in.mha", mask, "--lower", 1090, "--upper", 1300, *on)
        mask = [2 * v >= SCALE for v in smooth([v != 0 for v in values], size)]
        self.check("in.mha", mask, *on)

    def assert_same(self, runs):
        """Labels and what is told about walls."""
        results = []
        for name, *options in runs:
            labels, report = self.run_extract(name, *options)
            self.assertTrue(report["smoothed"])
            results.append((hashlib.sha256(bytes(labels)).hexdigest(), report["measure"]["on"], report["thickness"]))
            self.assertEqual(results[-1], results[0], (name, options))

    def write(self, name, kind, values):
        volume = volumes.Volume(self.volume.size, values, (1, 1, 1), kind)
        volumes.write_nrrd(self.folder / name, volume)

    def test_a_mask_has_one_answer_for_any_values_and_thresholds(self):
        for share in (0.05, 0.2):
            dice = random.Random(3)
            # A wall of 7 voxels, of which some flip.
            mask = [abs(x - 20 + y / 3 - 6) <= 3.5 for x, y, z in self.volume.indices()]
            mask = [value != (dice.random() < share) for value in mask]
            self.write("a.nrrd", "uint8", [255 * value for value in mask])
            self.write("b.nrrd", "int16", [100 if value else 2100 for value in mask])
            self.write("c.nrrd", "float64", [0.75 if value else -3 for value in mask])
            self.write("d.nrrd", "int32", [7 if value else -2000000000 for value in mask])
            self.write("e.nrrd", "uint16", [dice.randint(1, 3) if value else 0 for value in mask])
            self.assert_same((
                ("a.nrrd",), ("a.nrrd", "--lower", 255), ("a.nrrd", "--lower", 1), ("a.nrrd", "--lower", 0.5),
                ("a.nrrd", "--lower", "otsu"), ("a.nrrd", "--label", 255), ("a.nrrd", "--lower", 99, "--upper", 300),
                ("b.nrrd", "--upper", 100), ("b.nrrd", "--upper", 2099.5), ("b.nrrd", "--label", 100),
                ("c.nrrd", "--lower", 0.75), ("c.nrrd", "--lower", -2.999), ("d.nrrd", "--lower", 7),
                ("d.nrrd", "--lower", -1e9, "--divisions", 3, "--threads", 2),
                ("e.nrrd",), ("e.nrrd", "--lower", 1), ("e.nrrd", "--lower", 0.01), ("e.nrrd", "--lower", 1, "--upper", 3),
            ))  # fmt: skip

    def test_thresholds_between_the_same_values_are_one(self):
        even = [v // 2 * 2 for v in self.volume.voxels]
        self.write("even.nrrd", "uint16", even)
        self.write("far.nrrd", "float32", [(v - 1000) * 0.25 for v in even])
        self.write("turned.nrrd", "int16", [-v for v in even])
        labels = []
        for name, *options in (
            ("even.nrrd", "--lower", 1099), ("even.nrrd", "--lower", 1100), ("even.nrrd", "--lower", 1098.5),
            ("even.nrrd", "--lower", 1100, "--upper", 65535), ("far.nrrd", "--lower", 25), ("far.nrrd", "--lower", 24.6),
            ("turned.nrrd", "--upper", -1100), ("turned.nrrd", "--upper", -1099), ("turned.nrrd", "--lower", -9999, "--upper", -1099),
        ):  # fmt: skip
            labels.append(hashlib.sha256(bytes(self.run_extract(name, *options)[0])).hexdigest())
            self.assertEqual(labels[-1], labels[0], (name, options))

    def test_jobs_smooth_as_one_run(self):
        self.write("scan.nrrd", "uint16", self.volume.voxels)
        self.write("mask.nrrd", "uint8", [255 * (v >= 1100) for v in self.volume.voxels])
        for name, lower in (("scan.nrrd", 1100), ("mask.nrrd", 200)):
            expected, _ = self.run_extract(name, "--lower", lower, "--smooth", "on")
            for kind in ("on", "auto"):
                self.run_program("plan", name, "j.mha", f"job-{name}-{kind}", "--lower", lower, "--smooth", kind, "--divisions", 3, "--overwrite")
                self.run_program("work", f"job-{name}-{kind}")
                self.run_program("finalize", f"job-{name}-{kind}", "--overwrite")
                self.assertTrue(volumes.read_data(self.folder / "j.mha") == expected, (name, kind))

    def test_every_way_of_reading(self):
        mask = self.smoothed_mask()
        expected, wanted = self.expect(mask)
        volumes.write_meta(self.folder / "in.mha", self.volume)
        volumes.write_meta(self.folder / "swapped.mha", self.volume, big_endian=True)
        volumes.write_meta(self.folder / "packed.mha", self.volume, compressed=True)
        for kind in ("int16", "int32", "float32", "float64", "uint64"):
            volumes.write_nrrd(self.folder / f"{kind}.nrrd", self.volume.as_type(kind))
        (self.folder / "scratch").mkdir()
        runs = [("in.mha", *options) for options in (
            ("--divisions", 33), ("--divisions", 5, "--threads", 5), ("--memory", "48M"), ("--sparse",),
        )]  # fmt: skip
        runs += [("packed.mha",), ("packed.mha", "--divisions", 4), ("swapped.mha",)]
        runs += [(f"{kind}.nrrd",) for kind in ("int16", "int32", "float32", "float64", "uint64")]
        for name, *options in runs:
            for kind in ("on", "auto"):
                found, report = self.run_extract(name, "--lower", 1100, "--smooth", kind, *options)
                self.assertEqual(found, expected, (name, kind, options))
                self.assertEqual(report["counts"], wanted["counts"])

    def test_chunks(self):
        volumes.write_meta(self.folder / "in.mha", self.volume)
        mask = self.smoothed_mask()
        self.write_mask(mask)
        self.run_program("extract", "mask.mha", "a.zarr", "--smooth", "off")
        expected = volumes.read_data
        self.run_program("extract", "in.mha", "labels.zarr", "--lower", 1100, "--smooth", "on")
        self.run_program("extract", "a.zarr", "a.mha", "--thickness", 3)
        self.run_program("extract", "labels.zarr", "b.mha", "--thickness", 3)
        self.assertEqual(expected(self.folder / "a.mha"), expected(self.folder / "b.mha"))
        # Chunks as input: labels from 2 on are medial.
        labels, _ = self.run_extract("a.zarr", "--lower", 2, "--smooth", "on", "--max-pore-size", 0)
        self.run_program("extract", "mask.mha", "plain.mha", "--smooth", "off")
        again, _ = self.run_extract("plain.mha", "--lower", 2, "--smooth", "on", "--max-pore-size", 0)
        self.assertEqual(labels, again)

    def test_the_roughness_decides(self):
        mask = [v >= 1100 for v in self.volume.voxels]
        volumes.write_meta(self.folder / "in.mha", self.volume)
        volumes.write_meta(self.folder / "packed.mha", self.volume, compressed=True)
        for name in ("in.mha", "packed.mha"):
            for options in ([], ["--divisions", 3, "--threads", 4]):
                _, report = self.run_extract(name, "--lower", 1100, *options)
                rough, border = measure_roughness(mask, self.volume.size)
                self.assertEqual(report["roughness"]["rough_voxels"], rough)
                self.assertEqual(report["roughness"]["border_voxels"], border)
                self.assertAlmostEqual(report["roughness"]["ratio"], rough / border)
                self.assertTrue(report["smoothed"])
                self.assertEqual(report["parameters"]["smooth"], "auto")
        volumes.write_meta(self.folder / "clean.mha", noisy_wall(noise=0))
        found, report = self.run_extract("clean.mha", "--lower", 1100)
        self.assertFalse(report["smoothed"])
        self.assertEqual(report["roughness"]["rough_voxels"], 0)
        self.assertEqual(found, self.run_extract("clean.mha", "--lower", 1100, "--smooth", "off")[0])
        table = self.run_program("extract", "in.mha", "out.mha", "--lower", 1100, "--overwrite").stdout
        self.assertRegex(table, rf"decided +smoothed \(roughness {100 * rough / border:.2f} %\)")

    def test_defaults(self):
        volumes.write_meta(self.folder / "in.mha", self.volume)
        for options, smooth_option, measured in (
            ((), "auto", True),
            (("--thickness", 1.5), "off", False),
            (("--thickness", 1.5, "--smooth", "auto"), "auto", True),
            (("--smooth", "on"), "on", False),
            (("--smooth", "off"), "off", False),
        ):
            _, report = self.run_extract("in.mha", "--lower", 1100, *options)
            self.assertEqual(report["parameters"]["smooth"], smooth_option)
            self.assertEqual(report["roughness"] is not None, measured)
            self.assertEqual(report["smoothed"], smooth_option != "off")

    def test_pictures(self):
        self.volume = noisy_wall((60, 50, 1))
        picture = volumes.Volume((60, 50), self.volume.voxels, (0.5, 0.5), "uint16")
        volumes.write_nrrd(self.folder / "in.nrrd", picture)
        mask = self.smoothed_mask()
        flat = volumes.Volume((60, 50), [int(value) for value in mask], (0.5, 0.5), "uint8")
        volumes.write_nrrd(self.folder / "mask.nrrd", flat)
        expected, _ = self.run_extract("mask.nrrd", "--smooth", "off")
        found, report = self.run_extract("in.nrrd", "--lower", 1100, "--smooth", "on")
        self.assertEqual(found, expected)
        _, report = self.run_extract("in.nrrd", "--lower", 1100)
        rough, border = measure_roughness([v >= 1100 for v in self.volume.voxels], (60, 50, 1))
        self.assertEqual(report["roughness"]["rough_voxels"], rough)
        self.assertEqual(report["roughness"]["border_voxels"], border)

    def test_thickness_on_gray_values_is_that_of_raw_values(self):
        volumes.write_meta(self.folder / "in.mha", noisy_wall(noise=0.05))
        thickness = {}
        for kind in ("on", "off"):
            options = ("--lower", 1100, "--sub-voxel", "--smooth", kind, "--thickness-map", "t.mha")
            for divisions in (1, 6):
                self.run_extract("in.mha", *options, "--divisions", divisions)
                thickness.setdefault(kind, []).append(volumes.read_floats(self.folder / "t.mha"))
        self.assertEqual(*thickness["on"])
        differences = sorted(
            abs(a - b) for a, b in zip(thickness["on"][0], thickness["off"][0]) if a > 0 and b > 0
        )
        self.assertGreater(len(differences), 500)
        self.assertLess(differences[len(differences) // 2], 0.02)

    def test_errors(self):
        volumes.write_meta(self.folder / "in.mha", self.volume)
        self.assert_fails(USAGE, ["--smooth", "'yes'", "auto|on|off"], "extract", "in.mha", "o.mha", "--smooth", "yes")
        self.assert_fails(
            USAGE, ["labels of several objects", "smoothing"], "extract", "in.mha", "o.mha", "--labels", "all", "--smooth", "on"
        )


if __name__ == "__main__":
    unittest.main()
