#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures how many of the thin places of a part are found again when its surface is noisy.

Noise changes the sides of one of ten voxels of both layers beside the surface (26 neighbors). Each noisy part is measured
with --smooth auto and without smoothing.

again    a place is found again when a thin place of the noisy part comes within REACH voxels of its thinnest cell
covered  share of the cells of all places that such a place comes near
new      thin places of the noisy part that are near no place of the clean one

Prints a Markdown table and writes one JSON file.
Usage: bench/measure_thin_places.py BUILD VOLUME.mha --lower L [options]           needs numpy and scipy
"""

import argparse
import csv
import itertools
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import run_benchmarks as common
from compare_sheets import read_voxels
from measure_smoothing import flip
from scipy import ndimage

sys.path.insert(0, str(common.BENCH.parent / "doc" / "figures"))

import make_picture  # noqa: E402

REACH = 2.0
BLOCK = np.ones((3, 3, 3), bool)


class Places:
    """Thin places of an object, as rows of the table and as cells."""

    def __init__(self, program, mask, limit, smoothing, scratch):
        size = mask.shape[::-1]
        source, table, thickness = (scratch / name for name in ("in.raw", "places.csv", "map.mha"))
        mask.astype(np.uint8).tofile(source)
        command = [program, "extract", source, scratch / "labels.mha", "--raw-type", "uint8", "--smooth", smoothing]
        command += ["--raw-size", ",".join(map(str, size)), "--thin-below", limit, "--places", table]
        command += ["--thickness-map", thickness, "--report", scratch / "report.json", "--overwrite", "--quiet"]
        subprocess.run([str(word) for word in command], check=True)
        self.report = json.loads((scratch / "report.json").read_text(encoding="utf-8"))
        with table.open(newline="", encoding="ascii") as file:
            self.rows = list(csv.DictReader(file))
        values = read_voxels(thickness, np.float32, size)
        grown = (values > 0) & (values < self.report["places"]["thin"]["grow_limit"])
        self.parts = ndimage.label(grown, BLOCK)[0]
        self.thinnest = [tuple(int(row[f"index_{axis}"]) for axis in "zyx") for row in self.rows]
        self.numbers = [self.parts[index] for index in self.thinnest]
        self.cells = np.isin(self.parts, self.numbers)

    def distances(self):
        """From each cell of the grid to the next one of a place."""
        return ndimage.distance_transform_edt(~self.cells)


def compare(clean, noisy):
    to_noisy, to_clean = noisy.distances(), clean.distances()
    again = [to_noisy[index] <= REACH for index in clean.thinnest]
    near = ndimage.minimum(to_clean, noisy.parts, noisy.numbers) if noisy.numbers else []
    areas = [float(row["area"]) for row in noisy.rows]
    new = [area for area, distance in zip(areas, near) if distance > REACH]
    missed = [number for number, found in enumerate(again, 1) if not found]
    return {
        "smoothed": noisy.report["smoothed"],
        "places": len(noisy.rows),
        "area": round(sum(areas), 1),
        "again": sum(map(bool, again)),
        "missed": missed,
        "covered_percent": round(100 * float((to_noisy[clean.cells] <= REACH).mean()), 1),
        "new": len(new),
        "new_area": round(sum(new), 1),
        "largest_new_area": round(max(new, default=0.0), 1),
    }


def format_rows(document):
    clean = document["clean"]
    lines = ["| `--smooth` | seed | places | area | found again | cells covered | new | their area |", "|" + " --- |" * 8]
    lines.append(f"| clean part | | {clean['places']} | {clean['area']:.0f} | | | | |")
    for row in document["noisy"]:
        words = [row["smooth"], row["seed"], row["places"], f"{row['area']:.0f}", f"{row['again']} of {clean['places']}"]
        words += [f"{row['covered_percent']:.0f} %", row["new"], f"{row['new_area']:.0f}"]
        lines.append("| " + " | ".join(map(str, words)) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("volume", type=pathlib.Path, help="a .mha file")
    parser.add_argument("--lower", type=float, required=True, help="smallest value of the object")
    parser.add_argument("--limit", type=float, default=4.0, help="of thin walls, in voxels; default 4")
    parser.add_argument("--seeds", type=int, default=3, help="default 3")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "thin-places.json")
    arguments = parser.parse_args()
    program = common.find_program(arguments.build, "medialvoxel")
    mask = make_picture.read_meta_image(arguments.volume) >= arguments.lower
    document = common.describe_run(arguments.build, volume=arguments.volume.name, limit=arguments.limit, reach=REACH)
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        clean = Places(program, mask, arguments.limit, "auto", scratch)
        area = round(sum(float(row["area"]) for row in clean.rows), 1)
        document["clean"] = {"places": len(clean.rows), "area": area, "smoothed": clean.report["smoothed"]}
        document["noisy"] = []
        for smoothing, seed in itertools.product(("auto", "off"), range(arguments.seeds)):
            noisy = flip(mask.astype(float), np.random.default_rng([seed, 20261123])) > 0.5
            found = compare(clean, Places(program, noisy, arguments.limit, smoothing, scratch))
            document["noisy"].append({"smooth": smoothing, "seed": seed, **found})
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(format_rows(document))


if __name__ == "__main__":
    main()
