# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Small volumes in all formats, written and read without any library but Python's own."""

import array
import itertools
import pathlib
import zlib

# Name of the program: array code, MetaImage type, NRRD type.
TYPES = {
    "uint8": ("B", "MET_UCHAR", "uint8"),
    "int8": ("b", "MET_CHAR", "int8"),
    "uint16": ("H", "MET_USHORT", "uint16"),
    "int16": ("h", "MET_SHORT", "int16"),
    "uint32": ("I", "MET_UINT", "uint32"),
    "int32": ("i", "MET_INT", "int32"),
    "uint64": ("Q", "MET_ULONG_LONG", "uint64"),
    "int64": ("q", "MET_LONG_LONG", "int64"),
    "float32": ("f", "MET_FLOAT", "float"),
    "float64": ("d", "MET_DOUBLE", "double"),
}


class Volume:
    """Voxels, x fastest, and their spacing."""

    def __init__(self, size, voxels, spacing=None, kind="uint8"):
        self.size = tuple(size)
        self.voxels = list(voxels)
        self.spacing = tuple(spacing or [1.0] * len(size))
        self.kind = kind

    def indices(self):
        """Indices (x, y, ...) in the order of the voxels."""
        return (index[::-1] for index in itertools.product(*map(range, self.size[::-1])))

    def data(self, big_endian=False):
        values = array.array(TYPES[self.kind][0], self.voxels)
        if big_endian:
            values.byteswap()
        return values.tobytes()

    def as_type(self, kind):
        return Volume(self.size, self.voxels, self.spacing, kind)


def box_with_plate(size=(24, 20, 16), spacing=None, kind="uint8"):
    """A hollow box with walls of three voxels, and a plate of two that leaves the image at x = 0; object 100, else 7."""

    def value(x, y, z):
        inside = all(3 <= c < n - 3 for c, n in zip((x, y, z), size))
        hollow = all(6 <= c < n - 6 for c, n in zip((x, y, z), size))
        plate = x < 3 and 7 <= z < 9
        return 100 if (inside and not hollow) or plate else 7

    volume = Volume(size, [], spacing, kind)
    volume.voxels = [value(*index) for index in volume.indices()]
    return volume


def join(values):
    return " ".join(map(str, values))


def meta_header(volume, data_file="LOCAL", big_endian=False, compressed=False, **changes):
    """Header of a MetaImage; changes replace fields, or remove those that are None."""
    fields = {
        "ObjectType": "Image",
        "NDims": len(volume.size),
        "BinaryData": "True",
        "BinaryDataByteOrderMSB": big_endian,
        "CompressedData": compressed,
        "Offset": join([0] * len(volume.size)),
        "ElementSpacing": join(volume.spacing),
        "DimSize": join(volume.size),
        "ElementType": TYPES[volume.kind][1],
    }
    fields.update(changes)
    fields.pop("ElementDataFile", None)
    fields["ElementDataFile"] = changes.get("ElementDataFile", data_file)
    return "".join(f"{name} = {value}\n" for name, value in fields.items() if value is not None).encode()


def nrrd_header(volume, data_file=None, big_endian=False, **changes):
    """Header of a NRRD file; underscores stand for blanks in the names of changed fields."""
    fields = {
        "type": TYPES[volume.kind][2],
        "dimension": len(volume.size),
        "sizes": join(volume.size),
        "spacings": join(volume.spacing),
        "endian": "big" if big_endian else "little",
        "encoding": "raw",
        "data file": data_file,
    }
    fields.update({name.replace("_", " "): value for name, value in changes.items()})
    text = "".join(f"{name}: {value}\n" for name, value in fields.items() if value is not None)
    return f"NRRD0004\n# comment\n{text}key:=value\n\n".encode()


def write_meta(path, volume, big_endian=False, compressed=False, **changes):
    path = pathlib.Path(path)
    data = volume.data(big_endian)
    if compressed:
        data = zlib.compress(data)
        changes.setdefault("CompressedDataSize", len(data))
    if path.suffix == ".mhd":
        path.with_suffix(".img").write_bytes(data)
        path.write_bytes(meta_header(volume, path.stem + ".img", big_endian, compressed, **changes))
    else:
        path.write_bytes(meta_header(volume, "LOCAL", big_endian, compressed, **changes) + data)
    return path


def gzip(data):
    packer = zlib.compressobj(wbits=31)
    return packer.compress(data) + packer.flush()


def write_nrrd(path, volume, big_endian=False, compressed=False, **changes):
    path = pathlib.Path(path)
    data = gzip(volume.data(big_endian)) if compressed else volume.data(big_endian)
    changes.setdefault("encoding", "gzip" if compressed else "raw")
    if path.suffix == ".nhdr":
        path.with_suffix(".img").write_bytes(data)
        path.write_bytes(nrrd_header(volume, path.stem + ".img", big_endian, **changes))
    else:
        path.write_bytes(nrrd_header(volume, None, big_endian, **changes) + data)
    return path


def write_raw(path, volume, big_endian=False, header=b""):
    path = pathlib.Path(path)
    path.write_bytes(header + volume.data(big_endian))
    return path


def raw_options(volume):
    return [
        "--raw-size",
        ",".join(map(str, volume.size)),
        "--raw-type",
        volume.kind,
        "--raw-spacing",
        ",".join(map(str, volume.spacing)),
    ]


def read_header(path):
    """Fields of an output's header and the offset of what follows it."""
    content = pathlib.Path(path).read_bytes()
    is_meta = pathlib.Path(path).suffix in (".mha", ".mhd")
    if is_meta:
        end = content.index(b"\n", content.index(b"ElementDataFile")) + 1
        pairs = (line.split(" = ", 1) for line in content[:end].decode().splitlines())
    else:
        end = content.index(b"\n\n") + 2
        pairs = (line.split(": ", 1) for line in content[:end].decode().splitlines()[1:-1])
    return dict(pairs), end


def read_data(path):
    """Bytes of an output's voxels."""
    path = pathlib.Path(path)
    fields, end = read_header(path)
    name = fields.get("ElementDataFile", fields.get("data file", "LOCAL"))
    return path.read_bytes()[end:] if name == "LOCAL" else (path.parent / name).read_bytes()


def read_floats(path):
    values = array.array("f")
    values.frombytes(read_data(path))
    return values
