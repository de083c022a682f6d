#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws the results of compare_peers.py: voxels per CPU-second against size, and seconds per phase; needs matplotlib.

Usage: bench/plot_results.py [results/peers.json] [--folder doc/figures]     writes peers.png and phases.png
"""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLORS = {
    "floor": "#9a9a9a",
    "extract_1": "#c1121f",
    "extract_2": "#f08080",
    "vector_distance": "#1d3557",
    "signed_maurer": "#2a9d8f",
    "scipy": "#e9a03b",
    "vigra": "#8e5bb5",
    "edt": "#3a86c8",
    "skimage": "#7a5230",
    "itk-thickness3d": "#4d4d4d",
}
OURS = {"extract_1", "extract_2", "vector_distance"}
PHASES = {
    "reading": "#a8c5da",
    "distance": "#1d3557",
    "classification": "#c1121f",
    "writing": "#e9c46a",
    "rest": "#d0d0d0",
}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path, nargs="?", default=ROOT / "bench" / "results" / "peers.json")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "doc" / "figures")
    return parser.parse_args()


def machine_line(document):
    machine = document["machine"]
    return f"{machine['processor']}, {machine['cores']} cores, {machine['system']}, commit {document['revision']['commit'][:10]}"


def kinds_of(document):
    return list(dict.fromkeys(volume["kind"] for volume in document["volumes"]))


def plot_peers(document, path):
    kinds = kinds_of(document)
    columns = min(3, len(kinds) + 1)
    rows = -(-(len(kinds) + 1) // columns)
    figure, axes = pyplot.subplots(rows, columns, figsize=(4.1 * columns, 3.5 * rows), sharey=True, squeeze=False)
    panels = list(axes.flat)
    handles = {}
    for kind, panel in zip(kinds, panels):
        volumes = [volume for volume in document["volumes"] if volume["kind"] == kind]
        for name in document["titles"]:
            points = [
                (volume["voxels"] / 1e6, volume["results"][name]["mvoxel_per_cpu_second"])
                for volume in volumes
                if name in volume["results"]
            ]
            if points:
                style = {"linewidth": 2.4, "markersize": 6} if name in OURS else {"linewidth": 1.2, "markersize": 4}
                (handles[name],) = panel.plot(*zip(*points), marker="o", color=COLORS[name], **style)
        panel.set(xscale="log", yscale="log", title=kind)
        panel.grid(True, which="major", color="#e4e4e4")
        panel.set_axisbelow(True)
        panel.tick_params(labelleft=True)
        panel.xaxis.set_minor_formatter(ticker.NullFormatter())
    for panel in panels[len(kinds) :]:
        panel.axis("off")
    for row in axes:
        row[0].set_ylabel("Mvoxel per CPU-second")
    for panel in panels[max(0, len(kinds) - columns) : len(kinds)]:
        panel.set_xlabel("Mvoxel of the volume")
    names = [name for name in document["titles"] if name in handles]
    panels[len(kinds)].legend([handles[name] for name in names], [document["titles"][name] for name in names],
                              loc="center left", frameon=False, fontsize=9)  # fmt: skip
    figure.text(0.01, 0.005, machine_line(document), fontsize=7, color="#666666")
    figure.tight_layout(rect=(0, 0.02, 1, 1))
    figure.savefig(path, dpi=90)


def phases_of(volume):
    """Seconds by phase of one thread; what the report has as input and output is shared out as the traced calls were."""
    result = volume["results"]["extract_1"]
    seconds = {name: result[f"{name}_seconds"]["median"] for name in ("distance", "classification")}
    both = result["input_output_seconds"]["median"]
    traced = volume.get("traced_seconds", {"reading": 0.5, "writing": 0.5})
    share = traced["reading"] / max(sum(traced.values()), 1e-9)
    seconds["reading"], seconds["writing"] = both * share, both * (1 - share)
    seconds["rest"] = max(0.0, result["total_seconds"]["median"] - sum(seconds.values()))
    return seconds


def largest_volumes(document):
    for kind in kinds_of(document):
        volumes = [v for v in document["volumes"] if v["kind"] == kind and "extract_1" in v["results"]]
        if volumes:
            yield max(volumes, key=lambda volume: volume["voxels"])


def plot_phases(document, path):
    volumes = list(largest_volumes(document))
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 0.55 * len(volumes) + 1.6), sharey=True)
    labels = [f"{volume['kind']}\n{' x '.join(map(str, volume['size']))}" for volume in volumes]
    for panel, unit in ((left, None), (right, "object_voxels")):
        start = [0.0] * len(volumes)
        for phase, color in PHASES.items():
            scale = [1e9 / volume[unit] if unit else 1.0 for volume in volumes]
            widths = [phases_of(volume)[phase] * factor for volume, factor in zip(volumes, scale)]
            panel.barh(labels, widths, left=start, color=color, label=phase, height=0.62)
            start = [a + b for a, b in zip(start, widths)]
        panel.margins(x=0.12)
        panel.bar_label(panel.containers[-1], labels=[f"{value:.3g}" for value in start], padding=4, fontsize=9)
        panel.spines[["top", "right"]].set_visible(False)
    left.invert_yaxis()
    left.set_xlabel("seconds of one thread")
    right.set_xlabel("ns per object voxel")
    handles, names = left.get_legend_handles_labels()
    figure.legend(handles, names, loc="upper center", ncol=len(names), frameon=False, fontsize=9)
    figure.text(0.01, 0.005, machine_line(document), fontsize=7, color="#666666")
    figure.tight_layout(rect=(0, 0.03, 1, 0.93))
    figure.savefig(path, dpi=90)


def main():
    arguments = parse_arguments()
    document = json.loads(arguments.file.read_text(encoding="utf-8"))
    for name, plot in (("peers.png", plot_peers), ("phases.png", plot_phases)):
        plot(document, arguments.folder / name)
        print(arguments.folder / name)


if __name__ == "__main__":
    main()
