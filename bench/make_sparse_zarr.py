#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes a curved sheet in an otherwise empty cube as Zarr, without the chunks that it does not meet.

A sheet of 6 voxels in 10000 x 10000 x 10000 voxels, of which 3 in 100 chunks are there, takes minutes:
  bench/make_sparse_zarr.py sheet.zarr 10000
  medialvoxel extract sheet.zarr labels.zarr --lower 1 --thickness 8 --sparse --memory 1G --threads 1
"""

import argparse
import json
import pathlib
import zlib

import numpy

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("size", type=int, help="voxels along each axis")
parser.add_argument("--chunk", type=int, default=128, help="voxels of a chunk along each axis (default 128)")
parser.add_argument("--thickness", type=float, default=6.0, help="voxels of the sheet (default 6)")
arguments = parser.parse_args()

size, chunk = arguments.size, arguments.chunk
chunks = -(-size // chunk)
arguments.folder.mkdir()
(arguments.folder / ".zarray").write_text(
    json.dumps(
        {
            "zarr_format": 2,
            "shape": [size] * 3,
            "chunks": [chunk] * 3,
            "dtype": "|u1",
            "compressor": {"id": "zlib", "level": 1},
            "fill_value": 0,
            "order": "C",
            "filters": None,
            "dimension_separator": "/",
        }
    )
)


def write_column(row, column):
    """The chunks along z that the sheet meets."""
    y, x = (numpy.arange(chunk)[:, None] + row * chunk, numpy.arange(chunk)[None, :] + column * chunk)
    middle = size * (0.5 + 0.12 * numpy.sin(4.0 * x / size) + 0.08 * numpy.cos(5.0 * y / size))
    lowest, highest = middle.min() - arguments.thickness, middle.max() + arguments.thickness
    files = 0
    for layer in range(int(lowest) // chunk, int(highest) // chunk + 1):
        z = numpy.arange(layer * chunk, (layer + 1) * chunk)[:, None, None]
        voxels = (numpy.abs(z - middle) < arguments.thickness / 2).astype(numpy.uint8)
        voxels[:, y[:, 0] >= size] = 0
        voxels[:, :, x[0] >= size] = 0
        if voxels.any():
            path = arguments.folder / str(layer) / str(row) / str(column)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(zlib.compress(voxels.tobytes(), 1))
            files += 1
    return files


files = sum(write_column(row, column) for row in range(chunks) for column in range(chunks))
print(f"{files} of {chunks**3} chunks")
