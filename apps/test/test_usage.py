# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Options that are wrong, missing or contradictory: status 2, a message with value and range, nothing written."""

import json
import re
import unittest

import volumes
from program import FAILURE, USAGE, ProgramTestCase

FORMER_NAMES = {
    "--level": "--resolution",
    "--levels": "--materials",
    "--minimum-thickness": "--min-thickness",
    "--maximum-thickness": "--max-thickness",
    "--maximum-distance": "--max-distance",
    "--smallest-place": "--thin-below T,,A",
    "--min-place-area": "--thin-below T,,A",
    "--smallest-component": "--min-component-size",
    "--raw-spacing": "--spacing",
    "--zarr-compression": "--compress",
    "--voxel-units": "lengths with the unit vx, such as --thickness 3vx",
    "--thickness-csv": "thickness.histogram of --report",
    "--log-level": "the first word of each line of --log-file",
    "--section-width": "--sections",
    "--thickness-at": "--sections nodes",
    "--raw-header": "--raw-type TYPE:BYTES",
    "--raw-big-endian": "--raw-type TYPE:big",
}


# What users of other programs type.
USUAL_NAMES = {
    "--threshold": "--lower", "--iso": "--lower", "--isovalue": "--lower", "--max": "--upper", "--min-wall-thickness": "--thin-below",
    "--otsu": "--lower otsu", "--voxel-size": "--spacing", "--output": "OUTPUT", "--page": "--html", "--force": "--overwrite",
}  # fmt: skip


class UsageTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()
        volumes.write_meta(self.folder / "in.mha", self.volume)
        volumes.write_raw(self.folder / "in.raw", self.volume)

    def assert_usage(self, parts, *arguments):
        self.assert_fails(USAGE, parts, *arguments)

    def assert_extract_usage(self, parts, *arguments):
        self.assert_usage(parts, "extract", "in.mha", "out.mha", "--thickness", 3, *arguments)

    def test_help_and_version_are_results(self):
        self.assertIn("extract", self.run_program("--help").stdout)
        self.assertRegex(self.run_program("--version").stdout, r"^medialvoxel \d+\.\d+\.\d+\n$")
        self.assertEqual(self.run_program("-V").stdout, self.run_program("--version").stdout)
        self.assertEqual(self.run_program("help").stdout, self.run_program("--help").stdout)
        self.assertEqual(self.run_program("help", "mesh").stdout, self.run_program("mesh", "--help").stdout)
        for command in ("extract", "distance"):
            text = self.run_program(command, "--help").stdout
            self.assertIn("Examples:", text)
            self.assertIn("--raw-size", text)

    def test_missing_and_unknown_arguments(self):
        self.assert_usage(["subcommand"])
        self.assert_usage(["'Extract' is not a command; did you mean extract?"], "Extract", "in.mha", "out.mha")
        self.assert_usage(["'mash' is not a command; did you mean mesh?"], "help", "mash")
        self.assert_usage(["'mash' is not a command; did you mean mesh?"], "mash", "--help")
        self.assert_usage(["'finalise' is not a command; did you mean finalize?"], "finalise", "job")
        self.assert_usage(["'convert' is not a command (see"], "convert", "in.mha")
        self.assert_usage(["'check' has left the program", "python -m medialvoxel check"], "check", "shell.inp", "--json")
        self.assert_usage(["'\\x1b[' is not a command".replace("\\x1b", "?")], "\x1b[")
        self.assert_usage(["INPUT"], "extract", "--thickness", 3)
        self.assert_usage(["no output is asked for", "OUTPUT", "--html"], "extract", "in.mha", "--thickness", 3)
        self.assert_usage(["OUTPUT is required"], "plan", "in.mha")
        self.assert_usage(["--resume", "needs OUTPUT"], "extract", "in.mha", "--html", "a.html", "--resume")
        for usual, name in USUAL_NAMES.items():
            self.assert_extract_usage([f"'{usual}' is not an option of extract; did you mean {name}?"], usual, 1)
        self.assert_usage(["'--page' is not an option of info (see"], "info", "in.mha", "--page", "a.html")
        self.assert_extract_usage(["--bogus"], "--bogus")
        for former, name in FORMER_NAMES.items():
            command = {"--smallest-component": "mesh", "--maximum-distance": "distance"}.get(former, "extract")
            self.assert_usage([f"{former} is now {name}"], command, "in.mha", "out.mha", former, 1)
            self.assert_usage([f"{former} is now {name}"], command, "in.mha", "out.mha", f"{former}=1")
        self.assert_extract_usage(["'--Lower' is not an option of extract; did you mean --lower?"], "--Lower", 3)
        self.assert_extract_usage(["'--thickness-maps'", "did you mean --thickness-map?"], "--thickness-maps=t.mha")
        self.assert_extract_usage(["extra"], "extra")
        self.assert_extract_usage(["--lower"], "--lower")

    def test_messages_point_to_the_help_of_the_command(self):
        for command in (["extract", "in.mha", "out.mha"], ["mesh", "in.mha", "out.vtp"], ["distance", "in.mha", "out.mha"]):
            self.assert_usage(["lower threshold 5", f"(see medialvoxel {command[0]} --help)"], *command, "--lower", 5, "--upper", 3)
        self.assert_extract_usage(["--places", "(see medialvoxel extract --help)"], "--places", "p.csv")
        self.assert_extract_usage(["'seventy' is not a number or otsu (see"], "--lower", "seventy")

    def test_lengths_with_a_unit(self):
        """2mm are 2 units of the spacing, 3vx three times the smallest spacing."""
        stretched = ["--spacing", "2,0.5,1", "--lower", 50, "--report", "-"]
        for option, key, value, expected in (
            ("--thickness", "thickness", "3vx", 1.5), ("--thickness", "thickness", "3MM", 3), ("--max-thickness", "max_thickness", "20vx", 10),
        ):  # fmt: skip
            report = json.loads(self.run_program("extract", "in.mha", option, value, *stretched).stdout)
            self.assertEqual(report["parameters"][key], expected)
        thin = json.loads(self.run_program("extract", "in.mha", "--thin-below", "5vx,4mm", *stretched).stdout)["places"]["thin"]
        self.assertEqual((thin["limit"], thin["grow_limit"]), (2.5, 4))
        for value in ("2vx,8VX", "1,4", "1mm,4mm"):
            self.run_program("extract", "in.mha", "--html", "p.html", "--color-range", value, "--overwrite", *stretched[:-2])
            page = (self.folder / "p.html").read_text()
            self.assertEqual([re.search(rf'"{end}":([\d.]+)', page)[1] for end in ("low", "high")], ["1.0", "4.0"])
        self.run_program("plan", "in.mha", "out.mha", "job", "--thickness", "3vx", *stretched[:-2])
        self.assertIn('"--thickness": "1.5"', (self.folder / "job/manifest.json").read_text())
        for value in ("3v", "vx", "3px", "3 vx", "0vx", "-1mm", "1e30vx"):
            self.assert_extract_usage(["--max-thickness", f"'{value}'"] if value[0] in "3v" else ["--max-thickness"], "--max-thickness", value)
        self.assert_fails(FAILURE, ["no.mha"], "extract", "no.mha", "out.mha", "--thickness", "3vx")

    def test_thickness_out_of_range(self):
        for value in ("0", "-2", "nan", "inf", "-inf"):
            self.assert_usage(
                ["thickness", value, "finite number greater than 0"], "extract", "in.mha", "out.mha", "--thickness", value
            )
        for value in ("3x", "", "three", "0x3", "Autos"):
            self.assert_usage(["--thickness", f"'{value}'"], "extract", "in.mha", "out.mha", "--thickness", value)

    def test_labels_of_objects(self):
        for value in ("", "0", "1,,2", "1,0", "9223372036854775808"):
            self.assert_extract_usage(["--labels", f"'{value}'", "whole numbers other than 0"], "--labels", value)
        for value in ("2G", "Alle", "1.5"):
            self.assert_extract_usage(["labels", f"'{value}'", "no names", "--segments"], "--labels", value)

    def test_limits_of_the_automatic_thickness(self):
        command = ["extract", "in.mha", "out.mha"]
        for name in ("min", "max"):
            for value in ("0", "-2", "nan", "inf"):
                self.assert_usage([f"--{name}-thickness", f"'{value}'", "greater than 0"], *command, f"--{name}-thickness", value)
        limits = ["--min-thickness", 5, "--max-thickness", 4]
        self.assert_usage(["minimum thickness 5", "maximum thickness 4"], *command, *limits)

    def test_pore_size_out_of_range(self):
        for value in ("-1", "1000001", "2.5", "x"):
            self.assert_extract_usage(["--max-pore-size", f"'{value}'", "0 to 1000000"], "--max-pore-size", value)
            self.assert_usage(["--max-pore-size"], "mesh", "in.mha", "out.vtp", "--max-pore-size", value)
        self.assert_usage(["--max-pore-size"], "distance", "in.mha", "out.mha", "--max-pore-size", 3)

    def test_thresholds(self):
        for command in (["extract", "in.mha", "out.mha", "--thickness", 3], ["distance", "in.mha", "out.mha"]):
            self.assert_usage(["72.5", "greater than", "72"], *command, "--lower", 72.5, "--upper", 72)
            self.assert_usage(["-5", "-6"], *command, "--lower", -5, "--upper", -6)
            self.assert_usage(["lower", "nan"], *command, "--lower", "nan")
            self.assert_usage(["--upper", "'a'"], *command, "--upper", "a")

    def test_numbers_out_of_range(self):
        self.assert_extract_usage(["--threads", "'0'", "from 1"], "--threads", 0)
        self.assert_extract_usage(["--threads", "'-1'"], "--threads", -1)
        self.assert_extract_usage(["--threads", "'2.5'"], "--threads", 2.5)
        self.assert_extract_usage(["--divisions", "'0'", "from 1"], "--divisions", 0)
        for size in ("x", "", "-1G", "1X", "2GiBs", "nan", "1e30"):
            self.assert_extract_usage(["--memory", f"'{size}'", "500M"], "--memory", size)
        self.assert_usage(["--max-distance", "'0'"], "distance", "in.mha", "out.mha", "--max-distance", 0)

    def test_names_in_any_case(self):
        raw = ["--raw-size", "24X20x16", "--raw-type", "UINT8"]
        self.run_program("extract", "in.raw", "a.mha", *raw, "--thickness", "Auto", "--progress", "None", "--memory", "2GiB")
        self.run_program("extract", "in.mha", "b.mha", "--progress", "none", "--memory", "2gb")
        self.assertEqual((self.folder / "a.mha").read_bytes(), (self.folder / "b.mha").read_bytes())

    def test_unknown_choices(self):
        self.assert_extract_usage(["'objekt' is not one of", "did you mean object?"], "--vector-boundary", "objekt")
        self.assert_extract_usage(["--progress", "'loud'", "bar"], "--progress", "loud")
        self.assert_extract_usage(["--vector-boundary", "'both'", "object"], "--vector-boundary", "both")
        self.assert_usage(["--region", "'none'", "inside"], "distance", "in.mha", "out.mha", "--region", "none")

    def test_options_given_twice(self):
        self.assert_extract_usage(["--lower"], "--lower", 1, "--lower", 2)

    def test_options_without_effect(self):
        """Each is refused alone, and taken beside what it needs."""
        extract = ["extract", "in.mha", "out.mha", "--lower", 50]
        mesh = ["mesh", "in.mha"]
        distance = ["distance", "in.mha", "out.mha"]
        for command, need, option in (
            (extract, None, ["--min-thickness", 2, "--thickness", 3]),
            (extract, None, ["--max-thickness", 2, "--thickness", 3]),
            (extract, ["--vectors", "v.mha"], ["--vector-boundary", "object"]),
            (extract[:2] + ["--html", "p.html"], ["out.zarr"], ["--compress", "none"]),
            (extract, ["--mesh", "m.inp"], ["--sections", 1]),
            (mesh + ["m.vtp"], None, ["--sections", 1]),
            (mesh + ["m.BDF"], [], ["--sections", 1]),
            (mesh + ["m.ply"], None, ["--sections", "nodes"]),
            (mesh + ["m.k"], [], ["--sections", "NODES"]),
        ):
            if need != []:
                self.assert_usage([option[0], "no effect", "needs"], *command, *option)
            if need is not None:
                self.run_program(*command, *need, *option, "--dry-run")

    def test_unknown_output_extensions(self):
        for name in ("out", "out.tif", "out.raw", "out.gz", ".mha"):
            self.assert_usage([name, "unknown format", ".mha"], "extract", "in.mha", name, "--thickness", 3)
            self.assert_usage([name, "unknown format", ".mha"], "distance", "in.mha", name)
            self.assert_extract_usage([name, "unknown format"], "--vectors", name)
            self.assert_extract_usage([name, "unknown format"], "--distance", name)
        self.assert_extract_usage(["out.jpg", "unknown format", ".png"], "--preview", "out.jpg")

    def test_raw_description(self):
        command = ["extract", "in.raw", "out.mha", "--thickness", 3]
        self.assert_usage(["unknown format", "--raw-size"], *command)
        self.assert_usage(["--raw-type"], *command, "--raw-size", "24,20,16")
        self.assert_usage(["--raw-size"], *command, "--raw-type", "uint8")
        for size in ("24,20,x", "24x20xx16", "24 x 20 x 16", "24,20,-16", "24,20,0", "24,,16", "1e3,2,2", ""):
            self.assert_usage(["--raw-size"], *command, "--raw-type", "uint8", "--raw-size", size)
        for size in ("24", "24,20,16,1"):
            self.assert_usage(["--raw-size", "2 or 3"], *command, "--raw-type", "uint8", "--raw-size", size)
        self.assert_usage(["--raw-size"], *command, "--raw-type", "uint8", "--raw-size", "2000000000,2000000000,2000000000")
        self.assert_usage(["--raw-type", "'uint7'", "did you mean uint8?"], *command, "--raw-size", "24,20,16", "--raw-type", "uint7")
        for kind in (":", ":big", "uint8:", "uint8:-1", "uint8:2.5", "uint8:5:6", "uint8:big:5", "uint8:5:big:", "uint8:5:", "uint8::big", "uint8:5:little"):
            self.assert_usage(["--raw-type", "'"], *command, "--raw-size", "24,20,16", "--raw-type", kind)


if __name__ == "__main__":
    unittest.main()
