# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Thin and thick places from a thickness map, by a flood fill."""

import csv
import itertools
import struct


def read_places(path):
    """Rows of a table of places, with numbers as numbers."""

    def convert(name, text):
        if name == "kind":
            return text
        if name == "uncertainty":
            return float(text) if text else None
        return int(text) if name in ("place", "cells", "at_edge") or name.startswith(("index_", "first_", "last_")) else float(text)

    with open(path, newline="", encoding="ascii") as file:
        return [{name: convert(name, text) for name, text in row.items()} for row in csv.DictReader(file)]


def find_places(values, size, kind, limit, grow_limit):
    """Connected cells of a map, x fastest, that are beyond the second limit and have one beyond the first, as rows of
    the table have them; sorted by the index of the worst cell. Limits have the precision of the map."""
    limit, grow_limit = struct.unpack("2f", struct.pack("2f", limit, grow_limit))
    sign = 1 if kind == "thin" else -1
    size = (*size, 1)[:3]
    steps = [step for step in itertools.product((-1, 0, 1), repeat=3) if any(step)]

    def index_of(cell):
        return cell % size[0], cell // size[0] % size[1], cell // (size[0] * size[1])

    waiting = {cell for cell, value in enumerate(values) if value > 0 and sign * value < sign * grow_limit}
    places = []
    while waiting:
        border = [waiting.pop()]
        cells = []
        while border:
            cell = border.pop()
            cells.append(cell)
            at = index_of(cell)
            for step in steps:
                next_to = [a + s for a, s in zip(at, step)]
                if all(0 <= n < s for n, s in zip(next_to, size)):
                    neighbor = (next_to[2] * size[1] + next_to[1]) * size[0] + next_to[0]
                    if neighbor in waiting:
                        waiting.remove(neighbor)
                        border.append(neighbor)
        worst = min(cells, key=lambda cell: (sign * values[cell], cell))
        if sign * values[worst] < sign * limit:
            found = [values[cell] for cell in cells]
            corners = list(zip(*map(index_of, cells)))
            places.append(
                {
                    "cells": len(cells),
                    "minimum": min(found),
                    "mean": sum(found) / len(found),
                    "maximum": max(found),
                    "index": index_of(worst),
                    "first": tuple(map(min, corners)),
                    "last": tuple(map(max, corners)),
                    "members": cells,
                }
            )
    return sorted(places, key=lambda place: place["index"][::-1])
