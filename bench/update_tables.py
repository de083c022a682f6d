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
import sys

import print_table

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCUMENTS = ("README.md", "doc/explanation/performance.md", "doc/explanation/thickness.md")
MARKED = re.compile(r"(<!-- (?:table|number): ([a-z-]+) -->\n?)(.*?)(<!-- end of (?:table|number) -->)", re.DOTALL)

# Smaller volumes than this are left to the file.
SMALLEST_PEER = 256**3
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
LONG_RUNS = {
    "side frame, thickness 8 / thickness 3": ("side-frame", "thickness 8", "fixed"),
    "side frame, thickness 12 / thickness 3": ("side-frame", "thickness 12", "fixed"),
    "cranium, automatic, spacing in mm / in voxels": ("cranium", "automatic", "automatic in voxels"),
}


def large_volumes(document):
    return [volume for volume in document["volumes"] if volume["voxels"] >= SMALLEST_PEER]


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
        for volume in large_volumes(document)
    ]
    return ["part", "voxels", "object", "CPU s, 1 thread", "ns per object voxel", "peak MB, 2 threads"], rows


def peers(document):
    def cell(volume, name):
        return f"{volume['results'][name]['mvoxel_per_cpu_second']:.3g}" if name in volume["results"] else "-"

    rows = [
        [f"{volume['kind']} {print_table.size_of(volume)}", *(cell(volume, name) for name in PEERS)]
        for volume in large_volumes(document)
    ]
    return ["part", *PEERS.values()], rows


def transform(document):
    def row(name, volume):
        digits = 2 if volume["results"]["signed_maurer"]["filter_cpu_seconds"]["median"] > 5 else 3

        def seconds(program, measure):
            return f"{volume['results'][program][measure]['median']:.{digits}f}"

        times = volume["times_as_fast_as_signed_maurer"]
        cells = [TRANSFORM_VOLUMES[name]]
        for measure, key in (("filter_cpu_seconds", "cpu"), ("filter_user_seconds", "user")):
            cells += [seconds("vector_distance", measure), seconds("signed_maurer", measure), f"{times[key]:.1f}"]
        return [*cells, f"{volume['voxels_per_cpu_second'] / 1e6:.0f}"]

    header = ["volume", "seconds, all", "SignedMaurer", "times as fast", "seconds in its own code", "SignedMaurer",
              "times as fast", "Mvoxel per CPU second"]  # fmt: skip
    return header, [row(name, volume) for name, volume in document["volumes"].items()]


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
            title,
            variant["size"].replace(",", " x "),
            name,
            f"{result['wall_seconds']['median']:.2f}",
            f"{result['cpu_seconds']['median']:.2f}",
            f"{result['ns_per_candidate_cell']:.0f}",
        ]
        for title, variant in document["variants"].items()
        for name, result in variant["results"].items()
    ]
    return ["volume", "voxels", "run", "wall s", "CPU s", "ns per candidate cell"], rows


def options(document):
    rows = [
        [
            way,
            f"{result['cpu_seconds']['median']:.2f}",
            f"{result['wall_seconds']['median']:.2f}",
            f"{result['peak_bytes']['max'] / 2**20:.0f}",
        ]
        for way, result in document["results"].items()
    ]
    return ["run", "CPU s", "wall s", "peak MiB"], rows


def threads(document):
    def largest(result, key):
        name, seconds = next(iter(result[key].items()))
        return f"{name} {seconds:.2f}"

    rows = [
        [
            f"{volume}: {task}",
            f"{results['1']['seconds']:.2f}",
            f"{results['16']['seconds']:.2f}",
            f"{results['16']['speed_up']:.1f}",
            f"{sum(results['16']['serial_seconds'].values()):.2f}",
            largest(results["16"], "serial_seconds"),
            largest(results["16"], "idle_seconds"),
        ]
        for volume, tasks in document["volumes"].items()
        for task, results in tasks.items()
    ]
    header = ["task", "seconds with 1 thread", "with 16", "times as fast", "seconds with one at work",
              "most of them", "what cores wait for most"]  # fmt: skip
    return header, rows


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


def long_runs(document):
    rows = [[title, f"{ratio(document['cases'][name], way, other):.1f}"] for title, (name, way, other) in LONG_RUNS.items()]
    return ["run", "times the CPU"], rows


def profile(columns):
    """Makes the table of CPU seconds by work, before and now, with a column for each title and its case and way."""

    def make(document):
        runs = {title: document["cases"][name]["seconds"][way] for title, (name, way) in columns.items()}

        def cell(run, group):
            return " / ".join(f"{run[when][group]:.2f}" for when in ("before", "now"))

        groups = next(iter(runs.values()))["now"]
        rows = [[group, *(cell(run, group) for run in runs.values())] for group in groups]
        rows = [row for row in rows if any(value != "0.00 / 0.00" for value in row[1:])]
        sums = {name: {when: {"all": sum(seconds.values())} for when, seconds in run.items()} for name, run in runs.items()}
        return ["work", *runs], [*rows, ["all", *(cell(run, "all") for run in sums.values())]]

    return make


PROFILED = ("side-frame", "gyroid", "engine")
SIDE_FRAME = {
    "side-frame, thickness 8": ("side-frame", "thickness 8"),
    "side-frame, thickness 3 and `--distance`": ("side-frame", "with distances"),
}

# The file of results, and what makes the header and the rows of a table of it.
TABLES = {
    "whole-runs": ("peers.json", whole_runs),
    "peers": ("peers.json", peers),
    "variants": ("peers.json", variants),
    "transform": ("transform.json", transform),
    "arrays": ("arrays.json", arrays),
    "local-thickness": ("local-thickness.json", local_thickness),
    "options": ("options.json", options),
    "threads": ("tiles.json", threads),
    "automatic": ("automatic.json", automatic),
    "long-runs": ("automatic.json", long_runs),
    "profile-fixed": ("profile.json", profile({name: (name, "thickness 3") for name in PROFILED})),
    "profile-automatic": ("profile.json", profile({name: (name, "automatic") for name in (*PROFILED, "blobs")})),
    "profile-mesh": ("profile.json", profile({name: (name, "with a mesh") for name in PROFILED})),
    "profile-further": ("profile.json", profile(SIDE_FRAME)),
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
