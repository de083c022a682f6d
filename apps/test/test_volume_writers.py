# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Volumes that mrcfile, nibabel and tifffile write give the labels of the MetaImage with the same voxels."""

import pathlib
import re
import subprocess
import unittest

import volumes
from interpreters import python_with
from program import CORRUPT, READS_TIFF, ProgramTestCase
from test_input_identity import noisy_box

WRITE_VOLUMES = pathlib.Path(__file__).with_name("write_volumes.py")
SPACING = (0.5, 0.625, 0.75)


class VolumeWritersTest(ProgramTestCase):
    def labels(self, source, *arguments):
        self.extract(source, "labels.mha", "--lower", 50, "--overwrite", "--divisions", 3, *arguments, thickness=2)
        return volumes.read_data(self.folder / "labels.mha")

    def spacing(self, source):
        text = re.search(r"\nspacing +(.*)", self.run_program("info", source).stdout)[1]
        return [float(value) for value in text.split(" x ")]

    def write_files(self):
        """Lines of what was written, without TIFF when the program does not read it."""
        python = python_with("mrcfile, nibabel, tifffile, imagecodecs")
        if not python:
            self.skipTest("mrcfile, nibabel, tifffile or imagecodecs is not installed: run scripts/volume-writers")
        size, spacing = (",".join(map(str, values)) for values in (self.volume.size, SPACING))
        volumes.write_raw(self.folder / "in.raw", self.volume)
        command = [python, "-B", WRITE_VOLUMES, self.folder, size, spacing]
        written = subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True)
        lines = [line.split("\t") for line in written.stdout.splitlines()]
        return [line for line in lines if READS_TIFF or not line[0].endswith(".tif")]

    def test_all(self):
        self.volume = noisy_box("int16")
        self.volume.spacing = SPACING
        expected = self.labels(volumes.write_meta(self.folder / "reference.mha", self.volume))
        self.assertGreater(expected.count(2) + expected.count(3), 100)
        for name, kind, reading in self.write_files():
            with self.subTest(name):
                if "refused" in name:
                    self.assert_fails(CORRUPT, [name, reading], "info", name)
                    self.assert_fails(CORRUPT, [name, reading], "extract", name, "out.mha")
                    continue
                text = self.run_program("info", name).stdout
                self.assertRegex(text, rf"\ntype +{kind}\n")
                self.assertRegex(text, rf"\nreading +{reading}")
                known = 3 if not name.endswith(".tif") or name in ("imagej.tif", "ome.tif") else 2
                for found, wanted in zip(self.spacing(name)[:known], SPACING):
                    self.assertAlmostEqual(found, wanted, delta=1e-6 * wanted)
                spacing = ["--spacing", ",".join(map(str, SPACING))]
                self.assertEqual(self.labels(name, *spacing), expected)


if __name__ == "__main__":
    unittest.main()
