# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What tests of series of slices share: volumes, and other programs that write them."""

import json
import os
import pathlib
import subprocess
import unittest

import volumes
from interpreters import python_with
from program import ProgramTestCase

WRITE_SLICES = pathlib.Path(__file__).with_name("write_slices.py")
READS_DICOM = os.environ.get("MEDIALVOXEL_READS_DICOM", "1") == "1"

needs_dicom = unittest.skipUnless(READS_DICOM, "the program was built without GDCM")


def in_hounsfield_units(size=(40, 36, 24), spacing=(0.8, 0.7, 1.5)):
    """A tilted wall of -1000 in air and 3000 in metal."""
    volume = volumes.blurred_wall(size=size)
    volume.spacing = spacing
    return volume


class SeriesTestCase(ProgramTestCase):
    def write(self, kind, module, volume, folder, **spec):
        """Writes the slices of a volume to a folder."""
        path = self.folder / folder
        path.mkdir(exist_ok=True)
        self.call_writer([WRITE_SLICES, kind], module, volume, folder=str(path), **spec)
        return path

    def call_writer(self, command, module, volume, **spec):
        """Runs a script of these tests; skips the test where the library is missing that writes."""
        python = python_with(module)
        if python is None or python_with("numpy") is None:
            self.skipTest(f"{module} is not installed; scripts/install-packages slices does it")
        if spec.get("syntax", "").startswith("jpeg") and python_with("gdcm") is None:
            self.skipTest("python3-gdcm is not installed; scripts/install-packages slices does it")
        raw = volumes.write_raw(self.folder / "written.raw", volume)
        spec = {"raw": str(raw), "type": volume.kind, "size": volume.size, "spacing": volume.spacing, **spec}
        subprocess.run([python, *command, json.dumps(spec)], check=True)
        raw.unlink()

    def info(self, *arguments):
        lines = self.run_program("info", *arguments).stdout.splitlines()
        return {line.split("  ", 1)[0]: line.split("  ", 1)[1].strip() for line in lines}

    def results(self, source, *arguments):
        """Labels and sub-voxel thickness."""
        options = ["--lower", 1000, "--sub-voxel", "--thickness-map", "t.mha", "--overwrite", *arguments]
        self.extract(source, "l.mha", *options, thickness="auto")
        return [(self.folder / name).read_bytes() for name in ("l.mha", "t.mha")]
