#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Times the vector distance transform alone against ITK's SignedMaurer on one thread; writes one JSON file.

Both filters have the volume in memory and write their image: vectors inside the object, or signed distances. Both run in
turn, round after round. Processor seconds of the filter alone count, as the load of the machine disturbs them least;
those in the system, which makes the pages of the new image, are told apart: they depend on the machine, and an image of
vectors is three times as large as one of distances.

Usage: bench/measure_transform.py BUILD [--rounds 5] [--scale 1] [--output results/transform.json]
"""

import argparse
import json
import pathlib
import sys
import tempfile

import run_benchmarks as common

# Name: kind of medialvoxel-phantom, its size, and the middle part that is measured.
VOLUMES = {
    "solids": ("solids", (512, 512, 512), (512, 512, 512)),
    "gyroid": ("gyroid", (256, 256, 256), (256, 256, 256)),
    "side frame, crop": ("side-frame", (708, 965, 325), (256, 256, 256)),
}
KEYS = ("filter_cpu_seconds", "filter_user_seconds", "filter_system_seconds", "filter_seconds")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--scale", type=int, default=1, help="divides all sizes, to try the script; default 1")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "transform.json")
    return parser.parse_args()


def crop_middle(source, size, target, part):
    """Write the middle part of a volume of bytes; the number of its object voxels."""
    first = [(whole - middle) // 2 for whole, middle in zip(size, part)]
    objects = 0
    with open(source, "rb") as volume, open(target, "wb") as result:
        for z in range(first[2], first[2] + part[2]):
            for y in range(first[1], first[1] + part[1]):
                volume.seek((z * size[1] + y) * size[0] + first[0])
                row = volume.read(part[0])
                objects += part[0] - row.count(0)
                result.write(row)
    return objects


def measure(arguments, folder, name):
    kind, whole, middle = VOLUMES[name]
    size = [n // arguments.scale for n in whole]
    part = [n // arguments.scale for n in middle]
    volume = folder / "whole.raw"
    command = [common.find_program(arguments.build, "medialvoxel-phantom"), kind, str(volume)]
    common.run(command + ["--size", ",".join(map(str, size))])
    crop = folder / "part.raw"
    objects = crop_middle(volume, size, crop, part)
    volume.unlink()
    extent = ",".join(map(str, part))
    programs = {"vector_distance": "medialvoxel-vector-distance", "signed_maurer": "medialvoxel-maurer"}
    runs = {key: [] for key in programs}
    for number in range(arguments.rounds):
        for key, program in programs.items():
            text, measured = common.run([common.find_program(arguments.build, program), str(crop), extent, "1"])
            printed = json.loads(text)
            runs[key].append({k: printed[k] for k in KEYS})
            runs[key][-1]["load_before"] = measured["load_before"]
            print(f"{name}, round {number + 1}, {key}: {printed['filter_cpu_seconds']:.3f} s", file=sys.stderr)
    crop.unlink()
    results = {key: common.summarize(values) for key, values in runs.items()}
    ours, theirs = results["vector_distance"], results["signed_maurer"]
    voxels, seconds = part[0] * part[1] * part[2], ours["filter_cpu_seconds"]["median"]
    return {
        "size": part,
        "object_voxels": objects,
        "results": results,
        "voxels_per_cpu_second": round(voxels / seconds),
        "object_voxels_per_cpu_second": round(objects / seconds),
        "times_as_fast_as_signed_maurer": {
            key: round(theirs[f"filter_{key}_seconds"]["median"] / max(ours[f"filter_{key}_seconds"]["median"], 1e-6), 2)
            for key in ("cpu", "user")
        },
    }


def main():
    arguments = parse_arguments()
    document = common.describe_run(arguments.build, rounds=arguments.rounds)
    with tempfile.TemporaryDirectory() as folder:
        document["volumes"] = {name: measure(arguments, pathlib.Path(folder), name) for name in VOLUMES}
    arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(arguments.output)


if __name__ == "__main__":
    main()
