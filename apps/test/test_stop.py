# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A signal stops the program soon, with the status that shells know, and leaves no file."""

import signal
import subprocess
import unittest

from processes import PATIENCE, processor_seconds
from program import PROGRAM, ProgramTestCase, wait_for_begin
from stops import stop, wait_for_work

SIZE = 360


class StopTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        # A solid with one hole in the middle: long distances, seconds of work, and a file that is almost empty.
        with open(self.folder / "in.raw", "wb") as file:
            file.truncate(SIZE**3)
            file.seek(SIZE**3 // 2 + SIZE**2 // 2 + SIZE // 2)
            file.write(b"\1")
        self.before = sorted(path.name for path in self.folder.iterdir())

    def stop(self, number, *arguments):
        """Starts the program, sends the signal once it is at work, and returns its status and what it said."""
        command = [PROGRAM, *arguments, "--upper", "0", "--progress", "json"]
        command += ["--raw-size", f"{SIZE},{SIZE},{SIZE}", "--raw-type", "uint8"]
        with subprocess.Popen(
            command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        ) as process:
            process.stderr.readline()
            self.assertTrue(wait_for_begin(process, self.folder), "the work has not begun")
            wait_for_work(process, processor_seconds(process.pid) + 0.3)
            self.stop_seconds = stop(process, number)
            out, error = process.communicate()
            self.assertEqual(out, "")
            return process.returncode, error

    def assert_stopped(self, number, *arguments):
        status, error = self.stop(number, *arguments)
        self.assertEqual(status, 128 + number, error)
        self.assertIn("medialvoxel: stopped, no output was written", error)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), self.before)
        self.assertLess(self.stop_seconds, 1 * PATIENCE)

    def test_interrupt(self):
        self.assert_stopped(signal.SIGINT, "extract", "in.raw", "out.mha", "--thickness", "3", "--report", "r.json")

    def test_terminate(self):
        self.assert_stopped(signal.SIGTERM, "extract", "in.raw", "out.mhd", "--thickness", "3", "--distance", "d.nrrd")

    def test_distance(self):
        self.assert_stopped(signal.SIGINT, "distance", "in.raw", "out.nhdr")

    def test_existing_output_survives(self):
        (self.folder / "out.mha").write_bytes(b"precious")
        self.before.append("out.mha")
        self.before.sort()
        self.assert_stopped(signal.SIGTERM, "extract", "in.raw", "out.mha", "--thickness", "3", "--overwrite")
        self.assertEqual((self.folder / "out.mha").read_bytes(), b"precious")

    def test_kill_leaves_nothing(self):
        status, _ = self.stop(signal.SIGKILL, "extract", "in.raw", "out.mha", "--thickness", "3")
        self.assertEqual(status, -signal.SIGKILL)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), self.before)


if __name__ == "__main__":
    unittest.main()
