# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A few objects in much empty space, beyond the offsets that 32 bits can hold."""

import unittest

from sparse_runs import SparseTestCase


class SparseTest(SparseTestCase):
    def test_nine_billion_voxels(self):
        self.check_size((3000, 3000, 1000), "256M")


if __name__ == "__main__":
    unittest.main()
