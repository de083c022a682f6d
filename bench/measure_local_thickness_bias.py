#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""How far the local thickness of plates, tubes, rods and wedges is off, by spheres, walls, and walls on gray values.

A voxel of the mask is object when its center is in the part. The scan is the part blurred by a Gaussian of 0.8 voxels,
without noise, and a plate of 8 voxels beside it, from which the program learns values and blur. Lengths are in units of
the largest spacing, also where a voxel is 0.7 x 0.7 x 1.2. The bias is the mean difference from the true thickness over
the object voxels in the middle of the volume; all positions count the same, and then all directions.

Prints a Markdown table and writes one JSON file.
Usage: bench/measure_local_thickness_bias.py BUILD [--shapes LIST] [--output FILE]      needs numpy and scipy
"""

import argparse
import json
import math
import pathlib
import subprocess
import tempfile

import numpy as np
import run_benchmarks as common
from compare_sheets import read_voxels
from scipy import ndimage, special

SPACINGS = {"1 x 1 x 1": (1.0, 1.0, 1.0), "0.7 x 0.7 x 1.2": (0.7, 0.7, 1.2)}
DIRECTIONS = ((0, 0, 1), (1, 0, 0), (0, 1, 1), (1, 1, 1), (1, 2, 5), (0, 0.26, 0.97), (0.31, 0.57, 0.76))
POSITIONS = 4  # of the part, evenly over the way after which voxels repeat along its normal
THICKNESSES = {"plates": (1, 2, 3, 4, 5, 6, 8, 12, 16), "tubes": (1.5, 2, 3, 4, 6), "rods": (3, 5, 8, 12), "wedges": (10, 20, 30)}
DIRECTIONS_OF = {"plates": DIRECTIONS, "tubes": DIRECTIONS[:5], "rods": DIRECTIONS[:5], "wedges": DIRECTIONS[:1]}
RADIUS_OF_TUBE = 10.0  # of its middle
TIP = -20.0  # of a wedge along x; it opens towards the end of the part
BLUR = 0.8
FINE = 3  # samples of a voxel along each axis where the blur has no formula
# The values of the scan and where the plate that it learns from lies along x, in voxels of the largest spacing.
AIR, METAL = 1000, 9000
PART, REFERENCE = 44, (50, 58)
WAYS = {
    "sphere": ("--local-thickness-method", "sphere"),
    "wall": (),
    "wall on gray values": (),
}


class Grid:
    """Places of the voxels, in units of the largest spacing, from the middle of the part."""

    def __init__(self, spacing, fine=1):
        self.fine = fine
        self.steps = [s / max(spacing) for s in spacing]
        lengths = (REFERENCE[1] + 6, PART, PART)
        self.size = [math.ceil(n / s) for n, s in zip(lengths, self.steps)]
        axes = [((np.arange(n * fine) + 0.5) / fine - 0.5) * s - PART / 2 for n, s in zip(self.size, self.steps)]
        self.z, self.y, self.x = np.meshgrid(*axes[::-1], indexing="ij", sparse=True)

    def along(self, normal, shift):
        return normal[0] * self.x + normal[1] * self.y + normal[2] * self.z - shift


def unit(vector):
    vector = np.array(vector, float)
    return vector / np.linalg.norm(vector)


def step(distance, sigma):
    return special.ndtr(distance / sigma)


def slab(distance, half, sigma):
    return step(distance + half, sigma) - step(distance - half, sigma)


def is_inside(shape, size, grid, direction, shift):
    """Whether places are in the part, which goes through all of the volume."""
    axis = unit(direction)
    if shape == "plates":
        return abs(grid.along(axis, shift)) < size / 2
    if shape == "wedges":
        half = math.radians(size / 2)
        return abs(grid.z - shift) * math.cos(half) < (grid.x - TIP) * math.sin(half)
    side = unit(np.cross(axis, (0.3, 0.5, 0.81)))
    other = np.cross(axis, side)
    radius = np.hypot(grid.along(side, shift), grid.along(other, 0.6 * shift))
    return abs(radius - RADIUS_OF_TUBE) < size / 2 if shape == "tubes" else radius < size / 2


def make_mask(shape, size, grid, direction, shift):
    reference = (grid.x + PART / 2 > REFERENCE[0]) & (grid.x + PART / 2 < REFERENCE[1])
    mask = (is_inside(shape, size, grid, direction, shift) & (grid.x < PART / 2)) | reference
    return np.broadcast_to(mask, grid.size[::-1]).astype(np.uint8)


def make_scan(shape, size, spacing, direction, shift):
    """Of plates by a formula, of others from finer voxels."""
    grid = Grid(spacing)
    along_x = BLUR * grid.steps[0]
    middle, half = sum(REFERENCE) / 2 - PART / 2, (REFERENCE[1] - REFERENCE[0]) / 2
    if shape == "plates":
        normal = unit(direction)
        sigma = BLUR * np.linalg.norm(normal * grid.steps)
        share = slab(grid.along(normal, shift), size / 2, sigma) * step(PART / 2 - grid.x, along_x)
    else:
        fine = Grid(spacing, FINE)
        inside = is_inside(shape, size, fine, direction, shift) & (fine.x < PART / 2)
        inside = np.broadcast_to(inside, [FINE * n for n in grid.size[::-1]]).astype(np.float32)
        # The mean over a voxel is a part of the blur.
        blurred = ndimage.gaussian_filter(inside, FINE * math.sqrt(BLUR**2 - (1 - 1 / FINE**2) / 12), truncate=4)
        share = blurred.reshape([part for n in grid.size[::-1] for part in (n, FINE)]).mean(axis=(1, 3, 5))
    return np.rint(AIR + (METAL - AIR) * (share + slab(grid.x - middle, half, along_x))).astype(np.uint16)


def run(program, values, lower, spacing, options, scratch):
    source, labels, thickness = (scratch / name for name in ("in.raw", "labels.mha", "thickness.mha"))
    values.tofile(source)
    size, kind = values.shape[::-1], values.dtype.name
    command = [program, "extract", source, labels, "--raw-size", ",".join(map(str, size)), "--raw-type", kind, "--lower", lower]
    command += ["--spacing", ",".join(map(repr, spacing)), "--local-thickness", thickness, "--smooth", "off", "--max-pore-size", 0]
    command += [*options, "--threads", 1, "--quiet", "--overwrite"]
    subprocess.run([str(word) for word in command], check=True)
    return read_voxels(thickness, np.float32, size) / max(spacing)


def list_shifts(direction, grid):
    steps = [abs(part * step) for part, step in zip(unit(direction), grid.steps) if part != 0]
    return [(k + 0.5) / POSITIONS * min(steps) for k in range(POSITIONS)]


def measure_ways(program, shape, size, spacing, direction, shift, scratch):
    """The maps by each way."""
    mask = make_mask(shape, size, Grid(spacing), direction, shift)
    maps = {way: run(program, mask, 1, spacing, (*options, "--sub-voxel=off"), scratch) for way, options in list(WAYS.items())[:2]}
    scan = make_scan(shape, size, spacing, direction, shift)
    maps["wall on gray values"] = run(program, scan, (AIR + METAL) // 2, spacing, (), scratch)
    return maps


def truth_of(shape, size, grid, shift):
    """Of wedges: twice the radius of the largest ball that covers a place. Balls lie in the middle plane."""
    if shape != "wedges":
        return np.full(grid.size[::-1], float(size))
    half = math.radians(size / 2)
    along = grid.x - TIP
    distance = np.hypot(along, grid.z - shift)
    # The farther of the two places in the middle plane whose ball has the voxel on its surface.
    root = np.sqrt(np.maximum(along**2 - (distance * math.cos(half)) ** 2, 0))
    return np.broadcast_to(2 * math.sin(half) * (along + root) / math.cos(half) ** 2, grid.size[::-1])


def find_inner(shape, grid):
    """The voxels that count: no end of the part is near."""
    reach = PART / 3 if shape == "tubes" else PART / 6
    is_inner = (abs(grid.x) < reach) & (abs(grid.y) < reach) & (abs(grid.z) < reach)
    return is_inner & (grid.x < 0) if shape == "wedges" else is_inner


def measure_case(program, shape, size, spacing, scratch):
    """Bias, spread and share of voxels without a wall of each way, over all directions and positions."""
    grid = Grid(spacing)
    is_inner = find_inner(shape, grid)
    found = {way: {"errors": [], "means": [], "without": 0, "voxels": 0} for way in WAYS}
    for direction in DIRECTIONS_OF[shape]:
        of_direction = {way: [] for way in WAYS}
        for shift in list_shifts(direction, grid):
            wanted = truth_of(shape, size, grid, shift)[is_inner]
            for way, thickness in measure_ways(program, shape, size, spacing, direction, shift, scratch).items():
                values = thickness[is_inner]
                part = values != 0
                known = part & ~np.isnan(values)
                of_direction[way].append(values[known] - wanted[known])
                found[way]["without"] += int((part & ~known).sum())
                found[way]["voxels"] += int(part.sum())
        for way, errors in of_direction.items():
            found[way]["errors"] += errors
            found[way]["means"].append(mean_of([float(part.mean()) if part.size else math.nan for part in errors]))
    return {way: summarize(numbers) for way, numbers in found.items()}


def mean_of(numbers):
    """Of those that are known."""
    known = [number for number in numbers if not math.isnan(number)]
    return sum(known) / len(known) if known else math.nan


def summarize(numbers):
    errors, means = np.concatenate(numbers["errors"]), [mean for mean in numbers["means"] if not math.isnan(mean)]
    result = {"without_percent": round(100 * numbers["without"] / max(1, numbers["voxels"]), 2)}
    if errors.size:
        result |= {
            "bias": round(mean_of(means), 4),
            "worst_direction": round(max(means, key=abs), 4),
            "rms": round(float(np.sqrt((errors**2).mean())), 4),
        }
    return result


def print_table(cases):
    print("| shape | spacing | size | " + " | ".join(f"{way}: bias, worst direction, rms, NaN %" for way in WAYS) + " |")
    print("| --- " * (3 + len(WAYS)) + "|")
    for case in cases:
        cells = []
        for way in WAYS:
            numbers = case[way]
            known = [f"{numbers[name]:+.2f}" for name in ("bias", "worst_direction")] + [f"{numbers['rms']:.2f}"] if "bias" in numbers else ["-"]
            cells.append(", ".join([*known, f"{numbers['without_percent']:.0f}"]))
        print(f"| {case['shape']} | {case['spacing']} | {case['size']} | " + " | ".join(cells) + " |", flush=True)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="folder with the program")
    parser.add_argument("--shapes", default=",".join(THICKNESSES), help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path(__file__).parent / "results/local-thickness-bias.json")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    program = common.find_program(arguments.build, "medialvoxel")
    cases = []
    with tempfile.TemporaryDirectory() as scratch:
        for shape in arguments.shapes.split(","):
            for name, spacing in SPACINGS.items():
                for size in THICKNESSES[shape]:
                    case = {"shape": shape, "spacing": name, "size": size}
                    cases.append(case | measure_case(program, shape, size, spacing, pathlib.Path(scratch)))
                    print_table(cases[-1:])
    print_table(cases)
    result = {"revision": common.describe_revision(), "blur_voxels": BLUR, "positions": POSITIONS, "cases": cases}
    arguments.output.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
