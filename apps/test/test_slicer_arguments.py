# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The module for 3D Slicer takes what its description says, all of it and nothing else."""

import re
import unittest

from program import CORRUPT, DONE, FAILURE, REFUSED, USAGE
from slicer_module import BUILT_IN, ENUMERATIONS, FILES, Description, ModuleTestCase, text_of

VOLUMES = ["in.mha", "out.mha"]
# Values beside the defaults; texts and files take any.
OTHER = {"integer": "7", "double": "-2.5", "boolean": "true"}
SPECIAL = {"thickness": "2.5", "minBranchLength": "2.5", "upperThreshold": "72.5", "memory": "500M", "materials": "10,90", "thinBelow": "2,3", "thickAbove": "3", "largestBall": "9", "elementSize": "2.5"}


class DriftTest(ModuleTestCase):
    """Walks the description: each of its parameters, with its default, its elements and its limits, is the program's."""

    def setUp(self):
        super().setUp()
        self.description = Description()

    def other_value(self, flag, element):
        if element.tag in ENUMERATIONS:
            return element.findall("element")[-1].text
        return SPECIAL.get(flag) or OTHER.get(element.tag) or f"{flag}{element.get('fileExtensions', '').split(',')[0]}"

    def test_help_names_the_same_flags(self):
        flags = set(re.findall(r"--(\w+)", self.run_module("--help").stdout))
        self.assertEqual(flags, set(self.description.flagged) | BUILT_IN)

    def test_positional(self):
        names = [text_of(element, "name") for element in self.description.positional]
        self.assertEqual(names, ["inputVolume", "outputVolume"])
        echo = self.read_echo()
        self.assertEqual([echo[name] for name in names], ["missing.mha", "out.mha"])

    def test_defaults(self):
        echo = self.read_echo()
        self.assertEqual(set(echo) - BUILT_IN - {"inputVolume", "outputVolume"}, set(self.description.flagged))
        for flag, element in self.description.flagged.items():
            self.assertEqual(echo[flag], text_of(element, "default") or "", flag)

    def test_names_are_flags(self):
        for flag, element in self.description.flagged.items():
            self.assertEqual(text_of(element, "name"), flag)

    def test_every_parameter_in_every_form(self):
        selection = ["--objectSelection", "Between"]
        for flag, element in self.description.flagged.items():
            value = self.other_value(flag, element)
            self.assertNotEqual(value, text_of(element, "default"))
            others = [] if flag == "objectSelection" else selection
            others = [*others, "--thinBelow", "2"] if flag == "placesFile" else others
            others = [*others, "--localThickness", "t.mha"] if flag == "largestBall" else others
            others = [*others, "--elementSizeMode", "Automatic"] if flag == "extendRims" else others
            others = [*others, "--lowerThreshold", "50"] if flag == "materials" else others
            forms = [[f"--{flag}", value], [f"--{flag}={value}"]]
            if element.tag == "boolean":
                forms[0] = [f"--{flag}"]
                self.assertEqual(self.read_echo(f"--{flag}=false")[flag], "false")
            for form in forms:
                self.assertEqual(self.read_echo(*others, *form)[flag], value, form)

    def test_all_at_once_as_slicer_gives_them(self):
        """All flags that have a value, then the positional arguments; empty texts are left out."""
        arguments = []
        for flag, element in self.description.flagged.items():
            default = text_of(element, "default")
            if element.tag != "boolean" and default:
                arguments += [f"--{flag}", default]
        self.run_module("--processinformationaddress", "0", "--returnparameterfile", "r.txt", *arguments, *VOLUMES)
        self.assertTrue((self.folder / "out.mha").exists())

    def test_enumerations(self):
        shown = self.run_module("--help").stdout
        for flag, element in self.description.flagged.items():
            if element.tag in ENUMERATIONS:
                elements = [child.text for child in element.findall("element")]
                self.assertIn(f"--{flag} {'|'.join(elements)}={elements[0]}\n", shown)
                others = [] if flag == "objectSelection" else ["--objectSelection", "Between"]
                for value in elements:
                    self.assertEqual(self.read_echo(*others, f"--{flag}", value)[flag], value)
                for value in ("", "bogus", elements[0] + "s"):
                    self.assert_module_fails(USAGE, [flag, f"'{value}'", elements[-1]], f"--{flag}", value, *VOLUMES)

    def test_constraints(self):
        constrained = [flag for flag, element in self.description.flagged.items() if element.find("constraints") is not None]
        self.assertEqual(constrained, ["maxPoreSize", "numberOfThreads"])
        for flag in constrained:
            minimum = int(self.description.flagged[flag].findtext("constraints/minimum"))
            maximum = int(self.description.flagged[flag].findtext("constraints/maximum"))
            for value in (minimum, maximum):
                self.assertEqual(self.read_echo(f"--{flag}", value)[flag], str(value))
            for value in (minimum - 1, maximum + 1):
                self.assert_module_fails(USAGE, [flag, value, minimum, maximum], f"--{flag}", value, *VOLUMES)

    def test_results(self):
        self.run_module("--returnparameterfile", "r.txt", *VOLUMES)
        lines = (self.folder / "r.txt").read_text().splitlines()
        self.assertEqual([line.split(" = ")[0] for line in lines], self.description.results)

    def test_no_empty_default_of_a_file_is_an_output(self):
        for flag, element in self.description.flagged.items():
            if element.tag in FILES or element.tag == "string":
                self.assertEqual(self.read_echo(f"--{flag}", "")[flag], "")


class ArgumentTest(ModuleTestCase):
    def test_negative_numbers_are_values(self):
        echo = self.read_echo("--objectSelection", "Between", "--lowerThreshold", "-1000", "--upperThreshold=-1e2")
        self.assertEqual((echo["lowerThreshold"], echo["upperThreshold"]), ("-1000", "-1e2"))

    def test_flags_after_the_volumes(self):
        self.run_module(*VOLUMES, "--thickness", "2")

    def test_rest_is_positional(self):
        (self.folder / "in.mha").rename(self.folder / "--in.mha")
        for number, mark in enumerate(("--", "--ignore_rest")):
            self.run_module("--resample", mark, "--in.mha", f"--out{number}.mha")
            self.assertTrue((self.folder / f"--out{number}.mha").exists())

    def test_boolean_before_a_volume(self):
        self.run_module("--resample", *VOLUMES)

    def test_help_version_and_xml_need_no_volumes(self):
        for flag in ("--help", "-h", "--version", "--xml"):
            result = self.run_module(flag)
            self.assertNotEqual(result.stdout, "")

    def test_wrong_numbers(self):
        for value in ("0", "-2", "nan", "inf", "three", "", "3x"):
            self.assert_module_fails(USAGE, ["thickness", value], "--thickness", value, *VOLUMES)
        selection = ["--objectSelection", "Between"]
        for flag in ("lowerThreshold", "upperThreshold"):
            for value in ("nan", "a", ""):
                self.assert_module_fails(USAGE, [flag[:5], value], *selection, f"--{flag}", value, *VOLUMES)
        for value in ("1.5", "2147483648", "-2147483649", ""):
            self.assert_module_fails(USAGE, ["labelValue", value], *selection, "--labelValue", value, *VOLUMES)
        self.assert_module_fails(USAGE, ["memory", "x"], "--memory", "x", *VOLUMES)

    def test_lower_above_upper(self):
        limits = ["--lowerThreshold", "5", "--upperThreshold", "4"]
        self.assert_module_fails(USAGE, ["5", "4"], "--objectSelection", "Between", *limits, *VOLUMES)
        self.run_module("--objectSelection", "AboveLower", *limits, *VOLUMES)

    def test_limits_without_a_selection(self):
        for flag in ("lowerThreshold", "upperThreshold", "labelValue"):
            self.assert_module_fails(USAGE, [flag, "objectSelection"], f"--{flag}", "1", *VOLUMES)

    def test_missing_and_unknown_arguments(self):
        self.assert_module_fails(USAGE, ["inputVolume"])
        self.assert_module_fails(USAGE, ["outputVolume"], "in.mha")
        self.assert_module_fails(USAGE, ["outputVolume"], "in.mha", "")
        self.assert_module_fails(USAGE, ["extra.mha"], *VOLUMES, "extra.mha")
        for flag in ("--bogus", "-t", "--Thickness", "--inputVolume", "--lower-threshold"):
            self.assert_module_fails(USAGE, [flag, "not expected"], flag, *VOLUMES)
        self.assert_module_fails(USAGE, ["thickness"], *VOLUMES, "--thickness")
        self.assert_module_fails(USAGE, ["thickness", "given twice"], "--thickness", "3", "--thickness=4", *VOLUMES)
        self.assert_module_fails(USAGE, ["resample", "maybe"], "--resample=maybe", *VOLUMES)
        self.assert_module_fails(
            USAGE, ["processinformationaddress", "7"], "--processinformationaddress", "7", *VOLUMES
        )

    def test_status_of_other_failures(self):
        self.assert_module_fails(FAILURE, ["missing.mha"], "missing.mha", "out.mha")
        self.assert_module_fails(USAGE, ["out.tif"], "in.mha", "out.tif")
        self.assert_module_fails(USAGE, ["input"], "in.mha", "in.mha")
        self.assert_module_fails(USAGE, ["in.mha"], "--returnparameterfile", "in.mha", *VOLUMES)
        self.assert_module_fails(REFUSED, ["nowhere"], "in.mha", "nowhere/out.mha")
        self.assert_module_fails(REFUSED, ["memory"], "--memory", "1K", *VOLUMES)
        (self.folder / "in.mha").write_bytes((self.folder / "in.mha").read_bytes()[:-1])
        self.assert_module_fails(CORRUPT, ["in.mha"], *VOLUMES)

    def test_existing_output_is_replaced(self):
        """Slicer uses the same temporary names again."""
        (self.folder / "out.mha").write_bytes(b"of an earlier run")
        self.run_module(*VOLUMES, status=DONE)
        self.assertTrue((self.folder / "out.mha").read_bytes().startswith(b"ObjectType"))


if __name__ == "__main__":
    unittest.main()
