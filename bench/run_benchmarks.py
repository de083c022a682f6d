#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Times whole extractions of a synthetic part against the floor and against ITK's SignedMaurer; writes one JSON file.

The floor reads the volume, thresholds it and writes a file of the size of the labels. All programs run in turn, round
after round, so that a change of the machine's load or page cache meets all of them. The input is in the page cache;
every run writes a new file. Labels of all runs must be the same bytes.

Usage: bench/run_benchmarks.py BUILD KIND [options]      for example: bench/run_benchmarks.py build side-frame
       bench/run_benchmarks.py BUILD kernels             the kernels, by Google Benchmark
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

BENCH = pathlib.Path(__file__).resolve().parent
MAURER_BYTES_PER_VOXEL = 13


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("kind", help="kind of medialvoxel-phantom, or 'kernels'")
    parser.add_argument("--size", help="X,Y,Z; default: the size of the kind")
    parser.add_argument("--noise", type=float, default=0, help="surface noise in voxels; default 0")
    parser.add_argument("--seed", type=int, default=1, help="seed of the noise; default 1")
    parser.add_argument("--thickness", type=float, default=3, help="tau in voxels; default 3")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, os.cpu_count()], help="default: 1 and all")
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--no-maurer", action="store_true", help="leave SignedMaurer out")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the volumes; default: a temporary one")
    parser.add_argument("--output", type=pathlib.Path, help="default: results/KIND-tauT.json beside this script")
    return parser.parse_args()


def find_program(build, name):
    for path in sorted(build.rglob(name)):
        if path.is_file() and os.access(path, os.X_OK):
            return str(path.resolve())
    sys.exit(f"run_benchmarks.py: no program {name} in {build}")


def text_of(path, pattern):
    found = re.search(pattern, pathlib.Path(path).read_text(encoding="utf-8"), re.MULTILINE)
    return found.group(1) if found else "unknown"


def describe_machine(build):
    cache = build / "CMakeCache.txt"
    compiler = text_of(cache, r"^CMAKE_CXX_COMPILER:\w+=(.*)$")
    version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True)
    build_type = text_of(cache, r"^CMAKE_BUILD_TYPE:\w+=(.*)$")
    return {
        "processor": text_of("/proc/cpuinfo", r"^model name\s*:\s*(.*)$"),
        "cores": os.cpu_count(),
        "memory_gib": round(int(text_of("/proc/meminfo", r"^MemTotal:\s*(\d+)")) / 2**20, 1),
        "system": text_of("/etc/os-release", r'^PRETTY_NAME="(.*)"$'),
        "compiler": version.stdout.splitlines()[0],
        "build_type": build_type,
        "flags": " ".join(
            text_of(cache, rf"^{name}:\w+=(.*)$")
            for name in ("CMAKE_CXX_FLAGS", f"CMAKE_CXX_FLAGS_{build_type.upper()}")
        ).strip(),
        "itk": text_of(cache, r"^ITK_DIR:\w+=.*ITK-([\d.]+)$"),
    }


def describe_run(build, **details):
    """What a file of results begins with."""
    return {
        "machine": describe_machine(build),
        "revision": describe_revision(),
        "load_at_start": os.getloadavg()[0],
        **details,
    }


def describe_revision():
    def git(*words):
        return subprocess.run(["git", "-C", BENCH, *words], capture_output=True, text=True, check=True).stdout.strip()

    try:
        changes = git("status", "--porcelain", "--", "../include", "../src", "../apps", ".")
        return {"commit": git("rev-parse", "HEAD"), "modified": bool(changes)}
    except (OSError, subprocess.CalledProcessError):
        return {"commit": "unknown"}


def run(command):
    """Run to the end; standard output, and the times of the process alone."""
    load = os.getloadavg()[0]
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    text = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.perf_counter() - start
    if process.returncode != 0:
        sys.exit(f"run_benchmarks.py: exit status {process.returncode}: {' '.join(command)}")
    return text, {
        "wall_seconds": seconds,
        "cpu_seconds": usage.ru_utime + usage.ru_stime,
        "load_before": load,
    }


SUMMARY = {"distance": "distance", "classification": "classification", "reading and writing": "input_output", "total": "total"}


def parse_summary(text):
    """Seconds of the phases and peak memory out of the long table that the program prints. Its report would have them too,
    but it comes with a survey of the thickness that costs as much as a quarter of the run."""
    found = {}
    for line in text.splitlines():
        words = re.match(r"(\S+(?: \S+)*)  +([\d.]+)( s| MiB)?", line)
        if words and words[1] in SUMMARY:
            found[f"{SUMMARY[words[1]]}_seconds"] = float(words[2])
        elif words and words[1] == "peak memory":
            found["peak_memory_bytes"] = round(float(words[2]) * 2**20)
    if len(found) != len(SUMMARY) + 1:
        sys.exit(f"run_benchmarks.py: no phases in the table of the program:\n{text}")
    return found


def sha256_of(path):
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 24):
            digest.update(block)
    return digest.hexdigest()


class Extraction:
    """One way to run `medialvoxel extract`; checks that labels never change."""

    labels = None

    def __init__(self, program, volume, size, thickness, threads):
        self.output = volume.with_name(f"labels-{threads}.mha")
        self.report = volume.with_name(f"report-{threads}.json")
        self.command = [program, "extract", str(volume), str(self.output), "--raw-size", size, "--raw-type", "uint8", "--phases"]
        self.command += ["--thickness", str(thickness), "--threads", str(threads), "--progress", "none", "--overwrite"]

    def __call__(self):
        self.output.unlink(missing_ok=True)
        text, measured = run(self.command)
        digest = sha256_of(self.output)
        if Extraction.labels not in (None, digest):
            sys.exit("run_benchmarks.py: two extractions gave different labels")
        Extraction.labels = digest
        measured.update(parse_summary(text))
        self.output.unlink()
        return measured

    def get_report(self):
        run([*self.command, "--report", str(self.report), "--quiet"])
        self.output.unlink()
        report = json.loads(self.report.read_text(encoding="utf-8"))
        return {key: report[key] for key in ("counts", "percent", "divisions")}


class Comparison:
    """A program that prints one line of JSON."""

    def __init__(self, command, output=None):
        self.command = [str(word) for word in command]
        self.output = output

    def __call__(self):
        text, measured = run(self.command)
        printed = json.loads(text)
        measured.update({key: printed[key] for key in ("filter_seconds", "peak_memory_bytes") if key in printed})
        if self.output:
            self.output.unlink()
        return measured


def summarize(runs):
    return {
        key: {f.__name__: round(f([r[key] for r in runs]), 4) for f in (statistics.median, min, max)} for key in runs[0]
    }


def available_bytes():
    return int(text_of("/proc/meminfo", r"^MemAvailable:\s*(\d+)")) * 1024


def plan_runs(arguments, volume, phantom):
    """Name to callable, in the order of a round."""
    build = arguments.build
    size = ",".join(str(n) for n in phantom["size"])
    voxels = phantom["size"][0] * phantom["size"][1] * phantom["size"][2]
    copy = volume.with_name("floor.raw")
    floor = [find_program(build, "medialvoxel-floor"), volume, size, 1, copy]
    plan = {"floor": Comparison(floor + ["--flush"], copy), "floor_not_flushed": Comparison(floor, copy)}
    program = find_program(build, "medialvoxel")
    for threads in dict.fromkeys(arguments.threads):
        plan[f"extract_{threads}_threads"] = Extraction(program, volume, size, arguments.thickness, threads)
    if not arguments.no_maurer and voxels * MAURER_BYTES_PER_VOXEL < available_bytes():
        maurer = find_program(build, "medialvoxel-maurer")
        plan["signed_maurer"] = Comparison([maurer, volume, size, max(arguments.threads)])
    return plan


def measure_part(arguments, scratch):
    volume = scratch / f"{arguments.kind}.raw"
    command = [find_program(arguments.build, "medialvoxel-phantom"), arguments.kind, str(volume)]
    command += ["--noise", str(arguments.noise), "--seed", str(arguments.seed)]
    command += ["--size", arguments.size] if arguments.size else []
    phantom = json.loads(run(command)[0])
    del phantom["seconds"]

    plan = plan_runs(arguments, volume, phantom)
    runs = {name: [] for name in plan}
    for number in range(arguments.rounds):
        for name, measure in plan.items():
            runs[name].append(measure())
            print(f"round {number + 1} {name}: {runs[name][-1]['wall_seconds']:.2f} s", file=sys.stderr)
    extractions = [name for name in plan if name.startswith("extract")]
    report = plan[extractions[-1]].get_report()
    volume.unlink()

    results = {name: summarize(values) for name, values in runs.items()}
    floor = results["floor"]["wall_seconds"]["median"]
    return {
        "phantom": phantom,
        "thickness": arguments.thickness,
        "rounds": arguments.rounds,
        "results": results,
        "wall_ratio_to_floor": {name: round(results[name]["wall_seconds"]["median"] / floor, 2) for name in extractions},
        "report": report,
        "labels_sha256": Extraction.labels,
    }


def measure_kernels(arguments):
    command = [find_program(arguments.build, "medialvoxel-bench"), "--benchmark_format=json"]
    command += [f"--benchmark_repetitions={max(2, arguments.rounds)}", "--benchmark_report_aggregates_only=true"]
    benchmarks = json.loads(run(command)[0])["benchmarks"]
    kept = ("label", "real_time", "cpu_time", "time_unit", "items_per_second")
    return {
        "rounds": arguments.rounds,
        "kernels": {
            b["run_name"]: {key: b[key] for key in kept if key in b} for b in benchmarks if b["aggregate_name"] == "median"
        },
    }


def main():
    arguments = parse_arguments()
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory(dir=arguments.scratch) as folder:
        is_part = arguments.kind != "kernels"
        measured = measure_part(arguments, pathlib.Path(folder)) if is_part else measure_kernels(arguments)
    document = {
        "machine": describe_machine(arguments.build),
        "revision": describe_revision(),
        "load_at_start": load,
        **measured,
    }
    name = f"{arguments.kind}-tau{arguments.thickness:g}.json" if is_part else "kernels.json"
    output = arguments.output or BENCH / "results" / name
    output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(output)


if __name__ == "__main__":
    main()
