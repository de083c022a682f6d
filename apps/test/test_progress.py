# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Progress: on the right stream, never falling, not too much of it, ending at 1."""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import termios
import unittest

import volumes
from program import PROGRAM, ProgramTestCase


class ProgressTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate(size=(60, 50, 40)))

    def run_style(self, style, *arguments):
        command = [PROGRAM, "extract", "in.mha", f"{style}.mha", "--thickness", "3", "--lower", "72", "--progress", style]
        result = subprocess.run(
            [*command, "--divisions", "8", *arguments], cwd=self.folder, capture_output=True, text=True, check=True
        )
        return result.stdout, result.stderr

    def assert_fractions(self, fractions):
        self.assertEqual(fractions, sorted(fractions))
        self.assertEqual(fractions[-1], 1)
        self.assertGreaterEqual(fractions[0], 0)
        self.assertGreater(len(fractions), 4)
        self.assertLess(len(fractions), 150)

    def test_slicer(self):
        out, error = self.run_style("slicer")
        self.assertEqual(error, "")
        self.assertTrue(out.startswith("<filter-start><filter-name>medialvoxel</filter-name><filter-comment>"))
        self.assert_fractions([float(text) for text in re.findall(r"<filter-progress>(.*)</filter-progress>", out)])
        self.assertEqual(len(re.findall(r"<filter-end>.*<filter-time>[\d.e-]+</filter-time></filter-end>\n", out)), 1)
        self.assertLess(out.index("<filter-progress>1<"), out.index("<filter-end>"))

    def test_slicer_with_two_filters(self):
        out, _ = self.run_style("slicer", "--distance", "d.mha")
        self.assert_fractions([float(text) for text in re.findall(r"<filter-progress>(.*)</filter-progress>", out)])

    def test_json(self):
        out, error = self.run_style("json")
        lines = [json.loads(line) for line in error.splitlines()]
        self.assertEqual(lines[0]["start"], "medialvoxel")
        self.assertIn("end", lines[-1])
        self.assert_fractions([line["progress"] for line in lines[1:-1]])
        self.assertTrue(out.startswith("object"))

    def test_elements_of_a_mesh_have_a_share(self):
        """The run over the volume is half of the work: it does not end near 1."""
        command = [PROGRAM, "mesh", "in.mha", "m.inp", "--lower", "72", "--progress", "json"]
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=True)
        lines = [json.loads(line) for line in result.stderr.splitlines()]
        fractions = [line["progress"] for line in lines if "progress" in line]
        self.assert_fractions(fractions)
        self.assertLess(max(b - a for a, b in zip(fractions, fractions[1:])), 0.4)

    def test_styles_that_say_nothing_in_short_runs(self):
        for style in ("plain", "none", "auto"):
            self.assertEqual(self.run_style(style)[1], "")

    def test_bar(self):
        _, error = self.run_style("bar")
        self.assertIn("] 0 %", error)
        self.assertTrue(error.endswith("\x1b[K"), "the bar is wiped out at the end")

    def run_on_terminal(self, columns=80, **environment):
        """The result, and what the terminal shows."""
        try:
            master, slave = pty.openpty()
        except OSError as error:
            self.skipTest(f'no terminal can be made here: {error}')
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("4H", 25, columns, 0, 0))
        command = [PROGRAM, "extract", "in.mha", "t.mha", "--thickness", "3", "--lower", "72", "--overwrite"]
        environment = {**os.environ, "TERM": "xterm", **environment}
        result = subprocess.run(
            command, cwd=self.folder, stdout=subprocess.PIPE, stderr=slave, check=True, env=environment
        )
        # Without a byte to read, reading would wait.
        os.write(slave, b"$")
        os.close(slave)
        shown = b""
        while not shown.endswith(b"$"):
            shown += os.read(master, 65536)
        os.close(master)
        return result, shown[:-1]

    def test_terminal_that_cannot_be_drawn_over(self):
        for terminal in ("dumb", ""):
            self.assertEqual(self.run_on_terminal(TERM=terminal)[1], b"", terminal)

    def test_bar_fits_the_terminal(self):
        for columns in (200, 80, 62, 61, 40, 30, 20, 10, 5):
            for line in self.run_on_terminal(columns)[1].split(b"\r")[1:]:
                text = line.replace(b"\x1b[K", b"")
                self.assertLess(len(text), columns)
                if columns >= 50 and text:
                    self.assertTrue(text.startswith(b"medialvoxel ["), text)

    def test_bar_on_a_terminal(self):
        result, shown = self.run_on_terminal()
        self.assertIn(b"medialvoxel [", shown)
        self.assertNotIn(b"[", result.stdout)

    def test_quiet(self):
        out, error = self.run_style("bar", "--quiet")
        self.assertEqual((out, error), ("", ""))

    def test_closed_output(self):
        """Results that cannot be printed are a failure; a closed progress stream is not the end of the work."""
        with open("/dev/full", "w", encoding="utf-8") as full:
            command = [PROGRAM, "info", "in.mha"]
            result = subprocess.run(command, cwd=self.folder, stdout=full, stderr=subprocess.PIPE, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn(b"standard output", result.stderr)


if __name__ == "__main__":
    unittest.main()
