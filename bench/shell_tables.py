#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the results of solve_shells.py as tables (bench/results/shells.json, or another file)."""

import json
import pathlib
import sys

RESULTS = pathlib.Path(__file__).resolve().parent / "results/shells.json"


def print_rows(head, rows):
    print("\n| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |")


def find(rows, name, **wanted):
    """Values of the name in the rows that are wanted; a refused one has none."""
    return [row[name] for row in rows if name in row and all(row[key] == value for key, value in wanted.items())]


def worst(values):
    return f"{max(values, key=abs):+.1f} %" if values else "refused"


def span(values):
    return f"{min(values):+.1f} to {max(values):+.1f} %" if values else "refused"


def print_profiles(rows):
    head = ("", "gray, of the part", "gray, cut to the sheet", "binary, of the part", "binary, cut to the sheet")
    columns = [(values, name) for values in ("gray", "binary") for name in ("error_percent", "error_of_sheet_percent")]
    names = dict.fromkeys(row["profile"] for row in rows)
    found = ((profile, *(worst(find(rows, name, profile=profile, values=values)) for values, name in columns)) for profile in names)
    print_rows(head, found)


def print_plates(rows):
    head = ("thickness", "gray", "binary", "binary, against its layers", "gray, against the part")
    columns = (
        ("gray", "error_of_sheet_percent"),
        ("binary", "error_of_sheet_percent"),
        ("binary", "error_of_voxels_percent"),
        ("gray", "error_percent"),
    )
    sizes = dict.fromkeys(row["thickness"] for row in rows)
    print_rows(head, ((size, *(span(find(rows, name, thickness=size, values=values)) for values, name in columns)) for size in sizes))


def print_joints(rows):
    head = ("", "elements", "scaled Jacobian: least; 99 % have", "aspect ratio: 99 % have at most", "limits that fail", "refused")
    found = []
    for joint in dict.fromkeys(row["joint"] for row in rows):
        of = {name: find(rows, name, joint=joint) for name in rows[0]}
        shapes = f"{min(of['least_jacobian']):.2f}; {min(of['jacobian_of_99']):.2f}"
        failed = sum(map(len, of["failed_limits"]))
        elements = f"{min(of['elements'])} to {max(of['elements'])}"
        found.append((joint, elements, shapes, f"{max(of['aspect_of_99']):.1f}", failed, sum(map(bool, of["refused"]))))
    print_rows(head, found)


def print_parts(rows):
    print_rows(("part", "elements", "refused", "s to mesh", "s to solve"), (
        (row["part"], row["elements"], row["refused"], row["mesh_seconds"], row["solver_seconds"]) for row in rows
    ))  # fmt: skip


TABLES = {"plates": print_plates, "profiles": print_profiles, "joints": print_joints, "parts": print_parts}


def print_tables(results):
    for name, print_them in TABLES.items():
        if results.get(name):
            print_them(results[name])


if __name__ == "__main__":
    print_tables(json.loads(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else RESULTS).read_text("utf-8")))
