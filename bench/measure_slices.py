#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Time of series of slices against the same volume in one file, and whether the results have the same bytes.

The volumes are written as slices of DICOM (shuffled names, intercept -1024), TIFF and PNG.
Runs are interleaved; the times are medians. A stack in one TIFF file may be given too.

Usage: bench/measure_slices.py BUILD DATA [options]
DATA has cranium.mha and engine.mha. Needs numpy and what apps/test/write_slices.py needs.
"""

import argparse
import json
import pathlib
import statistics
import sys
import tempfile
import zlib

import numpy as np
import run_benchmarks as common

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "apps" / "test"))
from interpreters import python_with  # noqa: E402

WRITER = pathlib.Path(__file__).parents[1] / "apps" / "test" / "write_slices.py"
DICOM = {"series": "1.2.3.4", "intercept": -1024, "seed": 3}
SERIES = {
    "cranium": (
        ("DICOM", "dicom", "pydicom", {**DICOM}),
        ("DICOM, run lengths", "dicom", "pydicom", {**DICOM, "syntax": "rle"}),
        ("DICOM, JPEG-LS", "dicom", "gdcm", {**DICOM, "syntax": "jpeg-ls"}),
    ),
    "engine": (
        ("TIFF", "tifffile", "tifffile", {"name": "s{:04}.tif"}),
        ("TIFF, deflate", "tifffile", "tifffile", {"name": "s{:04}.tif", "options": {"compression": "zlib"}}),
        ("PNG", "pillow", "PIL", {"name": "s{:04}.png"}),
    ),
}
LOWER = {"cranium": 200, "engine": 72}
TYPES = {"MET_SHORT": "int16", "MET_UCHAR": "uint8"}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("data", type=pathlib.Path, help="folder of the volumes")
    parser.add_argument("--rounds", type=int, default=5, help="runs of each series")
    parser.add_argument("--stack", nargs=2, metavar=("FILE", "LOWER"), help="a stack in one TIFF file, and its threshold")
    parser.add_argument("--output", type=pathlib.Path, default="slices.json", help="JSON with the runs")
    return parser.parse_args()


def read_meta(path):
    """Voxels (z, y, x) and spacing of a packed MetaImage."""
    data = path.read_bytes()
    end = data.index(b"\n", data.index(b"ElementDataFile")) + 1
    fields = dict(line.split(" = ") for line in data[:end].decode().splitlines())
    size = [int(n) for n in fields["DimSize"].split()]
    voxels = np.frombuffer(zlib.decompress(data[end:]), TYPES[fields["ElementType"]]).reshape(size[::-1])
    return voxels, [float(n) for n in fields["ElementSpacing"].split()]


def write_meta(path, voxels, spacing):
    kinds = {kind: name for name, kind in TYPES.items()}
    header = f"""ObjectType = Image
NDims = 3
BinaryData = True
BinaryDataByteOrderMSB = False
ElementSpacing = {" ".join(map(str, spacing))}
DimSize = {" ".join(map(str, voxels.shape[::-1]))}
ElementType = {kinds[voxels.dtype.name]}
ElementDataFile = LOCAL
"""
    path.write_bytes(header.encode() + voxels.tobytes())
    return path


def write_series(folder, voxels, spacing, kind, module, details):
    """The slices; the names of those of DICOM are shuffled."""
    python = python_with(module)
    if python is None:
        sys.exit(f"measure_slices.py: no Python with {module}; scripts/install-packages slices installs it")
    folder.mkdir()
    raw = folder.parent / "written.raw"
    raw.write_bytes(voxels.tobytes())
    size, name = list(voxels.shape[::-1]), voxels.dtype.name
    spec = {"raw": str(raw), "type": name, "size": size, "folder": str(folder), "spacing": spacing, **details}
    common.run([python, str(WRITER), kind, json.dumps(spec)])
    raw.unlink()
    return folder


class Runner:
    def __init__(self, build, scratch, lower, spacing):
        self._program = common.find_program(build, "medialvoxel")
        self._scratch = scratch
        self._options = ["--lower", str(lower), "--spacing", ",".join(map(str, spacing)), "--threads", "2"]

    def run(self, source):
        labels, thickness, report = (self._scratch / name for name in ("l.mha", "t.mha", "r.json"))
        outputs = [str(labels), "--thickness-map", str(thickness), "--report", str(report), "--overwrite", "--quiet"]
        _, times = common.run([str(self._program), "extract", str(source), *outputs, *self._options])
        found = json.loads(report.read_text(encoding="utf-8"))
        voxels = [path.read_bytes().split(b"ElementDataFile = LOCAL\n", 1)[1] for path in (labels, thickness)]
        return {
            "wall_seconds": times["wall_seconds"],
            "cpu_seconds": times["cpu_seconds"],
            "peak_memory_bytes": found["peak_memory_bytes"],
            "planned_peak_bytes": found["planned_peak_bytes"],
        }, voxels


def measure(runner, sources, rounds):
    """A row for each source, the first of which is the one file."""
    runs = {title: [] for title in sources}
    expected = None
    for _ in range(rounds):
        for title, source in sources.items():
            found, voxels = runner.run(source)
            expected = expected or voxels
            runs[title].append({**found, "same_bytes": voxels == expected})
    rows = []
    for title, all_runs in runs.items():
        row = {"source": title}
        for key in ("wall_seconds", "cpu_seconds"):
            row[key] = round(statistics.median(run[key] for run in all_runs), 3)
            row[f"{key}_ratio"] = round(row[key] / (rows[0] if rows else row)[key], 2)
        row["same_bytes"] = all(run["same_bytes"] for run in all_runs)
        row["peak_mib"] = round(max(run["peak_memory_bytes"] for run in all_runs) / 2**20, 1)
        row["planned_mib"] = round(min(run["planned_peak_bytes"] for run in all_runs) / 2**20, 1)
        rows.append(row)
    return rows


def measure_series(arguments, name, scratch):
    voxels, spacing = read_meta(arguments.data / f"{name}.mha")
    sources = {"one file": write_meta(scratch / "in.mha", voxels, spacing)}
    for number, (title, *how) in enumerate(SERIES[name]):
        sources[title] = write_series(scratch / f"series{number}", voxels, spacing, *how)
    return measure(Runner(arguments.build, scratch, LOWER[name], spacing), sources, arguments.rounds)


def measure_stack(arguments, scratch):
    """A stack against its slices as files of their own."""
    import tifffile

    path, lower = arguments.stack
    voxels = np.ascontiguousarray(tifffile.imread(path))
    how = ("tifffile", "tifffile", {"name": "s{:04}.tif"})
    sources = {pathlib.Path(path).name: path, "its slices": write_series(scratch / "slices", voxels, [1, 1, 1], *how)}
    return measure(Runner(arguments.build, scratch, lower, [1, 1, 1]), sources, arguments.rounds)


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, rounds=arguments.rounds, series={})
    for name in [*SERIES, *(["stack"] if arguments.stack else [])]:
        with tempfile.TemporaryDirectory() as folder:
            scratch = pathlib.Path(folder)
            rows = measure_stack(arguments, scratch) if name == "stack" else measure_series(arguments, name, scratch)
        document["series"][name] = rows
        for row in rows:
            print(name, *(f"{key} {value}" for key, value in row.items()), sep="  ")
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    if not all(row["same_bytes"] for rows in document["series"].values() for row in rows):
        sys.exit("measure_slices.py: results differ")


if __name__ == "__main__":
    main()
