#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Measures what smoothing does for sheets of noisy walls: parts whose mid-surface is known, with and without noise.

Prints a Markdown table and writes one JSON file. Each noise has several seeds, whose cells and points are added up.

uncovered  lines through points of the true mid-surface, normal to it, that meet no medial cell within half a wall and
           one voxel, in percent; points near rims are left out
spurious   cells farther than 1.5 voxels from the true mid-surface, in percent of all
roughness  share of the border voxels that stand alone, in percent, which decides in --smooth auto

flips      one of ten voxels of both layers beside the surface (26 neighbors) changes sides
scan N %   blurred by a Gaussian of 0.8 voxels, white noise of N % of the contrast; the threshold is in the middle

Usage: bench/measure_smoothing.py BUILD [options]           needs numpy and scipy
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import run_benchmarks as common
import sheet_parts
from compare_sheets import read_voxels
from scipy import ndimage

FAR = 1.5
CONTRAST = 1000
BACKGROUND = 3000


def turn_to(normal):
    """The axes of a part whose third axis is the normal, one per row."""
    normal = np.array(normal, float) / np.linalg.norm(normal)
    first = np.cross(normal, (0.31, 0.87, -0.2))
    first /= np.linalg.norm(first)
    return np.array([first, np.cross(normal, first), normal])


class Gyroid:
    """Walls between the two nets of a gyroid; distances are those of a plane with the same gradient."""

    def __init__(self, size, period, wall):
        self.size, self.wall, self.k = size, wall, 2 * np.pi / period

    def _value(self, points):
        x, y, z = self.k * points.T
        value = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
        slope = np.stack(
            [
                np.cos(x) * np.cos(y) - np.sin(z) * np.sin(x),
                np.cos(y) * np.cos(z) - np.sin(x) * np.sin(y),
                np.cos(z) * np.cos(x) - np.sin(y) * np.sin(z),
            ]
        )
        return value / (self.k * np.maximum(np.linalg.norm(slope, axis=0), 0.3)), slope

    def middle(self, points):
        return np.abs(self._value(points)[0])

    def surface(self, points):
        return self.middle(points) - self.wall / 2

    def normals(self, points):
        slope = self._value(points)[1].T
        return slope / np.linalg.norm(slope, axis=1)[:, None]

    def samples(self):
        axis = np.arange(-self.size / 2 + 6, self.size / 2 - 6, 1.7)
        points = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3)
        for _ in range(3):
            distance, slope = self._value(points)
            points = points - (distance * slope / np.maximum(np.linalg.norm(slope, axis=0), 0.3)).T
        inside = (np.abs(points) < self.size / 2 - 6).all(axis=1) & (np.abs(self._value(points)[0]) < 0.05)
        return points[inside]


def wall(thickness, normal, size=64):
    return sheet_parts.Plates(size, [((0.3, -0.2, 0.17), (22, 22, thickness / 2))], turn_to(normal))


def pair(thickness, gap, normal, size=64):
    place = (thickness + gap) / 2
    boxes = [((0.3, -0.2, 0.17 + side * place), (22, 22, thickness / 2)) for side in (-1, 1)]
    return sheet_parts.Plates(size, boxes, turn_to(normal))


NORMALS = {"(1,3,4)": (1, 3, 4), "(1,1,1)": (1, 1, 1), "(2,1,0)": (2, 1, 0)}
PARTS = {f"wall of {t} {name}": wall(t, normal) for t in (2, 3, 4, 6) for name, normal in NORMALS.items()}
PARTS |= {
    "wall of 10 (1,3,4)": wall(10, (1, 3, 4)),
    "gyroid of 4": Gyroid(80, 36, 4),
    "gyroid of 3": Gyroid(80, 30, 3),
    "shell of 3": sheet_parts.Shell(64, 19.3, 3),
    "shell of 4": sheet_parts.Shell(64, 21.6, 4),
    "two walls of 3, gap of 2": pair(3, 2, (1, 3, 4)),
    "two walls of 4, gap of 2": pair(4, 2, (0, 0, 1)),
}


def flip(occupancy, random):
    mask = occupancy > 0.5
    block = np.ones((3, 3, 3), bool)
    beside = ndimage.binary_dilation(mask, block) & ~ndimage.binary_erosion(mask, block, border_value=1)
    return (mask ^ (beside & (random.random(mask.shape) < 0.1))).astype(float)


def scan(noise):
    def apply(occupancy, random):
        values = ndimage.gaussian_filter(occupancy, 0.8)
        return values + noise * random.standard_normal(occupancy.shape)

    return apply


NOISES = {"clean": None, "flips": flip, "scan 20 %": scan(0.2), "scan 40 %": scan(0.4)}


def occupy(part):
    """Share of each voxel that is inside, as if the surface were flat in it."""
    inside = np.clip(0.5 - part.surface(sheet_parts.points_of(part)), 0, 1)
    return inside.reshape(part.size, part.size, part.size)


class Runner:
    def __init__(self, build, scratch):
        self.program = common.find_program(build, "medialvoxel")
        self.scratch = scratch

    def run(self, values, smoothing):
        """Medial cells (z, y, x), roughness in percent, and whether the object was smoothed."""
        source, labels, report = self.scratch / "in.raw", self.scratch / "labels.mha", self.scratch / "report.json"
        np.clip(np.rint(BACKGROUND + CONTRAST * values), 0, 65535).astype(np.uint16).tofile(source)
        size = values.shape[::-1]
        command = [self.program, "extract", source, labels, "--raw-size", ",".join(map(str, size)), "--raw-type", "uint16"]
        command += ["--lower", BACKGROUND + CONTRAST // 2, "--smooth", smoothing, "--report", report, "--threads", 1]
        subprocess.run([str(word) for word in [*command, "--quiet", "--overwrite"]], check=True)
        found = json.loads(report.read_text(encoding="utf-8"))
        roughness = found["roughness"]
        ratio = 100 * roughness["ratio"] if roughness else None
        return read_voxels(labels, np.uint8, size) >= 2, ratio, found["smoothed"]


def find_normals(part, points):
    if isinstance(part, Gyroid):
        return part.normals(points)
    if isinstance(part, sheet_parts.Shell):
        return points / np.linalg.norm(points, axis=1)[:, None]
    return np.broadcast_to(part.turn[2], points.shape)


def judge(part, medial):
    """Counts of uncovered and of all lines, of spurious and of all cells."""
    samples = part.samples()
    normals = find_normals(part, samples)
    thickness = part.wall if hasattr(part, "wall") else 2 * min(half.min() for _, half in part.boxes)
    covered = np.zeros(len(samples), bool)
    for step in np.arange(-thickness / 2 - 1, thickness / 2 + 1.01, 0.2):
        # The center of cell i is half a voxel behind that of voxel i.
        cells = np.rint(samples + step * normals + (part.size - 1) / 2 - 0.5).astype(int)
        inside = ((cells >= 0) & (cells < part.size)).all(axis=1)
        x, y, z = np.clip(cells, 0, part.size - 1).T
        covered |= inside & medial[z, y, x]
    points = np.argwhere(medial)[:, ::-1] + 0.5 - (part.size - 1) / 2
    points = points[(np.abs(points) < part.size / 2 - 4).all(axis=1)]
    far = part.middle(points) > FAR if len(points) else np.zeros(0, bool)
    return [int((~covered).sum()), len(samples), int(far.sum()), len(points)]


def measure(runner, title, part, noise, seeds):
    row = {"part": title, "noise": noise}
    occupancy = occupy(part)
    for smoothing in ("off", "auto"):
        sums, ratios, decisions = np.zeros(4, int), [], []
        for seed in range(seeds if NOISES[noise] else 1):
            random = np.random.default_rng([seed, 20261123])
            values = NOISES[noise](occupancy, random) if NOISES[noise] else (occupancy > 0.5).astype(float)
            medial, ratio, smoothed = runner.run(values, smoothing)
            sums += judge(part, medial)
            ratios.append(ratio)
            decisions.append(smoothed)
        row[smoothing] = {
            "uncovered_percent": round(100 * sums[0] / sums[1], 3),
            "spurious_percent": round(100 * sums[2] / max(sums[3], 1), 3),
            "roughness_percent": [round(ratio, 3) for ratio in ratios if ratio is not None],
            "smoothed": decisions,
        }
    return row


def format_rows(rows):
    lines = ["| part | noise | off: uncovered / spurious, % | auto: uncovered / spurious, % | roughness, % |", "|" + " --- |" * 5]
    for row in rows:
        words = [f"{row[kind]['uncovered_percent']:.2f} / {row[kind]['spurious_percent']:.2f}" for kind in ("off", "auto")]
        ratios = row["auto"]["roughness_percent"]
        lines.append("| " + " | ".join([row["part"], row["noise"], *words, f"{min(ratios):.2f} to {max(ratios):.2f}"]) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--seeds", type=int, default=3, help="default 3")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS), help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "smoothing.json")
    arguments = parser.parse_args()
    document = common.describe_run(arguments.build, seeds=arguments.seeds, rows=[])
    with tempfile.TemporaryDirectory() as name:
        runner = Runner(arguments.build, pathlib.Path(name))
        for title in arguments.parts:
            for noise in NOISES:
                document["rows"].append(measure(runner, title, PARTS[title], noise, arguments.seeds))
                print(format_rows(document["rows"][-1:]).splitlines()[-1], file=sys.stderr)
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(format_rows(document["rows"]))


if __name__ == "__main__":
    main()
