# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the Python tests share: small volumes, the real ones, and the program to compare with."""

import os
import pathlib
import subprocess
import unittest

import itk
import numpy as np

PIXEL_TYPES = {"uint8": itk.UC, "int16": itk.SS, "uint16": itk.US, "float32": itk.F}

# File, smallest value of the object, thickness and its unit.
REAL_VOLUMES = {"engine": ("engine.mha", 72, 3.0, "voxels"), "cranium": ("cranium.mha", 200, 3.0, "mm")}

# First slice of the walls of scan() and their thickness.
WALLS = {4: 2, 12: 8, 25: 3, 32: 6}


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


def scan(dtype="float32", noise=1.5, shape=(40, 44, 60)):
    """Walls of 2, 8, 3 and 6 voxels across z, with values from 10 to 110, as a scanner blurs them by 0.8 voxels."""
    values = np.zeros(shape)
    for begin, thickness in WALLS.items():
        values[begin : begin + thickness, 4:-4, 4:-4] = 100
    steps = np.arange(-4, 5)
    kernel = np.exp(-(steps**2) / (2 * 0.8**2))
    for axis in range(3):
        values = np.apply_along_axis(np.convolve, axis, values, kernel / kernel.sum(), "same")
    return (values + 10 + np.random.default_rng(8).normal(0, noise, shape)).astype(dtype)


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


def hindrance():
    """For how many seconds each thread of this process could have gone on, and others had the processors."""
    found = {}
    for path in pathlib.Path("/proc/self/task").glob("*/schedstat"):
        try:
            found[path.parent.name] = int(path.read_text().split()[1]) / 1e9
        except (OSError, IndexError):
            pass  # the thread has ended
    return found


def program():
    """Path of the program medialvoxel; skips the test where it is not built."""
    path = pathlib.Path(os.environ.get("MEDIALVOXEL_PROGRAM") or "absent")
    if not path.is_file():
        raise unittest.SkipTest(f"skipped: MEDIALVOXEL_PROGRAM ({path}) is no file")
    return path


def run_program(folder, image, *options):
    """Extracts with the program; returns its outputs labels, thickness and more as arrays by name, as far as they are wanted.

    Options end with "=" for a file that they name, which stands for "--thickness-map=" and others."""
    itk.imwrite(image, str(folder / "in.mha"))
    names = {option: folder / f"{option.strip('-=')}.mha" for option in options if option.endswith("=")}
    words = [f"{option}{names.get(option, '')}" for option in options]
    command = [program(), "extract", folder / "in.mha", folder / "labels.mha", "--overwrite", "--quiet", *words]
    subprocess.run(list(map(str, command)), check=True)
    files = {"labels": folder / "labels.mha", **{path.stem: path for path in names.values()}}
    return {name: itk.array_from_image(itk.imread(path)) for name, path in files.items()}
