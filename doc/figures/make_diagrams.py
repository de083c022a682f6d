#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Draws definitions.svg and window.svg next to this file; what they show is computed by brute force."""

import heapq
import math
import pathlib

FOLDER = pathlib.Path(__file__).resolve().parent
CELL = 24
OBJECT, BOUNDARY, BACKGROUND, LINE = "#c9d3df", "#51606f", "#ffffff", "#e3e6ea"
MEDIAL, NEAREST, PATH = "#c8102e", "#1f6fb2", "#e08a00"
STEPS = [(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1) if (dx, dy) != (0, 0)]


def wall(width, height):
    """A wall of 4 voxels with a free end at the right."""
    return {(x, y) for x in range(width - 6) for y in range(height) if abs(y - 5.5) < 2}


def boundary_of(voxels, width, height):
    inside = {(x, y) for x in range(width) for y in range(height)}
    return {(x, y) for x, y in inside - voxels if any((x + dx, y + dy) in voxels for dx, dy in STEPS)}


def nearest(boundary, v):
    return min(boundary, key=lambda b: ((b[0] - v[0]) ** 2 + (b[1] - v[1]) ** 2, b[1], b[0]))


def shortest_path(boundary, start, end):
    queue, best = [(0.0, start, None)], {}
    while queue:
        length, node, previous = heapq.heappop(queue)
        if node in best:
            continue
        best[node] = previous
        for dx, dy in STEPS:
            following = (node[0] + dx, node[1] + dy)
            if following in boundary:
                heapq.heappush(queue, (length + math.hypot(dx, dy), following, node))
    path = [end]
    while path[-1] != start:
        path.append(best[path[-1]])
    return path


class Drawing:
    def __init__(self, width, height):
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif">',
            "<!-- SPDX-FileCopyrightText: MedialVoxel contributors -->",
            "<!-- SPDX-License-Identifier: Apache-2.0 -->",
            '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="6" markerHeight="6"'
            f' orient="auto"><path d="M0 0L8 4L0 8z" fill="{NEAREST}"/></marker></defs>',
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
        ]

    def rectangle(self, x, y, width, height, fill, stroke, extra=""):
        self.parts.append(
            f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{fill}" stroke="{stroke}"{extra}/>'
        )

    def line(self, points, stroke, width, extra=""):
        text = " ".join(f"{x},{y}" for x, y in points)
        self.parts.append(
            f'<polyline points="{text}" fill="none" stroke="{stroke}" stroke-width="{width}"{extra}/>'
        )

    def circle(self, x, y, radius, fill):
        self.parts.append(f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{fill}"/>')

    def text(self, x, y, text, fill="#22292f", size=15):
        self.parts.append(f'<text x="{x}" y="{y}" font-size="{size}" fill="{fill}">{text}</text>')

    def save(self, name):
        (FOLDER / name).write_text("\n".join(self.parts + ["</svg>", ""]), encoding="utf-8")


def center(v):
    return CELL * (v[0] + 0.5), CELL * (v[1] + 0.5)


def draw_cell(drawing, boundary, corner, diagonal, color):
    """A dual cell, its pair, their nearest boundary points and the geodesic between those."""
    ends = [(corner[0] + dx, corner[1] + dy) for dx, dy in diagonal]
    points = [nearest(boundary, v) for v in ends]
    path = shortest_path(boundary, *points)
    drawing.line([center(v) for v in path], PATH, 4, ' stroke-linejoin="round" stroke-linecap="round"')
    for v, point in zip(ends, points):
        if v != point:
            drawing.line([center(v), center(point)], NEAREST, 2, ' marker-end="url(#tip)"')
        drawing.circle(*center(v), 4, NEAREST)
    x, y = CELL * (corner[0] + 1), CELL * (corner[1] + 1)
    drawing.rectangle(x - 6, y - 6, 12, 12, color, "#ffffff")


def draw_definitions():
    width, height = 27, 12
    voxels = wall(width, height)
    boundary = boundary_of(voxels, width, height)
    drawing = Drawing(CELL * width, CELL * height + 34)
    for x in range(width):
        for y in range(height):
            fill = OBJECT if (x, y) in voxels else BOUNDARY if (x, y) in boundary else BACKGROUND
            drawing.rectangle(CELL * x, CELL * y, CELL, CELL, fill, LINE)
    draw_cell(drawing, boundary, (14, 5), [(0, 0), (1, 1)], MEDIAL)
    draw_cell(drawing, boundary, (4, 4), [(0, 0), (1, 1)], "#2e8540")
    base = CELL * height + 22
    for x, color, label in (
        (8, OBJECT, "object"),
        (82, BOUNDARY, "boundary B"),
        (190, NEAREST, "pair, vectors to N"),
        (342, PATH, "geodesic"),
        (430, MEDIAL, "medial cell"),
        (530, "#2e8540", "non-medial"),
    ):
        drawing.rectangle(x, base - 10, 11, 11, color, "#9aa5b1")
        drawing.text(x + 16, base, label, size=13)
    drawing.save("definitions.svg")


def draw_window():
    drawing = Drawing(680, 300)
    drawing.rectangle(20, 15, 420, 270, "#f4f6f8", "#9aa5b1")
    drawing.text(28, 34, "image", "#6b7680")
    drawing.rectangle(140, 65, 190, 160, "#dfe8f1", BOUNDARY)
    drawing.text(146, 82, "W", BOUNDARY)
    drawing.rectangle(190, 110, 90, 70, OBJECT, BOUNDARY)
    drawing.text(222, 150, "tile")
    drawing.line([(250, 110), (250, 65)], BOUNDARY, 1.5, ' stroke-dasharray="5 4"')
    drawing.text(256, 92, "\u03b4")
    drawing.line([(200, 126), (176, 110)], NEAREST, 2, ' marker-end="url(#tip)"')
    drawing.circle(200, 126, 4, NEAREST)
    drawing.line([(272, 172), (322, 221)], MEDIAL, 2)
    drawing.circle(272, 172, 4, MEDIAL)
    drawing.rectangle(120, 40, 230, 210, "none", MEDIAL, ' stroke-dasharray="7 4"')
    drawing.text(456, 60, "W: where the boundary", BOUNDARY)
    drawing.text(456, 80, "is known", BOUNDARY)
    drawing.text(456, 122, "d &lt; \u03b4: final", NEAREST)
    drawing.text(456, 172, "d \u2265 \u03b4: the dashed", MEDIAL)
    drawing.text(456, 192, "window, which reaches d", MEDIAL)
    drawing.text(456, 212, "around the tile, suffices", MEDIAL)
    drawing.save("window.svg")


if __name__ == "__main__":
    draw_definitions()
    draw_window()
