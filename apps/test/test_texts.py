# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Help, completions and manual pages: each option is in all of them, and the shells and man take them."""

import os
import re
import shutil
import subprocess
import unittest

from program import ProgramTestCase

MOST_OPTIONS_OF_EXTRACT, MOST_OPTIONS = 30, 48  # that the help shows
VOLUME_COMMANDS = ("extract", "mesh", "surface", "distance", "info", "plan")
COMMANDS = (*VOLUME_COMMANDS[:-1], "plan", "work", "finalize", "status")


class TextsTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.run_program("generate", ".")

    def help(self, *command, all=False):
        return self.run_program(*command, "--help-all" if all else "--help").stdout

    def options(self, *command, all=True):
        """Names of the options that the help shows, with what they take."""
        found = re.findall(r"^  ((?:-h,)?--[a-z-]+)(?: ([A-Z][A-Z,]*))?  ", self.help(*command, all=all), re.MULTILINE)
        return {name.split(",")[-1]: value for name, value in found}

    def complete(self, *words):
        """What bash offers for the last word."""
        script = """source ./medialvoxel.bash
        COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _medialvoxel; printf '%s\\n' "${COMPREPLY[@]}" """
        result = subprocess.run(
            ["bash", "--norc", "-c", script, "bash", "medialvoxel", *words],
            cwd=self.folder, capture_output=True, text=True, check=True,
        )  # fmt: skip
        self.assertEqual(result.stderr, "")
        return result.stdout.split()

    def test_help_fits_a_screen_and_shows_two_examples(self):
        for command in ((), *((name,) for name in (*COMMANDS, "generate"))):
            lines = self.help(*command).splitlines()
            self.assertLessEqual(len(lines), 70, command)
            self.assertLessEqual(max(map(len, lines)), 80, command)
            self.assertEqual(sum(line.startswith("  medialvoxel ") for line in lines), 2, command)
        self.assertNotIn("generate", self.help())

    def test_help_shows_what_users_need(self):
        """Not more options than a reader takes in; all of them are asked for, and are apart in manuals."""
        self.assertLessEqual(len(self.options("extract", all=False)), MOST_OPTIONS_OF_EXTRACT)
        shown = {name for command in COMMANDS for name in self.options(command, all=False)}
        self.assertLessEqual(len(shown), MOST_OPTIONS)
        self.assertEqual(list(self.options("extract", all=False))[:4], ["--lower", "--upper", "--label", "--labels"])
        self.assertIn("DICOM", self.help("extract"))
        for command in COMMANDS:
            text, few, many = self.help(command, all=True), self.options(command, all=False), self.options(command)
            self.assertTrue(set(few) <= set(many))
            page = (self.folder / f"medialvoxel-{command}.1").read_text().replace("\\-", "-")
            self.assertEqual("More options: " in self.help(command), len(few) < len(many))
            for name in set(many) - set(few):
                for place, heading in ((text, "Further options:\n"), (page, ".SS Further options\n")):
                    self.assertRegex(place.split(heading)[1], rf"{name}\b")
                    self.assertNotRegex(place.split(heading)[0], rf"\n(\.B|  ) ?{name}\b")

    def test_examples_of_the_help_are_accepted(self):
        for command in COMMANDS:
            text = self.help(command).replace("\\\n", " ")
            for example in re.findall(r"^  medialvoxel (.*)$", text, re.MULTILINE):
                message = self.run_program(*example.split(), status=1).stderr
                self.assertRegex(message, r"(part\.mha|scan\.raw|mask\.nrrd|job is not)")

    def test_each_option_is_everywhere(self):
        bash, zsh = ((self.folder / name).read_text() for name in ("medialvoxel.bash", "_medialvoxel"))
        for command in COMMANDS:
            options = self.options(command)
            self.assertEqual("--raw-size" in options, command in VOLUME_COMMANDS)
            page = (self.folder / f"medialvoxel-{command}.1").read_text().replace("\\-", "-")
            in_bash = re.search(rf"^    {command}\)\n      options='(.*)'", bash, re.MULTILINE)[1].split()
            in_zsh = re.search(rf"^    {command}\)\n(.*?);;", zsh, re.MULTILINE | re.DOTALL)[1]
            self.assertEqual(set(in_bash), set(options) | {"-h", "--help", "--help-all"})
            for name, value in options.items():
                self.assertRegex(page, rf"\n\.B (-h,)?{name}( {value})?\n")
                self.assertIn(f"'{name}=[" if value else f"'{name}[", in_zsh)

    def test_bash_completes(self):
        self.assertEqual(self.complete("ex"), ["extract"])
        self.assertEqual(self.complete(""), [*COMMANDS, "-h", "--help", "-V", "--version", "--help-all"])
        self.assertEqual(self.complete("extract", "--th"), ["--thin-below", "--thick-above", "--thickness-map", "--thickness", "--threads"])
        self.assertEqual(self.complete("distance", "--th"), ["--threads"])
        self.assertEqual(self.complete("extract", "--vector-boundary", ""), ["object", "background"])
        self.assertEqual(self.complete("extract", "--vector-boundary", "="), ["object", "background"])
        self.assertEqual(self.complete("extract", "--vector-boundary", "=", "b"), ["background"])
        self.assertIn("float32", self.complete("info", "--raw-type", ""))
        self.assertEqual(self.complete("extract", "--compress", ""), ["on", "gzip", "blosc-zstd", "none"])
        self.assertEqual(self.complete("extract", "--thickness", ""), [])
        self.assertEqual(self.complete("bogus", ""), [])
        (self.folder / "part.mha").touch()
        (self.folder / "partition").mkdir()
        self.assertEqual(sorted(self.complete("info", "par")), ["part.mha", "partition"])
        self.assertEqual(self.complete("extract", "--scratch", "par"), ["partition"])

    def test_bash_completes_when_the_tabulator_is_pressed(self):
        script = "source ./medialvoxel.bash; complete -p medialvoxel"
        result = subprocess.run(
            ["bash", "--norc", "-c", script], cwd=self.folder, capture_output=True, text=True, check=True
        )
        self.assertEqual(result.stdout, "complete -F _medialvoxel medialvoxel\n")

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed: its completion is not parsed")
    def test_zsh_parses(self):
        result = subprocess.run(["zsh", "-n", "_medialvoxel"], cwd=self.folder, capture_output=True, check=True)
        self.assertEqual(result.stderr, b"")

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed: manual pages are not formatted")
    def test_manual_pages_have_no_warnings(self):
        pages = sorted(path.name for path in self.folder.glob("*.1"))
        self.assertEqual(len(pages), 1 + len(COMMANDS))
        for page in pages:
            result = subprocess.run(
                ["groff", "-man", "-ww", "-Tutf8", page], cwd=self.folder, capture_output=True, text=True, check=True
            )
            self.assertEqual(result.stderr, "", page)
            self.assertIn("User Commands", result.stdout)

    @unittest.skipUnless(shutil.which("man"), "man is not installed: manual pages are not shown")
    def test_man_shows_the_pages_without_warnings(self):
        environment = {**os.environ, "MANWIDTH": "80", "LC_ALL": "C.UTF-8"}
        result = subprocess.run(
            ["man", "--warnings", "-l", "./medialvoxel-extract.1"],
            cwd=self.folder, capture_output=True, text=True, check=True, env=environment, stdin=subprocess.DEVNULL,
        )  # fmt: skip
        self.assertEqual(result.stderr, "")
        self.assertIn("--thickness", result.stdout)

    def test_folder_that_cannot_be_written(self):
        self.assert_fails(1, ["cannot write", "missing"], "generate", "missing")


if __name__ == "__main__":
    unittest.main()
