# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Compressed volumes while they are unpacked: stops, damage and kills leave nothing, and zeros take no space."""

import os
import pathlib
import random
import signal
import subprocess
import unittest

import volumes
from processes import PATIENCE, wait_until
from program import CORRUPT, DONE, PROGRAM, ProgramTestCase
from stops import stop

SIDE = 200
MEGABYTE = 1 << 20


def noise():
    """Values that pack badly, so that a file has a middle."""
    volume = volumes.Volume((SIDE, SIDE, SIDE), [], kind="uint8")
    volume.voxels = random.Random(3).randbytes(SIDE**3)
    return volume


class UnpackingTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.scratch = self.folder / "scratch"
        self.scratch.mkdir()

    def run_in_scratch(self, source, *options):
        """A run whose memory has no room for the values."""
        run = ["extract", source, "out.mha", "--thickness", 3, "--threads", 1, "--scratch", "scratch", *options]
        return [*run, "--memory", self.find_least_memory(*run) + 6 * MEGABYTE]

    def start(self, *arguments):
        process = subprocess.Popen(
            [PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def find_scratch_file(self, process):
        """What the system tells of the file without a name that a process has in the scratch folder, or None."""
        for entry in pathlib.Path(f"/proc/{process.pid}/fd").iterdir():
            try:
                if os.readlink(entry).startswith(f"{self.scratch.resolve()}/"):
                    found = entry.stat()
                    return found if found.st_size > 0 else None  # it has just been made
            except OSError:
                pass  # it has just been closed
        return None

    def write_slow_archive(self):
        """Gigabytes of zeros in a small file, which take seconds to unpack."""
        header = volumes.nrrd_header(volumes.Volume((1 << 10, 1 << 10, 1 << 12), []), encoding="gzip")
        (self.folder / "slow.nrrd").write_bytes(header + volumes.gzip(bytes(1 << 26)) * 64)
        return "slow.nrrd"

    def names(self):
        return sorted(path.name for path in self.folder.rglob("*"))

    def test_stop_and_kill(self):
        source = self.write_slow_archive()
        before = self.names()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            for options in ((), ("--smooth", "auto", "--lower", 1), ("--labels", "all"), ("--lower", "otsu")):
                process = self.start(*self.run_in_scratch(source, *options, "--sparse"))
                found = wait_until(lambda: self.find_scratch_file(process), "the scratch file")
                seconds = stop(process, number)
                self.assertLess(seconds, PATIENCE, (number, options))
                self.assertEqual(process.returncode, -number if number == signal.SIGKILL else 128 + number, options)
                self.assertEqual(self.names(), before)
                self.assertEqual((found.st_size >> 20, found.st_blocks), (1 << 12, 0))  # zeros take no space

    def test_damage_in_the_middle(self):
        volumes.write_meta(self.folder / "plain.mha", noise())
        path = volumes.write_nifti(self.folder / "in.nii.gz", noise())
        content = bytearray(path.read_bytes())
        middle = len(content) // 2
        for damaged, word in ((content[:middle], "early"), (content[:middle] + bytes(64) + content[middle + 64 :], "damaged")):
            path.write_bytes(damaged)
            for options in ((), ("--smooth", "on"), ("--lower", "otsu"), ("--mesh", "m.vtp")):
                with self.subTest(word=word, options=options):
                    run = ("extract", "in.nii.gz", "out.mha", "--thickness", 3, *options)
                    self.assert_fails(CORRUPT, ["in.nii.gz", word], *run)
            self.assert_fails(CORRUPT, ["in.nii.gz", word], *self.run_in_scratch("in.nii.gz"))
            self.assert_fails(CORRUPT, ["in.nii.gz", word], "info", "in.nii.gz", "--values")
        self.assertEqual(list(self.scratch.iterdir()), [])

    def test_end(self):
        volume = volumes.box_with_plate(size=(240, 240, 240))
        volumes.write_nrrd(self.folder / "in.nrrd", volume, compressed=True)
        volumes.write_meta(self.folder / "plain.mha", volume)
        self.extract("plain.mha", "out.mha")
        expected = volumes.read_data(self.folder / "out.mha")
        result = self.run_program(*self.run_in_scratch("in.nrrd"), "--overwrite", status=DONE)
        self.assertRegex(result.stderr, r"in\.nrrd is compressed and was unpacked once: .* MiB in scratch\n")
        self.assertEqual(volumes.read_data(self.folder / "out.mha"), expected)
        self.assertEqual(list(self.scratch.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
