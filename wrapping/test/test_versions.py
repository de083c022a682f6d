# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The module works with the ITK that it is built for, and says so beside another one."""

import importlib.metadata
import subprocess
import sys
import unittest

import itk

# What ITK says of itself, before the module is loaded.
SCRIPT = """
import itkConfig
itkConfig.ITK_GLOBAL_VERSION_STRING = {version!r}
import itk
print(itk.Image[itk.UC, 3].New().GetNameOfClass())
try:
    {call}
except ImportError as error:
    print(error)
"""

CALLS = ("itk.medial_voxel_image_filter", "itk.MedialSurfaceMeshFilter.New()", "import itk.MedialVoxelPython")


def call_with(version, call):
    """What the script says."""
    command = [sys.executable, "-c", SCRIPT.format(version=version, call=call)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    return done.stdout.splitlines(), done.stderr


class Versions(unittest.TestCase):
    def test_of_another_itk_is_an_error(self):
        cases = [("6.0.0", call) for call in CALLS] + [(version, CALLS[0]) for version in ("6.0b2", "5.3.0", "5.40.1")]
        for version, call in cases:
            with self.subTest(version=version, call=call):
                lines, errors = call_with(version, call)
                # ITK itself works on.
                self.assertEqual(lines[:1], ["Image"], errors)
                self.assertIn(f"built for ITK 5.4 and cannot work with ITK {version};", lines[1], errors)

    def test_of_this_itk_works(self):
        for version in (itk.__version__, "5.4.99"):
            lines, errors = call_with(version, CALLS[0])
            self.assertEqual(lines, ["Image"], errors)

    def test_of_the_wheel_are_known_to_pip(self):
        try:
            needed = importlib.metadata.requires("itk-medialvoxel")
        except importlib.metadata.PackageNotFoundError:
            self.skipTest("skipped: the module is not installed as a wheel")
        self.assertIn("itk==5.4.*", [text.replace(" ", "") for text in needed])


if __name__ == "__main__":
    unittest.main()
