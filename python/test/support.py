# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the tests share: volumes, and the program with files that NumPy writes and reads."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "apps/test"))

META_TYPES = {
    "uint8": "MET_UCHAR",
    "int8": "MET_CHAR",
    "uint16": "MET_USHORT",
    "int16": "MET_SHORT",
    "uint32": "MET_UINT",
    "int32": "MET_INT",
    "uint64": "MET_ULONG_LONG",
    "int64": "MET_LONG_LONG",
    "float32": "MET_FLOAT",
    "float64": "MET_DOUBLE",
}

INTEGERS = ["int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"]
REALS = ["float16", "float32", "float64"]


def spread(values):
    """Every second voxel of a larger array."""
    larger = np.full(tuple(2 * size for size in values.shape), 99, values.dtype)
    view = larger[::2, 1::2, ::2]
    view[...] = values
    return view


ORDERS = {
    "C": np.ascontiguousarray,
    "Fortran": np.asfortranarray,
    "reversed": lambda values: np.ascontiguousarray(values[::-1, ::-1, ::-1])[::-1, ::-1, ::-1],
    "transposed": lambda values: np.ascontiguousarray(values.transpose(1, 2, 0)).transpose(2, 0, 1),
    "every second": spread,
    "unaligned": lambda values: np.frombuffer(b"-" + values.tobytes(), values.dtype, offset=1).reshape(values.shape),
    "big-endian": lambda values: values.astype(values.dtype.newbyteorder(">")),
    "little-endian": lambda values: values.astype(values.dtype.newbyteorder("<")),
    "read-only": lambda values: np.frombuffer(values.tobytes(), values.dtype).reshape(values.shape),
}


def scene(shape=(22, 30, 34), seed=3):
    """A hollow box, a plate and some noise, of values from 0 to 100, as float64."""
    values = np.zeros(shape)
    values[2:-2, 3:-3, 3:-3] = 80
    values[6:-6, 7:-7, 7:-7] = 0
    values[9:12, 7:-7, 7:-7] = 60
    random = np.random.default_rng(seed)
    return np.floor(np.clip(values + random.normal(0, 8, shape), 0, 100))


def scan(shape=(40, 44, 60), noise=1.5):
    """Walls of 2, 3, 6 and 8 voxels, with values from 10 to 110, as a scanner blurs them, as float64."""
    values = np.zeros(shape)
    for begin, thickness in ((4, 2), (12, 8), (25, 3), (32, 6)):
        values[begin : begin + thickness, 4:-4, 4:-4] = 100
    steps = np.arange(-4, 5)
    kernel = np.exp(-(steps**2) / (2 * 0.8**2))
    for axis in range(values.ndim):
        values = np.apply_along_axis(np.convolve, axis, values, kernel / kernel.sum(), "same")
    return values + 10 + np.random.default_rng(8).normal(0, noise, shape)


def blob(size=256):
    """A thick object that keeps the engine busy for seconds."""
    mask = np.ones((size,) * 3, np.uint8)
    mask[0] = 0
    return mask


def slow_noise():
    """Noise of which one tile takes minutes with slow_options."""
    return np.random.default_rng(5).random((160, 160, 160)) < 0.75


slow_options = {"thickness": 154.0}


def program():
    """Path of the program; skips the test where there is none."""
    path = os.environ.get("MEDIALVOXEL_PROGRAM")
    if not path or not os.path.exists(path):
        raise unittest.SkipTest(f"skipped: MEDIALVOXEL_PROGRAM ({path}) is no file")
    return path


def write(path, values, spacing=None):
    """Writes an array as MetaImage; the spacing is (z, y, x)."""
    values = np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
    numbers = " ".join(map(str, values.shape[::-1]))
    steps = " ".join(map(repr, (spacing or (1.0,) * values.ndim)[::-1]))
    header = (
        f"ObjectType = Image\nNDims = {values.ndim}\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
        f"ElementSpacing = {steps}\nDimSize = {numbers}\nElementType = {META_TYPES[values.dtype.name]}\n"
        "ElementDataFile = LOCAL\n"
    )
    pathlib.Path(path).write_bytes(header.encode() + values.tobytes())


def read(path):
    """Reads a MetaImage; vectors are (z, y, x)."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"ElementDataFile = LOCAL\n") + len(b"ElementDataFile = LOCAL\n")
    header = dict(re.findall(r"(\w+) = (.*)", data[:end].decode()))
    dtype = next(name for name, meta in META_TYPES.items() if meta == header["ElementType"])
    shape = tuple(map(int, header["DimSize"].split()))[::-1]
    channels = int(header.get("ElementNumberOfChannels", 1))
    values = np.frombuffer(data, dtype, offset=end)
    if channels == 1:
        return values.reshape(shape)
    return values.reshape(shape + (channels,))[..., ::-1]


def read_ply(path):
    """Points (z, y, x), faces and thickness of a mesh that the program wrote. A triangle among quads has its last corner
    twice."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    points, faces = (int(number) for number in re.findall(rb"element \w+ (\d+)", data[:end]))
    real = "<f8" if b"property double x" in data[:end] else "<f4"
    vertices = np.frombuffer(data, [("point", real, 3), ("thickness", "<f4")], points, end)
    offset, cells = end + vertices.nbytes, []
    for _ in range(faces):
        cells.append(np.frombuffer(data, "<i4", data[offset], offset + 1))
        offset += 1 + cells[-1].nbytes
    most = max(map(len, cells), default=4)
    cells = [cell if len(cell) == most else np.append(cell, cell[-1]) for cell in cells]
    return vertices["point"][:, ::-1], np.array(cells, int).reshape(-1, most), vertices["thickness"]


def run(arguments):
    """Runs the program. Returns its status and the text of its error stream."""
    done = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stderr


class Folder(unittest.TestCase):
    """Tests with a folder of their own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
