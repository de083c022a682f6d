# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program on gray volumes and compares its thickness with that of the part. Lengths are voxels."""

import json
import subprocess

import numpy as np
import run_benchmarks as common
from compare_sheets import read_voxels
from scipy import ndimage
from virtual_scan import BACKGROUND, CONTRAST, THRESHOLD

# A medial cell belongs to a wall up to this distance from its middle.
FAR = 1.5
# Rays through one wall at most.
RAYS = 300
# Exit status where an uncertainty cannot be stated.
REFUSED = 3
# What is added up over cells and rays of one wall in one volume.
FIELDS = (
    *("cells", "error", "square", "rims", "far", "inside", "intervals", "width"),
    *("rays", "covered", "edges", "edge_error", "edge_square"),
)


class Program:
    """The program with what it does by default for gray values, and the uncertainty if it knows that."""

    def __init__(self, build, scratch):
        self.path, self.scratch = common.find_program(build, "medialvoxel"), scratch
        helps = (subprocess.run([self.path, "extract", word], capture_output=True, text=True).stdout for word in ("--help-all", "--help"))
        self.options = next(filter(None, helps))  # programs of earlier commits have only the second

    def knows(self, option):
        return option in self.options

    def describe(self, commit=None):
        commit = commit or common.describe_revision()["commit"]
        version = subprocess.run([self.path, "--version"], capture_output=True, text=True, check=True).stdout.strip()
        return {"version": version, "commit": commit[:10], "uncertainty": self.knows("--uncertainty-map"), "levels": self.knows("--materials")}

    def run(self, values, levels=None, options=(), threshold=THRESHOLD, measure=None):
        """Centers of the medial cells (x, y, z), their thickness (negative at rims), and the half widths or None.

        measure: the option of another measure than the default, which has no half widths
        """
        names = {name: self.scratch / f"{name}.mha" for name in ("labels", "thickness", "uncertainty")}
        source, size = self.scratch / "in.raw", values.shape[::-1]
        values.tofile(source)
        command = [self.path, "extract", source, names["labels"], "--raw-size", ",".join(map(str, size)), "--raw-type", "uint16"]
        command += ["--lower", threshold, "--thickness-map", names["thickness"], "--threads", 1]
        # Programs before the uncertainty measured gray values on request only.
        if measure or not self.knows("--uncertainty-map"):
            names.pop("uncertainty")
            command.append(measure or "--sub-voxel")
        else:
            command += ["--uncertainty-map", names["uncertainty"]]
        command += ["--materials", ",".join(map(str, levels))] if levels else []
        subprocess.run([str(word) for word in [*command, *options, "--quiet", "--overwrite"]], check=True)
        index = np.argwhere(read_voxels(names["labels"], np.uint8, size) >= 2)
        maps = [read_voxels(names[name], np.float32, size) for name in ("thickness", "uncertainty") if name in names]
        maps = [found[tuple(index.T)].astype(float) for found in maps]
        # The center of a cell is half a voxel behind that of its voxel.
        return index[:, ::-1] + 0.5, maps[0], maps[1] if len(maps) > 1 else None

    def report(self, values, **options):
        """The report of a run."""
        path = self.scratch / "report.json"
        self.run(values, options=("--report", path), **options)
        return json.loads(path.read_text(encoding="utf-8"))


def run_unless_refused(program, values, **options):
    """What the program finds, or None where it cannot state the uncertainty; such a volume does not count."""
    try:
        return program.run(values, **options)
    except subprocess.CalledProcessError as error:
        if error.returncode != REFUSED:
            raise
        return None


def make_rays(part):
    """Points of the middle of each wall and their normals; evenly left out where there are many."""
    result = []
    for wall in part.walls:
        points, normals = wall.sample(part.size)
        every = max(1, len(points) // RAYS)
        result.append((points[::every], normals[::every]))
    return result


def count_covered(rays, reach, medial):
    """Rays with a medial cell up to `reach` from the middle."""
    points, normals = rays
    covered = np.zeros(len(points), bool)
    for step in np.arange(-reach, reach + 0.01, 0.2):
        x, y, z = np.rint(points + step * normals - 0.5).astype(int).T
        covered |= medial[z, y, x]
    return int(covered.sum())


def measure_edges(rays, thickness, values):
    """Where single lines along the true normal cross half the contrast: the thickness of those that do on both sides."""
    points, normals = rays
    steps = np.arange(0, thickness / 2 + 4, 0.1)
    center = ndimage.map_coordinates(values, points[:, ::-1].T, order=1)
    points, normals = points[center > 0.5], normals[center > 0.5]
    total = np.zeros(len(points))
    for side in (-1, 1):
        places = points[:, None, :] + side * steps[:, None] * normals[:, None, :]
        profile = ndimage.map_coordinates(values, places[..., ::-1].reshape(-1, 3).T, order=1).reshape(len(points), len(steps))
        below = profile < 0.5
        first = below.argmax(axis=1)
        row = np.arange(len(points))
        before, after = profile[row, np.maximum(first - 1, 0)], profile[row, first]
        crossing = steps[first] - 0.1 * (0.5 - after) / np.where(before > after, before - after, 1)
        total += np.where(below.any(axis=1), crossing, np.nan)
    return total[np.isfinite(total)]


def judge(part, rays, values, found):
    """One row of FIELDS per wall; values: background 0 and material 1."""
    points, thickness, widths = found
    medial = np.zeros(part.size[::-1], bool)
    medial[tuple((points - 0.5).astype(int)[:, ::-1].T)] = True
    rows = []
    for wall, lines in zip(part.walls, rays):
        offset = np.abs(wall.offset(points))
        here = (offset < wall.thickness / 2 + 0.5) | (offset < FAR)
        here &= wall.is_clear(points, part.size)
        is_far = here & (offset > FAR)
        is_measured = here & ~is_far & (thickness > 0)
        error = thickness[is_measured] - wall.thickness
        width = np.full(len(error), np.nan) if widths is None else widths[is_measured]
        has_interval = width > 0
        edges = measure_edges(lines, wall.thickness, values) - wall.thickness
        row = [len(error), error.sum(), (error**2).sum(), (here & (thickness < 0)).sum(), is_far.sum()]
        row += [(np.abs(error) <= width)[has_interval].sum(), has_interval.sum(), width[has_interval].sum()]
        row += [len(lines[0]), count_covered(lines, wall.reach, medial), len(edges), edges.sum(), (edges**2).sum()]
        rows.append(row)
    return np.array(rows, float)


def to_unit(values):
    """Gray values with background 0 and material 1."""
    return (values.astype(np.float32) - BACKGROUND) / CONTRAST


def summarize(rows, tilts):
    """Figures of one wall; rows: FIELDS of its repetitions, tilts: the tilt of each."""
    total = dict(zip(FIELDS, np.sum(rows, axis=0)))
    column = {name: np.array(rows)[:, k] for k, name in enumerate(FIELDS)}
    used = column["cells"] >= 5
    means = column["error"][used] / column["cells"][used]
    groups = [means[np.array(tilts)[used] == tilt] for tilt in dict.fromkeys(tilts)]
    freedom = sum(len(group) - 1 for group in groups if len(group))
    squares = sum(((group - group.mean()) ** 2).sum() for group in groups if len(group))

    def ratio(name, count, factor=1.0, digits=3):
        return round(factor * float(total[name] / total[count]), digits) if total[count] else None

    return {
        "volumes": len(rows),
        "cells": int(total["cells"]),
        "covered_percent": ratio("covered", "rays", 100, 1),
        "bias": ratio("error", "cells"),
        "tilt_bias": [round(float(group.mean()), 3) if len(group) else None for group in groups],
        "repeatability": round(float(np.sqrt(squares / freedom)), 3) if freedom else None,
        "rms": round(float(np.sqrt(total["square"] / total["cells"])), 3) if total["cells"] else None,
        "spurious_percent": round(100 * float(total["far"] / max(total["cells"] + total["rims"] + total["far"], 1)), 2),
        "rim_percent": round(100 * float(total["rims"] / max(total["cells"] + total["rims"], 1)), 2),
        "in_interval_percent": ratio("inside", "intervals", 100, 1),
        "half_width": ratio("width", "intervals"),
        "with_interval_percent": ratio("intervals", "cells", 100, 1),
        "edge_found_percent": ratio("edges", "rays", 100, 1),
        "edge_bias": ratio("edge_error", "edges"),
        "edge_rms": round(float(np.sqrt(total["edge_square"] / total["edges"])), 3) if total["edges"] else None,
    }
