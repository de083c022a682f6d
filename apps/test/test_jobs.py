# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A job that several processes do has the bytes of one run, whoever does what when, and wherever they are stopped."""

import json
import math
import random
import re
import shutil
import signal
import struct
import time
import unittest

import jobs
import volumes
from jobs import ALL_OUTPUTS, JobTestCase
from processes import PATIENCE, wait_until
from program import FAILURE, READS_TIFF, REFUSED, USAGE
from stops import stop
from test_identity import rough_shell
from test_pores import solid, with_noise

CLUSTERS = 7
OPTIONS = ["--thickness", 2, *ALL_OUTPUTS]


class SmallJobTest(JobTestCase):
    """Jobs on a small volume with all outputs."""

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", rough_shell())

    def expected(self, *options):
        """What one run makes of it."""
        return self.expect("extract", "../in.mha", "out.mha", *(options or OPTIONS))

    def plan(self, *options, clusters=CLUSTERS):
        return self.in_target("plan", "../in.mha", "out.mha", "job", *(options or OPTIONS), "--divisions", clusters)

    def assert_finished(self, expected):
        self.in_target("finalize", "job")
        self.assertEqual(jobs.results(self.target), expected)

    def test_any_order_and_several_processes(self):
        expected = self.expected()
        order = list(range(CLUSTERS))
        for seed in range(3):
            self.plan()
            random.Random(seed).shuffle(order)
            for cluster in order[:3]:
                self.in_target("work", "job", "--clusters", cluster, "--threads", 1 + seed)
            workers = [self.start("work", "job", "--memory", memory) for memory in ("2G", "78M", "100M")]
            for worker in workers:
                self.assertEqual(worker.wait(), 0, worker.stderr.read())
            self.assert_finished(expected)
            self.clear_target()

    def test_clusters_of_any_number(self):
        expected = self.expected()
        for clusters in (1, 33, 1000):
            self.plan(clusters=clusters)
            self.in_target("work", "job")
            self.assert_finished(expected)
            self.assertEqual(self.status()["clusters"], min(clusters, 33))
            self.clear_target()

    def test_at_least_sixteen_clusters_where_slices_allow(self):
        for slices, least in ((17, 1), (32, 2), (128, 8), (256, 16), (530, 16), (1000, 16)):
            volumes.write_raw(self.folder / "flat.raw", volumes.Volume((8, 8, slices), [0, 1] * 32 * slices))
            raw = ["--raw-size", f"8,8,{slices}", "--raw-type", "uint8"]
            for thickness in ("auto", 3):
                plan = ["plan", "../flat.raw", "flat.mha", "flat", "--thickness", thickness, *raw, "--dry-run"]
                clusters = int(re.search(r"^pieces +(\d+) of", self.in_target(*plan).stdout, re.MULTILINE)[1])
                self.assertGreaterEqual(clusters, least, (slices, thickness))
                self.assertLessEqual(clusters, -(-slices // 16), (slices, thickness))

    def test_thickness_of_the_table_is_surveyed_without_a_report(self):
        options = ["--thickness", 2]
        expected = self.expected(*options)
        self.plan(*options)
        self.in_target("work", "job")
        self.assertTrue(list(self.job.rglob("*.survey")))
        self.assert_finished(expected)

    def test_values_that_are_no_numbers_are_counted_once(self):
        volume = rough_shell()
        values = [math.nan if i % 11 == 0 else float(v) for i, v in enumerate(volume.voxels)]
        path = self.folder / "in.mha"
        header = volumes.meta_header(volume, ElementType="MET_FLOAT")
        path.write_bytes(header + struct.pack(f"<{len(values)}f", *values))
        expected = self.expected()
        self.plan()
        self.in_target("work", "job")
        self.assert_finished(expected)
        self.assertGreater(expected["r.json"]["counts"]["not_a_number_voxels"], 0)

    def test_two_dimensions(self):
        flat = volumes.Volume((60, 50), [1 if 10 <= i % 60 < 14 or 20 <= i // 60 < 24 else 0 for i in range(3000)])
        volumes.write_meta(self.folder / "in.mha", flat)
        expected = self.expected()
        self.plan()
        self.in_target("work", "job")
        self.assert_finished(expected)

    def test_names_are_meant_from_the_folder_of_the_plan(self):
        expected = self.expected()
        self.plan()
        self.run_program("work", "target/job")
        self.run_program("finalize", self.job)
        self.assertEqual(jobs.results(self.target), expected)

    def test_pores_and_their_counts(self):
        volumes.write_meta(self.folder / "in.mha", with_noise(solid())[0])
        for fills, *options in ((True, "--thickness", 3, "--max-pore-size", 8), (False, "--thickness", 3), (True, "--smooth", "off")):
            options = [*options, "--report", "r.json"]
            expected = self.expected(*options)
            self.plan(*options)
            self.in_target("work", "job")
            self.assert_finished(expected)
            self.assertEqual(expected["r.json"]["counts"]["filled_voxels"] > 0, fills)
            self.clear_target()
            shutil.rmtree(self.folder / "expected")

    def test_every_option_of_plan_is_kept(self):
        """What changes a byte is in the manifest; what is not must be known here to change none."""
        help_text = self.run_program("plan", "--help-all").stdout
        of_run = {"--memory", "--threads", "--overwrite", "--divisions", "--dry-run", "--progress", "--quiet", "--log-file"}
        of_run |= {"--scratch", "--slurm", "--slurm-clusters"}
        raw = "--raw-size 40,36,33 --raw-type uint8:5:big"
        values = {
            "--thickness": 2, "--min-thickness": 2, "--max-thickness": 7, "--max-pore-size": 3,
            "--smooth": "on", "--lower": 1, "--upper": 1, "--label": 1, "--vectors": "v.mha",
            "--vector-boundary": "background", "--distance": "d.mha", "--thickness-map": "t.mha", "--sub-voxel": None,
            "--uncertainty-map": "u.mha", "--materials": "0,100", "--preview": "p.png", "--html": "p.html", "--report": "r.json",
            "--color-range": "1,3",
            "--compress": "none", "--spacing": "1,2,3", "--resample": 0.75, "--resolution": 1,
            "--slices": "2-6", "--thin-below": "2,,3", "--thick-above": 2, "--places": "p.csv",
            "--fail-if-thin": None, "--local-thickness": "lt.mha", "--largest-ball": 9, "--importance": "i.mha", "--importance-threshold": "h.mha",
            "--local-thickness-method": "sphere", "--same-topology": None,
        }  # fmt: skip
        of_raw = {word for word in raw.split() if word.startswith("--")}
        self.assertEqual(set(re.findall(r"^  (--[a-z-]+)", help_text, re.MULTILINE)), of_run | of_raw | set(values) | {"--series"})

        def parameters(source, *options):
            self.in_target("plan", source, "out.mha", "job", *options)
            found = json.loads((self.job / "manifest.json").read_text())["parameters"]
            self.clear_target()
            return found

        volumes.write_meta(self.folder / "long.mha", volumes.box_with_plate((300, 20, 16)))
        self.extract("long.mha", "levels.zarr")
        volumes.write_meta(self.folder / "gray.mha", volumes.blurred_wall(7))
        sources = {"--uncertainty-map": "../gray.mha", "--resolution": "../levels.zarr", "--slices": "../slice_*.tif"}
        for number in range(9 if READS_TIFF else 0):
            volumes.write_tiff(self.folder / f"slice_{number}.tif", volumes.Volume((20, 16, 1), [number] * 320))
        plain = parameters("../in.mha")
        for option, value in values.items():
            source = sources.get(option, "../in.mha")
            if option == "--slices" and not READS_TIFF:
                continue
            needed = {
                "--sub-voxel": ["--lower", 50],
                "--uncertainty-map": ["--lower", 1000],
                "--materials": ["--lower", 50],
                "--vector-boundary": ["--vectors", "v.mha"],
                "--places": ["--thin-below", 2],
                "--color-range": ["--html", "p.html"],
                "--fail-if-thin": ["--thin-below", 2],
                "--largest-ball": ["--local-thickness", "lt.mha"],
                "--local-thickness-method": ["--local-thickness", "lt.mha"],
            }.get(option, [])
            before = plain if source == "../in.mha" and not needed else parameters(source, *needed)
            found = parameters(source, option, *([] if value is None else [value]), *needed)
            self.assertEqual(len([name for name in found if name not in ("roughness", "smoothing_level", "measure", "needed_maximum") and found[name] != before[name]]), 1, option)
        (self.folder / "in.raw").write_bytes(bytes(5 + 40 * 36 * 33))
        found = parameters("../in.raw", *raw.split())
        self.assertEqual({option: found[option] for option in of_raw}, {"--raw-size": "40,36,33", "--raw-type": "uint8:5:big"})

    def test_status(self):
        self.plan()
        status = self.status()
        self.assertEqual((status["clusters"], status["missing"]["clusters"], status["finished"]), (7, "0-6", False))
        self.in_target("work", "job", "--clusters", "0-1,4")
        status = self.status()
        self.assertEqual((status["done"]["clusters"], status["done"]["number"]), ("0-1,4", 3))
        self.assertEqual(status["missing"]["clusters"], "2-3,5-6")
        self.assertTrue(0 < status["bytes_done"] < status["bytes"] == 40 * 36 * 33 * (1 + 12 + 4 + 4))
        self.assertIn("missing   4: 2-3,5-6", self.in_target("status", "job").stdout)
        self.assertEqual(status["next_command"], f"medialvoxel work {self.job} --clusters 2-3,5-6")
        self.in_target(*status["next_command"].split()[1:])
        self.assertEqual(self.status()["next_command"], f"medialvoxel finalize {self.job}")
        self.in_target("finalize", "job")
        status = self.status()
        self.assertEqual((status["finished"], status["next_command"]), (True, ""))

    def test_what_is_done_is_skipped(self):
        self.plan()
        self.assertIn("clusters done     3\n", self.in_target("work", "job", "--clusters", "2-4").stdout)
        before = self.markers()
        out = self.in_target("work", "job").stdout
        self.assertIn("clusters done     4\n", out)
        self.assertIn("clusters skipped  3\n", out)
        after = self.markers()
        self.assertEqual({name: after[name] for name in before}, before)

    def test_finalize_lacks_clusters(self):
        self.plan()
        self.in_target("work", "job", "--clusters", "1-2,6")
        message = self.in_target("finalize", "job", status=FAILURE).stderr
        self.assertIn("4 of 7 clusters are not done: 0,3-5; to do them: medialvoxel work ", message)
        self.assert_nothing_published()

    def test_finalize_twice(self):
        expected = self.expected()
        self.plan()
        self.in_target("work", "job")
        self.assert_finished(expected)
        self.assertIn("finished before", self.in_target("finalize", "job").stdout)
        (self.folder / "in.mha").unlink()
        self.assertIn("finished before", self.in_target("finalize", "job").stdout)
        self.assertIn("clusters skipped  7\n", self.in_target("work", "job").stdout)
        self.assertEqual(jobs.results(self.target), expected)

    def test_publication_that_was_interrupted(self):
        """Some outputs have their names, the labels do not, and no record says that all is done."""
        expected = self.expected()
        self.plan()
        temporary = next(self.target.glob("out.mha.*.partial")).name
        self.in_target("work", "job")
        self.assert_finished(expected)
        (self.job / "finished.json").unlink()
        (self.target / "out.mha").rename(self.target / temporary)
        (self.target / "v.nhdr").unlink()
        (self.target / "p.png").unlink()
        self.assert_finished(expected)

    def test_output_that_comes_up_meanwhile(self):
        self.plan()
        self.in_target("work", "job")
        (self.target / "out.mha").write_bytes(b"precious")
        self.assertIn("out.mha exists", self.in_target("finalize", "job", status=REFUSED).stderr)
        self.assertEqual((self.target / "out.mha").read_bytes(), b"precious")
        self.assertFalse((self.target / "r.json").exists())
        (self.target / "out.mha").unlink()
        self.in_target("finalize", "job")

    def test_plan_checks_as_extract_does(self):
        self.in_target("plan", "../none.mha", "out.mha", "job", status=FAILURE)
        self.in_target("plan", "../in.mha", "out.png", "job", status=USAGE)
        self.in_target("plan", "../in.mha", "../in.mha", "job", status=USAGE)
        self.in_target("plan", "../in.mha", "out.mha", "job", "--memory", "1M", status=REFUSED)
        (self.target / "out.mha").touch()
        self.assertIn("exists", self.in_target("plan", "../in.mha", "out.mha", "job", status=REFUSED).stderr)
        self.assertFalse(self.job.exists())
        self.in_target("plan", "../in.mha", "out.mha", "job", "--overwrite", "--dry-run")
        self.assertEqual([path.name for path in self.target.iterdir()], ["out.mha"])

    def test_what_jobs_do_not_do(self):
        for command in (["plan", "../in.mha", "out.mha", "job"], ["extract", "../in.mha", "out.mha", "--resume"]):
            self.assertIn("medialvoxel mesh", self.in_target(*command, "--mesh", "m.vtp", status=REFUSED).stderr)
            self.assertIn("--sparse", self.in_target(*command, "--sparse", status=REFUSED).stderr)
        self.assertEqual(list(self.target.iterdir()), [])

    def test_folders_that_are_no_job(self):
        for command in ("work", "finalize", "status"):
            for folder in ("none", "."):
                self.assertIn("not a job folder", self.in_target(command, folder, status=FAILURE).stderr)
        (self.target / "full").mkdir()
        (self.target / "full" / "notes.txt").touch()
        (self.target / "file").touch()
        for folder, reason in (("full", "not empty"), ("file", "not a folder"), ("none/job", "none")):
            self.assertIn(reason, self.in_target("plan", "../in.mha", "out.mha", folder, status=REFUSED).stderr)
        self.plan()
        self.assertIn("not empty", self.in_target("plan", "../in.mha", "o.mha", "job", status=REFUSED).stderr)

    def test_files_of_others_in_a_folder_for_a_job(self):
        """Such as slices with numbers for names, which are those of clusters, too."""
        for name in ("000001.tif", "000001.json", "1.survey", "manifest.json.old", "slurm.sh", "clusters/7.json"):
            path = self.target / "mine" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(b"precious")
            for command in (["plan", "../in.mha", "out.mha", "mine"], ["extract", "../in.mha", "mine", "--resume"]):
                if command[0] == "extract":
                    path.parents[name.count("/")].rename(self.target / "mine.mha.job")
                    command[2], path = "mine.mha", self.target / "mine.mha.job" / name
                self.assertIn("not empty", self.in_target(*command, status=REFUSED).stderr)
                self.assertEqual(path.read_bytes(), b"precious", name)
            self.clear_target()

    def test_clusters_that_are_none(self):
        self.plan()
        for text in ("", "x", "3-", "-3", "4-2", "1,,2", "1;2", "0x1", "1.5"):
            self.assertIn("--clusters", self.in_target("work", "job", f"--clusters={text}", status=USAGE).stderr)
        message = self.in_target("work", "job", "--clusters", "0-7", status=USAGE).stderr
        self.assertIn("no cluster 7; the job has 7 clusters, 0 to 6", message)
        self.in_target("work", "job", "--clusters", f"0-{2**62}", status=USAGE)

    def test_plan_that_was_interrupted(self):
        """Its files are found and taken away by the next plan in its folder."""
        self.plan()
        (self.job / "manifest.json").rename(self.job / "planned.json")
        old = {path.name for path in self.target.glob("*.partial")}
        self.plan()
        new = {path.name for path in self.target.glob("*.partial")}
        self.assertEqual(len(new), len(old))
        self.assertFalse(old & new)
        (self.job / "manifest.json").rename(self.job / "planned.json")
        (self.job / "planned.json").write_text("{}")
        refused = self.in_target("plan", "../in.mha", "out.mha", "job", status=REFUSED)
        self.assertIn("its checksum does not fit; a plan that ended early left it: remove the folder", refused.stderr)


class StoppedJobTest(JobTestCase):
    """Jobs of some seconds, that are stopped while they are at work."""

    SIZE = 200

    def setUp(self):
        super().setUp()
        # Solids with holes: distances that take their time, and labels everywhere.
        noise = random.Random(3)
        with open(self.folder / "in.raw", "wb") as file:
            for _ in range(self.SIZE):
                file.write(bytes(self.SIZE * self.SIZE))
            for _ in range(60):
                file.seek(noise.randrange(self.SIZE**3))
                file.write(b"\1")
        size = f"{self.SIZE},{self.SIZE},{self.SIZE}"
        self.input = ["../in.raw", "out.mha"]
        self.options = ["--raw-size", size, "--raw-type", "uint8", "--upper", 0, "--thickness", 3, "--divisions", 20]
        self.options += ["--report", "r.json", "--preview", "p.png"]

    def expected(self):
        return self.expect("extract", *self.input, *self.options)

    def wait_for_markers(self, number, process, folder=None):
        """Until there are so many, or the process has ended."""
        markers = (folder or self.job) / "clusters"
        wait_until(
            lambda: process.poll() is not None or len(list(markers.glob("*.json"))) >= number, f"{number} clusters"
        )

    def test_killed_at_any_moment(self):
        expected = self.expected()
        noise = random.Random(5)
        self.in_target("plan", *self.input, "job", *self.options)
        kills = 0
        while kills < 6 and len(self.markers()) < 20:
            before = self.markers()
            workers = [self.start("work", "job", "--threads", 1) for _ in range(2)]
            self.wait_for_markers(len(before) + 1, workers[0])
            time.sleep(noise.uniform(0, 0.2))  # any moment will do: each one leaves what was done
            for worker in workers:
                worker.send_signal(signal.SIGKILL)
                worker.wait()
            kills += 1
            # No cluster that was done is done again.
            after = self.markers()
            self.assertEqual({name: after[name] for name in before}, before)
        self.assertGreater(kills, 1)
        before = self.markers()
        self.in_target("work", "job")
        after = self.markers()
        self.assertEqual({name: after[name] for name in before}, before)
        self.in_target("finalize", "job")
        self.assertEqual(jobs.results(self.target), expected)

    def test_resume_after_kills(self):
        expected = self.expected()
        command = ["extract", *self.input, *self.options, "--resume"]
        folder = self.target / "out.mha.job"
        for number in (1, 4, 9):
            process = self.start(*command)
            self.wait_for_markers(number, process, folder)
            process.send_signal(signal.SIGKILL)
            process.wait()
            self.assertFalse((self.target / "out.mha").exists())
        self.assertIn("walls", self.in_target(*command).stdout)
        self.assertEqual(jobs.results(self.target), expected)
        self.assertFalse(folder.exists())

    def test_signals(self):
        expected = self.expected()
        self.in_target("plan", *self.input, "job", *self.options)
        for number in (signal.SIGINT, signal.SIGTERM):
            before = len(self.markers())
            process = self.start("work", "job")
            self.wait_for_markers(before + 1, process)
            seconds = stop(process, number)
            out, error = process.communicate()
            self.assertLess(seconds, 5 * PATIENCE)
            self.assertEqual((process.returncode, out), (128 + number, ""), error)
            self.assertIn(f"stopped; what is done stays, to continue: medialvoxel work {self.job}\n", error)
        self.assert_nothing_published()
        self.in_target("work", "job")
        self.in_target("finalize", "job")
        self.assertEqual(jobs.results(self.target), expected)

    def test_resume_after_a_signal(self):
        expected = self.expected()
        command = ["extract", *self.input, *self.options, "--resume"]
        process = self.start(*command)
        self.wait_for_markers(2, process, self.target / "out.mha.job")
        process.send_signal(signal.SIGTERM)
        error = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 143, error)
        again = error.split("to continue: ")[1]
        self.assertEqual(again, " ".join(["medialvoxel", *map(str, command)]) + "\n")
        self.in_target(*again.split()[1:])
        self.assertEqual(jobs.results(self.target), expected)
        self.assertEqual(sorted(path.name for path in self.target.iterdir()), sorted(expected))

    def test_resume_with_other_options(self):
        command = ["extract", *self.input, *self.options, "--resume"]
        process = self.start(*command)
        self.wait_for_markers(1, process, self.target / "out.mha.job")
        process.send_signal(signal.SIGKILL)
        process.wait()
        for change, difference in (
            (["--thickness", 4], "--thickness is 4, not 3"),
            (["--upper", 1], "--upper is 1, not 0"),
            (["--divisions", 19], "--divisions is 19, not 20"),
            (["--raw-size", "200,100,400"], "--raw-size is "),
        ):
            other = [part for part in map(str, command)]
            other[other.index(change[0]) + 1] = str(change[1])
            self.assertIn(difference, self.in_target(*other, status=REFUSED).stderr)
        self.in_target(*command, "--threads", 1, "--memory", "1G")


if __name__ == "__main__":
    unittest.main()
