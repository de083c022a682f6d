#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Norms of the vectors to the background border against scipy's Euclidean distance transform.

Usage: compare_scipy.py --dump MedialVoxelTestDump [--data FOLDER]
Exit status 0: equal, 1: not equal, 77: skipped because scipy is not installed.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy
    from scipy import ndimage
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

FIXTURES = ("plane", "isotropic", "anisotropic")
REAL_VOLUMES = (("engine.mha", 72), ("cranium.mha", 200), ("shell.nrrd", 65))

# Our vectors have float components, each rounded by at most 2^-24 of its size.
TOLERANCE = 2.0e-7


def load(prefix):
    """Mask and norms with the axes z, y, x, and the spacing in that order."""
    with open(prefix + ".json", encoding="ascii") as file:
        header = json.load(file)
    shape = header["size"][::-1]
    mask = numpy.fromfile(prefix + ".mask", dtype=numpy.uint8).reshape(shape) != 0
    norm = numpy.fromfile(prefix + ".norm", dtype=numpy.float64).reshape(shape)
    return mask, norm, header["spacing"][::-1]


def expected_norms(mask, spacing):
    """Distances to the nearest background voxel that touches the object."""
    touched = ndimage.binary_dilation(mask, structure=numpy.ones((3, 3, 3), dtype=bool))
    border = touched & ~mask
    inside = ndimage.distance_transform_edt(mask, sampling=spacing)
    everywhere = ndimage.distance_transform_edt(~border, sampling=spacing)
    if not numpy.allclose(inside[mask], everywhere[mask], rtol=1e-12, atol=0):
        raise AssertionError("an object voxel is nearer to other background than to the border")
    return everywhere


def compare(name, dump_arguments, folder):
    """Print one line and tell whether all voxels agree."""
    prefix = os.path.join(folder, "volume")
    subprocess.run(dump_arguments(prefix), check=True)
    mask, norm, spacing = load(prefix)
    expected = expected_norms(mask, spacing)
    wrong = ~(numpy.abs(norm - expected) <= TOLERANCE * expected)
    print(f"{name}: {mask.size} voxels, {mask.sum()} of the object, {wrong.sum()} differ from scipy")
    return not wrong.any() and mask.any()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dump", required=True, help="the program MedialVoxelTestDump")
    parser.add_argument("--data", default="", help="folder of real volumes")
    options = parser.parse_args()
    data = os.environ.get("MEDIALVOXEL_TEST_DATA", options.data)
    agree = True
    with tempfile.TemporaryDirectory() as folder:
        for name in FIXTURES:
            agree &= compare(name, lambda prefix, name=name: [options.dump, "norms", name, prefix], folder)
        for name, threshold in REAL_VOLUMES:
            path = os.path.join(data, name)
            if not os.path.isfile(path):
                print(f"{name}: skipped, not found; set MEDIALVOXEL_TEST_DATA to the folder that holds it")
                continue
            agree &= compare(
                name,
                lambda prefix, path=path, limit=threshold: [options.dump, "norms", path, prefix, str(limit)],
                folder,
            )
    return 0 if agree else 1


if __name__ == "__main__":
    sys.exit(main())
