# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The example that streams a volume which is larger than the memory it is given."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

from support import program

EXAMPLE = pathlib.Path(__file__).parent / "../../examples/python/stream_volume.py"
SIZE = (400, 800, 800)
HEADER = """ObjectType = Image
NDims = 3
BinaryData = True
BinaryDataByteOrderMSB = False
CompressedData = False
ElementSpacing = 1 1 1
DimSize = {2} {1} {0}
ElementType = MET_UCHAR
ElementDataFile = LOCAL
"""


def write_walls(path):
    """Walls of four voxels, slice by slice."""
    section = np.zeros(SIZE[1:], "uint8")
    section[20:24] = section[:, 50:54] = section[500:504] = 1
    with open(path, "wb") as file:
        file.write(HEADER.format(*SIZE).encode())
        for _ in range(SIZE[0]):
            file.write(section.tobytes())


class Streaming(unittest.TestCase):
    def test_a_volume_larger_than_the_memory(self):
        if not EXAMPLE.is_file():
            self.skipTest(f"skipped: {EXAMPLE.name} is not beside the tests")
        with tempfile.TemporaryDirectory() as name:
            volume, labels, expected = (pathlib.Path(name) / file for file in ("in.mha", "out.mha", "expected.mha"))
            write_walls(volume)
            command = [sys.executable, "-B", EXAMPLE, volume, labels, "--lower", 1, "--thickness", 4, "--memory", 100]
            run = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertGreater(int(re.search(r"volume (\d+) MiB", run.stdout)[1]), 200)
            self.assertLess(int(re.search(r"of the pipeline (\d+) MiB", run.stdout)[1]), 100)
            command = [program(), "extract", volume, expected, "--lower", 1, "--thickness", 4, "--quiet"]
            subprocess.run(list(map(str, command)), check=True)
            voxels = SIZE[0] * SIZE[1] * SIZE[2]
            self.assertEqual(labels.read_bytes()[-voxels:], expected.read_bytes()[-voxels:])


if __name__ == "__main__":
    unittest.main()
