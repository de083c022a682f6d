#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Times the program, its distance transform and what others offer on the same volumes, in turn; writes one JSON file.

Volumes of bench/phantom, headerless bytes in the page cache. All programs run round after round, each round begins
with another one. Each runs in a process of its own: CPU seconds and peak memory are what wait4() tells; the peak of
those in C++ is their own VmHWM, as wait4() counts what this interpreter had before exec(). Transforms and skeletons
also tell the CPU seconds of the call alone, without start and reading; plots and tables use those, and of the program
and the floor the whole process.

A program that would take longer than --limit or more memory than there is, judged by its last smaller volume, and one
that is not installed, is named under "skipped" or "missing". Slow peers run in as many rounds as --budget allows, at
least once; the program and the floor run in all, and as long as they take.

Usage: bench/compare_peers.py BUILD [options]
       bench/compare_peers.py BUILD --make-environment VENV     installs the peers of PyPI into VENV, then measures
"""

import argparse
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import run_benchmarks as common

NAME = "compare_peers.py"
ALWAYS = {"floor", "extract_1", "extract_2"}
PEERS = pathlib.Path(__file__).resolve().with_name("peers.py")
SYSTEM_PYTHON = "/usr/bin/python3"
PYPI_PEERS = ("numpy", "scipy", "edt", "scikit-image", "itk-thickness3d", "matplotlib")
MEMORY_SHARE = 0.8
READING_CALLS = {"read", "pread64", "readv", "preadv", "lseek"}
WRITING_CALLS = {
    "write", "pwrite64", "writev", "pwritev", "fsync", "fdatasync", "sync_file_range", "fallocate", "ftruncate", "rename",
}  # fmt: skip

TITLES = {
    "floor": "floor: read, threshold, write",
    "extract_1": "medialvoxel extract, 1 thread",
    "extract_2": "medialvoxel extract, 2 threads",
    "vector_distance": "MedialVoxel vectors alone",
    "signed_maurer": "ITK SignedMaurer (distances)",
    "scipy": "scipy edt with indices",
    "vigra": "vigra vector distances",
    "edt": "edt (distances)",
    "skimage": "skimage skeletonize (curves)",
    "itk-thickness3d": "ITK thinning (curves)",
}

CUBES = ("128", "256", "512")
# Kind of medialvoxel-phantom: its options, and its sizes from small to large.
VOLUMES = {
    "side-frame": ((), (*CUBES, "708,965,325")),
    "solids": ((), CUBES),
    "gyroid": ((), CUBES),
    "plates": ((), CUBES[:2]),
    "cover": ((), (*CUBES, "1500,1500,668")),
}
LONG = {f"tau {tau}": (tau,) for tau in (5, 6, 8, 12)}
# Only the program, two threads. Name: kind, options of the phantom, size, extractions by name with their options.
VARIANTS = {
    "cover, other thickness": ("cover", (), "1500,1500,668", {"tau 2": (2,), "tau 3": (3,), "tau 5": (5,)}),
    "side frame, larger thickness": ("side-frame", (), "256", LONG),
    "gyroid, larger thickness": ("gyroid", (), "256", LONG),
    "plate of 20 voxels": ("plate", ("--wall", "20"), "256", {"tau 3": (3,), "tau 20": (20,)}),
    "gyroid, other spacing": (
        "gyroid",
        (),
        "256",
        {"tau 3": (3,), "tau 3 mm, 0.957 x 0.957 x 1.5": (3, "--spacing", "0.957,0.957,1.5")},
    ),
}
CRANIUM_SIZE = "256,256,108"
CRANIUM_SPACING = "0.9570312,0.9570312,1.5"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="build folder")
    parser.add_argument("--kinds", nargs="*", choices=VOLUMES, default=list(VOLUMES), help="default: all")
    parser.add_argument("--sizes", nargs="+", help="N or X,Y,Z; default: three cubes, and the real sizes")
    parser.add_argument("--no-variants", action="store_true", help="leave out other thicknesses and spacings")
    parser.add_argument("--cranium", type=pathlib.Path, default=pathlib.Path("build/demo-data/cranium.raw"),
                        help="volume of scripts/demo; default: build/demo-data/cranium.raw")  # fmt: skip
    parser.add_argument("--rounds", type=int, default=5, help="default 5")
    parser.add_argument("--limit", type=float, default=60, help="seconds that a run of a peer may take; default 60")
    parser.add_argument("--budget", type=float, default=30, help="seconds of a peer, or of the transform, per volume; default 30")
    parser.add_argument("--python", help="interpreter that has the peers; Debian's is tried as well")
    parser.add_argument("--make-environment", type=pathlib.Path, metavar="VENV", help="make it, with the peers of PyPI")
    parser.add_argument("--scratch", type=pathlib.Path, help="folder of the volumes; default: a temporary one")
    parser.add_argument("--output", type=pathlib.Path, default=common.BENCH / "results" / "peers.json")
    return parser.parse_args()


def make_environment(folder):
    subprocess.run([SYSTEM_PYTHON, "-m", "venv", folder], check=True)
    for package in PYPI_PEERS:  # one at a time: one that is not to be had must not keep the others away
        if subprocess.run([folder / "bin" / "pip", "install", "--quiet", package]).returncode != 0:
            print(f"{NAME}: {package} cannot be installed", file=sys.stderr)
    return str(folder / "bin" / "python")


def find_peers(interpreters):
    """Name to interpreter and version of the peers that can be imported, and why the others cannot."""
    found, missing = {}, {}
    names = [name for name in TITLES if name not in ALWAYS | {"vector_distance", "signed_maurer"}]
    for name in names:
        for interpreter in interpreters:
            tried = subprocess.run([interpreter, PEERS, name], capture_output=True, text=True)
            if tried.returncode == 0:
                found[name] = {"interpreter": interpreter, "version": json.loads(tried.stdout)["version"]}
                break
            missing[name] = (tried.stderr.strip().splitlines() or ["no output"])[-1]
    for name in names:
        if name not in found:
            print(f"{NAME}: skipped: {name}: {missing[name]}", file=sys.stderr)
    return found, {name: text for name, text in missing.items() if name not in found}


def run_child(command, scratch, limit):
    """One process to its end: what it printed, and its numbers; nothing when it was stopped at the limit."""
    out = scratch / "stdout.txt"
    load, start = os.getloadavg()[0], time.perf_counter()
    to_file = [(os.POSIX_SPAWN_OPEN, 1, out, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    # Not a fork, whose child would begin with the memory of this interpreter.
    child = os.posix_spawn(command[0], list(map(str, command)), environment, file_actions=to_file)
    stopper = threading.Timer(min(limit, threading.TIMEOUT_MAX), os.kill, (child, 9))
    stopper.start()
    _, status, usage = os.wait4(child, 0)
    stopper.cancel()
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) == 9:
        return "", None
    if status != 0:
        sys.exit(f"{NAME}: status {status}: {' '.join(map(str, command))}")
    return out.read_text(encoding="utf-8"), {
        "wall_seconds": time.perf_counter() - start,
        "cpu_seconds": usage.ru_utime + usage.ru_stime,
        "peak_bytes": usage.ru_maxrss * 1024,
        "load_before": load,
    }


class Program:
    """A program that prints one line of JSON."""

    def __init__(self, command, output=None):
        self.command = command
        self.output = output

    def __call__(self, scratch, limit):
        text, measured = run_child(self.command, scratch, limit)
        if self.output:
            self.output.unlink(missing_ok=True)
        if measured:
            printed = json.loads(text)
            call = printed.get("call_cpu_seconds", printed.get("filter_cpu_seconds"))
            if call is not None:
                measured["call_cpu_seconds"] = call
            measured["peak_bytes"] = printed.get("peak_memory_bytes", measured["peak_bytes"])
        return measured


class Extraction:
    """medialvoxel extract; the first labels of each run that shares `labels` must be the same bytes."""

    def __init__(self, build, volume, size, threads, thickness, *options, labels=None, pixel_type="uint8", scratch=None):
        self.output = (scratch or volume.parent) / "labels.mha"
        self.report = self.output.with_name("report.json")
        self.labels = labels
        self.is_checked = labels is None
        self.command = [common.find_program(build, "medialvoxel"), "extract", volume, self.output, "--phases"]
        self.command += ["--raw-size", size, "--raw-type", pixel_type] if size else []
        self.command += ["--thickness", thickness, "--threads", threads, *options]
        self.command += ["--progress", "none", "--overwrite"]

    def __call__(self, scratch, limit):
        self.output.unlink(missing_ok=True)
        text, measured = run_child(self.command, scratch, limit)
        if measured:
            measured.update(common.parse_summary(text))
            measured["peak_bytes"] = measured.pop("peak_memory_bytes")
            self._check_labels()
        self.output.unlink(missing_ok=True)
        return measured

    def get_counts(self, scratch):
        run_child([*self.command, "--report", self.report, "--quiet"], scratch, 3600)
        self.output.unlink()
        return json.loads(self.report.read_text(encoding="utf-8"))["counts"]

    def _check_labels(self):
        if not self.is_checked:
            self.is_checked = True
            self.labels.add(common.sha256_of(self.output))
            if len(self.labels) > 1:
                sys.exit(f"{NAME}: two extractions gave different labels")

    def trace(self, scratch):
        """Seconds inside system calls that read and that write, of one run."""
        table = scratch / "calls.txt"
        subprocess.run(["strace", "-f", "-c", "-w", "-o", table, *map(str, self.command), "--quiet"], check=True)
        self.output.unlink()
        seconds = {"reading": 0.0, "writing": 0.0}
        for line in table.read_text(encoding="utf-8").splitlines():
            words = line.split()
            for phase, calls in (("reading", READING_CALLS), ("writing", WRITING_CALLS)):
                if words and words[-1] in calls:
                    seconds[phase] += float(words[1])
        return {phase: round(value, 4) for phase, value in seconds.items()}


def run_rounds(programs, scratch, rounds, limit, budget):
    """Runs by program, and why some have none."""
    runs, spent, skipped = {name: [] for name in programs}, dict.fromkeys(programs, 0.0), {}
    names = list(programs)
    for number in range(rounds):
        for name in names[number % len(names) :] + names[: number % len(names)]:
            last = runs[name][-1]["wall_seconds"] if runs[name] else 0
            if name in skipped or (name not in ALWAYS and spent[name] + last > budget):
                continue
            measured = programs[name](scratch, math.inf if name in ALWAYS else limit)
            if measured is None:
                skipped[name] = f"stopped after {limit:g} s"
                continue
            runs[name].append(measured)
            spent[name] += measured["wall_seconds"]
            print(f"  round {number + 1} {name}: {measured['cpu_seconds']:.2f} CPU s", file=sys.stderr)
    return {name: values for name, values in runs.items() if values}, skipped


def summarize(values, voxels, objects):
    result = {"runs": len(values)}
    for key in values[0]:
        numbers = [value[key] for value in values]
        result[key] = {f.__name__: round(f(numbers), 4) for f in (statistics.median, min, max)}
    seconds = result.get("call_cpu_seconds", result["cpu_seconds"])["median"]
    result["rated_cpu_seconds"] = seconds
    result["mvoxel_per_cpu_second"] = round(voxels / 1e6 / max(seconds, 1e-6), 2)
    result["ns_per_object_voxel"] = round(1e9 * seconds / max(objects, 1), 2)
    return result


class Forecast:
    """What a program takes on a volume, judged by its last one of the kind."""

    def __init__(self, limit):
        self.limit = limit
        self.last = {}

    def remember(self, name, voxels, result):
        self.last[name] = (voxels, result["cpu_seconds"]["median"], result["rated_cpu_seconds"], result["peak_bytes"]["max"])

    def reason_to_skip(self, name, voxels):
        if name not in self.last:
            return None
        known, whole, call, peak = self.last[name]
        ratio = max(1.0, voxels / known)
        seconds = whole - call + call * ratio
        if name not in ALWAYS and seconds > self.limit:
            return f"about {seconds:.0f} s expected, limit {self.limit:g} s"
        if peak * ratio > MEMORY_SHARE * common.available_bytes():
            return f"about {peak * ratio / 2**30:.0f} GiB expected"
        return None


def make_phantom(build, kind, options, size, volume, scratch):
    size = size if "," in size else ",".join([size] * 3)
    command = [common.find_program(build, "medialvoxel-phantom"), kind, volume, "--size", size, *options]
    phantom = json.loads(run_child(command, scratch, 3600)[0])
    return size, phantom


def plan_programs(build, volume, size, peers):
    copy, labels = volume.with_name("floor.raw"), set()
    programs = {
        "floor": Program([common.find_program(build, "medialvoxel-floor"), volume, size, 1, copy], copy),
        "extract_1": Extraction(build, volume, size, 1, 3, labels=labels),
        "extract_2": Extraction(build, volume, size, 2, 3, labels=labels),
        "vector_distance": Program([common.find_program(build, "medialvoxel-vector-distance"), volume, size, 1]),
        "signed_maurer": Program([common.find_program(build, "medialvoxel-maurer"), volume, size, 1]),
    }
    for name, peer in peers.items():
        programs[name] = Program([peer["interpreter"], PEERS, name, volume, size])
    return programs


def measure_volume(arguments, scratch, kind, size, peers, forecast):
    volume = scratch / "volume.raw"
    size, phantom = make_phantom(arguments.build, kind, VOLUMES[kind][0], size, volume, scratch)
    print(f"{kind} {size}", file=sys.stderr)
    voxels, objects = volume.stat().st_size, phantom["object_voxels"]
    planned = plan_programs(arguments.build, volume, size, peers)
    skipped = {name: forecast.reason_to_skip(name, voxels) for name in planned}
    programs = {name: program for name, program in planned.items() if not skipped[name]}
    runs, stopped = run_rounds(programs, scratch, arguments.rounds, arguments.limit, arguments.budget)
    results = {name: summarize(values, voxels, objects) for name, values in runs.items()}
    for name, result in results.items():
        forecast.remember(name, voxels, result)
    one = programs.get("extract_1")
    document = {
        "kind": kind,
        "size": phantom["size"],
        "voxels": voxels,
        "object_voxels": objects,
        "object_percent": phantom["object_percent"],
        "counts": one.get_counts(scratch) if one else None,
        "skipped": {name: reason for name, reason in {**skipped, **stopped}.items() if reason},
        "results": results,
    }
    if one and shutil.which("strace"):
        document["traced_seconds"] = one.trace(scratch)
    volume.unlink()
    return document


def measure_variant(arguments, scratch, volume, size, extractions, pixel_type="uint8", options=()):
    """Runs by name of the extraction, with the cost of a candidate cell."""
    programs = {
        name: Extraction(arguments.build, volume, size, 2, *given, *options, pixel_type=pixel_type)
        for name, given in extractions.items()
    }
    runs, skipped = run_rounds(programs, scratch, arguments.rounds, arguments.limit, math.inf)
    results = {}
    for name, values in runs.items():
        counts = programs[name].get_counts(scratch)
        results[name] = summarize(values, volume.stat().st_size, counts["object_voxels"])
        results[name]["candidate_cells"] = counts["candidate_cells"]
        per_cell = 1e9 * results[name]["cpu_seconds"]["median"] / max(counts["candidate_cells"], 1)
        results[name]["ns_per_candidate_cell"] = round(per_cell, 2)
    return {"size": size, "skipped": skipped, "results": results}


def measure_variants(arguments, scratch):
    variants = {}
    for title, (kind, options, size, extractions) in VARIANTS.items():
        print(title, file=sys.stderr)
        volume = scratch / "volume.raw"
        size, _ = make_phantom(arguments.build, kind, options, size, volume, scratch)
        variants[title] = measure_variant(arguments, scratch, volume, size, extractions)
        volume.unlink()
    if not arguments.cranium.is_file():
        print(f"{NAME}: skipped: {arguments.cranium} is not there, scripts/demo makes it", file=sys.stderr)
        return variants
    volume = scratch / "cranium.raw"
    shutil.copyfile(arguments.cranium, volume)
    extractions = {
        "tau 3": (3,),
        "tau 3 mm, 0.957 x 0.957 x 1.5": (3, "--spacing", CRANIUM_SPACING),
    }
    variants["cranium"] = measure_variant(
        arguments, scratch, volume, CRANIUM_SIZE, extractions, "int16", ("--lower", "200")
    )
    return variants


def main():
    arguments = parse_arguments()
    interpreters = [make_environment(arguments.make_environment)] if arguments.make_environment else []
    interpreters += [arguments.python] if arguments.python else []
    peers, missing = find_peers([*interpreters, sys.executable, SYSTEM_PYTHON])
    document = {
        "machine": common.describe_machine(arguments.build),
        "revision": common.describe_revision(),
        "load_at_start": os.getloadavg()[0],
        "thickness": 3,
        "rounds": arguments.rounds,
        "limit_seconds": arguments.limit,
        "titles": TITLES,
        "versions": {name: peer["version"] for name, peer in peers.items()},
        "missing": missing,
        "volumes": [],
    }

    def save():
        arguments.output.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")

    with tempfile.TemporaryDirectory(dir=arguments.scratch) as name:
        scratch = pathlib.Path(name)
        for kind in arguments.kinds:
            forecast = Forecast(arguments.limit)
            for size in arguments.sizes or VOLUMES[kind][1]:
                document["volumes"].append(measure_volume(arguments, scratch, kind, size, peers, forecast))
                save()
        if not arguments.no_variants:
            document["variants"] = measure_variants(arguments, scratch)
    save()
    print(arguments.output)


if __name__ == "__main__":
    main()
