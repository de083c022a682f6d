# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What an installed wheel holds beside its code."""

import importlib.metadata
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import support

LICENSED = {"c-blosc", "itk", "libcli11-dev", "libjpeg-turbo", "libjs-three", "libpng1.6", "libzstd", "lz4", "nlohmann-json3-dev"}
LICENSED |= {"tiff", "zig", "zlib"}


def wheel():
    """The installed package; skips the test where the package is not installed."""
    try:
        return importlib.metadata.distribution("medialvoxel")
    except importlib.metadata.PackageNotFoundError:
        raise unittest.SkipTest("skipped: the wheel is not installed; scripts/build-numpy-wheel tests it") from None


class Wheel(unittest.TestCase):
    def test_licenses_of_all_libraries(self):
        texts = [path for path in wheel().files if "licenses" in path.parts]
        folders = {path.parts[path.parts.index("licenses") + 2] for path in texts if len(path.parts) > 3}
        self.assertEqual(folders, LICENSED)
        for text in texts:
            self.assertGreater(len(text.read_binary()), 200 if text.name != "NOTICE" else 10, text)

    def test_the_page_has_its_view(self):
        wheel()
        values = np.zeros((16, 20, 24), np.uint8)
        values[6:10, 3:-3, 3:-3] = 1
        with tempfile.TemporaryDirectory() as folder:
            volume, labels, page = (pathlib.Path(folder, name) for name in ("part.mha", "labels.mha", "part.html"))
            support.write(volume, values)
            command = [sys.executable, "-m", "medialvoxel", "extract", volume, labels, "--html", page]
            subprocess.run(command, check=True, capture_output=True)
            text = page.read_text()
        self.assertIn("OrbitControls", text)
        self.assertIn("Permission is hereby granted", text)


if __name__ == "__main__":
    unittest.main()
