#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Time and peak memory of extractions from a Zarr volume that is mostly empty, in different divisions; writes one JSON
file and prints a table.

The volume is that of bench/make_sparse_zarr.py, or an existing one. All labels must have the same bytes, of which a
SHA-256 is kept: that of the sorted lines "name SHA-256" of all files. The peak is what the system tells about the
finished process.

Usage: bench/measure_sparse_sheet.py BUILD [--size 10000] [--volume FOLDER] [--divisions 0 97] [--output FILE]
"""

import argparse
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import run_benchmarks as common
from measure_memory import measure

NAME = "measure_sparse_sheet.py"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--size", type=int, default=10000, help="voxels along each axis; default 10000")
    parser.add_argument("--volume", type=pathlib.Path, help="an existing volume of that size; default: a new one")
    parser.add_argument("--divisions", type=int, nargs="+", default=[0, 97], help="0: as planned; default 0 97")
    parser.add_argument("--memory", default="1G", help="cap of the program; default 1G")
    parser.add_argument("--thickness", type=float, default=8, help="tau; default 8")
    parser.add_argument("--threads", type=int, default=1, help="default 1")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of volume and labels; default: a temporary one")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "sparse-sheet.json")
    return parser.parse_args()


def make_volume(arguments, scratch):
    if arguments.volume:
        return arguments.volume
    volume = scratch / "sheet.zarr"
    maker = common.BENCH / "make_sparse_zarr.py"
    subprocess.run([sys.executable, maker, volume, str(arguments.size)], check=True, stdout=subprocess.DEVNULL)
    return volume


def describe_volume(volume):
    array = json.loads((volume / ".zarray").read_text())
    chunks = [-(-n // c) for n, c in zip(array["shape"], array["chunks"])]
    files = [path for path in volume.rglob("*") if path.is_file() and path.name != ".zarray"]
    return {
        "shape": array["shape"],
        "chunks": array["chunks"],
        "chunks_present": len(files),
        "chunks_of_shape": chunks[0] * chunks[1] * chunks[2],
        "bytes_on_disk": sum(path.stat().st_size for path in files),
    }


def digest_of_folder(folder):
    """Of the names and contents of all files, and their number and bytes."""
    lines, size = [], 0
    for path in folder.rglob("*"):
        if path.is_file():
            data = path.read_bytes()
            size += len(data)
            lines.append(f"{path.relative_to(folder)} {hashlib.sha256(data).hexdigest()}\n")
    return {
        "sha256": hashlib.sha256("".join(sorted(lines)).encode()).hexdigest(),
        "label_files": len(lines),
        "label_bytes": size,
    }


def measure_division(arguments, volume, scratch, divisions):
    # The name of the image is in the files.
    labels, report = scratch / str(divisions) / "labels.zarr", scratch / "report.json"
    labels.parent.mkdir()
    command = [common.find_program(arguments.build, "medialvoxel"), "extract", volume, labels, "--lower", 1, "--sparse"]
    command += ["--thickness", arguments.thickness, "--memory", arguments.memory, "--threads", arguments.threads]
    command += ["--report", report, "--overwrite", "--quiet"]
    load = os.getloadavg()[0]
    result = measure(str(divisions), command + (["--divisions", divisions] if divisions else []))
    written = json.loads(report.read_text())
    return (
        result
        | digest_of_folder(labels)
        | {"load_before": round(load, 1), "load_after": round(os.getloadavg()[0], 1)}
        | {key: written[key] for key in ("divisions", "planned_peak_bytes", "memory_limit_bytes", "counts", "seconds")}
    )


def print_table(document):
    print("| divisions | planned, MiB | peak, MiB | CPU, s | wall, s | load |\n" + "| --- " * 6 + "|")
    for run in document["runs"]:
        planned = run["planned_peak_bytes"] / (1 << 20)
        load = f"{run['load_before']} to {run['load_after']}"
        seconds = f"{run['cpu_seconds']:.0f} | {run['wall_seconds']:.0f}"
        print(f"| {run['divisions']} | {planned:.0f} | {run['peak_mib']:.0f} | {seconds} | {load} |")


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, thickness=arguments.thickness, threads=arguments.threads)
    with tempfile.TemporaryDirectory(dir=arguments.scratch) as folder:
        scratch = pathlib.Path(folder)
        volume = make_volume(arguments, scratch)
        document["volume"] = describe_volume(volume)
        document["runs"] = [measure_division(arguments, volume, scratch, n) for n in arguments.divisions]
    if len({run["sha256"] for run in document["runs"]}) > 1:
        sys.exit(f"{NAME}: the labels differ")
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print_table(document)


if __name__ == "__main__":
    main()
