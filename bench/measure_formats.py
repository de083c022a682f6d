#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Peak memory, time and bytes read of the program for one volume in every kind of file; prints JSON.

The first run is not limited; its labels are those that all others must equal, byte by byte. Files are written one
after the other into the scratch folder and removed again, so that it needs twice the size of the volume.

Usage: bench/measure_formats.py BUILD VOLUME [options]     VOLUME: .nrrd of type uint8, raw encoding, data attached
"""

import argparse
import gzip
import json
import pathlib
import shutil
import struct
import sys
import tempfile
import zlib

from measure_memory import MIB, has_same_voxels, measure, print_result
from run_benchmarks import find_program

NAME = "measure_formats.py"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("volume", type=pathlib.Path)
    parser.add_argument("--thickness", type=float, default=3, help="tau; default 3")
    parser.add_argument("--lower", type=float, default=1, help="smallest value of the object; default 1")
    parser.add_argument("--memory", default="256M", help="cap of the limited runs; default 256M")
    parser.add_argument("--threads", type=int, default=2, help="default 2")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the files; default: a temporary one")
    return parser.parse_args()


class Source:
    """The voxels of the volume, as a stream."""

    def __init__(self, path):
        with open(path, "rb") as file:
            head = file.read(8192)
        self.path = path
        self.offset = head.index(b"\n\n") + 2
        fields = dict(line.split(": ", 1) for line in head[: self.offset].decode().splitlines() if ": " in line)
        if fields["type"] != "uint8" or fields["encoding"] != "raw":
            sys.exit(f"{NAME}: {path}: type is {fields['type']}, encoding is {fields['encoding']}; needed: uint8, raw")
        self.sizes = fields["sizes"]

    def copy_to(self, target):
        with open(self.path, "rb") as file:
            file.seek(self.offset)
            shutil.copyfileobj(file, target, MIB)

    def nrrd_header(self, *fields):
        lines = ["NRRD0004", "type: uint8", "dimension: 3", f"sizes: {self.sizes}", "spacings: 1 1 1", *fields]
        return "\n".join(lines).encode() + b"\n"

    def meta_header(self, *fields):
        lines = ["ObjectType = Image", "NDims = 3", f"DimSize = {self.sizes}", "ElementType = MET_UCHAR", *fields]
        return "\n".join(lines).encode() + b"\n"


def write_raw(source, folder):
    with open(folder / "in.raw", "wb") as file:
        source.copy_to(file)
    return [folder / "in.raw", "--raw-size", source.sizes.replace(" ", ","), "--raw-type", "uint8"]


def write_mha(source, folder):
    with open(folder / "in.mha", "wb") as file:
        file.write(source.meta_header("ElementDataFile = LOCAL"))
        source.copy_to(file)
    return [folder / "in.mha"]


def write_mhd(source, folder):
    write_raw(source, folder)
    (folder / "in.mhd").write_bytes(source.meta_header("ElementDataFile = in.raw"))
    return [folder / "in.mhd"]


def write_nrrd(source, folder):
    with open(folder / "in.nrrd", "wb") as file:
        file.write(source.nrrd_header("encoding: raw", ""))
        source.copy_to(file)
    return [folder / "in.nrrd"]


def write_nhdr(source, folder):
    write_raw(source, folder)
    (folder / "in.nhdr").write_bytes(source.nrrd_header("encoding: raw", "data file: in.raw"))
    return [folder / "in.nhdr"]


def write_split_nhdr(source, folder):
    """Two data files with as many slices each."""
    slices = int(source.sizes.split()[2])
    if slices % 2:
        sys.exit(f"{NAME}: {source.path}: has {slices} slices; needed: an even number")
    write_raw(source, folder)
    size = (folder / "in.raw").stat().st_size
    with open(folder / "in.raw", "r+b") as first, open(folder / "rest.raw", "wb") as second:
        first.seek(size // 2)
        shutil.copyfileobj(first, second, MIB)
        first.truncate(size // 2)
    (folder / "in.nhdr").write_bytes(source.nrrd_header("encoding: raw", "data file: LIST 3", "in.raw", "rest.raw"))
    return [folder / "in.nhdr"]


def nifti_header(source):
    sizes = [int(size) for size in source.sizes.split()]
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *sizes, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    header[344:348] = b"n+1\0"
    return bytes(header)


def write_nifti(source, folder):
    with open(folder / "in.nii", "wb") as file:
        file.write(nifti_header(source))
        source.copy_to(file)
    return [folder / "in.nii"]


def write_gzip_nifti(source, folder):
    with gzip.open(folder / "in.nii.gz", "wb", compresslevel=1) as file:
        file.write(nifti_header(source))
        source.copy_to(file)
    return [folder / "in.nii.gz"]


def write_gzip_nrrd(source, folder):
    with open(folder / "in.nrrd", "wb") as file:
        file.write(source.nrrd_header("encoding: gzip", ""))
        with gzip.GzipFile(fileobj=file, mode="wb", compresslevel=1) as packed:
            source.copy_to(packed)
    return [folder / "in.nrrd"]


class Deflater:
    """A file that packs what is written to it."""

    def __init__(self, file):
        self.file = file
        self.packer = zlib.compressobj(1)

    def write(self, data):
        self.file.write(self.packer.compress(data))

    def finish(self):
        self.file.write(self.packer.flush())


def write_compressed_mha(source, folder):
    with open(folder / "packed", "wb") as file:
        packed = Deflater(file)
        source.copy_to(packed)
        packed.finish()
    size = (folder / "packed").stat().st_size
    with open(folder / "in.mha", "wb") as file, open(folder / "packed", "rb") as packed:
        fields = ("CompressedData = True", f"CompressedDataSize = {size}", "ElementDataFile = LOCAL")
        file.write(source.meta_header(*fields))
        shutil.copyfileobj(packed, file, MIB)
    (folder / "packed").unlink()
    return [folder / "in.mha"]


FORMATS = {
    "raw": write_raw,
    ".mha": write_mha,
    ".mhd": write_mhd,
    ".nrrd": write_nrrd,
    ".nhdr": write_nhdr,
    ".nhdr with two data files": write_split_nhdr,
    ".nii": write_nifti,
    ".nrrd gzip": write_gzip_nrrd,
    ".nii.gz": write_gzip_nifti,
    ".mha compressed": write_compressed_mha,
}


def run_program(arguments, folder, name, source, memory):
    """One run, whose labels are in labels.mha of the folder afterwards."""
    command = [find_program(arguments.build, "medialvoxel"), "extract", source[0], folder / "labels.mha", *source[1:]]
    command += ["--thickness", arguments.thickness, "--lower", arguments.lower, "--memory", memory]
    command += ["--threads", arguments.threads, "--report", folder / "report.json", "--overwrite", "--quiet"]
    result = measure(name, command)
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    result["memory"] = memory
    result["planned_mib"] = round(report["planned_peak_bytes"] / MIB, 1)
    result["read_per_file_byte"] = round(report["bytes_read"] / arguments.volume.stat().st_size, 3)
    result["recomputed_voxels"] = report["recomputed_voxels"]
    result["divisions"] = report["divisions"]
    return result


def measure_formats(arguments, folder):
    source = Source(arguments.volume)
    files = folder / "files"
    runs = [run_program(arguments, folder, "not limited", [arguments.volume], "64G")]
    (folder / "labels.mha").rename(folder / "expected.mha")
    for name, write in FORMATS.items():
        files.mkdir()
        run = run_program(arguments, folder, name, write(source, files), arguments.memory)
        run["same_voxels"] = has_same_voxels(folder / "labels.mha", folder / "expected.mha")
        runs.append(run)
        shutil.rmtree(files)
    return runs


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory(dir=arguments.scratch) as name:
        runs = measure_formats(arguments, pathlib.Path(name))
    print_result(NAME, arguments, runs)


if __name__ == "__main__":
    main()
