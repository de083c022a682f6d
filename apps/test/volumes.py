# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Small volumes in all formats, written and read without any library but Python's own."""

import array
import itertools
import math
import pathlib
import struct
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


def blurred_wall(thickness=4.3, size=(40, 36, 34), normal=(0.2, 0.37, 0.91)):
    """A tilted wall of metal in air, with voxels that hold a part of both; the threshold is 1000."""
    volume = Volume(size, [], (1, 1, 1), "int16")
    for index in volume.indices():
        distance = sum(n * (i - s / 2.1) for n, i, s in zip(normal, index, size))
        share = (math.erf((thickness / 2 - distance) / 0.9) + math.erf((thickness / 2 + distance) / 0.9)) / 2
        volume.voxels.append(round(-1000 + 4000 * share))
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


def raw_options(volume, more=""):
    return [
        "--raw-size",
        ",".join(map(str, volume.size)),
        "--raw-type",
        volume.kind + more,
        "--spacing",
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


NIFTI_TYPES = {
    "uint8": 2,
    "int16": 4,
    "int32": 8,
    "float32": 16,
    "float64": 64,
    "int8": 256,
    "uint16": 512,
    "uint32": 768,
    "int64": 1024,
    "uint64": 1280,
}

# Of each version the bytes of the header, and of the fields that are not 0 in every header offset and struct code.
NIFTI_FIELDS = {
    1: (
        348,
        {
            "sizeof_hdr": (0, "i"),
            "dim": (40, "8h"),
            "datatype": (70, "h"),
            "bitpix": (72, "h"),
            "pixdim": (76, "8f"),
            "vox_offset": (108, "f"),
            "scl_slope": (112, "f"),
            "scl_inter": (116, "f"),
            "xyzt_units": (123, "B"),
            "qform_code": (252, "h"),
            "sform_code": (254, "h"),
            "quatern": (256, "3f"),
            "qoffset": (268, "3f"),
            "srow": (280, "12f"),
            "magic": (344, "4s"),
        },
        b"n+1\0",
    ),
    2: (
        540,
        {
            "sizeof_hdr": (0, "i"),
            "magic": (4, "8s"),
            "datatype": (12, "h"),
            "bitpix": (14, "h"),
            "dim": (16, "8q"),
            "pixdim": (104, "8d"),
            "vox_offset": (168, "q"),
            "scl_slope": (176, "d"),
            "scl_inter": (184, "d"),
            "qform_code": (344, "i"),
            "sform_code": (348, "i"),
            "quatern": (352, "3d"),
            "qoffset": (376, "3d"),
            "srow": (400, "12d"),
            "xyzt_units": (500, "i"),
        },
        b"n+2\0\r\n\x1a\n",
    ),
}


def pack_fields(header, places, fields, big_endian):
    """Puts values, or sequences of them, where the fields lie; places are offsets and struct codes."""
    for name, value in fields.items():
        offset, code = places[name]
        values = value if isinstance(value, (tuple, list)) else (value,)
        struct.pack_into((">" if big_endian else "<") + code, header, offset, *values)


def nifti_header(volume, big_endian=False, version=1, **changes):
    """Header of a NIfTI file; changes replace fields."""
    size, places, magic = NIFTI_FIELDS[version]
    dimension = len(volume.size)
    fields = {
        "sizeof_hdr": size,
        "dim": (dimension, *volume.size, *[1] * (7 - dimension)),
        "datatype": NIFTI_TYPES[volume.kind],
        "bitpix": 8 * array.array(TYPES[volume.kind][0]).itemsize,
        "pixdim": (1, *volume.spacing, *[1] * (7 - dimension)),
        "vox_offset": size + 4,
        "xyzt_units": 2,
        "magic": magic,
    }
    fields.update(changes)
    header = bytearray(size + 4)
    pack_fields(header, places, fields, big_endian)
    return bytes(header)


def write_nifti(path, volume, big_endian=False, version=1, **changes):
    """A file, or a pair of .hdr and .img."""
    path = pathlib.Path(path)
    if path.suffix == ".hdr":
        changes = {"vox_offset": 0, "magic": NIFTI_FIELDS[version][2].replace(b"n+", b"ni"), **changes}
    header = nifti_header(volume, big_endian, version, **changes)
    if path.suffix == ".hdr":
        path.write_bytes(header)
        path.with_suffix(".img").write_bytes(volume.data(big_endian))
        return path
    content = header + volume.data(big_endian)
    path.write_bytes(gzip(content) if path.suffix.lower() == ".gz" else content)
    return path


MRC_MODES = {"int8": 0, "int16": 1, "float32": 2, "uint16": 6}

MRC_FIELDS = {
    "size": (0, "3i"),
    "mode": (12, "i"),
    "start": (16, "3i"),
    "intervals": (28, "3i"),
    "cell": (40, "3f"),
    "angles": (52, "3f"),
    "axes": (64, "3i"),
    "ispg": (88, "i"),
    "nsymbt": (92, "i"),
    "imod": (152, "2i"),
    "origin": (196, "3f"),
    "map": (208, "4s"),
    "machst": (212, "4B"),
}


def mrc_header(volume, big_endian=False, **changes):
    """Header of a MRC file, in ten millionths of the spacing; changes replace fields."""
    fields = {
        "size": volume.size,
        "mode": MRC_MODES.get(volume.kind, 0),
        "intervals": volume.size,
        "cell": [1e7 * count * step for count, step in zip(volume.size, volume.spacing)],
        "angles": (90, 90, 90),
        "axes": (1, 2, 3),
        "ispg": 1,
        "map": b"MAP ",
        "machst": (0x11, 0x11, 0, 0) if big_endian else (0x44, 0x44, 0, 0),
    }
    fields.update(changes)
    header = bytearray(1024)
    pack_fields(header, MRC_FIELDS, fields, big_endian)
    return bytes(header)


def write_mrc(path, volume, big_endian=False, extended=b"", **changes):
    path = pathlib.Path(path)
    header = mrc_header(volume, big_endian, **{"nsymbt": len(extended), **changes})
    path.write_bytes(header + extended + volume.data(big_endian))
    return path


# Number of the compression in the format, and how strips are packed.
TIFF_PACKERS = {
    "none": (1, bytes),
    "deflate": (8, zlib.compress),
}


def cut_into_tiles(slice_data, width, height, tile, bytes_per_voxel):
    """Tiles of a slice row by row; those at the ends are filled up with zeros."""
    for y in range(0, height, tile[1]):
        for x in range(0, width, tile[0]):
            rows = [
                slice_data[(row * width + x) * bytes_per_voxel : (row * width + min(x + tile[0], width)) * bytes_per_voxel]
                for row in range(y, min(y + tile[1], height))
            ]
            whole = b"".join(row.ljust(tile[0] * bytes_per_voxel, b"\0") for row in rows)
            yield whole.ljust(tile[0] * tile[1] * bytes_per_voxel, b"\0")


def write_tiff(path, volume, big_endian=False, packing="none", rows_per_strip=7, big=False, tile=None, **changes):
    """A stack with one directory per slice; changes replace values of tags, named tag_NUMBER, or drop those of None. With
    a tile of X x Y voxels there are no strips."""
    path = pathlib.Path(path)
    order = ">" if big_endian else "<"
    offset_code = "Q" if big else "I"
    width, height = volume.size[:2]
    slices = volume.size[2] if len(volume.size) > 2 else 1
    data = volume.data(big_endian)
    slice_bytes = len(data) // slices
    row_bytes = slice_bytes // height
    number, packer = TIFF_PACKERS[packing]
    content = bytearray((b"MM" if big_endian else b"II") + struct.pack(order + "H", 43 if big else 42))
    content += struct.pack(order + "HHQ", 8, 0, 0) if big else struct.pack(order + "I", 0)
    link = len(content) - struct.calcsize(offset_code)
    for z in range(slices):
        offsets, counts = [], []
        slice_data = data[z * slice_bytes : (z + 1) * slice_bytes]
        step = rows_per_strip * row_bytes
        parts = [slice_data[begin : begin + step] for begin in range(0, slice_bytes, step)]
        for part in cut_into_tiles(slice_data, width, height, tile, row_bytes // width) if tile else parts:
            offsets.append(len(content))
            content += packer(part)
            counts.append(len(content) - offsets[-1])
        kind = volume.kind.rstrip("0123456789")
        tags = {
            256: width,
            257: height,
            258: 8 * row_bytes // width,
            259: number,
            262: 1,
            273: offsets,
            277: 1,
            278: rows_per_strip,
            279: counts,
            339: {"uint": 1, "int": 2, "float": 3}[kind],
        }
        if tile:
            for tag in (273, 278, 279):
                del tags[tag]
            tags.update({322: tile[0], 323: tile[1], 324: offsets, 325: counts})
        tags.update({int(name[4:]): value for name, value in changes.items()})
        struct.pack_into(order + offset_code, content, link, len(content))
        link = write_tiff_directory(content, tags, order, offset_code)
    path.write_bytes(content)
    return path


def write_tiff_directory(content, tags, order, offset_code):
    """Appends a directory and returns where the offset of the next one is to be put."""
    tags = {tag: value for tag, value in sorted(tags.items()) if value is not None}
    room = struct.calcsize(offset_code)
    end = len(content) + (8 if room == 8 else 2) + len(tags) * (4 + 2 * room) + room
    beside = b""
    content += struct.pack(order + ("Q" if room == 8 else "H"), len(tags))
    for tag, value in tags.items():
        if isinstance(value, bytes):
            kind, count, data = 2, len(value), value
        elif isinstance(value, tuple):
            kind, count, data = 5, 1, struct.pack(order + "2I", *value)
        else:
            values = value if isinstance(value, list) else [value]
            kind, count = (16 if room == 8 else 4), len(values)
            data = struct.pack(f"{order}{count}{offset_code}", *values)
        content += struct.pack(order + "HH" + offset_code, tag, kind, count)
        if len(data) > room:
            content += struct.pack(order + offset_code, end + len(beside))
            beside += data
        else:
            content += data.ljust(room, b"\0")
    link = len(content)
    content += bytes(room) + beside
    return link
