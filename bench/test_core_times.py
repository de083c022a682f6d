# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests of runs on paper with a core for each thread: times that are known, and sums by name.

Usage: MEDIALVOXEL_BUILD=BUILD python3 -m unittest test_core_times
"""

import os
import pathlib
import subprocess
import unittest

import core_times

TILES = pathlib.Path(os.environ["MEDIALVOXEL_BUILD"]) / "bench" / "tiles"


class TestVirtualCores(unittest.TestCase):
    """By hand: the work is over when the last thread is, and each takes work in the order of their clocks."""

    def test_known_times(self):
        cases = {
            "one thread": 0.08,
            "equal work": 0.04,
            "the longest work last": 0.10,
            "more threads than work": 0.06,
            "a lock": 0.08,
            "a queue": 0.11,
            "waiting in vain": 0.10,
            "a future": 0.08,
        }
        environment = {**os.environ, "LD_PRELOAD": str(TILES / "libmedialvoxel-cores.so")}
        for case, seconds in cases.items():
            with self.subTest(case):
                command = [str(TILES / "medialvoxel-try-cores"), case]
                measured = []
                # Others on the machine make a run longer.
                while len(measured) < 5 and not any(abs(one - seconds) <= 0.1 * seconds for one in measured):
                    run = subprocess.run(command, env=environment, check=True, capture_output=True, text=True, timeout=60)
                    measured.append(float(run.stdout))
                self.assertAlmostEqual(min(measured), seconds, delta=0.1 * seconds)


class TestSums(unittest.TestCase):
    """Two threads: both run from 0 to 10 s, the first one alone to 14, nobody to 16, the second one to 20."""

    SECOND = 10**9
    THREADS = [[[0, 14 * SECOND]], [[0, 10 * SECOND], [16 * SECOND, 20 * SECOND]]]
    NAMES = (("inner", "other"),)

    def summarize(self, cores):
        samples = [[thread, time * self.SECOND] for thread, time in ((0, 5), (0, 12), (1, 5), (1, 18))]
        return core_times.summarize({"threads": self.THREADS, "samples": samples}, cores, self.NAMES)

    def test_seconds_are_work_over_cores_and_what_cores_wait_for(self):
        result = self.summarize(2)
        self.assertAlmostEqual(result["seconds"], 20.0)
        self.assertAlmostEqual(result["work_cpu_seconds"], 28.0)
        self.assertAlmostEqual(sum(result["serial_seconds"].values()), 8.0)
        waiting_for_nobody = 2.0
        self.assertAlmostEqual(sum(result["idle_seconds"].values()) + 28.0 / 2 + waiting_for_nobody, 20.0)

    def test_more_cores_than_threads_wait_longer(self):
        self.assertAlmostEqual(sum(self.summarize(4)["idle_seconds"].values()), 18.0 - 28.0 / 4)

    def test_first_name_that_is_called_counts(self):
        names = (("Prepare", "first"), ("Run", "second"))
        self.assertEqual(core_times.name_of(["Loop::Run(int)", "Job::Prepare()"], names), "first")
        self.assertEqual(core_times.name_of(["Loop::Run(int)"], names), "second")
        self.assertEqual(core_times.name_of(["main"], names), core_times.OTHER)


if __name__ == "__main__":
    unittest.main()
