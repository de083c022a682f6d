# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The log: a line for each step, added to what is there."""

import json
import re
import subprocess
import unittest

import volumes
from program import CORRUPT, FAILURE, PROGRAM, REFUSED, USAGE, ProgramTestCase

LINE = re.compile(r"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z) (error|warning|info) (\d+) ([a-z]+)((?: [a-z_]+=\S.*?)*)")


class LogTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volume = volumes.box_with_plate()
        volume.voxels = [value // 100 for value in volume.voxels]  # an object in a background, of which nothing warns
        volumes.write_meta(self.folder / "in.mha", volume)

    def log(self, *arguments, status=0, command="extract"):
        """Runs the program; the events that it logged, with their level and values."""
        path = self.folder / "steps.log"
        before = path.read_text() if path.exists() else ""
        self.run_program(command, "in.mha", *arguments, "--log-file", "steps.log", "--overwrite", status=status)
        text = path.read_text()
        self.assertTrue(text.startswith(before))
        return self.parse(text[len(before) :])

    def parse(self, text):
        """The lines of a log, each of which must be whole."""
        self.assertTrue(text.endswith("\n") or not text)
        events = []
        for line in text.splitlines():
            match = LINE.fullmatch(line)
            self.assertTrue(match, line)
            values = dict(re.findall(r' ([a-z_]+)=("(?:[^"\\]|\\.)*"|\S+)', match[5]))
            events.append((match[2], match[4], values))
        return events

    def pieces(self, events):
        return [values for _, event, values in events if event == "piece"]

    def test_line_for_each_piece(self):
        events = self.log("out.mha", "--thickness", 3, "--divisions", 4)
        self.assertEqual([event for _, event, _ in events], ["start", "plan"] + ["piece"] * 4 + ["end"])
        self.assertEqual(events[1][2]["pieces"], "4")
        self.assertEqual(events[1][2]["size"], '"24 x 20 x 16"')
        pieces = self.pieces(events)
        self.assertEqual([piece["slices"] for piece in pieces], ["0-3", "4-7", "8-11", "12-15"])
        self.assertTrue(all(float(piece["seconds"]) >= 0 for piece in pieces))
        self.assertTrue(all(int(piece["peak_memory_bytes"]) > 1 << 20 for piece in pieces))
        self.assertEqual(int(pieces[-1]["bytes_read"]), 24 * 20 * 16)
        self.assertTrue(all(int(piece["recomputed_voxels"]) >= 0 for piece in pieces))

    def test_growth_of_windows(self):
        size = (80, 80, 80)
        volume = volumes.Volume(size, [])
        volume.voxels = b"".join(bytes(1 if 4 <= min(x, y, z) and max(x, y, z) < 76 else 0 for x in range(80))
                                 for z in range(80) for y in range(80))  # fmt: skip
        volumes.write_meta(self.folder / "in.mha", volume)
        events = self.log("out.mha", "--thickness", 3, "--divisions", 8, "--vectors", "v.mha")
        self.assertGreater(sum(int(piece["recomputed_voxels"]) for piece in self.pieces(events)), 0)

    def test_other_commands(self):
        self.assertEqual(len(self.pieces(self.log("v.mha", command="distance"))), 1)
        self.assertEqual(len(self.pieces(self.log("m.vtp", command="mesh"))), 1)
        events = self.log("out.mha", "--distance", "d.mha", "--divisions", 2)
        self.assertEqual([piece["of"] for piece in self.pieces(events)], ["labels", "distances"] * 2)

    def test_jobs(self):
        """One line for each cluster, of all processes, and what they did in the end."""
        self.run_program("plan", "in.mha", "out.mha", "job", "--divisions", 5, "--log-file", "steps.log")
        self.run_program("work", "job", "--clusters", "3", "--log-file", "steps.log")
        command = [PROGRAM, "work", "job", "--log-file", "steps.log", "--threads", "1", "--quiet"]
        workers = [subprocess.Popen(command, cwd=self.folder) for _ in range(3)]
        self.assertEqual([worker.wait() for worker in workers], [0] * 3)
        self.run_program("finalize", "job", "--log-file", "steps.log")
        events = self.parse((self.folder / "steps.log").read_text())
        self.assertEqual(events[0][1], "planned")
        self.assertEqual([event for _, event, _ in events][-4:], ["start", "verified", "published", "end"])
        clusters = [values for _, event, values in events if event == "cluster"]
        self.assertEqual(sorted(values["cluster"] for values in clusters), list("01234"))
        self.assertEqual(clusters[0]["slices"], "10-12")
        for values in clusters:
            self.assertEqual(values["job"], events[0][2]["job"])
            self.assertGreaterEqual(float(values["seconds"]), 0)
            self.assertGreaterEqual(int(values["recomputed_voxels"]), 0)
            self.assertGreater(int(values["peak_memory_bytes"]), 1 << 20)
        work = [values for _, event, values in events if event == "job"]
        self.assertEqual([values["clusters"] for values in work], ["3"] + ["0-4"] * 3)
        self.assertEqual(len({values["host"] for values in work}), 1)
        ends = [values for _, event, values in events if event == "clusters"]
        self.assertEqual([(values["done"], values["skipped"]) for values in ends[:1]], [("1", "0")])
        self.assertEqual(sum(int(values["done"]) for values in ends), 5)
        self.assertEqual(sum(int(values["skipped"]) for values in ends), 11)

    def test_lines_of_many_processes_stay_whole(self):
        self.run_program("plan", "in.mha", "out.mha", "job")
        command = [PROGRAM, "work", "job", "--log-file", "steps.log", "--quiet"]
        workers = [subprocess.Popen(command, cwd=self.folder) for _ in range(8)]
        self.assertEqual([worker.wait() for worker in workers], [0] * 8)
        events = self.parse((self.folder / "steps.log").read_text())
        self.assertEqual(len([event for _, event, _ in events if event == "start"]), 8)
        self.assertEqual(len([event for _, event, _ in events if event == "end"]), 8)

    def test_failures_of_jobs(self):
        log = ["--log-file", "steps.log"]
        self.run_program("plan", "in.mha", "missing/out.mha", "job", *log, status=REFUSED)
        self.run_program("plan", "in.mha", "out.mha", "job", *log)
        self.run_program("work", "none", *log, status=FAILURE)
        self.run_program("finalize", "job", *log, status=FAILURE)
        (self.folder / "in.mha").unlink()
        self.run_program("work", "job", *log, status=FAILURE)
        events = self.parse((self.folder / "steps.log").read_text())
        errors = [line for line in events if line[0] == "error"]
        self.assertEqual([event for _, event, _ in errors], ["failed"] * 4)
        for (_, _, values), part in zip(errors, ("missing", "not a job folder", "clusters are not done", "in.mha")):
            self.assertIn(part, values["message"])

    def test_run_that_can_be_resumed(self):
        events = self.log("out.mha", "--divisions", 4, "--resume")
        self.assertEqual([values["cluster"] for _, event, values in events if event == "cluster"], list("0123"))
        self.assertEqual(events[-2][1], "published")

    def test_log_in_the_folder_of_the_job(self):
        self.run_program("plan", "in.mha", "out.mha", "job")
        self.run_program("work", "job", "--log-file", "job/work.log")
        self.run_program("finalize", "job", "--log-file", "job/work.log")
        self.assert_fails(REFUSED, ["manifest.json is not a log"], "work", "job", "--log-file", "job/manifest.json")

    def test_errors(self):
        events = self.log("missing/out.mha", status=REFUSED)
        self.assertEqual([(level, event) for level, event, _ in events], [("error", "failed")])
        self.assertIn("missing", events[0][2]["message"])
        (self.folder / "in.mha").write_bytes(b"NDims = \n")
        self.assertEqual(len(self.log("out.mha", status=CORRUPT)), 1)

    def test_what_is_not_a_log_stays(self):
        (self.folder / "notes.txt").write_text("important\n")
        self.assert_fails(REFUSED, ["notes.txt is not a log"], "extract", "in.mha", "out.mha", "--log-file", "notes.txt")
        self.assert_fails(REFUSED, ["in.mha is not a log"], "extract", "in.mha", "out.mha", "--log-file", "in.mha")
        self.assert_fails(REFUSED, ["missing/a.log"], "extract", "in.mha", "out.mha", "--log-file", "missing/a.log")
        self.run_program("extract", "in.mha", "out.mha", "--log-file", "out.mha", status=USAGE)

    def test_results_do_not_depend_on_it(self):
        self.extract("in.mha", "a.mha")
        self.extract("in.mha", "b.mha", "--log-file", "a.log", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["outputs"]["log"], "a.log")
        self.assertEqual((self.folder / "a.mha").read_bytes(), (self.folder / "b.mha").read_bytes())


if __name__ == "__main__":
    unittest.main()
