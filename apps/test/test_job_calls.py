# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Jobs that are killed, stopped or fail at a chosen call of the system; large_job_kills.py has all calls."""

import os
import pathlib
import signal
import subprocess
import unittest

from job_kills import JOB_OPTIONS, WORK, JobKillCase
from jobs import results
from processes import wait_until
from program import FAILURE
from system_calls import command_with, needs_strace, run_with

PLAN = ["plan", "../in.mha", "out.mha", "job", *JOB_OPTIONS]


@needs_strace
class JobCallTest(JobKillCase):
    def test_killed_when_names_change(self):
        """One process that plans, works and finalizes, over the outputs of another run."""
        self.assertGreater(self.check_resume(["renameat2", "rename", "rmdir"], "--overwrite"), 20)

    def assert_stopped(self, injection, command, message, path=None):
        result = run_with(injection + ":signal=SIGTERM:when=1", command, self.target, path)
        self.assertEqual((result.returncode, result.stdout), (128 + signal.SIGTERM, ""), result.stderr)
        self.assertIn(message, result.stderr)

    def test_plan_is_stopped(self):
        self.assert_stopped("fallocate", PLAN, "stopped, no output was written")
        self.assertEqual(list(self.target.iterdir()), [])

    def test_finalize_is_stopped(self):
        """While it verifies the first cluster."""
        self.prepare([], PLAN, WORK)
        path = next(self.target.glob("out.mha.*.partial"))
        self.assert_stopped("pread64", ["finalize", "job"], f"to continue: medialvoxel finalize {self.job}", path)
        self.assert_nothing_published()
        self.in_target("finalize", "job")
        self.assertEqual(results(self.target), self.expected)

    def test_finalize_is_stopped_within_a_cluster(self):
        """Of 12 MB, each of which takes a second to read."""
        path = self.folder / "in.raw"
        path.write_bytes(bytes(10**6 - 1) + b"\1")
        options = ["--raw-size", "100,100,100", "--raw-type", "uint8", "--divisions", 1, "--vectors", "v.mha"]
        self.in_target("plan", path, "out.mha", "job", *options)
        self.in_target(*WORK)
        trace = self.folder / "trace"
        slow = ["pread64:delay_enter=1000000", ["finalize", "job"], next(self.target.glob("v.mha.*.partial")), trace]
        with subprocess.Popen(command_with(*slow), cwd=self.target, stderr=subprocess.PIPE, text=True) as process:
            wait_until(lambda: process.poll() is not None or self.count_reads(trace) >= 2, "the second megabyte")
            child = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()[0]
            before = self.count_reads(trace)
            os.kill(int(child), signal.SIGTERM)
            error = process.communicate()[1]
        self.assertEqual(process.returncode, 128 + signal.SIGTERM, error)
        self.assertLessEqual(self.count_reads(trace), before + 2)

    @staticmethod
    def count_reads(trace):
        return trace.read_text().count("pread64(") if trace.exists() else 0

    def test_reserving_space_is_interrupted(self):
        """As when a process is halted and goes on."""
        result = run_with("fallocate:error=EINTR:when=1..2", PLAN, self.target)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_disk_fails(self):
        """The message names the file; what was done before counts."""
        start = self.prepare([], PLAN)
        for call, error, reason in (
            ("pwrite64:when=2", "EDQUOT", "Disk quota exceeded"),
            ("fdatasync:when=2", "EIO", "Input/output error"),
            ("fsync:when=1", "ENOSPC", "No space left on device"),
            ("rename:when=3", "EIO", "Input/output error"),
        ):
            start.restore()
            result = run_with(f"{call}:error={error}", WORK, self.target)
            self.assertEqual((result.returncode, result.stdout), (FAILURE, ""), call)
            self.assertRegex(result.stderr, rf"\Amedialvoxel: cannot .* \S+: {reason}\n\Z")
            self.in_target(*WORK)
            self.in_target("finalize", "job")
            self.assertEqual(results(self.target), self.expected)

    def test_disk_that_lies(self):
        """It says that it has written voxels, and has not."""
        self.prepare([], PLAN)
        result = run_with("pwrite64:retval=15840:when=1", WORK, self.target)
        self.assertEqual(result.returncode, 0, result.stderr)
        message = self.in_target("finalize", "job", status=FAILURE).stderr
        self.assertIn("do not have the checksums that they were written with: 0; compute them again", message)
        self.assert_nothing_published()
        self.in_target(*WORK)
        self.in_target("finalize", "job")
        self.assertEqual(results(self.target), self.expected)


if __name__ == "__main__":
    unittest.main()
