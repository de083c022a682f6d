# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the module for 3D Slicer that the environment variable MEDIALVOXEL_MODULE names, and reads its description."""

import os
import pathlib
import subprocess
import xml.etree.ElementTree

import volumes
from program import DONE, ProgramTestCase

MODULE = pathlib.Path(os.environ["MEDIALVOXEL_MODULE"])
XML_FILE = MODULE.with_suffix(".xml")

BUILT_IN = {"help", "version", "xml", "echo", "returnparameterfile", "processinformationaddress", "ignore_rest"}
# Kinds of parameters by the name of their element.
ENUMERATIONS = {f"{kind}-enumeration" for kind in ("integer", "float", "double", "string")}
VECTORS = {f"{kind}-vector" for kind in ("integer", "float", "double", "string")}
NUMBERS = {"integer", "float", "double"}
FILES = {"image", "file", "directory", "geometry", "pointfile", "table", "transform", "measurement"}
SIMPLE = NUMBERS | {"string", "boolean"}


def parameters_of(root):
    """All parameter elements of a description."""
    return [element for group in root.findall("parameters") for element in group if element.tag not in ("label", "description")]


def text_of(element, tag):
    """Text of a child, empty when it has none; None without the child."""
    return None if element.find(tag) is None else (element.findtext(tag) or "").strip()


def is_result(element):
    """Whether the parameter comes back in the return parameter file."""
    return text_of(element, "channel") == "output" and element.find("longflag") is None and element.find("index") is None


class Description:
    """The module's parameters: positional ones, those with flags, and results."""

    def __init__(self):
        self.root = xml.etree.ElementTree.parse(XML_FILE).getroot()
        everything = parameters_of(self.root)
        self.positional = sorted(
            (element for element in everything if element.find("index") is not None),
            key=lambda element: int(element.findtext("index")),
        )
        self.flagged = {text_of(element, "longflag"): element for element in everything if element.find("longflag") is not None}
        self.results = [text_of(element, "name") for element in everything if is_result(element)]


class ModuleTestCase(ProgramTestCase):
    """Has a volume in.mha, and runs the module on it."""

    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def run_module(self, *arguments, status=DONE, **options):
        """Runs the module, checks its exit status and that it uses the error stream for errors only."""
        result = subprocess.run(
            [MODULE, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, check=False, **options
        )
        self.assertEqual(result.returncode, status, f"{arguments}\n{result.stdout}{result.stderr}")
        if status == DONE:
            self.assertEqual(result.stderr, "", arguments)
        else:
            self.assertRegex(result.stderr, r"\AMedialVoxelExtraction: .*\n\Z")
        return result

    def assert_module_fails(self, status, parts, *arguments):
        """The module fails with this status, its message has all the parts, and no file has changed."""
        before = self.snapshot()
        message = self.run_module(*arguments, status=status).stderr
        for part in parts:
            self.assertIn(str(part), message)
        self.assertEqual(self.snapshot(), before, "files changed")

    def read_echo(self, *arguments):
        """The values that the module takes from the arguments; it does not get as far as a run."""
        out = self.run_module("--echo", *arguments, "missing.mha", "out.mha", status=1).stdout
        return dict(line.split(": ", 1) if ": " in line else (line.rstrip(":"), "") for line in out.splitlines())
