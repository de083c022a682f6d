#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the committed results of run_benchmarks.py as a Markdown table: bench/print_table.py [FILE.json...]"""

import json
import pathlib
import sys

HEADER = ["part", "object", "tau", "threads", "wall s", "CPU s", "floor, wall s", "ratio", "peak MB", "SignedMaurer, wall s",
          "CPU s", "load"]  # fmt: skip


def spread(values):
    return f"{values['median']:.2f} ({values['min']:.2f}-{values['max']:.2f})"


def rows_of(path):
    document = json.loads(path.read_text(encoding="utf-8"))
    if "phantom" not in document:
        return
    phantom, results = document["phantom"], document["results"]
    size = " x ".join(str(n) for n in phantom["size"])
    maurer = results.get("signed_maurer")
    for name, ratio in document["wall_ratio_to_floor"].items():
        load = results[name]["load_before"]
        yield [
            f"[{phantom['kind']}](bench/results/{path.name}) {size}",
            f"{phantom['object_percent']:.1f} %",
            f"{document['thickness']:g}",
            name.split("_")[1],
            spread(results[name]["wall_seconds"]),
            f"{results[name]['cpu_seconds']['median']:.2f}",
            spread(results["floor"]["wall_seconds"]),
            f"{ratio:.1f}",
            f"{results[name]['peak_memory_bytes']['median'] / 1e6:.0f}",
            spread(maurer["filter_seconds"]) if maurer else "not run",
            f"{maurer['cpu_seconds']['median']:.2f}" if maurer else "",
            f"{load['min']:.1f}-{load['max']:.1f}",
        ]


def main():
    folder = pathlib.Path(__file__).resolve().parent / "results"
    files = [pathlib.Path(name) for name in sys.argv[1:]] or sorted(folder.glob("*.json"))
    rows = [HEADER, ["---"] * len(HEADER)] + [row for path in files for row in rows_of(path)]
    print("\n".join("| " + " | ".join(row) + " |" for row in rows))


if __name__ == "__main__":
    main()
