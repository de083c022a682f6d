#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Prints the committed results as Markdown tables: bench/print_table.py [FILE.json...]     default: bench/results/*.json

Whole runs (run_benchmarks.py), peers (compare_peers.py), options (measure_options.py) and bounds for threads (measure_tiles.py).
"""

import json
import pathlib
import sys

WHOLE_RUNS = ["part", "object", "tau", "threads", "wall s", "CPU s", "floor, wall s", "ratio", "peak MB",
              "SignedMaurer, wall s", "CPU s", "load"]  # fmt: skip


def spread(values):
    return f"{values['median']:.2f} ({values['min']:.2f}-{values['max']:.2f})"


def size_of(volume):
    return " x ".join(str(n) for n in volume["size"])


def volumes_by_name(document):
    """Those of a file that names them; others have a list, or none."""
    volumes = document.get("volumes")
    return volumes if isinstance(volumes, dict) else {}


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def whole_runs(path, document):
    phantom, results = document["phantom"], document["results"]
    maurer = results.get("signed_maurer")
    for name, ratio in document["wall_ratio_to_floor"].items():
        load = results[name]["load_before"]
        yield [
            f"[{phantom['kind']}](bench/results/{path.name}) {size_of(phantom)}",
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


def peer_speeds(document):
    names = [name for name in document["titles"] if name not in document["missing"]]

    def cell(volume, name):
        return f"{volume['results'][name]['mvoxel_per_cpu_second']:.3g}" if name in volume["results"] else "-"

    rows = [[volume["kind"], size_of(volume), *(cell(volume, name) for name in names)] for volume in document["volumes"]]
    yield "Mvoxel per CPU-second (-: skipped, the file says why)\n"
    yield table(["part", "voxels", *(document["titles"][name] for name in names)], rows)
    yield from (f"not installed: {document['titles'][name]}: {reason}\n" for name, reason in document["missing"].items())


def costs(document):
    rows = []
    for volume in document["volumes"]:
        runs = [volume["results"].get(name) for name in ("floor", "extract_1", "extract_2")]
        if None in runs:
            continue
        floor, one, two = runs
        rows.append([
            volume["kind"], size_of(volume), f"{volume['object_percent']:.1f} %",
            f"{one['cpu_seconds']['median']:.2f}", f"{one['wall_seconds']['median']:.2f}",
            f"{two['wall_seconds']['median']:.2f}",
            f"{one['wall_seconds']['median'] / two['wall_seconds']['median']:.2f}",
            f"{two['wall_seconds']['median'] / floor['wall_seconds']['median']:.1f}",
            f"{one['cpu_seconds']['median'] * 1e9 / volume['voxels']:.1f}", f"{one['ns_per_object_voxel']:.0f}",
            f"{two['peak_bytes']['max'] / 1e6:.0f}", f"{two['load_before']['min']:.1f}-{two['load_before']['max']:.1f}",
        ])  # fmt: skip
    yield "Whole runs of medialvoxel extract, tau 3\n"
    yield table(["part", "voxels", "object", "CPU s, 1 thread", "wall s, 1 thread", "wall s, 2 threads", "1 to 2 threads",
                 "2 threads to floor", "ns per voxel", "ns per object voxel", "peak MB", "load"], rows)  # fmt: skip


def variants(document):
    rows = [
        [title, variant["size"].replace(",", " x "), name, f"{result['wall_seconds']['median']:.2f}",
         f"{result['cpu_seconds']['median']:.2f}", f"{result['ns_per_candidate_cell']:.0f}"]
        for title, variant in document.get("variants", {}).items()
        for name, result in variant["results"].items()
    ]  # fmt: skip
    if rows:
        yield "Other thicknesses and spacings, two threads\n"
        yield table(["volume", "voxels", "run", "wall s", "CPU s", "ns per candidate cell"], rows)


def options(document):
    rows = [
        [way, f"{result['cpu_seconds']['median']:.2f}", f"{result['wall_seconds']['median']:.2f}",
         f"{result['peak_bytes']['max'] / 2**20:.0f}"]
        for way, result in document["results"].items()
    ]  # fmt: skip
    yield f"Options, side frame {size_of(document)}, one thread\n"
    yield table(["run", "CPU s", "wall s", "peak MiB"], rows)


def thread_bounds(document):
    yield "Times as fast on paper, from the file to the file\n"
    for volume, tasks in document["volumes"].items():
        numbers = next(iter(tasks.values()))
        rows = [[task, *(f"{result['speed_up']:.1f}" for result in results.values())] for task, results in tasks.items()]
        yield table([volume, *(f"{number} threads" for number in numbers)], rows)


def main():
    folder = pathlib.Path(__file__).resolve().parent / "results"
    files = [pathlib.Path(name) for name in sys.argv[1:]] or sorted(folder.glob("*.json"))
    documents = {path: json.loads(path.read_text(encoding="utf-8")) for path in files}
    rows = [row for path, document in documents.items() if "phantom" in document for row in whole_runs(path, document)]
    if rows:
        print(table(WHOLE_RUNS, rows))
    for document in documents.values():
        if "titles" in document:
            print("\n".join([*costs(document), *peer_speeds(document), *variants(document)]))
        elif "with `--report`" in document.get("results", {}):
            print("\n".join(options(document)))
        elif any("speed_up" in runs.get("1", {}) for runs in next(iter(volumes_by_name(document).values()), {}).values() if isinstance(runs, dict)):
            print("\n".join(thread_bounds(document)))


if __name__ == "__main__":
    main()
