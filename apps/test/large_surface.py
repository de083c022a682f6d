# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Surfaces of many millions of faces become files in little memory, also beyond 4 GiB. 10 GB of disk."""

import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import unittest

WRITE_SURFACE = os.environ["MEDIALVOXEL_WRITE_SURFACE"]
MEBIBYTE = 1 << 20


class LargeSurfaceTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="medialvoxel-test-", dir=os.environ.get("TMPDIR"))
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        free = shutil.disk_usage(self.folder).free
        if free < 12 * 10**9:
            self.skipTest(f"12 GB of disk are needed, {self.folder.parent} has {free / 1e9:.1f} GB")

    def write(self, side, name):
        """A square of so many quads along each side; the file, and the peak of the memory."""
        path = self.folder / name
        with subprocess.Popen([WRITE_SURFACE, f"strip:{side},{side},{side},{side},1,20", "0.25", path]) as process:
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return path, usage.ru_maxrss * 1024

    def test_memory(self):
        side = 4000
        for extension in ("vtp", "vtu", "vtk", "ply", "stl", "obj", "inp", "bdf", "k"):
            with self.subTest(extension):
                path, peak = self.write(side, f"square.{extension}")
                self.assertLess(peak, 100 * MEBIBYTE)
                self.assertGreater(path.stat().st_size, 32 * side**2)
                path.unlink()

    def test_more_than_four_gibibytes(self):
        side = 9000
        path, _ = self.write(side, "square.vtp")
        self.assertGreater(path.stat().st_size, 1 << 32)
        with open(path, "rb") as file:
            head = file.read(1 << 14)
            begin = head.index(b"\n_") + 2
            offsets = {name: int(offset) for name, offset in re.findall(rb'Name="(\w+)".*? offset="(\d+)"', head)}
            sizes = {b"connectivity": 4 * 8 * side**2, b"offsets": 8 * side**2, b"Points": 12 * (side + 1) ** 2}
            for name, size in sizes.items():
                file.seek(begin + offsets[name])
                self.assertEqual(struct.unpack("<Q", file.read(8))[0], size, name)
            file.seek(begin + offsets[b"connectivity"] + sizes[b"connectivity"] - 24)
            last = (side + 1) ** 2 - 1
            self.assertEqual(struct.unpack("<4Q", file.read(32)), (last - side - 2, last - side - 1, last, last - 1))
            file.seek(begin + offsets[b"offsets"] + sizes[b"offsets"])
            self.assertEqual(struct.unpack("<Q", file.read(8))[0], 4 * side**2)


if __name__ == "__main__":
    unittest.main()
