# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The job array of medialvoxel plan --slurm: as a script, and in a Slurm that is cancelled half way."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

import jobs
import slurm_node
import volumes
from jobs import JobTestCase
from processes import wait_until
from program import REFUSED, USAGE
from scheduled_jobs import CLUSTERS, PROGRAM_FOLDER, ScheduledJobTestCase
from test_identity import rough_shell


class SlurmScriptTest(JobTestCase):
    """Without a Slurm: the script is run as Slurm runs a task."""

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", rough_shell())

    def plan(self, *options, job="job", status=0, divisions=7):
        options = ["--thickness", 2, "--divisions", divisions, *options]
        return self.in_target("plan", "../in.mha", "out.mha", job, *options, status=status)

    def run_task(self, script, number, **environment):
        environment = {"SLURM_ARRAY_TASK_ID": str(number), "SLURM_CPUS_PER_TASK": "1", **environment}
        environment = {**slurm_node.environment_for([PROGRAM_FOLDER]), **environment}
        command = ["sh", "-eu", script]
        result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, cwd="/")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_tasks_do_all_clusters(self):
        expected = self.expect("extract", "../in.mha", "out.mha", "--thickness", 2)
        script = self.target / "job with 'quotes'/slurm.sh"
        for per_task, last_task in ((1, 6), (2, 3), (3, 2), (7, 0), (50, 0)):
            self.plan("--slurm", "--slurm-clusters", per_task, "--threads", 3, job=script.parent)
            text = script.read_text()
            self.assertIn(f"#SBATCH --array=0-{last_task}\n", text)
            self.assertIn("#SBATCH --cpus-per-task=3\n", text)
            for task in reversed(range(last_task + 1)):
                self.assertIn("clusters skipped  0\n", self.run_task(script, task))
            self.assertIn("clusters done     0\n", self.run_task(script, 0))
            self.in_target("finalize", script.parent)
            self.assertEqual(jobs.results(self.target), expected)
            self.clear_target()

    def test_array_of_many_clusters_has_few_tasks(self):
        self.plan("--slurm", divisions=1)
        self.assertIn("#SBATCH --array=0-0\n", (self.job / "slurm.sh").read_text())
        self.clear_target()
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((3, 3, 130), [1] * 1170))
        self.plan("--slurm", divisions=130)
        self.assertIn("#SBATCH --array=0-43\n", (self.job / "slurm.sh").read_text())

    def test_memory(self):
        self.plan("--slurm")
        self.assertIn("#SBATCH --mem=1152M\n", (self.job / "slurm.sh").read_text())
        self.clear_target()
        self.plan("--slurm", "--memory", "800M")
        script = self.job / "slurm.sh"
        self.assertIn("#SBATCH --mem=900M\n", script.read_text())
        # What sbatch --mem gives wins.
        echo = self.folder / "bin"
        echo.mkdir()
        (echo / "medialvoxel").write_text('#!/bin/sh\necho "$@"\n')
        (echo / "medialvoxel").chmod(0o755)
        path = f"{echo}{os.pathsep}{os.environ['PATH']}"
        self.assertIn("--memory 800M", self.run_task(script, 0, PATH=path))
        self.assertIn("--memory 1600M", self.run_task(script, 0, PATH=path, SLURM_MEM_PER_NODE="1800"))

    def test_name_of_the_script(self):
        out = self.plan("--slurm=array.sh", "--slurm-clusters=2%3").stdout
        self.assertIn("#SBATCH --array=0-3%3\n", (self.target / "array.sh").read_text())
        self.assertFalse((self.job / "slurm.sh").exists())
        self.assertIn(f"sbatch {self.target}/array.sh\n", out)
        self.assertIn("7, 0 to 6, in 4 tasks of a job array", out)
        message = self.plan("--slurm=array.sh", job="other", status=REFUSED).stderr
        self.assertIn("array.sh exists; it is replaced only with --overwrite", message)
        self.assertFalse((self.target / "other").exists())
        self.plan("--slurm=array.sh", "--overwrite", job="other")
        self.assertIn("/other\n", (self.target / "array.sh").read_text())

    def test_what_is_refused(self):
        for clusters in ("0", "x", "2%", "%2", "2%0", "-1"):
            message = self.plan("--slurm", f"--slurm-clusters={clusters}", status=USAGE).stderr
            self.assertIn("is not a number of clusters from 1 on such as 4, or two as 4%8", message)
        self.assertIn("--slurm", self.plan("--slurm-clusters", 2, status=USAGE).stderr)
        self.assertIn("input", self.plan("--slurm=../in.mha", "--overwrite", status=USAGE).stderr)
        self.assertIn("is named for both", self.plan("--slurm=out.mha", status=USAGE).stderr)
        self.assertIn("does not exist", self.plan("--slurm=none/array.sh", status=REFUSED).stderr)
        self.assertFalse(list(self.target.iterdir()))

    def test_dry_run_writes_nothing(self):
        self.plan("--slurm", "--dry-run")
        self.assertFalse(list(self.target.iterdir()))


@unittest.skipIf(slurm_node.why_not(), slurm_node.why_not())
class SlurmTest(ScheduledJobTestCase):
    def setUp(self):
        super().setUp()
        self.logs = self.folder / "logs"
        self.logs.mkdir()
        # Names of sockets are short.
        folder = tempfile.mkdtemp(prefix="medialvoxel-slurm-")
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        self.slurm = slurm_node.SlurmNode(folder, [PROGRAM_FOLDER])
        self.addCleanup(self.slurm.stop)

    def submit(self, command):
        """Number of the last job that the command of a shell submits."""
        out = self.slurm.run("sh", "-c", command, cwd=self.logs)
        return int(re.fullmatch(r"Submitted batch job (\d+)\n", out)[1])

    def count(self, array):
        """Clusters that tasks of an array which ended by themselves have done and skipped."""
        text = "".join(path.read_text() for path in self.logs.glob(f"slurm-{array}_*.out"))
        return [sum(map(int, re.findall(rf"^clusters {kind} +(\d+)$", text, re.MULTILINE))) for kind in ("done", "skipped")]

    def kill_a_process(self):
        """As when a machine fails: the task of the process fails, the others go on."""
        found = wait_until(self.find_workers, "a worker", 120, 0.01)
        os.kill(min(found), signal.SIGKILL)

    def test_killed_and_cancelled_half_way_and_submitted_again_unchanged(self):
        out = self.plan("--slurm", "--slurm-clusters", 2).stdout
        command = re.search(r"^or both +(.*)$", out, re.MULTILINE)[1]
        script = (self.job / "slurm.sh").read_bytes()

        first = self.submit(command) - 1
        self.wait_for_markers(CLUSTERS // 5)
        self.kill_a_process()
        self.wait_for_markers(CLUSTERS // 3)
        self.slurm.run("scancel", str(first))
        self.slurm.wait_for(lambda: not self.slurm.queue())
        before = self.markers()
        self.assertLess(len(before), CLUSTERS)
        self.assert_nothing_published()

        last = self.submit(command)
        self.slurm.wait_for(lambda: not self.slurm.queue(), 200)
        self.assertEqual((self.job / "slurm.sh").read_bytes(), script)
        done, skipped = self.count(last - 1)
        print(f"done before: {len(before)}, then {done} of {CLUSTERS} done and {skipped} skipped", flush=True)
        self.assertEqual((done, skipped), (CLUSTERS - len(before), len(before)))
        self.assert_kept(before)
        self.assert_same_bytes()


if __name__ == "__main__":
    unittest.main()
