#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Renders a volume's object, its medial voxels and one section with both (needs python3-numpy and python3-pil).

Usage: doc/figures/make_picture.py VOLUME LOWER-THRESHOLD LABELS.mha OUTPUT.png [--thickness-map MAP.mha]
VOLUME is a .mha file or headerless bytes named by --raw-size X,Y,Z; .mha files are uncompressed bytes or zlib-packed.
Medial cells are white (blue in the section) where a bound decided them and red where a geodesic search did, or have the
color of the thickness in the map: from dark violet (5 % of the cells are thinner) to yellow (5 % are thicker); then
the section shows them all red.
"""

import argparse
import math
import pathlib
import zlib

import numpy
from PIL import Image

WIDTH, HEIGHT = 840, 760  # of a panel, before it is halved
PAPER, OBJECT, BY_BOUND, BY_GEODESIC = (255, 255, 255), (150, 165, 182), (225, 228, 232), (200, 30, 45)
SECTION_BY_BOUND = (25, 60, 120)
TYPES = {"MET_UCHAR": "u1", "MET_SHORT": "<i2", "MET_USHORT": "<u2", "MET_FLOAT": "<f4"}
# The colors of thickness, with equal steps of lightness.
THIN_TO_THICK = ((68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume", type=pathlib.Path)
    parser.add_argument("threshold", type=float)
    parser.add_argument("labels", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--raw-size")
    parser.add_argument("--thickness-map", type=pathlib.Path)
    parser.add_argument("--turn", type=float, default=35.0, help="about the z axis")
    parser.add_argument("--tilt", type=float, default=55.0, help="of the z axis towards the viewer")
    parser.add_argument("--slice", type=int, help="of the section; default: the middle one")
    return parser.parse_args()


def read_meta_image(path):
    content = path.read_bytes()
    end = content.index(b"\n", content.index(b"ElementDataFile")) + 1
    header = dict(line.split(" = ") for line in content[:end].decode("ascii").splitlines())
    data = content[end:]
    if header.get("CompressedData") == "True":
        data = zlib.decompress(data)
    size = [int(n) for n in header["DimSize"].split()]
    return numpy.frombuffer(data, TYPES[header["ElementType"]]).reshape(size[::-1])


def read_volume(path, raw_size):
    if not raw_size:
        return read_meta_image(path)
    return numpy.fromfile(path, numpy.uint8).reshape([int(n) for n in raw_size.split(",")][::-1])


def surface_of(inside):
    """Voxels with a face neighbor outside; the others cannot be seen."""
    padded = numpy.pad(inside, 1)
    hidden = inside.copy()
    for axis in range(3):
        for step in (-1, 1):
            hidden &= numpy.roll(padded, step, axis)[1:-1, 1:-1, 1:-1]
    return inside & ~hidden


def project(points, size, turn, tilt):
    """Positions right and down the picture and towards the viewer of (z, y, x) points, in voxels."""
    z, y, x = (points[:, k] - size[k] / 2 for k in range(3))
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    u, v = c * x - s * y, s * x + c * y
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    return u, c * v - s * z, s * v + c * z


def frame_of(u, v):
    """Scale and shift that fit the projected points into the picture."""
    scale = 0.96 * min(WIDTH / numpy.ptp(u), HEIGHT / numpy.ptp(v))
    return scale, WIDTH / 2 - scale * (u.max() + u.min()) / 2, HEIGHT / 2 - scale * (v.max() + v.min()) / 2


def render(points, colors, view, frame):
    """Draw each point as a square of a voxel's size, the nearest in front."""
    u, v, height = project(points, *view)
    scale, shift_u, shift_v = frame
    depth = numpy.full((HEIGHT, WIDTH), -1e9)
    picture = numpy.empty((HEIGHT, WIDTH, 3))
    picture[:] = PAPER
    order = numpy.argsort(height)
    reach = int(math.ceil(0.7 * scale))
    for dx in range(-reach, reach + 1):
        for dy in range(-reach, reach + 1):
            column = numpy.clip((u * scale + shift_u + dx).astype(int), 0, WIDTH - 1)[order]
            row = numpy.clip((v * scale + shift_v + dy).astype(int), 0, HEIGHT - 1)[order]
            nearer = height[order] > depth[row, column]
            row, column, shown = row[nearer], column[nearer], order[nearer]
            depth[row, column] = height[shown]
            picture[row, column] = colors[shown]
    return shade(depth, picture, scale)


def shade(depth, picture, scale):
    """Light from the upper left, on the slopes of the depth."""
    seen = depth > -1e8
    smooth = numpy.where(seen, depth, depth[seen].min())
    for _ in range(4):
        smooth = (smooth + sum(numpy.roll(smooth, step, axis) for axis in (0, 1) for step in (-1, 1))) / 5
    slope_y, slope_x = numpy.gradient(smooth * scale)
    light = (0.35 * slope_x + 0.5 * slope_y + 0.8) / numpy.sqrt(1.0 + slope_x**2 + slope_y**2)
    picture[seen] *= numpy.clip(0.3 + 0.75 * light, 0.25, 1.1)[seen, None]
    return numpy.clip(picture, 0, 255).astype(numpy.uint8)


def colors_of_thickness(cells, path):
    """Colors of cells by the thickness of their wall, which at rims is that of the negative number there."""
    thickness = numpy.abs(read_meta_image(path)[tuple(cells.T)])
    place = numpy.interp(thickness, numpy.percentile(thickness, (5, 95)), (0, len(THIN_TO_THICK) - 1))
    stops = numpy.array(THIN_TO_THICK, float)
    return numpy.stack([numpy.interp(place, range(len(stops)), stops[:, k]) for k in range(3)], axis=1)


def draw_section(inside, cells, colors, slice_number):
    picture = numpy.empty(inside.shape[1:] + (3,), numpy.uint8)
    picture[:] = PAPER
    picture[inside[slice_number]] = OBJECT
    here = cells[:, 0] == slice_number
    picture[tuple(cells[here, 1:].T)] = colors[here]
    rows, columns = (numpy.flatnonzero(inside[slice_number].any(axis)) for axis in (1, 0))
    picture = picture[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    scale = 0.96 * min(WIDTH / picture.shape[1], HEIGHT / picture.shape[0])
    size = (int(picture.shape[1] * scale), int(picture.shape[0] * scale))
    section = Image.fromarray(picture).resize(size, Image.Resampling.NEAREST)
    panel = Image.new("RGB", (WIDTH, HEIGHT), PAPER)
    panel.paste(section, ((WIDTH - section.width) // 2, (HEIGHT - section.height) // 2))
    return panel


def main():
    arguments = parse_arguments()
    inside = read_volume(arguments.volume, arguments.raw_size) >= arguments.threshold
    labels = read_meta_image(arguments.labels)
    view = (inside.shape, arguments.turn, arguments.tilt)

    points = numpy.argwhere(surface_of(inside))
    frame = frame_of(*project(points, *view)[:2])
    left = render(points, numpy.tile(numpy.array(OBJECT, float), (len(points), 1)), view, frame)

    cells = numpy.argwhere(labels >= 2)
    is_by_bound = labels[tuple(cells.T)] == 2
    colors = numpy.where(is_by_bound[:, None], BY_BOUND, BY_GEODESIC).astype(float)
    section_colors = numpy.where(is_by_bound[:, None], SECTION_BY_BOUND, BY_GEODESIC)
    if arguments.thickness_map:
        colors = colors_of_thickness(cells, arguments.thickness_map)
        section_colors = numpy.tile(BY_GEODESIC, (len(cells), 1))
    right = render(cells + 0.5, colors, view, frame)

    slice_number = arguments.slice if arguments.slice is not None else len(inside) // 2
    section = draw_section(inside, cells, section_colors, slice_number)
    picture = Image.fromarray(numpy.hstack([left, right, numpy.asarray(section)]))
    picture = picture.resize((picture.width // 2, picture.height // 2), Image.Resampling.LANCZOS)
    picture.quantize(96, dither=Image.Dither.NONE).save(arguments.output, optimize=True)


if __name__ == "__main__":
    main()
