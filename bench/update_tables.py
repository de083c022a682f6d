#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the committed results into the tables of the documents, so that each number comes from one file.

A table stands between the comments <!-- table: NAME --> and <!-- end of table -->, a single number between
<!-- number: NAME --> and <!-- end of number -->.

Usage: bench/update_tables.py [--check]
       --check: change nothing; exit status 1, with the names of tables and numbers, when a document differs from the results
"""

import argparse
import json
import pathlib
import re
import statistics
import sys

import print_table

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCUMENTS = ("README.md", *(f"doc/explanation/{name}.md" for name in ("accuracy", "performance", "thickness")))
MARKED = re.compile(r"(<!-- (?:table|number): ([a-z-]+) -->\n?)(.*?)(<!-- end of (?:table|number) -->)", re.DOTALL)

# Of phantoms the tables have this size and larger ones than the other; all sizes are in the file.
SHOWN_SIZE, HIDDEN_SIZE = 256**3, 512**3
PEERS = {
    "floor": "floor",
    "extract_1": "1 thread",
    "extract_2": "2 threads",
    "vector_distance": "vectors alone",
    "signed_maurer": "SignedMaurer",
    "scipy": "scipy edt",
    "edt": "edt",
    "skimage": "skimage",
    "itk-thickness3d": "ITK's thinning",
}
LOCAL_VOLUMES = {
    "gyroid": "gyroid 256 x 256 x 256",
    "solid": "solid with bores 256 x 256 x 256",
    "engine": "engine 256 x 256 x 110",
}

TRANSFORM_VOLUMES = {
    "solids": "solids 512 x 512 x 512",
    "gyroid": "gyroid 256 x 256 x 256",
    "side frame, crop": "middle 256 x 256 x 256 of the side frame",
}
# A call, and what stands beside it.
CALLS = {
    "medialvoxel.extract, automatic, all outputs": "skimage.morphology.skeletonize (curves)",
    "medialvoxel.extract, thickness 3, labels alone": None,
    "medialvoxel.extract, thickness 5, labels alone": None,
    "medialvoxel.mesh": "skimage.measure.marching_cubes (faces)",
    "medialvoxel.distance, inside": "scipy.ndimage.distance_transform_edt with indices",
    "medialvoxel.local_thickness, at most 16": None,
}
VARIANTS = ("cover, other thickness", "side frame, larger thickness", "gyroid, other spacing")
GRAY_WAYS = {
    "labels alone": "labels, `--sub-voxel=off`",
    "on the object": "map on the object",
    "fits": "map by fits",
    "with uncertainty": "map with uncertainty",
    "local thickness": "local thickness",
    "mesh": "mesh `.ply`",
    "surface": "surface",
    "solver mesh": "solver mesh",
}


def shown_volumes(document):
    return [volume for volume in document["volumes"] if volume["voxels"] == SHOWN_SIZE or volume["voxels"] > HIDDEN_SIZE]


def whole_runs(document):
    rows = [
        [
            volume["kind"],
            print_table.size_of(volume),
            f"{volume['object_percent']:.1f} %",
            f"{volume['results']['extract_1']['cpu_seconds']['median']:.2f}",
            f"{volume['results']['extract_1']['ns_per_object_voxel']:.0f}",
            f"{volume['results']['extract_2']['peak_bytes']['max'] / 1e6:.0f}",
        ]
        for volume in shown_volumes(document)
    ]
    return ["part", "voxels", "object", "CPU s, 1 thread", "ns per object voxel", "peak MB, 2 threads"], rows


def peers(document):
    def cell(volume, name):
        return f"{volume['results'][name]['mvoxel_per_cpu_second']:.3g}" if name in volume["results"] else "-"

    rows = [
        [f"{volume['kind']} {print_table.size_of(volume)}", *(cell(volume, name) for name in PEERS)]
        for volume in shown_volumes(document)
    ]
    return ["part", *PEERS.values()], rows


def transform(document):
    def row(name, volume):
        seconds = [volume["results"][program]["filter_cpu_seconds"]["median"] for program in ("vector_distance", "signed_maurer")]
        times = volume["times_as_fast_as_signed_maurer"]["cpu"]
        return [TRANSFORM_VOLUMES[name], *(f"{value:.2f}" for value in seconds), f"{times:.1f}"]

    return ["volume", "vectors", "SignedMaurer", "times as fast"], [row(*item) for item in document["volumes"].items()]


def arrays(document):
    def seconds(call):
        return f"{document['calls'][call + ', threads 1']['cpu_seconds']:.2f}" if call else "-"

    rows = [[call, seconds(call), beside or "-", seconds(beside)] for call, beside in CALLS.items()]
    return ["call", "CPU s", "beside it", "CPU s"], rows


def local_thickness(document):
    def row(name, volume):
        ways = volume["ways"]
        ours = [ways[f"medialvoxel, threads {threads}"] for threads in (1, 2)]
        cells = [LOCAL_VOLUMES[name], f"{volume['largest_diameter']:.1f}", f"{ours[0]['cpu_seconds']:.2f}"]
        cells.append(f"{ours[0]['wall_seconds'] / ours[1]['wall_seconds']:.1f}")
        for peer in ("porespy", "localthickness"):
            mean, largest = (ways[peer][f"{which}_difference"] for which in ("mean", "largest"))
            cells += [f"{ways[peer]['cpu_seconds']:.2f}", f"{mean:+.2f} / {largest:.1f}"]
        return cells

    header = ["volume", "largest diameter", "one thread", "two threads: times as fast", "PoreSpy", "difference", "localthickness",
              "difference"]  # fmt: skip
    return header, [row(name, volume) for name, volume in document["volumes"].items()]


def variants(document):
    rows = [
        [
            title.split(",")[0],
            document["variants"][title]["size"].replace(",", " x "),
            name,
            f"{result['cpu_seconds']['median']:.2f}",
            f"{result['ns_per_candidate_cell']:.0f}",
        ]
        for title in VARIANTS
        for name, result in document["variants"][title]["results"].items()
    ]
    return ["volume", "voxels", "run", "CPU s", "ns per candidate cell"], rows


def options(document):
    rows = [
        [way, f"{result['cpu_seconds']['median']:.2f}", f"{result['peak_bytes']['max'] / 2**20:.0f}"]
        for way, result in document["results"].items()
    ]
    return ["run", "CPU s", "peak MiB"], rows


def topology_cost(document):
    def show(result):
        return [f"{result['cpu_seconds']['median']:.2f}", f"{result['peak_bytes']['max'] / 2**20:.0f}"]

    rows = [
        [name, *show(row["labels"]), *show(row["same topology"]), f"{row['ratio']:.2f}"]
        for name, row in document["volumes"].items()
    ]
    return ["volume", "labels, CPU s", "peak MiB", "with `--same-topology`, CPU s", "peak MiB", "ratio"], rows


def importance(document):
    rows = []
    for name, row in document["volumes"].items():
        cells = {**row["thicknesses"], "automatic": row["automatic"]}
        alike = ", ".join(thickness for thickness, found in cells.items() if found["different_cells"] == 0)
        seconds = (row[way]["cpu_seconds"]["median"] for way in ("labels", "labels and importance"))
        rows.append([name, *(f"{value:.2f}" for value in seconds), f"{row['ratio']:.1f}", alike])
    return ["volume", "labels, CPU s", "with `--importance`, CPU s", "ratio", "thicknesses with the same sheet"], rows


def gray_walls(document):
    cases = document["cases"]

    def show(case, way):
        seconds = {way: statistics.median(values) for way, values in case["cpu_seconds"].items()}
        return f"{seconds[way]:.2f} ({seconds[way] / seconds['labels alone']:.1f})" if way in seconds else ""

    rows = [[title, *(show(case, way) for case in cases)] for way, title in GRAY_WAYS.items()]
    return ["CPU s", *(case["volume"] for case in cases)], [row for row in rows if any(row[1:])]


def wall_profile(document):
    """Before and now, without groups that no run needs."""
    runs = {
        f"{way}, {name.removeprefix('walls of ')}": seconds
        for name, case in document["cases"].items()
        for way, seconds in case["seconds"].items()
    }
    runs = dict(sorted(runs.items(), key=lambda run: run[0].partition(",")[0] != "thickness map"))
    rows = []
    for group in next(iter(runs.values()))["now"]:
        row = [(run["before"][group], run["now"][group]) for run in runs.values()]
        rows.append([group, *(f"{before:.2f}, {now:.2f}" if max(before, now) >= 0.005 else "" for before, now in row)])
    return ["CPU s, before and now", *runs], rows


def threads(document):
    volumes = document["volumes"]
    tasks = next(iter(volumes.values()))
    return ["task", *volumes], [[task, *(f"{runs[task]['16']['speed_up']:.1f}" for runs in volumes.values())] for task in tasks]


def ratio(case, way, other):
    values = [case["results"][name]["cpu_seconds"]["median"] for name in (way, other)]
    return values[0] / values[1]


def automatic(document):
    rows = []
    for name, case in document["cases"].items():
        results = case["results"]
        peaks = ", ".join(f"{results[way]['peak_bytes']['median'] / 2**20:.0f}" for way in ("fixed", "automatic"))
        rows.append([
            name,
            *(f"{results[way]['cpu_seconds']['median']:.2f}" for way in ("fixed", "automatic")),
            f"{ratio(case, 'automatic', 'fixed'):.1f}",
            f"{ratio(case, 'with a mesh', 'automatic'):.1f}",
            f"{ratio(case, 'with report, page and picture', 'automatic'):.2f}",
            peaks,
        ])  # fmt: skip
    header = ["volume", "fixed", "automatic", "ratio", "with a mesh: times automatic", "with report, page and picture", "peak"]
    return header, rows


# The file of results, and what makes the header and the rows of a table of it.
TABLES = {
    "whole-runs": ("peers.json", whole_runs),
    "peers": ("peers.json", peers),
    "variants": ("peers.json", variants),
    "transform": ("transform.json", transform),
    "arrays": ("arrays.json", arrays),
    "local-thickness": ("local-thickness.json", local_thickness),
    "options": ("options.json", options),
    "importance": ("importance.json", importance),
    "topology-cost": ("topology-cost.json", topology_cost),
    "threads": ("tiles.json", threads),
    "automatic": ("automatic.json", automatic),
    "gray-walls": ("gray-walls.json", gray_walls),
    "wall-profile": ("wall-profile.json", wall_profile),
}


def seconds_of_cover(way):
    def make(document):
        seconds = document["cases"]["cover"]["results"][way]["wall_seconds"]["median"]
        return f"{seconds:.2g}"

    return make


def times_the_floor(document):
    return f"{document['wall_ratio_to_floor']['extract_2_threads']:.1f}"


# The same for single numbers.
NUMBERS = {
    "cover-to-floor": ("cover-tau3.json", times_the_floor),
    "side-frame-to-floor": ("side-frame-tau3.json", times_the_floor),
    "solids-to-floor": ("solids-tau3.json", times_the_floor),
    "cover-automatic": ("automatic.json", seconds_of_cover("automatic")),
    "cover-fixed": ("automatic.json", seconds_of_cover("fixed")),
}


def make_text(name):
    """The table or the number of this name."""
    results, make = (TABLES | NUMBERS)[name]
    made = make(json.loads((ROOT / "bench" / "results" / results).read_text(encoding="utf-8")))
    return print_table.table(*made) if name in TABLES else made


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    outdated, found = [], set()

    def replace(match):
        begin, name, old, end = match.groups()
        new = make_text(name)
        found.add(name)
        if new != old:
            outdated.append(name)
        return begin + new + end

    for document in map(ROOT.joinpath, DOCUMENTS):
        text = document.read_text(encoding="utf-8")
        updated = MARKED.sub(replace, text)
        if updated != text and not arguments.check:
            document.write_text(updated, encoding="utf-8")
    missing = sorted((set(TABLES) | set(NUMBERS)) - found)
    if missing:
        sys.exit(f"update_tables: no document has: {', '.join(missing)}")
    if arguments.check and outdated:
        sys.exit(f"update_tables: differ from bench/results: {', '.join(outdated)}; run bench/update_tables.py")


if __name__ == "__main__":
    main()
