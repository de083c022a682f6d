# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Jobs whose outputs are Zarr folders: the files of one run, whoever writes which chunks, and whatever happens to them."""

import json
import pathlib
import random
import re
import shutil
import signal
import subprocess
import unittest

import jobs
import volumes
from interpreters import python_with
from jobs import JobTestCase
from processes import wait_until
from program import FAILURE, REFUSED, USAGE
from test_zarr import READ_ZARR, make_part

# Layers of 28 slices: four of them.
SIZE = (60, 50, 110)
OPTIONS = "--thickness 2 --distance d.ome.zarr --thickness-map t.nrrd --preview p.png --report r.json".split()
UNPACKED = ["--compress", "none"]


def make_wall(size):
    """Of three voxels, along x and z."""
    volume = volumes.Volume(size, [])
    row, rows = bytes(size[0]), size[1] - 43
    volume.voxels = (row * 40 + b"\1" * (3 * size[0]) + row * rows) * size[2]
    return volume


class ZarrJobTestCase(JobTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", make_part(SIZE))
        self.expected = None

    def plan(self, *options, clusters=100):
        """Clusters of one layer each, unless fewer are wanted."""
        self.in_target("plan", "../in.mha", "out.zarr", "job", *OPTIONS, *options, "--divisions", clusters)
        self.expected = self.expected or self.expect("extract", "../in.mha", "out.zarr", *OPTIONS, *options)

    def forget_expected(self):
        self.expected = None
        shutil.rmtree(self.folder / "expected")

    def partial(self, name="out.zarr"):
        return next(self.target.glob(f"{name}.*.partial"))

    def assert_finishes(self):
        self.in_target("finalize", "job")
        self.assertEqual(jobs.results(self.target), self.expected)
        self.assertFalse(list(self.target.glob("*.partial*")))


class ZarrJobTest(ZarrJobTestCase):
    def test_any_order_and_several_processes(self):
        for packing, first in ((UNPACKED, 2), ([], 3)):
            self.plan("--vectors", "v.zarr", *packing)
            self.in_target("work", "job", "--clusters", first, "--threads", 3)
            workers = [self.start("work", "job", "--memory", memory) for memory in ("2G", "100M")]
            for worker in workers:
                self.assertEqual(worker.wait(), 0, worker.stderr.read())
            self.assert_finishes()
            self.clear_target()
            self.forget_expected()

    def test_pieces_that_are_no_layers(self):
        """With so little memory that chunks are written in parts."""
        volumes.write_meta(self.folder / "in.mha", make_wall((120, 100, 110)))
        for packing in (UNPACKED, []):
            self.plan(*packing)
            command = ["work", "job", "--threads", 1, "--memory"]
            least = self.in_target(*command, "1M", status=REFUSED).stderr
            memory = float(re.search(r"needs at least ([0-9.]+) MiB", least)[1])
            self.in_target(*command, f"{int(memory) + 2}M", "--log-file", "../log")
            self.assertRegex((self.folder / "log").read_text(), r" slices_of_piece=([1-9]|1[0-9]|2[0-7]) ")
            self.assert_finishes()
            self.clear_target()
            self.forget_expected()

    def test_clusters_are_whole_layers(self):
        for wanted, clusters in ((1, 1), (3, 3), (100, 4)):
            self.plan(clusters=wanted)
            self.assertEqual(self.status()["clusters"], clusters)
            self.in_target("work", "job")
            slices = [json.loads(path.read_text())["slices"] for path in sorted(self.job.glob("clusters/*.json"))]
            self.assertEqual([begin % 28 for begin, _ in slices], [0] * clusters)
            self.assert_finishes()
            self.clear_target()

    def test_two_dimensions(self):
        flat = volumes.Volume((60, 50), [1 if 10 <= i % 60 < 14 or 20 <= i // 60 < 24 else 0 for i in range(3000)])
        volumes.write_meta(self.folder / "in.mha", flat)
        self.plan()
        self.in_target("work", "job")
        self.assert_finishes()

    def test_resume(self):
        self.in_target("extract", "../in.mha", "out.zarr", *OPTIONS, "--resume")
        expected = self.expect("extract", "../in.mha", "out.zarr", *OPTIONS)
        self.assertEqual(jobs.results(self.target), expected)
        command = ["extract", "../in.mha", "out.zarr", *OPTIONS, "--resume"]
        self.assertIn("exists", self.in_target(*command, status=REFUSED).stderr)
        self.in_target(*command, "--overwrite", "--divisions", 3)
        self.assertEqual(jobs.results(self.target), expected)

    def test_readers_of_others(self):
        self.plan()
        self.in_target("work", "job")
        self.assert_finishes()
        self.in_target("extract", "../in.mha", "l.mha", "--thickness", 2, "--distance", "d.mha")
        modules = [module for module in ("zarr", "ngff_zarr") if python_with(module)]
        if not modules:
            self.skipTest("no Python with the module zarr here")
        for module in modules:
            python = python_with(module)
            for name, data in (("out.zarr", "l.mha"), ("d.ome.zarr", "d.mha")):
                command = [python, READ_ZARR, module, self.target / name, self.folder / "data.raw"]
                subprocess.run(command, check=True, capture_output=True)
                self.assertEqual((self.folder / "data.raw").read_bytes(), volumes.read_data(self.target / data), name)

    def test_folder_that_is_replaced(self):
        self.in_target("extract", "../in.mha", "out.zarr", "--thickness", 4)
        before = jobs.results(self.target)
        self.assertIn("exists", self.in_target("plan", "../in.mha", "out.zarr", "job", status=REFUSED).stderr)
        self.plan("--overwrite")
        self.in_target("work", "job")
        found = jobs.results(self.target)
        self.assertEqual({name: found[name] for name in before}, before)
        self.assert_finishes()

    def test_publication_that_was_interrupted(self):
        """Between the exchange of two folders' names and its end."""
        self.plan()
        temporary = self.partial()
        mark = temporary.name[len("out.zarr") :]
        self.assertEqual((temporary / mark).read_bytes(), b"")
        self.in_target("work", "job")
        self.assert_finishes()
        (self.job / "finished.json").unlink()
        (self.target / "out.zarr" / mark).touch()
        temporary.mkdir()
        (temporary / "old").touch()
        (self.target / "p.png").unlink()
        self.assert_finishes()
        (self.job / "finished.json").unlink()
        (self.target / "out.zarr" / mark).touch()
        (self.target / "out.zarr").rename(temporary)
        self.assert_finishes()

    def test_job_folder_in_an_output(self):
        self.in_target("extract", "../in.mha", "out.zarr")
        command = ["plan", "../in.mha", "out.zarr", "out.zarr/job", "--overwrite"]
        self.assertIn("in the Zarr folder of the labels", self.in_target(*command, status=USAGE).stderr)


class ZarrJobFaultTest(ZarrJobTestCase):
    def chunks(self, name="out.zarr"):
        return sorted(path for path in (self.partial(name) / "0").rglob("*") if path.is_file() and path.name != ".zarray")

    def assert_done_again(self, cluster):
        message = self.in_target("finalize", "job", status=FAILURE).stderr
        self.assertIn(f"were written with: {cluster};", message)
        self.assert_nothing_published()
        self.assertIn("clusters done     1\n", self.in_target("work", "job").stdout)
        self.assert_finishes()

    def test_chunks_that_are_damaged_or_gone(self):
        def flip(path):
            content = path.read_bytes()
            path.write_bytes(content[:-9] + bytes([content[-9] ^ 1]) + content[-8:])

        def cut(path):
            path.write_bytes(path.read_bytes()[:-1])

        for packing, name, change in (
            ([], "out.zarr", flip),
            ([], "d.ome.zarr", pathlib.Path.unlink),
            (UNPACKED, "out.zarr", flip),
            (UNPACKED, "out.zarr", cut),
        ):
            self.plan(*packing)
            self.in_target("work", "job")
            change(self.chunks(name)[2])
            self.assert_done_again(2)
            self.clear_target()
            self.forget_expected()

    def test_chunk_that_is_gone_is_missed_without_verification(self):
        self.plan()
        self.in_target("work", "job")
        self.chunks()[3].unlink()
        message = self.in_target("finalize", "job", "--no-verify", status=FAILURE).stderr
        self.assertIn("has 3 chunks after writing, not 4", message)
        self.assert_nothing_published()

    def test_metadata_that_are_changed_or_gone(self):
        self.plan()
        for name in (".zgroup", ".zattrs", "0/.zarray"):
            path = self.partial() / name
            content = path.read_bytes()
            for change in (lambda: path.write_bytes(content[:-3]), lambda: path.unlink()):
                change()
                message = self.in_target("work", "job", status=FAILURE).stderr
                self.assertIn(f"{name} is gone or was changed", message)
            path.write_bytes(content)
        self.in_target("work", "job")
        path = self.partial() / "0/.zarray"
        path.write_bytes(content.replace(b'"gzip"', b'"zlib"'))
        self.assertIn(".zarray is gone or was changed", self.in_target("finalize", "job", status=FAILURE).stderr)
        path.write_bytes(content)
        self.assert_finishes()

    def test_folder_that_is_gone(self):
        self.plan()
        self.in_target("work", "job", "--clusters", 0)
        path = self.partial()
        path.rename(self.folder / "away")
        for command in ("work", "finalize"):
            self.in_target(command, "job", status=FAILURE)
        (self.folder / "away").rename(path)
        self.in_target("work", "job")
        path.rename(self.folder / "away")
        self.assertIn("No such file", self.in_target("finalize", "job", "--no-verify", status=FAILURE).stderr)
        (self.folder / "away").rename(path)
        self.assert_finishes()

    def test_other_folder_is_not_taken_for_the_result(self):
        """The folder of the job is gone, and another one has the name that it was to get."""
        self.plan("--overwrite")
        self.in_target("work", "job")
        self.in_target("extract", "../in.mha", "out.zarr", "--thickness", 4)
        self.partial().rename(self.folder / "away")
        self.assertIn("No such file", self.in_target("finalize", "job", "--no-verify", status=FAILURE).stderr)

    def test_several_processes_without_locks(self):
        """As on a file system that has none: all write the same chunks at the same time."""
        self.plan()
        workers = []
        for _ in range(4):
            (self.job / "locks").unlink(missing_ok=True)
            workers.append(self.start("work", "job"))
        for worker in workers:
            self.assertEqual(worker.wait(timeout=60), 0, worker.stderr.read())
        self.assert_finishes()

    def test_disk_that_gets_full(self):
        disk = self.target / "disk"
        self.mount_small_disk(disk, "256k")
        command = ["plan", "../in.mha", "out.zarr", "job", "--thickness", 2, "--vectors", "disk/v.zarr"]
        refused = self.in_target(*command, *UNPACKED, status=REFUSED)
        self.assertIn("no space for the outputs", refused.stderr)
        self.in_target(*command)
        filler = disk / "filler"
        filler.write_bytes(bytes(200 << 10))
        self.assertIn("No space left", self.in_target("work", "job", status=FAILURE).stderr)
        subprocess.run(["mount", "-o", "remount,size=4M", disk], check=True)
        self.in_target("work", "job")
        self.in_target("finalize", "job")
        expected = self.expect("extract", "../in.mha", "out.zarr", "--thickness", 2, "--vectors", "v.zarr")
        found = jobs.results(self.target)
        self.assertEqual({name.replace("disk/", ""): found[name] for name in found}, expected)


class ZarrJobKillTest(ZarrJobTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", make_wall((100, 80, 330)))

    def test_two_workers_one_of_which_is_killed(self):
        for _ in range(10):
            self.plan()
            self.assertEqual(self.status()["clusters"], 11)
            workers = [self.start("work", "job", "--threads", 1, "--clusters", part) for part in ("0-2", "3-10")]
            first = {f"{cluster:06}.json" for cluster in range(3)}
            wait_until(lambda: self.markers().keys() - first, "a cluster of the second worker")
            workers[1].send_signal(signal.SIGKILL)
            workers[1].wait()
            self.assertEqual(workers[0].wait(), 0)
            before = self.markers()
            if len(before) < 11:
                break
            self.clear_target()  # it was faster
        self.assertLess(len(before), 11)
        out = self.in_target("work", "job").stdout
        after = self.markers()
        self.assertEqual({name: after[name] for name in before}, before)
        self.assertIn(f"clusters done     {11 - len(before)}\n", out)
        self.assert_finishes()

    @staticmethod
    def files_of_labels(results):
        """Without the mark of the job, which stays in the folder for a moment after it got its name."""
        labels = {name: content for name, content in results.items() if name.startswith("out.zarr/")}
        return {name: content for name, content in labels.items() if not name.endswith(".partial")}

    def test_kills_at_any_time(self):
        command = ["extract", "../in.mha", "out.zarr", *OPTIONS, "--resume", "--threads", 1, "--divisions", 11]
        expected = self.expect("extract", "../in.mha", "out.zarr", *OPTIONS)
        choose = random.Random(3)
        kills = 0
        for _ in range(8):
            process = self.start(*command)
            try:
                process.wait(timeout=choose.uniform(0.02, 0.2))  # any moment will do
                break
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
                kills += 1
                labels = self.files_of_labels(jobs.results(self.target))
                self.assertIn(labels, ({}, self.files_of_labels(expected)))
                if labels and not (self.target / "out.zarr.job").exists():
                    break  # it was killed when all was done
        else:
            self.in_target(*command)
        self.assertGreater(kills, 0)
        self.assertEqual(list(self.target.glob("*.partial")), [])
        self.assertEqual(jobs.results(self.target), expected)


if __name__ == "__main__":
    unittest.main()
