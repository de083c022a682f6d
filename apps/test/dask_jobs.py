# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What test_dask.py runs: python/medialvoxel_dask.py with two worker processes, one of which is killed half way."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

from program import PROGRAM
from scheduled_jobs import CLUSTERS, ScheduledJobTestCase

HELPERS = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "python"
sys.path.insert(0, str(HELPERS))

import distributed  # noqa: E402
import medialvoxel_dask  # noqa: E402


def get_parent(process):
    """Of a process, or nothing when it has ended."""
    try:
        return int(pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])
    except OSError:
        return None


class DaskJobTest(ScheduledJobTestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="medialvoxel-dask-")
        cls.addClassCleanup(folder.cleanup)
        cluster = distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1",
            dashboard_address=None, local_directory=folder.name, silence_logs="CRITICAL",
        )  # fmt: skip
        cls.addClassCleanup(cluster.close)
        cls.client = distributed.Client(cluster)
        cls.addClassCleanup(cls.client.close)

    def setUp(self):
        super().setUp()
        self.client.wait_for_workers(2)

    def count_done(self, clusters):
        """Of a range such as 10-19."""
        first, last = map(int, clusters.split("-"))
        return sum(f"{cluster:06}.json" in self.markers() for cluster in range(first, last + 1))

    def lose_a_worker(self):
        """Kills a worker and the command that it runs, as when its machine fails: the one that has done more."""
        commands = self.find_workers()
        command = max(commands, key=lambda process: self.count_done(commands[process]))
        workers = set(self.client.run(os.getpid).values())
        self.assertIn(get_parent(command), workers)
        for process in (get_parent(command), command):
            os.kill(process, signal.SIGKILL)
        return self.count_done(commands[command])

    def in_background(self, function, *arguments, **options):
        """Begins to call a function; the result is a list that it, or its error, will be in, and the thread."""
        results = []

        def call():
            try:
                results.append(function(*arguments, **options))
            except BaseException as error:
                results.append(error)

        thread = threading.Thread(target=call)
        thread.start()
        self.addCleanup(thread.join)
        return results, thread

    def test_worker_killed_half_way(self):
        self.plan()
        results, thread = self.in_background(
            medialvoxel_dask.run_job, self.client, self.job, program=PROGRAM, clusters_per_task=CLUSTERS // 2
        )
        self.wait_for_markers(CLUSTERS // 3)
        lost = self.lose_a_worker()
        before = self.markers()
        self.assertLess(len(before), CLUSTERS)
        thread.join()
        print(f"{len(before)} done when a worker was killed, {lost} by it; in the end: {results}", flush=True)
        # A marker may come up between the kill and the count.
        self.assertIn(results[0], [(CLUSTERS - skipped, skipped) for skipped in (lost, lost + 1)])
        self.assert_kept(before)
        self.assert_same_bytes()

    def test_what_is_done_is_skipped(self):
        self.plan()
        self.in_target("work", "job", "--clusters", "3-9")
        before = self.markers()
        counts = medialvoxel_dask.work(self.client, self.job, program=PROGRAM, memory="1G")
        self.assertEqual(counts, (CLUSTERS - 7, 7))
        self.assert_kept(before)
        self.assert_nothing_published()
        command = [sys.executable, "-B", HELPERS / "medialvoxel_dask.py", self.job, "--program", PROGRAM]
        command += ["--scheduler", self.client.scheduler.address]
        result = subprocess.run(command, capture_output=True, text=True, check=True)
        self.assertEqual(result.stdout, f"clusters executed  0\nclusters skipped   {CLUSTERS}\n")
        self.assert_same_bytes()

    def test_errors_of_the_program_arrive(self):
        self.plan()
        for path in self.target.glob("*.partial"):
            path.unlink()
        with self.assertRaisesRegex(medialvoxel_dask.JobError, "^medialvoxel: .*out.mha"):
            medialvoxel_dask.run_job(self.client, self.job, program=PROGRAM, retries=0)
        with self.assertRaisesRegex(medialvoxel_dask.JobError, "is not a job folder"):
            medialvoxel_dask.run_job(self.client, self.folder, program=PROGRAM)
        with self.assertRaisesRegex(ValueError, "clusters_per_task is 0"):
            medialvoxel_dask.run_job(self.client, self.job, program=PROGRAM, clusters_per_task=0)

    def test_interrupted_and_called_again(self):
        self.plan()
        real, taken = medialvoxel_dask._output, []

        def stop_at_the_third(future):
            taken.append(future)
            if len(taken) == 4:
                raise KeyboardInterrupt
            return real(future)

        medialvoxel_dask._output = stop_at_the_third
        self.addCleanup(setattr, medialvoxel_dask, "_output", real)
        with self.assertRaises(KeyboardInterrupt):
            medialvoxel_dask.work(self.client, self.job, program=PROGRAM)
        medialvoxel_dask._output = real
        before = self.markers()
        self.assertTrue(3 <= len(before) < CLUSTERS - 2, len(before))
        counts = medialvoxel_dask.run_job(self.client, self.job, program=PROGRAM)
        self.assertGreaterEqual(counts.skipped, len(before))
        self.assertEqual(sum(counts), CLUSTERS)
        self.assert_kept(before)
        self.assert_same_bytes()


if __name__ == "__main__":
    unittest.main()
