#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares parts, tunnels and cavities of the labels 2, 3 and 4 with those of the object, by the homology of GUDHI.

Usage: bench/check_topology.py OUTPUT.json DATA [NUMBER [SEED]]    needs numpy, scipy, gudhi and the package medialvoxel
NUMBER random volumes of 5 to 24 voxels a side, as many random label maps, phantoms, and crops of the volumes in DATA. The object is the union of its voxels as
closed cubes, so that voxels that touch at a corner are joined: GUDHI's complex of top-dimensional cells. The complex of the cells
has all faces of these cubes whose corners are in the set: GUDHI's complex of simplices.
"""

import itertools
import json
import pathlib
import sys
import time
import zlib

import gudhi
import medialvoxel
import numpy as np
from scipy import ndimage

CORNERS = np.ones((3, 3, 3))
FACES = ndimage.generate_binary_structure(3, 1)
CROP = 40  # voxels a side of the crops of real volumes
PORE_SIZE = 32  # the default with automatic thickness


def betti_numbers(cubes):
    """Of a union of closed cubes."""
    if not cubes.any():
        return [0, 0, 0]
    cubes = cubes[ndimage.find_objects(cubes.astype(np.uint8))[0]]
    filtration = gudhi.CubicalComplex(top_dimensional_cells=np.where(cubes, 0.0, 1.0))
    filtration.compute_persistence()
    return (filtration.persistent_betti_numbers(0.0, 0.0) + [0, 0, 0])[:3]


def shift(values, offset, size):
    """The part of the values from an offset on."""
    return values[tuple(slice(o, o + n) for o, n in zip(offset, size))]


def betti_numbers_of_cells(cells, voxels):
    """Of the complex of a set of cells. Each face is divided into simplices, one for each order of its axes."""
    numbers = np.arange(cells.size).reshape(cells.shape)
    tree = gudhi.SimplexTree()
    for odd in itertools.product((0, 1), repeat=3):
        size = [n - o for n, o in zip(cells.shape, odd)]
        faces = np.zeros(size, bool)
        for offset in itertools.product(*((1,) if o else (0, 1) for o in odd)):
            faces |= shift(voxels, offset, size)
        for offset in itertools.product(*(range(o + 1) for o in odd)):
            faces &= shift(cells, offset, size)
        for order in itertools.permutations(np.flatnonzero(odd)):
            steps = [[int(axis in order[:n]) for axis in range(3)] for n in range(len(order) + 1)]
            tree.insert_batch(np.array([shift(numbers, step, size)[faces] for step in steps]), np.zeros(faces.sum()))
    tree.compute_persistence(persistence_dim_max=True)
    return (tree.betti_numbers() + [0, 0, 0])[:3]


def fill_small(background, most, structure):
    """The components of at most so many voxels without one at a face of the image."""
    parts, number = ndimage.label(background, structure)
    small = np.bincount(parts.ravel(), minlength=number + 1) <= most
    small[0] = False
    for axis, end in itertools.product(range(3), (0, -1)):
        small[np.take(parts, end, axis)] = False
    return small[parts]


def without_noise(mask, most):
    """Pores become object, then grains background; closed pores are no cavities."""
    filled = mask | fill_small(~mask, most, CORNERS)
    kept = filled & ~fill_small(filled, most, CORNERS)
    return kept, kept | fill_small(~kept, most, FACES)


def check(name, mask, max_pore_size, **keywords):
    """A row of the results."""
    kept, filled = without_noise(mask, max_pore_size) if max_pore_size else (mask, mask)
    keywords["max_pore_size"] = max_pore_size
    start = time.process_time()
    plain = medialvoxel.extract(mask, thickness_map=False, **keywords)
    middle = time.process_time()
    found = medialvoxel.extract(mask, thickness_map=False, same_topology=True, **keywords)
    seconds = [middle - start, time.process_time() - middle]
    inner = found.labels[tuple(slice(0, -1) for _ in range(3))]
    of_object = betti_numbers(filled)
    # Voxels at a face of the image have no corners there; the others hold all that counts.
    of_sheet = betti_numbers_of_cells(inner >= 2, filled)
    told = [[found.topology[kind][name] for name in ("parts", "tunnels", "cavities")] for kind in ("object", "sheet")]
    return {
        "name": name,
        "voxels": int(mask.size),
        "object_voxels": int(kept.sum()),
        "medial_cells": int(plain.medial.sum()),
        "added_cells": int((found.labels == 4).sum()),
        "betti_numbers": of_object,
        "betti_numbers_of_medial_cells": betti_numbers_of_cells((inner == 2) | (inner == 3), filled),
        "seconds": [round(second, 4) for second in seconds],
        "same_object": found.counts["object_voxels"] == int(kept.sum()),
        "passes": of_object == of_sheet
        and told == [of_object, of_sheet]
        and bool(((found.labels == plain.labels) | (found.labels == 4) & (plain.labels <= 1)).all()),
    }


def random_map(draw):
    """Labels of objects that touch, in parts of other objects, or apart."""
    mask = random_mask(draw)
    z, y, x = np.indices(mask.shape)
    if draw.random() < 0.5:
        seeds = [draw.integers(mask.shape) for _ in range(draw.integers(2, 6))]
        nearest = np.argmin([(z - a) ** 2 + (y - b) ** 2 + (x - c) ** 2 for a, b, c in seeds], axis=0)
        labels = np.where(mask, 1 + nearest, 0)
    else:
        labels = np.where(mask, 1, np.where(ndimage.binary_erosion(~mask, iterations=int(draw.integers(3))), draw.integers(3), 0))
    labels[0, 0, 0] *= not labels.all()
    return labels.astype(np.uint8)


def check_map(name, labels, max_pore_size, **keywords):
    """A row of the results. Each object is the complex of its own cells, unless another object has some of them: then that of a run
    with its label alone, which the map is put together from."""
    keywords |= {"max_pore_size": max_pore_size, "thickness_map": False, "same_topology": True}
    found = medialvoxel.extract(labels, labels="all", **keywords)
    sheets, sums, passes, own = {}, np.zeros((2, 3), int), True, 0
    for label in np.unique(labels[labels > 0]):
        kept, filled = without_noise(labels == label, max_pore_size) if max_pore_size else (labels == label,) * 2
        alone = medialvoxel.extract(labels, label=int(label), smooth=False, **keywords).labels
        sheets[label] = alone
        inner = tuple(slice(0, -1) for _ in range(3))
        sheet = (found.objects == label) & (found.labels >= 2)
        own += int((sheet == (alone >= 2)).all())
        cells = sheet if (sheet == (alone >= 2)).all() else alone >= 2
        numbers = betti_numbers(filled), betti_numbers_of_cells(cells[inner], filled)
        sums += numbers
        passes &= numbers[0] == numbers[1]
    expected = np.max([np.select([sheet >= 4, sheet >= 2], [1, 2], 0) for sheet in sheets.values()], axis=0)
    told = [[found.topology[kind][part] for part in ("parts", "tunnels", "cavities")] for kind in ("object", "sheet")]
    passes &= told == sums.tolist() and bool((np.select([found.labels == 4, found.labels >= 2], [1, 2], 0) == expected).all())
    return {"name": name, "objects": len(sheets), "objects_with_all_their_cells": own, "passes": bool(passes)}


def check_maps(number, seed):
    rows = []
    for i in range(number):
        draw = np.random.default_rng([seed, i, 1])
        labels = random_map(draw)
        keywords = {"max_pore_size": int(draw.choice((0, 0, 3, 32))), "thickness": ("auto", 1.5, 3.0)[draw.integers(3)]}
        if labels.any():
            rows.append(check_map(f"map {seed} {i}", labels, threads=1 + i % 2, **keywords))
            if not rows[-1]["passes"]:
                print(rows[-1], keywords, flush=True)
    sums = {name: sum(row[name] for row in rows) for name in ("objects", "objects_with_all_their_cells")}
    return {"maps": len(rows), **sums, "failures": [row["name"] for row in rows if not row["passes"]]}


def share_when_smoothed(mask):
    """Of added cells; the smoothed object is not known here, so that nothing is compared."""
    labels = medialvoxel.extract(mask, thickness_map=False, same_topology=True, smooth=True).labels
    return int((labels == 4).sum()) / max(int(((labels == 2) | (labels == 3)).sum()), 1)


def random_mask(draw):
    size = draw.integers(5, 25 if draw.random() < 0.1 else 15, 3)
    z, y, x = (index - (n - 1) / 2 for index, n in zip(np.indices(size), size))
    normal = draw.normal(size=3)
    height = (np.stack((z, y, x), -1) @ normal) / np.linalg.norm(normal)
    kind = draw.integers(6)
    if kind == 0:
        return draw.random(size) < draw.uniform(0.1, 0.95)
    if kind == 1:
        noise = ndimage.gaussian_filter(draw.normal(size=size), draw.uniform(0.6, 2))
        return noise > np.quantile(noise, draw.uniform(0.2, 0.9))
    if kind == 2:
        return (abs(height) < draw.uniform(0.6, 4)) ^ (draw.random(size) < draw.uniform(0, 0.2))
    if kind == 3:
        mask = np.zeros(size, bool)
        for _ in range(draw.integers(2, 9)):
            low = [draw.integers(n) for n in size]
            mask[tuple(slice(a, a + draw.integers(1, 9)) for a in low)] ^= True
        return mask
    if kind == 4:
        seeds = draw.random(size) < draw.uniform(0.005, 0.1)
        return ndimage.binary_dilation(seeds, CORNERS if draw.random() < 0.5 else FACES, iterations=int(draw.integers(1, 4)))
    step = draw.uniform(0.5, 1.2)
    waves = np.sin(x * step) * np.cos(y * step) + np.sin(y * step) * np.cos(z * step) + np.sin(z * step) * np.cos(x * step)
    return abs(waves) < draw.uniform(0.2, 1)


def phantoms():
    """Walls, clean and with a tenth of the voxels at their border flipped: those beside it across a face, or across a corner, too.
    A voxel that touches the others at an edge or corner alone makes a tunnel where it touches them twice."""
    draw = np.random.default_rng(7)
    z, y, x = np.indices((44, 44, 44)) - 21.5
    tilted = (0.31 * x + 0.22 * y + 0.925 * z) / np.linalg.norm((0.31, 0.22, 0.925))
    inside = np.maximum(np.maximum(abs(x), abs(y)), abs(z)) < 18
    radius = np.sqrt(x**2 + y**2 + z**2)
    shapes = {f"plate {t}": (abs(z - 0.5 * (t % 2)) <= t / 2) & inside for t in (1, 2, 3, 4, 5, 8)}
    shapes |= {f"tilted plate {t}": (abs(tilted) <= t / 2) & inside for t in (2, 3, 4, 5, 6, 8)}
    shapes |= {f"shell {t}": abs(radius - 14) <= t / 2 for t in (3, 4, 6)}
    shapes["T of 4"] = ((abs(z) <= 2) | (abs(x) <= 2) & (z > 0)) & inside
    for name, mask in shapes.items():
        yield name, mask
        for across, structure in (("faces", FACES), ("corners", CORNERS)):
            border = ndimage.binary_dilation(mask, structure) & ~ndimage.binary_erosion(mask, structure)
            yield f"{name}, flips across {across}", mask ^ (border & (draw.random(mask.shape) < 0.1))


def read_volume(path):
    header, data = path.read_bytes().split(b"LOCAL\n", 1)
    fields = dict(line.split(" = ") for line in header.decode().splitlines() if " = " in line)
    kind = {"MET_UCHAR": "u1", "MET_SHORT": "<i2", "MET_USHORT": "<u2"}[fields["ElementType"]]
    data = zlib.decompress(data) if fields.get("CompressedData") == "True" else data
    return np.frombuffer(data, kind).reshape([int(n) for n in fields["DimSize"].split()][::-1])


def crops(data, draw):
    for name, lower in (("engine", 72), ("cranium", 200)):
        path = data / f"{name}.mha"
        if not path.exists():
            continue
        values = read_volume(path)
        for _ in range(6):
            corner = [int(draw.integers(max(1, n - CROP))) for n in values.shape]
            crop = values[tuple(slice(c, c + CROP) for c in corner)] >= lower
            yield f"{name} at {corner[::-1]}", np.ascontiguousarray(crop)


def main():
    output, data = map(pathlib.Path, sys.argv[1:3])
    number, seed = (int(word) for word in [*sys.argv[3:], *["1000", "1"][len(sys.argv) - 3 :]])
    rows = []
    for i in range(number):
        draw = np.random.default_rng([seed, i])
        mask = random_mask(draw)
        mask[0, 0, 0] &= not mask.all()  # without background there is no distance
        keywords = {"smooth": False, "max_pore_size": int(draw.choice((0, 0, 3, 32)))}
        keywords["thickness"] = ("auto", 1.5, 3.0, 5.0)[draw.integers(4)]
        rows.append(check(f"random {seed} {i}", mask, threads=1 + i % 2, **keywords))
        if not rows[-1]["passes"] or i % 1000 == 999:
            print(rows[-1], keywords, flush=True)
    large = [
        check(name, mask, PORE_SIZE, smooth=False) | {"phantom": True, "share_when_smoothed": share_when_smoothed(mask)}
        for name, mask in phantoms()
    ]
    large += [check(name, mask, PORE_SIZE, smooth=False) for name, mask in crops(data, np.random.default_rng(seed))]
    for row in large:
        row["share"] = row["added_cells"] / max(row["medial_cells"], 1)
        print(row["name"], f"{row['share']:.3%}", row["betti_numbers"], row["passes"])
    everything = rows + large
    result = {
        "random_volumes": number,
        "failures": [row["name"] for row in everything if not row["passes"]],
        "other_objects": sum(not row["same_object"] for row in everything),
        "tunnels_of_random_volumes": sum(row["betti_numbers"][1] for row in rows),
        "cavities_of_random_volumes": sum(row["betti_numbers"][2] for row in rows),
        "random_with_another_topology_before": sum(
            row["betti_numbers"] != row["betti_numbers_of_medial_cells"] for row in rows
        ),
        "label_maps": check_maps(number, seed),
        "volumes": large,
    }
    output.write_text(json.dumps(result, indent=1) + "\n")
    print({key: value for key, value in result.items() if key != "volumes"})


if __name__ == "__main__":
    main()
