#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the automatic thickness costs beside a fixed one of 3 voxels, and a mesh and a report beside it; writes one JSON
file and prints a table.

All ways run in turn, round after round: on phantoms of full size, on two random volumes, and on the real volumes of a
folder that holds engine.mha, shell.nrrd and cranium.mha. Labels of all runs of a way must be the same bytes.

Usage: bench/measure_automatic.py BUILD [--data FOLDER] [--rounds 5] [--output results/automatic.json]
"""

import argparse
import collections
import json
import pathlib
import statistics
import tempfile

import compare_peers
import run_benchmarks as common

# The thickness and further options; FILE is a new file in the scratch folder.
FIXED = {"fixed": ("3vx",)}
USUAL = FIXED | {
    "automatic": ("auto",),
    "with a mesh": ("auto", "--mesh", "FILE.vtp"),
    "with report, page and picture": ("auto", "--report", "FILE.json", "--html", "FILE.html", "--preview", "FILE.png"),
}
LONG = {"thickness 8": ("8vx",), "thickness 12": ("12vx",)}
VOXELS = {"automatic in voxels": ("auto", "--spacing", "1,1,1")}

# The size is that of a file with a header; otherwise it is the source.
Case = collections.namedtuple("Case", "source options ways size", defaults=(None,))
CASES = {
    "side-frame": Case("708,965,325", (), USUAL | LONG),
    "cover": Case("1500,1500,668", (), USUAL),
    "gyroid": Case("256,256,256", (), USUAL),
    "blobs": Case("192,192,192", (), USUAL),
    "struts": Case("256,256,256", (), USUAL),
    "engine": Case("engine.mha", ("--lower", "72", "--sub-voxel=off"), USUAL, "256,256,110"),
    "shell": Case("shell.nrrd", ("--lower", "65", "--sub-voxel=off"), USUAL, "128,128,225"),
    "cranium": Case("cranium.mha", ("--lower", "200", "--sub-voxel=off"), USUAL | VOXELS, "256,256,108"),
}
RATIOS = {
    "automatic to fixed": ("automatic", "fixed"),
    "mesh": ("with a mesh", "automatic"),
    "report, page and picture": ("with report, page and picture", "automatic"),
    "thickness 8": ("thickness 8", "fixed"),
    "thickness 12": ("thickness 12", "fixed"),
    "mm to voxels": ("automatic", "automatic in voxels"),
}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--data", type=pathlib.Path, help="folder of the real volumes; default: leave them out")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--threads", type=int, default=2, help="default 2")
    parser.add_argument("--cases", nargs="+", choices=CASES, default=list(CASES), help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "automatic.json")
    return parser.parse_args()


def make_random(case, size, volume):
    """Smoothed noise: where it is positive (blobs), or where it is near zero (struts and plates as in thin bone)."""
    import numpy
    from scipy import ndimage

    shape = tuple(int(n) for n in reversed(size.split(",")))
    noise = numpy.random.default_rng(1).standard_normal(shape, dtype=numpy.float32)
    width, limits = {"blobs": (3, (0, numpy.inf)), "struts": (5, (-0.2, 0.2))}[case]
    smooth = ndimage.gaussian_filter(noise, width, mode="wrap")
    smooth /= smooth.std()
    ((smooth > limits[0]) & (smooth < limits[1])).astype(numpy.uint8).tofile(volume)


def make_volume(arguments, scratch, name):
    """File, and its size if it has no header."""
    source = CASES[name].source
    if "," not in source:
        return arguments.data / source, None
    volume = scratch / "volume.raw"
    if name in ("blobs", "struts"):
        make_random(name, source, volume)
    else:
        compare_peers.make_phantom(arguments.build, name, (), source, volume, scratch)
    return volume, source


def summarize(values):
    return {
        key: {f.__name__: round(f([value[key] for value in values]), 4) for f in (statistics.median, min, max)}
        for key in values[0]
    }


def measure(arguments, scratch, name):
    volume, size = make_volume(arguments, scratch, name)
    case = CASES[name]
    programs = {
        way: compare_peers.Extraction(
            arguments.build,
            volume,
            size,
            arguments.threads,
            *(str(word).replace("FILE", str(scratch / "extra")) for word in words),
            *case.options,
            labels=set(),
            scratch=scratch,
        )
        for way, words in case.ways.items()
    }
    runs, _ = compare_peers.run_rounds(programs, scratch, arguments.rounds, 3600, 3600)
    return {"source": case.source, "results": {way: summarize(values) for way, values in runs.items()}}


def print_table(cases):
    """CPU seconds of fixed and automatic, and all ratios; for the peak memory the ratio of these two."""
    print("| volume | fixed, CPU s | automatic, CPU s | " + " | ".join(RATIOS) + " | peak memory | load |")
    print("| --- " * (len(RATIOS) + 5) + "|")
    for name, case in cases.items():
        results = case["results"]

        def median(way, measure):
            return results[way][measure]["median"]

        ratios = [
            f"{median(way, 'cpu_seconds') / median(other, 'cpu_seconds'):.2f}" if way in results and other in results else ""
            for way, other in RATIOS.values()
        ]
        seconds = [f"{median(way, 'cpu_seconds'):.2f}" for way in ("fixed", "automatic")]
        memory = median("automatic", "peak_bytes") / median("fixed", "peak_bytes")
        load = median("automatic", "load_before")
        print("| " + " | ".join([name, *seconds, *ratios, f"{memory:.1f}", f"{load:.1f}"]) + " |")


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, thickness=3, threads=arguments.threads)
    names = [name for name in arguments.cases if arguments.data or "," in CASES[name].source]
    document["cases"] = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            document["cases"][name] = measure(arguments, pathlib.Path(folder), name)
            # After each case, as all of them take long.
            arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print_table(document["cases"])


if __name__ == "__main__":
    main()
