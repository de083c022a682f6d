# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Each command of a job killed at each call of the system that changes a file or a folder."""

import unittest

from job_kills import JOB_OPTIONS, WORK, JobKillCase
from system_calls import needs_strace

CALLS = "pwrite64 ftruncate fallocate rename renameat2 unlink unlinkat mkdir rmdir".split()
PLAN = ["plan", "../in.mha", "out.mha", "job", *JOB_OPTIONS]
FINALIZE = ["finalize", "job"]


@needs_strace
class LargeJobKillTest(JobKillCase):
    def report(self, kills, least):
        print(f"{kills} kills", flush=True)
        self.assertGreater(kills, least)

    def test_resume(self):
        self.report(self.check_resume(CALLS), 70)

    def test_resume_that_overwrites(self):
        self.report(self.check_resume(CALLS, "--overwrite"), 80)

    def test_plan(self):
        self.report(self.check_part(CALLS, PLAN, [], [PLAN, WORK, FINALIZE]), 20)

    def test_work(self):
        self.report(self.check_part(CALLS, WORK, [PLAN], [WORK, FINALIZE]), 20)

    def test_finalize(self):
        self.report(self.check_part(CALLS, FINALIZE, [PLAN, WORK], [FINALIZE]), 15)

    def test_finalize_that_overwrites(self):
        plan = [*PLAN, "--overwrite"]
        self.report(self.check_part(CALLS, FINALIZE, [plan, WORK], [FINALIZE], "--overwrite"), 25)


if __name__ == "__main__":
    unittest.main()
