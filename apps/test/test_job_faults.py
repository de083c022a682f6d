# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Faults of a job's files, disks and processes: a clear error and a way on, never a file that looks like a result."""

import json
import os
import re
import shutil
import signal
import subprocess
import unittest

import jobs
import volumes
from jobs import JobTestCase
from processes import open_files_of, state_of, wait_until
from program import FAILURE, PROGRAM, REFUSED, unprivileged
from test_identity import rough_shell

OPTIONS = ["--thickness", 2, "--vectors", "v.nhdr", "--preview", "p.png", "--report", "r.json", "--divisions", 7]


class JobFaultTest(JobTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", rough_shell())
        self.expected = self.expect("extract", "../in.mha", "out.mha", *OPTIONS)

    def plan(self, *options):
        self.in_target("plan", "../in.mha", "out.mha", "job", *OPTIONS, *options)

    def cluster(self, number, extension="json"):
        return self.job / "clusters" / f"{number:06}.{extension}"

    def partial(self, name="out.mha"):
        return next(self.target.glob(f"{name}.*.partial"))

    def assert_refused(self, *parts, commands=("work", "finalize"), status=FAILURE):
        for command in commands:
            message = self.in_target(command, "job", status=status).stderr
            for part in parts:
                self.assertIn(part, message)
        self.assert_nothing_published()

    def assert_finishes(self):
        self.in_target("finalize", "job")
        self.assertEqual(jobs.results(self.target), self.expected)

    def assert_done_again(self, clusters, ending):
        """Finalizing names these clusters, and when they are done again it succeeds."""
        message = self.in_target("finalize", "job", status=FAILURE).stderr
        self.assertIn(f"{ending}: {clusters};", message)
        self.assert_nothing_published()
        self.assertIn("clusters done     1\n", self.in_target("work", "job").stdout)
        self.assert_finishes()

    # The input

    def test_input_of_another_time(self):
        path = self.folder / "in.mha"
        # An even time may be what a file system of a network makes of the next nanosecond.
        os.utime(path, ns=(path.stat().st_atime_ns, path.stat().st_mtime_ns | 1))
        self.plan()
        self.in_target("work", "job", "--clusters", "0-5")
        times = path.stat()
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns + 1))
        self.assert_refused("in.mha has changed since the job was planned: it was written at another time")
        os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
        self.in_target("work", "job")
        self.assert_finishes()

    def test_input_of_another_size_or_gone(self):
        self.plan()
        path = self.folder / "in.mha"
        with open(path, "ab") as file:
            file.write(b"x")
        self.assert_refused("in.mha has changed", "bytes, it had")
        path.unlink()
        self.assert_refused("in.mha", "No such file")

    def test_input_of_many_files(self):
        """Chunks of a Zarr folder; the folder itself does not tell when one of them changes."""
        self.in_target("distance", "../in.mha", "v.mha", "--distance", "../z.zarr", "--compress", "none")
        command = ["../z.zarr", "out.mha", "--upper", 0, "--thickness", 2]
        self.in_target("extract", *command)
        expected = (self.target / "out.mha").read_bytes()
        chunk = next(path for path in (self.folder / "z.zarr/0").rglob("0") if path.is_file())
        times, content = chunk.stat(), chunk.read_bytes()
        self.clear_target()
        self.in_target("plan", *command[:2], "job", *command[2:])
        self.in_target("work", "job")
        chunk.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
        self.assert_refused("z.zarr has changed", "another time", commands=["finalize"])
        chunk.unlink()
        self.assert_refused("z.zarr has changed", "bytes, it had", commands=["finalize"])
        chunk.write_bytes(content)
        os.utime(chunk, ns=(times.st_atime_ns, times.st_mtime_ns))
        self.in_target("finalize", "job")
        self.assertEqual((self.target / "out.mha").read_bytes(), expected)

    # The files of the job

    def test_manifest_was_changed(self):
        self.plan()
        path = self.job / "manifest.json"
        text = path.read_text()
        for changed in (
            text.replace('"--thickness": "2"', '"--thickness": "3"'),
            text.replace('"number": 7', '"number": 6'),
            text[: len(text) // 2],
            "",
            "{}",
            "[1]",
            "\0" * 100,
            '{"checksum": -1}',
            "[" * 100000,
        ):
            self.assertNotEqual(changed, text)
            path.write_text(changed)
            self.assert_refused("manifest.json is damaged or was changed", commands=("work", "finalize", "status"))
        path.write_text(text)
        self.in_target("work", "job")
        self.assert_finishes()

    def test_manifest_of_another_form(self):
        """The checksum is right, what it seals is not what this program writes."""
        self.plan()
        path = self.job / "manifest.json"
        content = json.loads(path.read_text())
        for name, value, part in (
            ("version", "0.0.1", "version 0.0.1"),
            ("format", 4, "(format 4)"),
            ("job", 5, "not a manifest"),
            ("parameters", {}, "not a manifest"),
            ("parameters", {**content["parameters"], "--vector-boundary": "both"}, "both"),
            ("parameters", {**content["parameters"], "--raw-size": "1"}, "not a manifest"),
            ("input", [{}], "not a manifest"),
            ("clusters", {**content["clusters"], "number": 0}, "not a manifest"),
            ("clusters", {**content["clusters"], "number": 10**9}, "not a manifest"),
        ):
            path.write_text(jobs.seal({**content, name: value}))
            self.assert_refused(part)
        path.write_text(jobs.seal(content))
        self.in_target("work", "job")
        self.assert_finishes()

    def test_marker_that_is_none(self):
        self.plan()
        self.in_target("work", "job")
        path = self.cluster(3)
        good = path.read_text()
        content = json.loads(good)
        for bad in (
            good.replace('"cluster": 3', '"cluster": 2'),
            good[:-20],
            "",
            self.cluster(2).read_text(),
            jobs.seal({**content, "job": "0" * 16}),
            jobs.seal({**content, "counts": {}}),
            jobs.seal({**content, "checksums": "none"}),
        ):
            path.write_text(bad)
            self.assertIn("1 of 7 clusters are not done: 3;", self.in_target("finalize", "job", status=FAILURE).stderr)
            self.assertEqual(self.status()["missing"]["clusters"], "3")
        self.assertIn("clusters done     1\n", self.in_target("work", "job").stdout)
        self.assert_finishes()

    def test_survey_is_damaged_or_gone(self):
        for change in (lambda path: path.unlink(), lambda path: path.write_bytes(path.read_bytes()[:-1] + b"x")):
            self.plan("--overwrite")
            self.in_target("work", "job")
            change(self.cluster(4, "survey"))
            self.assert_done_again(4, "were written with")
            self.clear_target()

    # The outputs

    def flip(self, path, offset):
        with open(path, "r+b") as file:
            file.seek(offset)
            byte = file.read(1)[0]
            file.seek(offset)
            file.write(bytes([byte ^ 1]))

    def test_outputs_are_damaged(self):
        for name, offset in (("out.mha", -1), ("v.raw", 0)):
            self.plan()
            self.in_target("work", "job")
            path = self.partial(name)
            self.flip(path, offset % path.stat().st_size)
            self.assert_done_again(6 if offset else 0, "were written with")
            self.clear_target()

    def test_header_of_an_output_is_damaged(self):
        self.plan()
        self.in_target("work", "job")
        self.flip(self.partial(), 3)
        self.assert_refused("out.mha: its header was changed", commands=["finalize"])

    def test_outputs_are_cut_or_gone(self):
        self.plan()
        self.in_target("work", "job", "--clusters", "0-5")
        path = self.partial()
        content = path.read_bytes()
        path.write_bytes(content[:-1])
        self.assert_refused(f"has {len(content) - 1} bytes, not {len(content)}", commands=["work"])
        path.unlink()
        self.assert_refused(path.name, "No such file", "plan the job again", commands=["work"])
        path.write_bytes(content)
        self.in_target("work", "job")
        content = path.read_bytes()
        path.write_bytes(content[:-1])
        self.assert_refused(f"has {len(content) - 1} bytes, not {len(content)}", commands=["finalize"])
        path.write_bytes(content)
        self.assert_finishes()

    # Folders and disks

    def test_folder_is_removed_meanwhile(self):
        self.plan()
        process = self.start("work", "job", "--clusters", "0")
        shutil.rmtree(self.job / "clusters")
        out, error = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out), (FAILURE, ""))
        self.assertIn("clusters", error)
        self.assert_nothing_published()

    def test_folder_that_cannot_be_written(self):
        options = unprivileged()
        self.folder.chmod(0o755)
        self.target.chmod(0o755)
        command = [PROGRAM, "plan", "../in.mha", "out.mha", "job"]
        result = subprocess.run(command, cwd=self.target, capture_output=True, text=True, check=False, **options)
        self.assertEqual(result.returncode, REFUSED, result.stderr)
        self.assertEqual(list(self.target.iterdir()), [])
        self.plan()
        result = subprocess.run(
            [PROGRAM, "work", "job"], cwd=self.target, capture_output=True, text=True, check=False, **options
        )
        self.assertEqual((result.returncode, result.stdout), (FAILURE, ""), result.stderr)
        self.assertIn("Permission denied", result.stderr)
        self.in_target("work", "job")
        self.assert_finishes()

    def test_disk_of_the_outputs_is_full(self):
        disk = self.target / "disk"
        self.mount_small_disk(disk, "256k")
        message = self.in_target(
            "plan", "../in.mha", "disk/out.mha", "job", "--vectors", "disk/v.mha", status=REFUSED
        ).stderr
        self.assertIn("no space for the outputs", message)
        self.assertEqual((list(disk.iterdir()), self.job.exists()), ([], False))

    def test_disk_of_the_job_is_full(self):
        self.mount_small_disk(self.job, "256k")
        self.plan()
        self.in_target("work", "job", "--clusters", "0-1")
        filler = self.job / "filler"
        with open(filler, "wb", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(4096))
            except OSError:
                pass
        before = self.markers()
        self.assert_refused("No space left", commands=["work"])
        self.assertEqual(self.markers(), before)
        filler.unlink()
        self.in_target("work", "job")
        self.assert_finishes()

    # Several processes

    def test_two_processes_and_one_cluster(self):
        """One does it, the other one waits for it."""
        self.plan()
        workers = [self.start("work", "job", "--clusters", "3") for _ in range(4)]
        out = [worker.communicate(timeout=60)[0] for worker in workers]
        self.assertEqual([worker.returncode for worker in workers], [0] * 4)
        self.assertEqual(sum("clusters done     1\n" in text for text in out), 1)
        self.in_target("work", "job")
        self.assert_finishes()

    def test_two_processes_without_locks(self):
        """As on a file system that has none: both write the same bytes."""
        self.plan()
        workers = []
        for _ in range(4):
            (self.job / "locks").unlink(missing_ok=True)
            workers.append(self.start("work", "job"))
            wait_until(lambda: self.has_locks(workers[-1]), "the file of locks")
        for worker in workers:
            self.assertEqual(worker.wait(timeout=60), 0, worker.stderr.read())
        self.assert_finishes()

    @staticmethod
    def has_locks(worker):
        """Whether it has opened the file, or has ended."""
        files = open_files_of(worker.pid)
        return worker.poll() is not None or any(re.search(r"/locks( \(deleted\))?\Z", file) for file in files)

    def test_lock_ends_with_its_process(self):
        self.plan()
        worker = self.start("work", "job", "--threads", 1)
        wait_until(lambda: worker.poll() is not None or self.status()["running"]["number"], "a cluster")
        worker.send_signal(signal.SIGKILL)
        worker.wait()
        self.assertEqual(self.status()["running"]["number"], 0)
        self.in_target("work", "job")
        self.assert_finishes()

    def test_old_worker_of_a_job_that_was_given_up(self):
        """It is halted in a cluster, and goes on when there is another job in its folder."""
        self.plan()
        worker = self.halt_in_a_cluster()
        halted = f"{int(self.status()['running']['clusters']):06}.json"
        self.clear_target()
        self.plan()
        self.in_target("work", "job", "--clusters", "0-5")
        before = self.markers()
        worker.send_signal(signal.SIGCONT)
        out, error = worker.communicate(timeout=60)
        self.assertEqual((worker.returncode, out), (FAILURE, ""))
        self.assertIn(f"{self.job} is no longer the folder of this job", error)
        # Halted just before its marker, it writes this one, which does not count: it is that of another job.
        changed = {name for name, time_ in self.markers().items() if before.get(name) != time_}
        self.assertLessEqual(changed, {halted})
        self.in_target("work", "job")
        self.assert_finishes()

    def test_worker_that_is_late_without_locks(self):
        """It is halted in a cluster that others do, and goes on when all outputs have their names."""
        self.plan()
        worker = self.halt_in_a_cluster()
        (self.job / "locks").unlink()
        self.in_target("work", "job")
        self.assert_finishes()
        worker.send_signal(signal.SIGCONT)
        worker.communicate(timeout=60)
        self.assertEqual(worker.returncode, 0)
        self.assertEqual(jobs.results(self.target), self.expected)

    def halt_in_a_cluster(self):
        """Starts a worker and stops it while it computes a cluster."""
        for _ in range(50):
            worker = self.start("work", "job", "--threads", 1, "--clusters", "0-6")
            if wait_until(lambda: worker.poll() is not None or self.halts(worker), "a cluster") == "halted":  # noqa: B023
                return worker
            self.clear_target()  # it was faster
            self.plan()
        self.fail("no worker was found at work")

    def halts(self, worker):
        """Stops it; lets it go on where it computes no cluster."""
        worker.send_signal(signal.SIGSTOP)
        wait_until(lambda: state_of(worker.pid) in "TZ", "the halt")
        running = self.status()["running"]["clusters"]
        if running and not list(self.job.glob(f"clusters/{int(running):06}.*")):
            return "halted"
        worker.send_signal(signal.SIGCONT)
        return None

    def test_clock_that_is_wrong(self):
        """Markers and locks of another time, past or future, are as good."""
        self.plan()
        self.in_target("work", "job", "--clusters", "0-3")
        for i, path in enumerate([*self.job.rglob("*"), *self.target.glob("*.partial")]):
            os.utime(path, (0, 4e9 if i % 2 else 1))
        self.assertIn("clusters skipped  4\n", self.in_target("work", "job").stdout)
        self.assert_finishes()


if __name__ == "__main__":
    unittest.main()
