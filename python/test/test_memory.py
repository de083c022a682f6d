# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Calls leave no memory behind."""

import ctypes
import gc
import pathlib
import unittest

import medialvoxel

from support import scene


def resident():
    """Bytes of this process in memory, without what it can give back."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    for line in pathlib.Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) * 1024
    raise unittest.SkipTest("skipped: no VmRSS")


class Memory(unittest.TestCase):
    def test_two_hundred_calls_do_not_grow(self):
        values = scene((64, 64, 64)).astype("float32")

        def fail():
            try:
                medialvoxel.extract(values, thickness=-1)
            except ValueError:
                pass

        calls = (
            lambda: medialvoxel.extract(values, lower=40),
            lambda: medialvoxel.mesh(values, lower=40),
            lambda: medialvoxel.distance(values.astype(">i2"), lower=40),
            lambda: medialvoxel.local_thickness(values, lower=40),
            fail,
        )
        # Threads of the system come and go with memory of their own; what is lost at each call is lost in each round.
        sizes = []
        for _ in range(4):
            for i in range(200):
                calls[i % len(calls)]()
            sizes.append(resident())
        growth = min(after - before for before, after in zip(sizes, sizes[1:]))
        print(f"200 calls grow by {growth / 2**20:.2f} MiB")
        self.assertLess(growth, 2**20)


if __name__ == "__main__":
    unittest.main()
