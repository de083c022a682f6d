# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What a job that was killed at any call of the system leaves, and that it goes on from there to the same bytes."""

import os

import volumes
from jobs import JobTestCase, results
from program import REFUSED
from system_calls import PreparedFolder, compare, kill_at_each
from test_identity import rough_shell

OPTIONS = ["--thickness", 2, "--vectors", "v.mhd", "--distance", "d.zarr", "--preview", "p.png", "--report", "r.json"]
JOB_OPTIONS = [*OPTIONS, "--divisions", 3, "--threads", 1]
WORK = ["work", "job", "--threads", 1]


class JobKillCase(JobTestCase):
    # Memory where there is such a disk: hundreds of runs would wait for another one most of the time.
    PLACE = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", rough_shell())

    def prepare(self, overwrites, *commands):
        """Sets what each run begins with, and what is expected of it in the end."""
        extract = ["extract", "../in.mha", "out.mha", *OPTIONS]
        if overwrites:
            self.in_target(*extract, "--spacing", "0.5,0.5,0.5")
        start = PreparedFolder(self.target, self.folder / "start")
        self.in_target(*extract, *overwrites)
        self.expected = results(self.target)
        start.restore()
        for command in commands:
            self.in_target(*command)
        return PreparedFolder(self.target, self.folder / "prepared") if commands else start

    def check_resume(self, calls, *overwrites):
        """Returns the number of kills."""
        command = ["extract", "../in.mha", "out.mha", *JOB_OPTIONS, "--resume", *overwrites]
        start = self.prepare(overwrites)

        def check(label):
            left = self.target / "out.mha.job"
            if results(self.target) == self.expected and not (left / "manifest.json").exists():
                # All is done, but for the folder of the job.
                if not overwrites:
                    self.in_target(*command, status=REFUSED)
                compare(self, label, self.expected, [left.name])
            else:
                self.in_target(*command)
                compare(self, label, self.expected)

        return sum(kill_at_each(call, command, start.restore, check, self.target) for call in calls)

    def check_part(self, calls, killed, before, after, *overwrites):
        """Kills one command, with others before and after it. Returns the number of kills."""
        start = self.prepare(overwrites, *before)

        def check(label):
            planned = killed[0] == "plan" and (self.job / "manifest.json").exists()
            for command in after[1:] if planned else after:
                self.in_target(*command)
            compare(self, label, self.expected, ["job"])

        return sum(kill_at_each(call, killed, start.restore, check, self.target) for call in calls)
