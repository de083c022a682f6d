# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A signal stops the programs within a second also where a single step takes minutes, and progress is never silent."""

import gzip
import json
import os
import random
import re
import signal
import subprocess
import tempfile
import unittest

from processes import PATIENCE, wait_until
from program import PROGRAM, ProgramTestCase
from slicer_module import MODULE
from stops import stop, wait_for_work

SIZE = 200
NOISE = ("noise.raw", "--raw-size", f"{SIZE},{SIZE},{SIZE}", "--raw-type", "uint8", "--lower", "64")
SOLID = ("solid.raw", "--raw-size", f"{SIZE},{SIZE},{SIZE}", "--raw-type", "uint8", "--upper", "0")

# A member of a packed file, and how often it is repeated: gigabytes that take seconds to unpack, in little space.
MEMBER_BYTES = 1 << 26
MEMBERS = 64

# Seconds of processors after which a run is in its long step.
WORK = 2

FRACTION = re.compile(r"<filter-progress>(.*)</filter-progress>\n")


class StopSoonTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        # Each search of a path goes far, as there are boundary points everywhere.
        (self.folder / "noise.raw").write_bytes(random.Random(17).randbytes(SIZE**3))
        # A solid with a few holes: walls that are thick, as far as the largest one that is a sheet.
        solid = bytearray(SIZE**3)
        for hole in range(0, SIZE**3, 4099):
            solid[hole] = 1
        (self.folder / "solid.raw").write_bytes(solid)
        self.before = self.names()

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def start(self, *command):
        """The process has files for its output streams, which can be read at any time."""
        self.streams = [tempfile.TemporaryFile() for _ in range(2)]
        for file in self.streams:
            self.addCleanup(file.close)
        process = subprocess.Popen([*map(str, command)], cwd=self.folder, stdout=self.streams[0], stderr=self.streams[1])
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def read_streams(self):
        return [os.pread(file.fileno(), 1 << 20, 0).decode() for file in self.streams]

    def stop(self, number, process):
        """Sends the signal; returns what is in the output streams. How long the stop takes is checked."""
        self.assertIsNone(process.poll(), f"the work ended before it could be stopped: {self.read_streams()}")
        seconds = stop(process, number)
        streams = self.read_streams()
        self.assertEqual(process.returncode, 128 + number, streams)
        self.assertLess(seconds, 1 * PATIENCE, streams)
        return streams

    def assert_stops(self, *arguments):
        for number in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(arguments=arguments, signal=number):
                process = self.start(PROGRAM, *arguments)
                wait_for_work(process, WORK)
                out, error = self.stop(number, process)
                self.assertEqual(out, "")
                self.assertIn("medialvoxel: stopped, no output was written", error)
                self.assertEqual(self.names(), self.before)

    def test_large_thickness(self):
        self.assert_stops("extract", *NOISE, "out.mha", "--thickness", "40vx")

    def test_thickness_in_small_voxels(self):
        """The same as 154 voxels."""
        spacing = ("--spacing", "0.0195,0.0195,0.0195")
        self.assert_stops("extract", *NOISE, "out.mha", "--thickness", "3", *spacing)

    def test_automatic_thickness(self):
        holes = ("--smooth", "off", "--max-pore-size", "0")
        self.assert_stops("extract", *SOLID, "out.mha", "--max-thickness", "60", "--thickness-map", "t.mha", *holes)

    def test_pores(self):
        self.assert_stops("extract", *NOISE, "out.mha", "--max-pore-size", "1000000", "--thickness", "40")

    def test_mesh(self):
        cleaning = ("--min-branch-length", "3", "--min-component-size", "20")
        self.assert_stops("mesh", *NOISE, "out.ply", "--thickness", "40", *cleaning)

    def test_mesh_with_labels(self):
        self.assert_stops("extract", *NOISE, "out.mha", "--thickness", "40", "--mesh", "out.vtp", "--html", "p.html")

    def test_distance(self):
        size = 500
        with open(self.folder / "large.raw", "wb") as file:
            file.truncate(size**3)
            file.seek(size**3 // 2)
            file.write(b"\1")
        self.before = self.names()
        raw = ("--raw-size", f"{size},{size},{size}", "--raw-type", "uint8", "--spacing", "1,1.1,1.3")
        self.assert_stops("distance", "large.raw", "out.nhdr", *raw, "--upper", "0")

    def test_surface(self):
        self.assert_stops("surface", *NOISE, "out.ply", "--ray", "--largest-ball", "100")
        self.assert_stops("surface", *SOLID, "out.glb", "--ray", "--largest-ball", "200")

    def test_unpacking(self):
        slices = MEMBER_BYTES * MEMBERS >> 22
        header = f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2048 2048 {slices}\nencoding: gzip\n\n"
        member = gzip.compress(bytes(MEMBER_BYTES), 1)
        (self.folder / "packed.nrrd").write_bytes(header.encode() + member * MEMBERS)
        self.before = self.names()
        self.assert_stops("extract", "packed.nrrd", "out.mha", "--thickness", "3", "--memory", "8G")  # of zeros, which take none

    def test_work(self):
        """On a cluster; what is done stays."""
        self.run_program("plan", *NOISE, "out.mha", "hard", "--thickness", "40", "--divisions", "2")
        for number in (signal.SIGTERM, signal.SIGINT):
            process = self.start(PROGRAM, "work", "hard")
            wait_for_work(process, WORK)
            error = self.stop(number, process)[1]
            self.assertIn("medialvoxel: stopped; what is done stays, to continue: medialvoxel work ", error)

    def test_module(self):
        volume = self.folder / "noise.nhdr"
        volume.write_text(
            "NRRD0004\ntype: uint8\ndimension: 3\n"
            f"sizes: {SIZE} {SIZE} {SIZE}\nencoding: raw\ndata file: noise.raw\n"
        )
        self.before = self.names()
        options = ("--objectSelection", "AboveLower", "--lowerThreshold", "64", "--thicknessMode", "Fixed")
        for number in (signal.SIGTERM, signal.SIGINT):
            process = self.start(MODULE, "noise.nhdr", "out.nrrd", *options, "--thickness", "40")
            self.wait_for_fractions(process, lambda: FRACTION.findall(self.read_streams()[0]))
            self.stop(number, process)
            self.assertEqual(self.names(), self.before)

    def wait_for_fractions(self, process, read):
        """Three, none of which is below the one before, while a single step goes on."""
        wait_until(lambda: process.poll() is not None or len(read()) >= 3, "progress")
        fractions = list(map(float, read()))
        self.assertGreaterEqual(len(fractions), 3, self.read_streams())
        self.assertEqual(fractions, sorted(fractions))

    def test_progress_is_not_silent(self):
        command = (PROGRAM, "extract", *NOISE, "out.mha", "--thickness", "154", "--threads", "1")
        process = self.start(*command, "--progress", "json")
        self.wait_for_fractions(process, lambda: [line["progress"] for line in self.read_progress()])
        seconds = [line["seconds"] for line in self.read_progress()]
        self.assertLess(max(after - before for before, after in zip(seconds, seconds[1:])), 3 * PATIENCE)
        self.stop(signal.SIGTERM, process)

    def read_progress(self):
        lines = re.findall(r"^(\{.*\})\n", self.read_streams()[1], re.MULTILINE)
        return [line for line in map(json.loads, lines) if "progress" in line]


if __name__ == "__main__":
    unittest.main()
