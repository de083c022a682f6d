# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Jobs that are refused tell which file, which value, and what to do."""

import contextlib
import fcntl
import os
import shutil
import subprocess
import unittest

import volumes
from jobs import JobTestCase, results
from program import FAILURE, PROGRAM, REFUSED, USAGE
from test_identity import rough_shell

# Bytes of the file of locks that stand for these.
PLANNING = 1 << 40
FINALIZING = PLANNING + 1

PLAN = ["plan", "../in.mha", "out.mha", "job", "--thickness", 2, "--divisions", 3]


class JobMessageTest(JobTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", rough_shell())

    def assert_message(self, part, *command, status=FAILURE):
        self.assertIn(part, self.in_target(*command, status=status).stderr)

    @contextlib.contextmanager
    def lock(self, thing):
        with open(self.job / "locks", "r+b") as file:
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, thing)
            yield

    def test_two_that_plan(self):
        self.job.mkdir()
        (self.job / "locks").touch()
        with self.lock(PLANNING):
            self.assert_message("job: another process has just planned a job in this folder", *PLAN, status=REFUSED)
        self.assert_nothing_published()
        self.in_target(*PLAN)
        self.assert_message("job is not empty, it has a job; medialvoxel status shows", *PLAN, status=REFUSED)

    def test_two_that_finalize(self):
        self.in_target(*PLAN)
        self.in_target("work", "job")
        with self.lock(FINALIZING):
            self.assert_message("job: another process is finalizing this job", "finalize", "job")
        self.in_target("finalize", "job")

    def test_resume_with_other_options(self):
        command = ["extract", *PLAN[1:3], *PLAN[4:], "--resume"]
        self.in_target(*PLAN[:3], "out.mha.job", *PLAN[4:])
        for options, difference in (
            (["--lower", 72], "--lower is 72, not unset"),
            (["--vectors", "v.mha"], f"--vectors is {self.target}/v.mha, not unset"),
        ):
            part = f"out.mha.job is of a job with other options: {difference}; remove the folder, and the files"
            self.assert_message(part, *command, *options, status=REFUSED)
        raw = os.fsencode(PROGRAM), *(os.fsencode(str(word)) for word in command), b"--vectors", b"\xff.mha"
        result = subprocess.run(raw, capture_output=True, cwd=self.target, check=False)
        self.assertEqual(result.returncode, REFUSED)
        self.assertIn(b"of a job with other options: --vectors is", result.stderr)
        self.in_target(*command)
        self.assertEqual([path.name for path in self.target.iterdir()], ["out.mha"])

    def test_output_that_came_up_can_be_replaced(self):
        """The message names an option that the command has."""
        expected = self.expect("extract", "../in.mha", "out.mha", "--thickness", 2)
        self.in_target(*PLAN)
        self.in_target("work", "job")
        (self.target / "out.mha").write_text("of another program")
        self.assert_message("it is replaced only with --overwrite", "finalize", "job", status=REFUSED)
        self.in_target("finalize", "job", "--overwrite")
        self.assertEqual((self.target / "out.mha").read_bytes(), expected["out.mha"])

    def test_resume_replaces_an_output_that_came_up(self):
        command = ["extract", *PLAN[1:3], *PLAN[4:], "--resume"]
        self.in_target(*PLAN[:3], "out.mha.job", *PLAN[4:])
        (self.target / "out.mha").write_text("of another program")
        self.assert_message("it is replaced only with --overwrite", *command, status=REFUSED)
        self.in_target(*command, "--overwrite")
        self.assertGreater((self.target / "out.mha").stat().st_size, 1000)

    def test_names_that_are_not_text(self):
        raw = [PROGRAM, "plan", "../in.mha", b"\xff.mha", "job"]
        result = subprocess.run(raw, capture_output=True, cwd=self.target, check=False)
        self.assertEqual(result.returncode, USAGE)
        self.assertIn(b"the names of the files of a job must be valid UTF-8", result.stderr)
        self.assertEqual(list(self.target.iterdir()), [])

    def test_folder_of_the_plan_is_gone(self):
        self.in_target(*PLAN)
        self.target.rename(self.folder / "moved")
        (self.folder / "moved/job").rename(self.job.parent.with_name("job"))
        result = self.run_program("work", "job", status=FAILURE)
        self.assertIn("to which the names of the job's files are relative: No such file", result.stderr)
        self.assertIn("plan the job with absolute names", result.stderr)

    def move(self, copies=False):
        """Moves or copies input, outputs and job folder; the copy becomes the folder of the test."""
        moved = self.folder / "elsewhere"
        moved.mkdir()
        for path in (self.folder / "in.mha", self.target):
            if path.is_dir():
                shutil.copytree(path, moved / path.name)
            else:
                shutil.copy2(path, moved)
            if not copies:
                path.rename(self.folder / f"gone-{path.name}")
        old, self.target = self.target, moved / "target"
        self.job = self.target / "job"
        return old

    def test_job_that_was_moved_goes_on(self):
        expected = self.expect("extract", "../in.mha", "out.mhd", "--thickness", 2, "--vectors", "v.zarr")
        plan = ["plan", "../in.mha", "out.mhd", "job", "--thickness", 2, "--divisions", 3, "--vectors", "v.zarr"]
        self.in_target(*plan)
        self.in_target("work", "job", "--clusters", 1)
        self.move()
        self.assertIn("clusters skipped  1", self.in_target("work", "job").stdout)
        self.run_program("finalize", self.job)
        self.in_target("finalize", "job")
        found = {name: data for name, data in results(self.target).items() if not name.startswith("job/")}
        self.assertEqual(found, expected)

    def test_copy_of_a_job_leaves_the_first_one_alone(self):
        self.in_target(*PLAN)
        old = self.move(copies=True)
        self.in_target("work", "job")
        self.in_target("finalize", "job")
        self.assertFalse((old / "out.mha").exists())
        self.assertEqual(list((old / "job/clusters").iterdir()), [])

    def test_resume_goes_on_after_a_move(self):
        self.in_target(*PLAN[:3], "out.mha.job", *PLAN[4:])
        self.in_target("work", "out.mha.job", "--clusters", 0)
        self.move()
        self.in_target("extract", *PLAN[1:3], *PLAN[4:], "--resume")
        self.assertEqual([path.name for path in self.target.iterdir()], ["out.mha"])

    def test_job_folder_alone_may_be_moved(self):
        self.in_target(*PLAN)
        self.job.rename(self.folder / "job")
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertTrue((self.target / "out.mha").exists())

    def test_input_that_was_moved(self):
        self.in_target(*PLAN)
        (self.folder / "in.mha").rename(self.folder / "other.mha")
        message = self.in_target("work", "job", status=FAILURE).stderr
        self.assertIn(f"the input {self.folder}/in.mha of the job is gone", message)
        self.assertIn("put it back, or plan the job again", message)

    def test_output_is_a_link_that_leads_elsewhere_now(self):
        (self.target / "a").mkdir()
        (self.target / "out.mha").symlink_to("a/out.mha")
        self.in_target(*PLAN)
        (self.target / "out.mha").unlink()
        (self.target / "out.mha").symlink_to("out2.mha")
        self.assert_message("No such file or directory; the output of the job is missing", "work", "job")

    def test_other_folder_comes_up_in_place_of_a_zarr_folder(self):
        self.in_target("plan", "../in.mha", "out.zarr", "job", "--overwrite")
        self.in_target("work", "job")
        (self.target / "out.zarr").mkdir()
        (self.target / "out.zarr/notes.txt").touch()
        self.assert_message("out.zarr exists and is not a Zarr folder", "finalize", "job", status=REFUSED)
        self.assertTrue((self.target / "out.zarr/notes.txt").exists())

    def test_outputs_in_one_zarr_folder(self):
        command = ["plan", "../in.mha", "out.zarr", "job", "--vectors", "out.zarr/v.mha"]
        self.assert_message("the vectors and the labels are in one Zarr folder", *command, status=USAGE)


if __name__ == "__main__":
    unittest.main()
