# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What tests share that have a scheduler do a job."""

import os
import pathlib
import random

import jobs
from jobs import JobTestCase
from processes import wait_until
from program import PROGRAM

PROGRAM_FOLDER = pathlib.Path(PROGRAM).parent
CLUSTERS = 20


class ScheduledJobTestCase(JobTestCase):
    """A job of some seconds in self.job."""

    SIZE = 150

    def setUp(self):
        super().setUp()
        # A solid with holes: distances that take their time, and labels everywhere.
        noise = random.Random(11)
        with open(self.folder / "in.raw", "wb") as file:
            file.truncate(self.SIZE**3)
            for _ in range(60):
                file.seek(noise.randrange(self.SIZE**3))
                file.write(b"\1")
        size = f"{self.SIZE},{self.SIZE},{self.SIZE}"
        self.options = ["--raw-size", size, "--raw-type", "uint8", "--upper", 0, "--thickness", 3]
        self.options += ["--divisions", CLUSTERS, "--threads", 1, "--report", "r.json", "--preview", "p.png"]

    def plan(self, *options):
        return self.in_target("plan", "../in.raw", "out.mha", "job", *self.options, *options)

    def wait_for_markers(self, number):
        wait_until(lambda: len(self.markers()) >= number, f"{number} clusters", 120, 0.01)

    def find_workers(self):
        """Processes that are at work on the job, and their clusters."""
        found = {}
        for number in filter(str.isdigit, os.listdir("/proc")):
            try:
                words = pathlib.Path("/proc", number, "cmdline").read_text().split("\0")
            except OSError:
                continue  # it has ended
            if "work" in words and str(self.job) in words:
                found[int(number)] = words[words.index("--clusters") + 1]
        return found

    def assert_kept(self, before):
        """No cluster that was done before has been done again."""
        after = self.markers()
        self.assertEqual({name: after[name] for name in before}, before)

    def assert_same_bytes(self):
        """As one run makes of the same volume."""
        expected = self.expect("extract", "../in.raw", "out.mha", *self.options)
        self.assertEqual(jobs.results(self.target), expected)
