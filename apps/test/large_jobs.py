# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A job on the cover phantom, 1.5 billion voxels: killed twenty times, and done by four processes. 6 GB of disk."""

import filecmp
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import time
import unittest

import jobs
from program import PROGRAM, ProgramTestCase

PHANTOM = pathlib.Path(os.environ["MEDIALVOXEL_BUILD"]) / "bench/phantom/medialvoxel-phantom"
SIZE = "1500,1500,668"
CLUSTERS = 21
KILLS = 20


class LargeJobTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        if not PHANTOM.exists():
            self.skipTest("the benchmarks, which make the volume, were not built")
        if shutil.disk_usage(self.folder).free < 6 * 10**9:
            self.skipTest("6 GB of disk are needed")
        subprocess.run([PHANTOM, "cover", self.folder / "in.raw", "--size", SIZE], check=True, capture_output=True)
        (self.folder / "expected").mkdir()
        self.options = ["--raw-size", SIZE, "--raw-type", "uint8", "--thickness", 3, "--progress", "none"]
        self.options += ["--report", "r.json", "--preview", "p.png", "--divisions", CLUSTERS]
        begin = time.monotonic()
        self.seconds = self.run_in("expected", "extract", "../in.raw", "out.mha", *self.options, "--threads", 2)
        self.cluster_seconds = (time.monotonic() - begin) / CLUSTERS
        (self.folder / "target").mkdir()

    def start(self, *arguments):
        process = subprocess.Popen(
            [PROGRAM, *map(str, arguments)], cwd=self.folder / "target", stdout=subprocess.DEVNULL
        )
        self.addCleanup(process.kill)
        return process

    def run_in(self, folder, *arguments):
        """Seconds of the processor in user mode."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder / folder, check=True, capture_output=True)
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

    def assert_same_outputs(self):
        target, expected = self.folder / "target", self.folder / "expected"
        for name in ("out.mha", "p.png"):
            self.assertTrue(filecmp.cmp(target / name, expected / name, shallow=False), name)
        reports = [json.loads((folder / "r.json").read_text()) for folder in (target, expected)]
        for report in reports:
            for key in jobs.RUN_KEYS:
                del report[key]
        self.assertEqual(*reports)

    def test_killed_twenty_times(self):
        noise = random.Random(11)
        folder = self.folder / "target" / "out.mha.job"
        command = ["extract", "../in.raw", "out.mha", *self.options, "--threads", 2, "--resume"]
        wasted, kills, done, ended = 0, 0, set(), False
        while kills < KILLS and not ended:
            process = self.start(*command)
            time.sleep(noise.uniform(0.1, 1.9) * self.cluster_seconds)  # any moment will do
            # While it is stopped, its locks tell what it is at.
            process.send_signal(signal.SIGSTOP)
            status = {"running": {"number": 0}}
            if (folder / "manifest.json").exists():
                text = subprocess.run([PROGRAM, "status", folder, "--json"], check=True, capture_output=True).stdout
                status = json.loads(text)
            process.send_signal(signal.SIGKILL)
            # A machine that others leave alone by now is faster than it was for the expected results.
            ended = process.wait() == 0
            self.assertIn(process.returncode, (0, -signal.SIGKILL))
            kills += 0 if ended else 1
            self.assertLessEqual(status["running"]["number"], 1)
            wasted += status["running"]["number"]
            markers = {(path.name, path.stat().st_mtime_ns) for path in folder.glob("clusters/*.json")}
            self.assertLessEqual(done, markers, "a cluster that was done was done again")
            done = markers
        self.assertGreaterEqual(kills, KILLS // 4, "the job ended before it was killed often enough")
        if not ended:
            self.run_in("target", *command)
        print(f"{kills} kills, {len(done)} clusters done before the last one, {wasted} begun in vain", flush=True)
        self.assertGreater(len(done), 0)
        self.assertLessEqual(wasted, KILLS)
        self.assert_same_outputs()

    def test_four_processes(self):
        seconds = self.run_in("target", "plan", "../in.raw", "out.mha", "job", *self.options)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        workers = [self.start("work", "job", "--threads", 1, "--progress", "none") for _ in range(4)]
        for worker in workers:
            self.assertEqual(worker.wait(), 0)
        seconds += resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        finalization = self.run_in("target", "finalize", "job")
        print(
            f"one process with two threads {self.seconds:.2f} s, four processes {seconds:.2f} s of the processor, "
            f"and {finalization:.2f} s to verify and publish",
            flush=True,
        )
        self.assert_same_outputs()


if __name__ == "__main__":
    unittest.main()
