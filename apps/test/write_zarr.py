# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes a volume of bytes as Zarr folders in many ways with the libraries of others; prints their names as JSON.

Usage: write_zarr.py FOLDER DATA.raw X,Y,Z
"""

import json
import pathlib
import sys

import ngff_zarr
import numpy
import zarr
from numcodecs import Blosc, GZip, Zlib, Zstd
from zarr.codecs import BloscCodec, BytesCodec, Crc32cCodec, GzipCodec, ShardingCodec, TransposeCodec, ZstdCodec

SHUFFLES = ("noshuffle", "shuffle", "bitshuffle")
TYPES = ("u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8")

folder = pathlib.Path(sys.argv[1])
size = [int(length) for length in sys.argv[3].split(",")]
voxels = numpy.fromfile(sys.argv[2], numpy.uint8).reshape(size[::-1])
chunks = tuple(max(1, length // 3 + 1) for length in voxels.shape)
inner = tuple(max(1, length // 7) for length in voxels.shape)
shards = tuple(2 * length for length in inner)
names = []


def write(name, data=voxels, **options):
    array = zarr.create_array(folder / name, shape=data.shape, dtype=data.dtype, **options)
    array[:] = data
    names.append(name)


def as_type(kind):
    """The values 0 to 127, which all types have."""
    return (voxels // 2).astype(kind)


def write_version_2():
    write("v2-default.zarr", zarr_format=2)
    write("v2-plain.zarr", zarr_format=2, compressors=None, chunks=chunks)
    write("v2-f-order.zarr", zarr_format=2, order="F", chunks=chunks)
    write("v2-f-order-plain.zarr", zarr_format=2, order="F", chunks=chunks, compressors=None)
    write("v2-slash.zarr", zarr_format=2, chunks=chunks, chunk_key_encoding={"name": "v2", "separator": "/"})
    packers = [GZip(1), Zlib(1), Zstd(3), Blosc(cname="lz4"), Blosc(cname="zstd", shuffle=2), Blosc(cname="blosclz")]
    for number, packer in enumerate([*packers, Blosc(cname="lz4hc", shuffle=0), Blosc(cname="zlib", clevel=9)]):
        write(f"v2-{packer.codec_id}-{number}.zarr", zarr_format=2, compressors=packer, chunks=chunks)
    for kind in TYPES:
        for order in "<>":
            name = f"v2-{'little' if order == '<' else 'big'}-{kind}.zarr"
            write(name, as_type(order + kind), zarr_format=2, chunks=chunks, fill_value=as_type(kind).flat[0])


def write_version_3():
    write("v3-default.zarr")
    write("v3-plain.zarr", compressors=None, chunks=chunks)
    write("v3-names.zarr", chunks=chunks, chunk_key_encoding={"name": "v2", "separator": "."})
    write("v3-dots.zarr", chunks=chunks, chunk_key_encoding={"name": "default", "separator": "."})
    write("v3-transposed.zarr", chunks=chunks, filters=[TransposeCodec(order=(1, 2, 0))])
    write("v3-checked.zarr", chunks=chunks, compressors=[GzipCodec(), Crc32cCodec()])
    write("v3-twice.zarr", chunks=chunks, compressors=[ZstdCodec(), GzipCodec()])
    for number, cname in enumerate(("lz4", "lz4hc", "blosclz", "zstd", "zlib")):
        write(f"v3-{cname}.zarr", compressors=BloscCodec(cname=cname, shuffle=SHUFFLES[number % 3]), chunks=chunks)
    for kind in TYPES:
        for endian in ("little", "big"):
            packer = BloscCodec(cname="lz4") if endian == "big" else ZstdCodec()
            name = f"v3-{endian}-{kind}.zarr"
            data = as_type(kind)
            write(name, data, serializer=BytesCodec(endian=endian), compressors=packer, chunks=chunks,
                  fill_value=data.flat[0])  # fmt: skip


def write_shards():
    write("shards-default.zarr", shards=shards, chunks=inner)
    write("shards-plain.zarr", shards=shards, chunks=inner, compressors=None)
    for number, (location, index_codecs) in enumerate(
        [
            ("start", [BytesCodec(), Crc32cCodec()]),
            ("end", [BytesCodec()]),
            ("start", [BytesCodec(endian="big"), Crc32cCodec()]),
        ]
    ):
        sharding = ShardingCodec(
            chunk_shape=inner, codecs=[BytesCodec(endian="big"), BloscCodec(cname="zstd")], index_codecs=index_codecs,
            index_location=location,
        )  # fmt: skip
        array = zarr.create(
            store=str(folder / f"shards-{number}.zarr"), shape=voxels.shape, dtype="u2", chunks=shards,
            codecs=[sharding], fill_value=0, zarr_format=3,
        )  # fmt: skip
        array[:] = voxels // 2
        names.append(f"shards-{number}.zarr")


def write_images():
    image = ngff_zarr.to_ngff_image(
        voxels, dims=list("zyx"), scale={"x": 0.5, "y": 1.0, "z": 2.0}, translation={"x": 6.0, "y": 5.0, "z": 4.0}
    )
    for version, more in (("0.4", {}), ("0.5", {}), ("0.5", {"chunks_per_shard": 2})):
        scales = ngff_zarr.to_multiscales(image, scale_factors=[2, 4], chunks=16)
        name = f"ngff-{version}{'-shards' if more else ''}.ome.zarr"
        ngff_zarr.to_ngff_zarr(str(folder / name), scales, version=version, **more)
        names.append(name)


for step in (write_version_2, write_version_3, write_shards, write_images):
    step()
print(json.dumps(names))
