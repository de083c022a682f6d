# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""64 billion voxels, and empty space that takes disk space; run by ctest -C Large, as it takes minutes."""

import math
import unittest

import sparse_volumes
import volumes
from sparse_runs import SparseTestCase


class LargeSparseTest(SparseTestCase):
    def test_64_billion_voxels(self):
        seconds = self.check_size((4000, 4000, 4000), "512M")
        self.assertLessEqual(seconds, 180)

    def test_allocated_zeros_are_as_good_as_holes(self):
        size = (1000, 1000, 1000)
        self.check_size(size, "64M")
        expected = (self.folder / "labels.mha").read_bytes()
        objects = sparse_volumes.scattered_objects(size)
        shape = volumes.Volume(size, [])
        for name, header in (("in.mha", volumes.meta_header(shape)), ("in.nrrd", volumes.nrrd_header(shape))):
            path = sparse_volumes.write_sparse(self.folder / name, size, objects, header, allocate=True)
            self.assertGreaterEqual(sparse_volumes.allocated_bytes(path), math.prod(size))
            seconds, peak = self.extract_measured(name, "allocated.mha", "--overwrite", "--memory", "64M")
            print(f"{name}: {seconds:.1f} s, peak {peak / 2**20:.0f} MiB of 64M", flush=True)
            self.assertLessEqual(peak, 64 << 20)
            self.assertEqual((self.folder / "allocated.mha").read_bytes(), expected, name)


if __name__ == "__main__":
    unittest.main()
