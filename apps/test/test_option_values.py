# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Odd values of all options in the program's own list: each is taken for what it says, or ends with status 2 and a line
that names option, value and what is allowed."""

import json
import re
import unittest

import volumes
from program import FAILURE, REFUSED, USAGE, ProgramTestCase
from slicer_module import Description, ModuleTestCase

# None of the files is there: what is taken ends with another status than 2, before anything is read.
ARGUMENTS = {
    "extract": ["no.mha", "out.mha"], "mesh": ["no.mha", "out.inp"], "surface": ["no.mha", "out.vtp"],
    "distance": ["no.mha", "out.mha"], "info": ["no.mha"], "plan": ["no.mha", "out.mha", "job"],
    "work": ["job"], "finalize": ["job"], "status": ["job"],
}  # fmt: skip
RAW = ["--raw-size=2,2,2", "--raw-type=uint8"]
NEEDS = {
    "--raw-size": RAW[1:], "--raw-type": RAW[:1], "--slurm-clusters": ["--slurm"], "--materials": ["--lower=2.5"],
    "--sub-voxel": ["--lower=50"], "--fail-if-thin": ["--thin-below=2"],
}  # fmt: skip
# Of commands with a mesh or a thickness of their own these are no options.
NEEDS_OF_EXTRACT = {
    "--largest-ball": ["--local-thickness=t.mha"], "--local-thickness-method": ["--local-thickness=t.mha"],
    "--element-size": ["--mesh=m.inp"], "--sections": ["--mesh=m.inp"], "--vector-boundary": ["--vectors=v.mha"],
    "--extend-rims": ["--mesh=m.inp"], "--mesh-walls": ["--mesh=m.inp"],
    "--min-component-size": ["--mesh=m.inp"], "--color-range": ["--html=p.html"],
}  # fmt: skip
FLAG_WORDS = ["true", "ON", "Yes", "1", "false", "off", "NO", "0"]
ODD_FLAGS = [
    "", "2", "-1", "-0-3", "3abc", "1.2.3", "1Q", "1,2", "1e300,1,1", "'", "{}", "[1]", "NaN", "/", "g-endian", "auto",
    " on", "+1", "01", "\uff11", "1=1", "99999999999999999999",
]  # fmt: skip
ODD = [
    "", " ", "inf", "nan", "0x10", "1e999", "9" * 40, "3abc", "1,,2", "1,2,", ",", " 1", "1 ", "\uff13", "--", "{}", "[1]",
    "=", "1=1", "+-1", "1_000", "0,5", "banana", "-1",
]  # fmt: skip
# What numbers mean that are odd elsewhere.
TAKEN = {
    "--lower": {"inf", "-1", "9" * 40}, "--upper": {"inf", "-1", "9" * 40}, "--label": {"-1"}, "--max-distance": {"inf", "9" * 40},
    "--labels": {value for value in ODD if value.strip() and "," not in value and value != "9" * 40 and value[0] != "-"} | {"-1"},
    "--thin-below": {"1,,2"}, "--thick-above": {"1,,2"}, "--clusters": {"0,5"}, "--materials": {"0,5"}, "--color-range": {"0,5"},
}  # fmt: skip


class OptionValueTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.run_program("generate", ".")
        commands = json.loads((self.folder / "catalog.json").read_text())["commands"]
        self.options = [
            (command["name"], *usage.partition(" ")[::2], option_choices)
            for command in commands
            for usage, option_choices in ((option["usage"], option.get("choices")) for option in command["options"])
            if usage != "-V,--version"
        ]

    def command_with(self, command, option, value):
        needs = NEEDS.get(option, []) + (NEEDS_OF_EXTRACT.get(option, []) if command in ("extract", "plan") else [])
        return [command, *ARGUMENTS[command], *needs, option if value is None else f"{option}={value}"]

    def assert_refused(self, option, value, command):
        """The line has the option, and the value or one of its parts."""
        message = self.run_program(*command, status=USAGE).stderr
        self.assertTrue(any(f"'{part}'" in message for part in [value, *re.split("[,x]", value)]), (command, message))
        self.assertIn(option, message, command)
        self.assertIn(f"(see medialvoxel {command[0]} --help)", message)
        self.assertEqual(message.count("\n"), 1, message)

    def assert_taken(self, command):
        self.run_program(*command, status=FAILURE)

    def test_flags(self):
        seen = set()
        for command, option, unit, _ in self.options:
            if unit or option == "--slurm":
                continue
            with self.subTest(command=command, option=option):
                for value in ODD_FLAGS if option not in seen else ODD_FLAGS[:3]:
                    self.assert_refused(option, value, self.command_with(command, option, value))
                for value in [None, *(FLAG_WORDS if option not in seen else ["no"])]:
                    self.assert_taken(self.command_with(command, option, value))
                self.assert_refused(option, "No", [*self.command_with(command, option, None), f"{option}=No"])
            seen.add(option)
        self.assertGreater(len(seen), 15)

    def test_values(self):
        seen = set()
        for command, option, unit, choices in self.options:
            if not unit or option == "--compress" or command == "plan" and option in ("--mesh", "--element-size", "--sections", "--min-component-size"):
                continue
            with self.subTest(command=command, option=option):
                odd = [""] if unit in ("FILE", "DIR", "UID") else ODD if option not in seen else ["", "1e999", "3abc"]
                for value in odd:
                    if value in TAKEN.get(option, ()) and value:
                        self.assert_taken(self.command_with(command, option, value))
                    else:
                        self.assert_refused(option, value, self.command_with(command, option, value))
                for choice in choices or ():
                    self.assert_taken(self.command_with(command, option, choice.upper()))
                self.assertIn(option, self.run_program(*self.command_with(command, option, None), status=USAGE).stderr)
                self.assert_refused(option, "a", [*self.command_with(command, option, "a"), option, "a"])
            seen.add(option)
        self.assertGreater(len(seen), 40)

    def test_kind_of_packing_may_be_left_out(self):
        extract = ["extract", "no.mha", "out.zarr"]
        for words in ([], ["on"], ["GZIP"], ["Blosc-zstd"], ["none"], ["off"]):
            self.assert_taken(["extract", "--compress", *words, "no.mha", "out.zarr"])
            self.assert_taken([*extract, "--compress=" + "".join(words)] if words else [*extract, "--compress"])
        for value in ODD:
            self.assert_refused("--compress", value, [*extract, f"--compress={value}"])
        self.assertIn("--compress", self.run_program(*extract, "--compress", "--compress", "on", status=USAGE).stderr)

    def test_words_in_any_case(self):
        extract = ["extract", "no.mha", "out.mha", "--mesh", "m.inp"]
        for option, value in (
            ("--lower", "OTSU"), ("--thickness", "Auto"), ("--resample", "AUTO"), ("--element-size", "AUTO"),
            ("--element-size", "Voxel"), ("--labels", "ALL"), ("--smooth", "ON"), ("--memory", "2gIb"),
        ):  # fmt: skip
            self.assert_taken([*extract, option, value])

    def test_slurm_names_a_file_or_is_a_flag(self):
        plan = ["plan", "no.mha", "out.mha", "job"]
        for value in ("--slurm", "--slurm=on", "--slurm=No", "--slurm=run.sh"):
            self.assert_taken([*plan, value])
        self.assert_refused("--slurm", "", [*plan, "--slurm="])
        self.assert_refused("--slurm-clusters", "4", [*plan, "--slurm=off", "--slurm-clusters", "4"])

    def test_value_of_a_flag_is_the_next_word(self):
        """But for 0 and 1, which are names of folders of slices."""
        for word in FLAG_WORDS:
            if word in ("0", "1"):
                self.assertIn(f"cannot open {word}:", self.run_program("info", "--values", word, status=FAILURE).stderr)
            else:
                self.assert_taken(["extract", "--sub-voxel", word, "no.mha", "out.mha", "--lower", "50"])
        message = self.run_program("extract", "no.mha", "out.mha", "--report", "--quiet", status=USAGE).stderr
        self.assertIn("--report: has no value, FILE; the option --quiet follows", message)

    def test_a_flag_that_is_off_is_as_none(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        self.run_program("extract", "in.mha", "out.mha", "--dry-run=off", "--quiet=No")
        before = (self.folder / "out.mha").stat().st_mtime_ns
        self.run_program("extract", "in.mha", "out.mha", "--overwrite=0", status=REFUSED)
        self.run_program("extract", "in.mha", "out.mha", "--overwrite=1", "--dry-run=on")
        self.assertEqual((self.folder / "out.mha").stat().st_mtime_ns, before)
        for words in (["--help=yes"], ["--version=1"], ["info", "--help=no"]):
            message = self.run_program(*words, status=USAGE).stderr
            self.assertIn("takes none", message)

    def test_levels_around_the_threshold(self):
        """Also that of Otsu, which is known later; a status and the values, in every door of the job."""
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        extract = ["extract", "in.mha", "out.mha", "--thickness-map", "t.mha"]
        for limits, refused, taken in (
            (["--lower", 50], ["144,4", "4,50", "50,144", "60,144", "4,40", "5,5"], ["4,144", "-1e3,51"]),
            (["--upper", 50], ["4,144", "144,50", "50,4", "40,4"], ["144,4"]),
            (["--lower", "otsu"], ["144,4", "0,1"], []),
        ):  # fmt: skip
            for levels in refused:
                parts = ["--materials", *(f"{float(value):g}" for value in levels.split(","))]
                self.assert_fails(USAGE, parts, *extract, *limits, "--materials", levels)
                self.assert_fails(USAGE, parts, "plan", "in.mha", "out.mha", "job", *limits, "--materials", levels)
            for levels in taken:
                self.run_program(*extract, *limits, "--materials", levels, "--dry-run")
        for levels in ("nan,144", "4,inf", "-inf,4", "4", "4,5,6"):
            self.assert_fails(USAGE, ["--materials"], *extract, "--lower", 50, "--materials", levels)

    def test_names_of_outputs(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        for option in ("--distance", "--vectors", "--thickness-map", "--html", "--preview"):
            self.assert_fails(USAGE, [f"{option} x.abc: "], "extract", "in.mha", "out.mha", option, "x.abc")
        parts = ["--largest-ball", "is 257;", "256 voxels"]
        self.assert_fails(USAGE, parts, "surface", "in.mha", "out.vtp", "--largest-ball", 257)

    def test_spacing_that_was_typed(self):
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        volumes.write_raw(self.folder / "in.raw", volumes.box_with_plate())
        raw = volumes.raw_options(volumes.box_with_plate())[:4]
        for command in (["info", "in.mha"], ["extract", "in.mha", "o.mha"], ["distance", "in.mha", "o.mha"]):
            self.assert_fails(USAGE, ["--spacing is 1,1,1001", "ratio", "1000"], *command, "--spacing", "1,1,1001")
        self.assert_fails(USAGE, ["--spacing is 1e-12,1,1"], "info", "in.raw", *raw, "--spacing", "1e-12,1,1")


class ParameterValueTest(ModuleTestCase):
    def test_flags(self):
        flags = [flag for flag, element in Description().flagged.items() if element.tag == "boolean"]
        self.assertGreater(len(flags), 1)
        for flag in flags:
            for value in ODD_FLAGS:
                self.assert_module_fails(USAGE, [f"--{flag}", f"'{value}'", "true|on"], f"--{flag}={value}", "in.mha", "out.mha")

    def test_numbers(self):
        for flag, element in Description().flagged.items():
            if element.tag in ("integer", "double"):
                for value in ODD:
                    if value in ("-1", "inf", "9" * 40) and flag in ("lowerThreshold", "upperThreshold", "maxPoreSize", "labelValue"):
                        continue
                    others = [] if flag == "objectSelection" else ["--objectSelection", "NonZero"]
                    self.assert_module_fails(USAGE, [f"--{flag}", f"'{value}'"], *others, f"--{flag}={value}", "in.mha", "out.mha")


if __name__ == "__main__":
    unittest.main()
