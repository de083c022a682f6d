# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A cap on the memory holds, whatever the format, and changes no byte; values of compressed volumes wait in memory or on the disk."""

import json
import os
import random
import resource
import unittest

import volumes
from program import PROGRAM, REFUSED, ProgramTestCase

MEGABYTE = 1 << 20
SIZE = (400, 400, 120)


def walls(size=SIZE):
    """Two thin walls, written without a loop over voxels."""
    row = bytes(1 if 40 <= x < 43 else 0 for x in range(size[0]))
    full = bytes([1]) * size[0]
    piece = b"".join(full if 100 <= y < 104 else row for y in range(size[1]))
    volume = volumes.Volume(size, [])
    volume.voxels = piece * size[2]
    return volume


class MemoryTest(ProgramTestCase):
    def result(self, source, *arguments):
        self.extract(source, "l.mha", "--vectors", "v.mha", "--report", "r.json", "--overwrite", *arguments)
        report = json.loads((self.folder / "r.json").read_text())
        return [volumes.read_data(self.folder / name) for name in ("l.mha", "v.mha")] + [report["counts"]], report

    def peak_of_child(self, *arguments):
        """Largest resident memory of the program as the system tells its parent, in bytes."""
        child = os.fork()
        if child == 0:
            os.chdir(self.folder)
            os.execv(PROGRAM, [PROGRAM, *map(str, arguments), "--quiet"])
        _, status, usage = os.wait4(child, 0)
        self.assertEqual(status, 0)
        return usage.ru_maxrss * 1024

    def test_caps_hold_for_every_format(self):
        volume = walls()
        sources = [
            volumes.write_raw(self.folder / "a.raw", volume),
            volumes.write_meta(self.folder / "b.mha", volume),
            volumes.write_meta(self.folder / "c.mhd", volume),
            volumes.write_nrrd(self.folder / "d.nrrd", volume),
            volumes.write_nrrd(self.folder / "e.nhdr", volume),
            volumes.write_meta(self.folder / "f.mha", volume, compressed=True),
            volumes.write_nrrd(self.folder / "g.nrrd", volume, compressed=True),
        ]
        expected = None
        for source in sources:
            raw = volumes.raw_options(volume) if source.suffix == ".raw" else []
            for memory in ("1G", "48M"):
                result, report = self.result(source, "--memory", memory, *raw)
                expected = expected or result
                self.assertEqual(result, expected, (source.name, memory))
                self.assertLessEqual(report["planned_peak_bytes"], 1024 * MEGABYTE if memory == "1G" else 48 * MEGABYTE)
                self.assertLessEqual(report["peak_memory_bytes"], report["planned_peak_bytes"], (source.name, memory))

    def test_limits_of_the_process_are_planned_with(self):
        volume = volumes.write_meta(self.folder / "in.mha", walls())
        self.extract(volume, "expected.mha")
        for limit, name in ((resource.RLIMIT_AS, "address space"), (resource.RLIMIT_DATA, "data")):
            for megabytes in (250, 1000):
                limited = {"preexec_fn": lambda: resource.setrlimit(limit, (megabytes * MEGABYTE,) * 2)}
                command = [volume, "out.mha", "--threads", 1, "--report", "r.json", "--overwrite"]
                for memory in ([], ["--memory", "4G"]):
                    self.extract(*command, *memory, **limited)
                    report = json.loads((self.folder / "r.json").read_text())
                    self.assertLess(report["memory_limit_bytes"], megabytes * MEGABYTE, name)
                    self.assertEqual((self.folder / "out.mha").read_bytes(), (self.folder / "expected.mha").read_bytes())
            small = {"preexec_fn": lambda: resource.setrlimit(limit, (40 * MEGABYTE,) * 2)}
            if limit == resource.RLIMIT_DATA:
                self.assert_fails(REFUSED, ["are allowed"], "extract", volume, "no.mha", "--memory", "4G", **small)

    def test_picture_and_page_do_not_grow_with_the_volume(self):
        """Eight times the slices, in pieces of the same size: the same peak, up to the longer views."""
        peaks = []
        for slices in (60, 480):
            volumes.write_meta(self.folder / "in.mha", walls((300, 300, slices)))
            results = ["--preview", "p.png", "--html", "h.html", "--report", "r.json"]
            cut = ["--divisions", slices // 20, "--threads", 1, "--memory", "64M"]
            self.extract("in.mha", "l.mha", *results, *cut, "--overwrite")
            report = json.loads((self.folder / "r.json").read_text())
            self.assertLessEqual(report["peak_memory_bytes"], report["planned_peak_bytes"])
            peaks.append(report["peak_memory_bytes"])
        self.assertLess(peaks[1] - peaks[0], 3 * MEGABYTE)

    def test_thick_walls_keep_the_cap_or_are_refused(self):
        size = (180, 180, 150)
        solid = volumes.Volume(size, [])
        row = bytes([0]) + bytes([1]) * (size[0] - 2) + bytes([0])
        slice_ = bytes(size[0]) + row * (size[1] - 2) + bytes(size[0])
        solid.voxels = bytes(size[0] * size[1]) + slice_ * (size[2] - 2) + bytes(size[0] * size[1])
        volumes.write_meta(self.folder / "in.mha", solid)
        expected, report = self.result("in.mha", "--threads", 1)
        self.assertGreater(report["peak_memory_bytes"], 45 * MEGABYTE)
        for memory in (40, 32):
            result, report = self.result("in.mha", "--threads", 1, "--memory", f"{memory}M")
            self.assertEqual(result, expected)
            self.assertLessEqual(report["peak_memory_bytes"], memory * MEGABYTE)
        self.assert_fails(
            REFUSED,
            ["walls", "MiB", "--memory"],
            *("extract", "in.mha", "x.mha", "--vectors", "y.mha", "--thickness", 3, "--threads", 1, "--memory", "20M"),
        )
        self.assertFalse((self.folder / "x.mha").exists())

    def test_the_system_sees_the_same_peak(self):
        volumes.write_meta(self.folder / "in.mha", walls())
        own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
        peak = self.peak_of_child("extract", "in.mha", "l.mha", "--thickness", 3, "--memory", "48M", "--vectors", "v.mha")
        self.assertLessEqual(peak, max(own, 48 * MEGABYTE))

    def test_pieces_of_one_slice_read_the_input_once(self):
        volume = walls((200, 100, 40))
        volumes.write_meta(self.folder / "in.mha", volume)
        _, report = self.result("in.mha", "--divisions", 40)
        self.assertEqual(report["divisions"], 40)
        self.assertEqual(report["bytes_read"], len(volume.data()))
        self.assertEqual(report["recomputed_voxels"], 0)

    def test_scratch(self):
        volume = walls()
        volumes.write_nrrd(self.folder / "in.nrrd", volume, compressed=True)
        expected, _ = self.result("in.nrrd")
        (self.folder / "scratch").mkdir()
        run = ("--scratch", "scratch", "--threads", 1)
        limits = ("--memory", self.find_least_memory("extract", "in.nrrd", "p.mha", "--thickness", 3, *run), *run)
        self.assertRegex(self.extract("in.nrrd", "l2.mha", *limits).stderr, "in scratch\n")
        self.assertEqual(volumes.read_data(self.folder / "l2.mha"), expected[0])
        self.assertEqual(list((self.folder / "scratch").iterdir()), [])
        self.assert_fails(REFUSED, ["--scratch"], "extract", "in.nrrd", "x.mha", "--thickness", 3, *limits[:2], "--threads", 1)
        self.assert_fails(REFUSED, ["none"], "extract", "in.nrrd", "x.mha", "--thickness", 3, "--scratch", "none")

    def test_random_configurations(self):
        numbers = random.Random(20260)
        for trial in range(6):
            size = tuple(numbers.randint(1, 40) for _ in range(3))
            kind = numbers.choice(["uint8", "int16", "float32"])
            volume = volumes.Volume(size, [], (1, 1, numbers.choice([1, 1.5])), kind)
            share = numbers.choice([0.1, 0.5, 0.95])
            volume.voxels = [int(numbers.random() < share) for _ in range(size[0] * size[1] * size[2])]
            plain = volumes.write_meta(self.folder / "plain.mha", volume)
            packed = volumes.write_nrrd(self.folder / "packed.nrrd", volume, big_endian=True, compressed=True)
            expected, _ = self.result(plain, "--divisions", 1, "--threads", 1, "--lower", 0.5)
            for source in (plain, packed):
                options = ["--divisions", numbers.randint(1, 40), "--threads", numbers.randint(1, 4)]
                options += ["--memory", f"{numbers.randint(64, 300)}M", "--lower", 0.5]
                self.assertEqual(self.result(source, *options)[0], expected, (trial, size, source.name, options))


if __name__ == "__main__":
    unittest.main()
