# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The log: a line for each step, added to what is there."""

import json
import re
import unittest

import volumes
from program import CORRUPT, REFUSED, USAGE, ProgramTestCase

LINE = re.compile(r"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z) (error|warning|info|debug) (\d+) ([a-z]+)((?: [a-z_]+=\S.*?)*)")


class LogTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())

    def log(self, *arguments, status=0, command="extract"):
        """Runs the program; the events that it logged, with their level and values."""
        path = self.folder / "steps.log"
        before = path.read_text() if path.exists() else ""
        self.run_program(command, "in.mha", *arguments, "--log-file", "steps.log", "--overwrite", status=status)
        text = path.read_text()
        self.assertTrue(text.startswith(before))
        events = []
        for line in text[len(before) :].splitlines():
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

    def test_levels(self):
        run = ("out.mha", "--thickness", 3, "--divisions", 2)
        self.assertEqual(self.log(*run, "--log-level", "error"), [])
        self.assertEqual(self.log(*run, "--log-level", "warning"), [])
        self.assertIn("write", [event for _, event, _ in self.log(*run, "--log-level", "debug")])
        self.assertEqual({level for level, _, _ in self.log(*run)}, {"info"})

    def test_other_commands(self):
        self.assertEqual(len(self.pieces(self.log("v.mha", command="distance"))), 1)
        self.assertEqual(len(self.pieces(self.log("m.vtp", command="mesh"))), 1)
        events = self.log("out.mha", "--distance", "d.mha", "--divisions", 2)
        self.assertEqual([piece["of"] for piece in self.pieces(events)], ["labels", "distances"] * 2)

    def test_errors(self):
        events = self.log("missing/out.mha", status=REFUSED)
        self.assertEqual([(level, event) for level, event, _ in events], [("error", "failed")])
        self.assertIn("missing", events[0][2]["message"])
        (self.folder / "in.mha").write_bytes(b"NDims = \n")
        self.assertEqual(len(self.log("out.mha", "--log-level", "error", status=CORRUPT)), 1)

    def test_what_is_not_a_log_stays(self):
        (self.folder / "notes.txt").write_text("important\n")
        self.assert_fails(REFUSED, ["notes.txt is not a log"], "extract", "in.mha", "out.mha", "--log-file", "notes.txt")
        self.assert_fails(REFUSED, ["in.mha is not a log"], "extract", "in.mha", "out.mha", "--log-file", "in.mha")
        self.assert_fails(REFUSED, ["missing/a.log"], "extract", "in.mha", "out.mha", "--log-file", "missing/a.log")
        self.assert_fails(USAGE, ["--log-file"], "extract", "in.mha", "out.mha", "--log-level", "debug")
        self.run_program("extract", "in.mha", "out.mha", "--log-file", "out.mha", status=USAGE)

    def test_results_do_not_depend_on_it(self):
        self.extract("in.mha", "a.mha")
        self.extract("in.mha", "b.mha", "--log-file", "a.log", "--log-level", "debug", "--report", "r.json")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["outputs"]["log"], "a.log")
        self.assertEqual((self.folder / "a.mha").read_bytes(), (self.folder / "b.mha").read_bytes())


if __name__ == "__main__":
    unittest.main()
