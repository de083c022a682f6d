# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Zarr folders of version 2, written and read without any library but Python's own."""

import array
import gzip
import itertools
import json
import pathlib
import struct
import zlib
import volumes

# Name of the program: NumPy's name without byte order.
TYPES = {
    "uint8": "u1", "int8": "i1", "uint16": "u2", "int16": "i2", "uint32": "u4", "int32": "i4",
    "uint64": "u8", "int64": "i8", "float32": "f4", "float64": "f8",
}  # fmt: skip


def read_metadata(folder, array_path="0"):
    """What .zattrs and .zarray of an image say."""
    folder = pathlib.Path(folder)
    return (
        json.loads((folder / ".zattrs").read_text()),
        json.loads((folder / array_path / ".zarray").read_text()),
    )


def read_data(folder, array_path="0"):
    """Bytes of the voxels, x fastest, components of a voxel together; chunks without a file are 0."""
    description = read_metadata(folder, array_path)[1]
    shape, chunks = description["shape"], description["chunks"]
    if len(shape) == 3:
        shape, chunks = [1, *shape], [1, *chunks]
    components, planes, rows, columns = shape
    size = int(description["dtype"][2:])
    data = bytearray(components * planes * rows * columns * size)
    for index in itertools.product(*(range(-(-n // c)) for n, c in zip(shape, chunks))):
        name = "/".join(map(str, index[-len(description["shape"]) :]))
        path = pathlib.Path(folder) / array_path / name
        if not path.exists():
            continue
        chunk = gzip.decompress(path.read_bytes()) if description["compressor"] else path.read_bytes()
        component, z0, y0, x0 = (i * c for i, c in zip(index, chunks))
        for z in range(z0, min(z0 + chunks[1], planes)):
            for y in range(y0, min(y0 + chunks[2], rows)):
                begin = ((z - z0) * chunks[2] + y - y0) * chunks[3] * size
                count = min(chunks[3], columns - x0)
                row = chunk[begin : begin + count * size]
                target = ((z * rows + y) * columns + x0) * components + component
                for byte in range(size):
                    first = target * size + byte
                    data[first : first + count * components * size : components * size] = row[byte::size]
    return bytes(data)


def write_image(folder, volume, chunks, packer=None, big_endian=False, leading=0, separator=".", **changes):
    """Writes a volume as other programs may; changes replace fields of .zarray."""
    folder = pathlib.Path(folder)
    (folder / "s0").mkdir(parents=True)
    size = volume.size[::-1]
    order = ">" if big_endian else "<"
    item = array.array(volumes.TYPES[volume.kind][0]).itemsize
    description = {
        "zarr_format": 2,
        "shape": [1] * leading + list(size),
        "chunks": [1] * leading + list(chunks),
        "dtype": ("|" if item == 1 else order) + TYPES[volume.kind],
        "compressor": packer,
        "fill_value": 0,
        "order": "C",
        "filters": None,
        "dimension_separator": separator,
    }
    description.update(changes)
    (folder / "s0" / ".zarray").write_text(json.dumps(description))
    (folder / ".zgroup").write_text('{"zarr_format": 2}')
    names = ["t", "c"][2 - leading :] + ["z", "y", "x"][3 - len(size) :]
    kinds = ["time", "channel"][2 - leading :] + ["space"] * len(size)
    scale = {"type": "scale", "scale": [1.0] * leading + list(volume.spacing[::-1])}
    shift = {"type": "translation", "translation": [0.0] * leading + [4.0, 5.0, 6.0][: len(size)]}
    multiscale = {
        "version": "0.4",
        "axes": [{"name": name, "type": kind} for name, kind in zip(names, kinds)],
        "datasets": [{"path": "s0", "coordinateTransformations": [scale, shift]}],
    }
    (folder / ".zattrs").write_text(json.dumps({"multiscales": [multiscale]}))
    for index in itertools.product(*(range(-(-n // c)) for n, c in zip(size, chunks))):
        values = []
        for place in itertools.product(*(range(i * c, (i + 1) * c) for i, c in zip(index, chunks))):
            inside = all(p < n for p, n in zip(place, size))
            offset = 0
            for p, n in zip(place, size):
                offset = offset * n + p
            values.append(volume.voxels[offset] if inside else 0)
        if any(values):
            data = struct.pack(f"{order}{len(values)}{volumes.TYPES[volume.kind][0]}", *values)
            packed = {None: bytes, "zlib": zlib.compress, "gzip": gzip.compress}[packer and packer["id"]](data)
            path = folder / "s0" / separator.join(map(str, (0,) * leading + index))
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(packed)
    return folder
