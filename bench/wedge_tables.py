# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes and prints the results of measure_step_wedge.py and measure_thin_walls.py.

Usage: bench/wedge_tables.py [results/step-wedge.json] [--page]     prints the tables of a result, or those of accuracy.md
       bench/wedge_tables.py results/thin-walls.json --thin-walls   all parts together
"""

import json
import pathlib
import sys

RESULTS = pathlib.Path(__file__).resolve().with_name("results")
TITLES = {"wedge": "wedge", "tubes": "tubes", "tomography": "wedge, reconstructed"}
# Half of the wall counts as found, and nearly all of it.
FOUND = (50, 95)
NEAR = 0.1


def write(document, path):
    """JSON with one line per row."""
    head = json.dumps({key: value for key, value in document.items() if key != "rows"}, indent=2)
    rows = ",\n".join("    " + json.dumps(row) for row in document["rows"])
    path.write_text(f'{head[:-2]},\n  "rows": [\n{rows}\n  ]\n}}\n', encoding="utf-8")


def format_table(head, rows):
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in [head, ["---"] * len(head), *rows])


def is_found(row):
    return row["covered_percent"] is not None and row["covered_percent"] >= FOUND[0]


def show(row):
    """bias / rms / cells in their interval; a dash where less than half of the wall is found."""
    if not is_found(row) or not row["cells"]:
        return "-"
    text = f"{row['bias']:+.2f} / {row['rms']:.2f}"
    return text if row["in_interval_percent"] is None else f"{text} / {row['in_interval_percent']:.0f}"


def find_smallest(rows, is_good):
    """Smallest wall that is good and that all thicker ones are too, or a dash."""
    smallest = None
    for row in sorted(rows, key=lambda row: -row["wall"]):
        if not is_good(row):
            break
        smallest = row["wall"]
    return "-" if smallest is None else f"{smallest:g}"


def measured(row):
    return is_found(row) and row["cells"] > 0 and abs(row["bias"]) <= NEAR


def measured_by_edges(row):
    return (row["edge_found_percent"] or 0) >= FOUND[0] and abs(row["edge_bias"]) <= NEAR


def select(rows, **values):
    return [row for row in rows if all(row[key] == value for key, value in values.items())]


def cases_of(rows):
    """(blur, noise, percent) in the order of the rows, white first."""
    cases = dict.fromkeys((row["blur"], row["noise"], row["noise_percent"]) for row in rows)
    return sorted(cases, key=lambda case: (str(case[0]), case[1] != "white", case[2]))


def noise_name(noise, percent):
    if noise == "photons":
        return f"{percent} photons"
    return "none" if percent == 0 else f"{percent} % {noise}"


def format_errors(rows, what=show):
    walls = sorted({row["wall"] for row in rows})
    lines = []
    for blur, noise, percent in cases_of(rows):
        found = {row["wall"]: row for row in select(rows, blur=blur, noise=noise, noise_percent=percent)}
        lines.append([blur, noise_name(noise, percent), *(what(found[wall]) if wall in found else "" for wall in walls)])
    return format_table(["blur", "noise", *(f"{wall:g}" for wall in walls)], lines)


def format_limits(rows):
    lines = []
    for blur, noise, percent in cases_of(rows):
        case = select(rows, blur=blur, noise=noise, noise_percent=percent)
        words = [find_smallest(case, lambda row, share=share: (row["covered_percent"] or 0) >= share) for share in FOUND]
        words += [find_smallest(case, measured), find_smallest(case, measured_by_edges)]
        lines.append([blur, noise_name(noise, percent), *words])
    return format_table(["blur", "noise", "half found", "95 % found", "measured within 0.1", "edges within 0.1"], lines)


def repeat(row):
    return "-" if not is_found(row) or row["repeatability"] is None else f"{row['repeatability']:.3f}"


def covered(row):
    return f"{row['covered_percent']:.0f}" if row["covered_percent"] is not None else ""


def edge(row):
    if (row["edge_found_percent"] or 0) < FOUND[0]:
        return "-"
    return f"{row['edge_bias']:+.2f} / {row['edge_rms']:.2f}"


SECTIONS = {
    "bias / rms / cells in their 95 % interval": show,
    "repeatability": repeat,
    "covered, %": covered,
    "half-contrast crossings along the true normal, bias / rms": edge,
}


def format_all(document):
    parts = [f"{key}: {json.dumps(document[key])}" for key in ("program", "levels", "checks", "reconstructed") if key in document]
    for kind in dict.fromkeys(row["part"] for row in document["rows"]):
        rows = select(document["rows"], part=kind)
        parts += [f"## {TITLES.get(kind, kind)}", format_limits(rows)]
        for title, what in SECTIONS.items():
            parts += [f"### {title}", format_errors(rows, what)]
    return "\n\n".join(parts)


def format_limits_of_page(rows):
    """Noise over blur: smallest wall found by half, by 95 %, and measured."""
    blurs = sorted({row["blur"] for row in rows})
    lines = []
    for noise, percent in dict.fromkeys((noise, percent) for _, noise, percent in cases_of(rows)):
        words = []
        for blur in blurs:
            case = select(rows, blur=blur, noise=noise, noise_percent=percent)
            goals = [lambda row, share=share: (row["covered_percent"] or 0) >= share for share in FOUND]
            words.append(" / ".join(find_smallest(case, goal) for goal in [*goals, measured]))
        lines.append([noise_name(noise, percent), *words])
    return format_table(["noise", *(f"blur {blur:g}" for blur in blurs)], lines)


PAGE_CASES = (("white", 0), ("white", 10), ("white", 20), ("white", 40), ("correlated", 20))
PAGE_BLURS, PAGE_WALLS = (0.8, 1.5), (2, 3, 6, 16)


def format_page(document):
    """The tables of doc/explanation/accuracy.md."""
    rows = select(document["rows"], part="wedge")
    shown = [row for row in rows if row["blur"] in PAGE_BLURS and row["wall"] in PAGE_WALLS]
    shown = [row for row in shown if (row["noise"], row["noise_percent"]) in PAGE_CASES]
    return "\n\n".join([format_limits_of_page([row for row in rows if row["noise_percent"] != 5]), format_errors(shown)])


def pool(rows):
    """Rows of one wall in several parts, as one; cells count evenly."""
    cells = sum(row["cells"] for row in rows)

    def mean(name):
        return sum(row["cells"] * row[name] for row in rows if row["cells"]) / max(cells, 1)

    return {
        **rows[0],
        "cells": cells,
        "bias": mean("bias"),
        "rms": (sum(row["cells"] * row["rms"] ** 2 for row in rows if row["cells"]) / max(cells, 1)) ** 0.5,
        "in_interval_percent": mean("in_interval_percent"),
    }


def format_thin_walls(document):
    """Flat walls and tubes together, and the other parts; walls that the lower threshold has by that one."""
    low = {(row["part"].split(",")[0], row["wall"]) for row in document["rows"] if "threshold" in row["part"]}
    groups = {}
    for row in document["rows"]:
        kind = row["part"].split(",")[0]
        has_low = (kind, row["wall"]) in low and row["noise_percent"] <= 10
        if is_found(row) and has_low == ("threshold" in row["part"]):
            name = "plates and tubes" if kind in ("plates", "tubes") else kind
            case = (row["blur"], row["noise"], row["noise_percent"], row["wall"])
            groups.setdefault(name, {}).setdefault(case, []).append(row)
    parts = []
    for name, cases in sorted(groups.items(), reverse=True):
        parts += [name, format_errors([pool(rows) for rows in cases.values()])]
    return "\n\n".join(parts)


PAGES = {"--page": format_page, "--thin-walls": format_thin_walls}


def main():
    words = [word for word in sys.argv[1:] if word not in PAGES]
    path = pathlib.Path(words[0]) if words else RESULTS / "step-wedge.json"
    document = json.loads(path.read_text(encoding="utf-8"))
    format_one = next((PAGES[word] for word in sys.argv if word in PAGES), format_all)
    print(format_one(document))


if __name__ == "__main__":
    main()
