#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Peak memory and time of the program and of a C++ pipeline on the same volume; prints JSON.

The program is medialvoxel extract with a cap on its memory; the pipeline is the example StreamMedialVoxels (reader,
filter, writer with stream divisions). The pipeline gets as many divisions as the program's plan has. Both label files
must be the same bytes. The peak is what the system tells about the finished child (its VmHWM).

Usage: bench/measure_memory.py BUILD VOLUME [options]     VOLUME: .mha, .mhd or .nrrd of type uint8
"""

import argparse
import json
import os
import pathlib
import sys
import tempfile
import time

from run_benchmarks import describe_machine, describe_revision, find_program

NAME = "measure_memory.py"
MIB = 1 << 20


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("volume", type=pathlib.Path)
    parser.add_argument("--thickness", type=float, default=3, help="tau; default 3")
    parser.add_argument("--lower", type=float, default=1, help="smallest value of the object; default 1")
    parser.add_argument("--memory", default="256M", help="cap of the program; default 256M")
    parser.add_argument("--divisions", type=int, nargs="+", help="of the pipeline; default: as the program")
    parser.add_argument("--preview", action="store_true", help="measure the program with a preview as well")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the outputs; default: a temporary one")
    return parser.parse_args()


def measure(name, command):
    """Seconds and peak memory of one run that must succeed."""
    start = time.perf_counter()
    silent = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
    # Not a fork, whose child would begin with the memory of this interpreter.
    child = os.posix_spawn(command[0], list(map(str, command)), os.environ, file_actions=silent)
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"{NAME}: {name} failed: {command}")
    return {
        "name": name,
        "wall_seconds": round(time.perf_counter() - start, 3),
        "cpu_seconds": round(usage.ru_utime + usage.ru_stime, 3),
        "peak_mib": round(usage.ru_maxrss / 1024, 1),
    }


def measure_program(arguments, folder, name, *options):
    program = find_program(arguments.build, "medialvoxel")
    command = [program, "extract", arguments.volume, folder / f"{name}.mha", "--thickness", arguments.thickness]
    command += ["--lower", arguments.lower, "--memory", arguments.memory, "--report", folder / "report.json"]
    result = measure(name, [*command, "--overwrite", "--quiet", *options])
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    result["planned_mib"] = round(report["planned_peak_bytes"] / MIB, 1)
    result["divisions"] = report["divisions"]
    result["bytes_read"] = report["bytes_read"]
    return result


def measure_pipeline(arguments, folder, divisions):
    example = find_program(arguments.build, "StreamMedialVoxels")
    name = f"pipeline of {divisions} divisions"
    target = folder / "pipeline.mha"
    result = measure(name, [example, arguments.volume, target, arguments.lower, arguments.thickness, divisions])
    result["divisions"] = divisions
    result["same_voxels"] = has_same_voxels(target, folder / "program.mha")
    target.unlink()
    return result


def has_same_voxels(one, other):
    """Headers differ in their wording; what follows them must not."""
    with open(one, "rb") as first, open(other, "rb") as second:
        for file in (first, second):
            head = file.read(4096)
            file.seek(head.index(b"\n", head.index(b"ElementDataFile")) + 1)
        while True:
            a, b = first.read(MIB), second.read(MIB)
            if a != b or not a:
                return a == b


def print_result(name, arguments, runs):
    """All runs with machine and revision, as JSON; ends with an error when labels differ."""
    result = {
        "volume": arguments.volume.name,
        "bytes": arguments.volume.stat().st_size,
        "memory": arguments.memory,
        "machine": describe_machine(arguments.build),
        "revision": describe_revision(),
        "runs": runs,
    }
    print(json.dumps(result, indent=2))
    if not all(run.get("same_voxels", True) for run in runs):
        sys.exit(f"{name}: the labels differ")


def main():
    arguments = parse_arguments()
    with tempfile.TemporaryDirectory(dir=arguments.scratch) as name:
        folder = pathlib.Path(name)
        runs = [measure_program(arguments, folder, "program")]
        if arguments.preview:
            runs.append(measure_program(arguments, folder, "preview", "--preview", folder / "preview.png"))
            (folder / "preview.mha").unlink()
        for divisions in arguments.divisions or [runs[0]["divisions"]]:
            runs.append(measure_pipeline(arguments, folder, divisions))
    print_result(NAME, arguments, runs)


if __name__ == "__main__":
    main()
