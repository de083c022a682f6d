# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the Python tests share: small volumes, the real ones, and the program to compare with."""

import os
import pathlib
import unittest

import itk
import numpy as np

PIXEL_TYPES = {"uint8": itk.UC, "int16": itk.SS, "uint16": itk.US, "float32": itk.F}

# File, smallest value of the object, thickness and its unit.
REAL_VOLUMES = {"engine": ("engine.mha", 72, 3.0, "voxels"), "cranium": ("cranium.mha", 200, 3.0, "mm")}


def plate(dtype="uint8", thickness=4):
    """A plate across the whole volume, as an array with the axes z, y, x."""
    mask = np.zeros((20, 24, 28), dtype)
    mask[:, 10 : 10 + thickness, :] = 1
    return mask


def blobs(dtype="uint8", shape=(30, 34, 38), seed=1):
    """Boxes in places that have no order."""
    random = np.random.default_rng(seed)
    mask = np.zeros(shape, dtype)
    for _ in range(12):
        low = [random.integers(0, size - 4) for size in shape]
        high = [start + random.integers(2, 12) for start in low]
        mask[tuple(slice(*ends) for ends in zip(low, high))] = 1
    return mask


def image_of(array, spacing=None, origin=None, direction=None):
    """A copy of the array as an image; spacing and origin are in the order x, y, z."""
    image = itk.image_from_array(np.ascontiguousarray(array))
    if spacing is not None:
        image.SetSpacing(spacing)
    if origin is not None:
        image.SetOrigin(origin)
    if direction is not None:
        image.SetDirection(itk.matrix_from_array(np.asarray(direction, float)))
    return image


def real_volume(name):
    """Path of a real volume and its parameters; skips the test where the volume is absent."""
    file_name, lower, thickness, unit = REAL_VOLUMES[name]
    folder = pathlib.Path(os.environ.get("MEDIALVOXEL_TEST_DATA") or "absent")
    if not (folder / file_name).is_file():
        raise unittest.SkipTest(f"skipped: no {file_name} in MEDIALVOXEL_TEST_DATA ({folder})")
    return folder / file_name, lower, thickness, unit


def program():
    """Path of the program medialvoxel; skips the test where it is not built."""
    path = pathlib.Path(os.environ.get("MEDIALVOXEL_PROGRAM") or "absent")
    if not path.is_file():
        raise unittest.SkipTest(f"skipped: MEDIALVOXEL_PROGRAM ({path}) is no file")
    return path
