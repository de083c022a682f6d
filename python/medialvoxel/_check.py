# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The quality of a shell mesh in a file, as `medialvoxel mesh` reports it of its own: python -m medialvoxel check --help.

meshio reads the file. Scaled Jacobian and aspect ratio have no unit and are those of the Verdict library; places are in the
units of the file. Triangles and quadrilaterals are rows of four numbers of points, with -1 as the last one of a triangle.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import math
import os
import pathlib
import stat
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

# Exit statuses, which are those of the program.
_DONE, _LIMIT_FAILS, _USAGE, _REFUSED, _CORRUPT = range(5)

_NEAR_SIDE = 1e-3  # of the length of a side: a node that is nearer to it lies on it
_LARGEST_COORDINATE = 1e30  # products of six are still numbers
_PAIRS_AT_A_TIME = 1 << 20

_ROWS = {
    "nodes": "nodes",
    "triangles": "triangles",
    "quadrilaterals": "quadrilaterals",
    "sides of one element": "rim_sides",
    "sides of more than two": "junction_sides",
    "walls": "walls",
    "walls with one side only": "one_sided_walls",
    "least scaled Jacobian": "least_scaled_jacobian",
    "largest aspect ratio": "largest_aspect_ratio",
    "largest warpage": "largest_warpage",
    "least angle": "least_angle",
    "largest angle": "largest_angle",
    "shortest side": "shortest_side",
    "mean side": "mean_side",
    "longest side": "longest_side",
}


class CheckError(Exception):
    """A file that is not checked, with the exit status."""

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status


def _norm(vectors: NDArray[Any]) -> NDArray[Any]:
    return np.sqrt((vectors * vectors).sum(axis=-1))


def _divide(a: NDArray[Any], b: NDArray[Any], otherwise: float) -> NDArray[Any]:
    return np.divide(a, b, out=np.full(np.shape(a), otherwise), where=b > 0)


def _measure_shapes(points: NDArray[Any], elements: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Scaled Jacobians and aspect ratios of elements that all have three or all four corners."""
    number = elements.shape[1]
    corners = points[elements]
    sides = np.roll(corners, -1, axis=1) - corners
    lengths = _norm(sides)
    if number == 3:
        normals = np.cross(sides[:, 0], -sides[:, 2])
        products = (lengths * np.roll(lengths, -1, axis=1)).max(axis=1, initial=0)
        jacobians = _divide(_norm(normals), products, 0.0) * (2 / math.sqrt(3))
        best = 4 * math.sqrt(3)
    else:
        # The sum of the normals of the corners, twice the area in the mean.
        normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        before = np.roll(sides, 1, axis=1)
        products = _norm(before) * lengths * _norm(normals)[:, None]
        at_corners = _divide((np.cross(before, sides) * normals[:, None]).sum(axis=2), products, 0.0)
        jacobians = at_corners.min(axis=1, initial=1)
        best = 4.0
    aspects = _divide(lengths.max(axis=1, initial=0) * lengths.sum(axis=1), best * _norm(normals) / 2, math.inf)
    return jacobians, aspects


def _angles_between(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """In degrees; 0 where one of the vectors is zero."""
    return np.degrees(np.arccos(_divide((a * b).sum(axis=-1), _norm(a) * _norm(b), 1.0).clip(-1, 1)))


def _measure_warpage(corners: NDArray[Any]) -> NDArray[Any]:
    """Of quadrilaterals: the angle between the halves, along the diagonal where it is larger."""
    warpage = np.zeros(len(corners))
    for first in (0, 1):
        a, b, c, d = (corners[:, (first + k) % 4] for k in range(4))
        warpage = np.maximum(warpage, _angles_between(np.cross(b - a, c - a), np.cross(d - c, a - c)))
    return warpage


def _measure_sizes(points: NDArray[Any], elements: NDArray[Any]) -> dict[str, float]:
    """Warpage and angles in degrees, and lengths of sides."""
    is_triangle = elements[:, 3] < 0
    angles, lengths = [], []
    for corners in (points[elements[is_triangle, :3]], points[elements[~is_triangle]]):
        sides = np.roll(corners, -1, axis=1) - corners
        angles.append(_angles_between(sides, -np.roll(sides, 1, axis=1)).ravel())
        lengths.append(_norm(sides).ravel())
    all_angles, all_lengths = np.concatenate(angles), np.concatenate(lengths)
    warpage = np.sort(_measure_warpage(points[elements[~is_triangle]])) if not is_triangle.all() else np.zeros(1)
    return {
        "warpage_percentile_99": float(warpage[int(0.99 * (len(warpage) - 1))]),
        "largest_warpage": float(warpage[-1]),
        "least_angle": float(all_angles.min()),
        "largest_angle": float(all_angles.max()),
        "shortest_side": float(all_lengths.min()),
        "mean_side": float(all_lengths.mean()),
        "longest_side": float(all_lengths.max()),
    }


def _count_repeated(rows: NDArray[Any]) -> int:
    """How many of the rows come again."""
    ordered = rows[np.lexsort(rows.T)]
    return int((ordered[1:] == ordered[:-1]).all(axis=1).sum())


def _find_roots(number: int, a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """The lowest number that pairs of a and b join each number to."""
    roots = np.arange(number)
    while True:
        a, b = roots[a], roots[b]
        differ = a != b
        if not differ.any():
            return roots
        a, b = a[differ], b[differ]
        np.minimum.at(roots, np.maximum(a, b), np.minimum(a, b))
        while (roots[roots] != roots).any():
            roots = roots[roots]


def _count_walls(number: int, a: NDArray[Any], b: NDArray[Any], alike: NDArray[Any]) -> tuple[int, int, int]:
    """Walls, those with one side only, and others that are turned both ways.

    a, b: elements that share a side of no other one. alike: whether both go the same way along it."""
    # Each element stands for itself as it is and turned: what joins both has one side only.
    ways = np.concatenate((2 * a, 2 * a + 1)), np.concatenate((2 * b + alike, 2 * b + 1 - alike))
    roots = _find_roots(2 * number, *ways).reshape(-1, 2)
    walls = roots.min(axis=1)
    one_sided = np.unique(walls[roots[:, 0] == roots[:, 1]])
    turned = np.setdiff1d(walls[a[alike]], one_sided)
    return len(np.unique(walls)), len(one_sided), len(turned)


def _count_hanging(points: NDArray[Any], rims: NDArray[Any]) -> int:
    """Ends of rims that lie on another rim, between its ends."""
    nodes = np.unique(rims)
    if not len(nodes):
        return 0
    axis = int(np.argmax(np.ptp(points[nodes], axis=0)))
    nodes = nodes[np.argsort(points[nodes, axis])]
    places = points[nodes, axis]
    ends = points[rims]
    nears = _NEAR_SIDE * _norm(ends[:, 1] - ends[:, 0])
    first = np.searchsorted(places, ends[:, :, axis].min(axis=1) - nears, "left")
    last = np.searchsorted(places, ends[:, :, axis].max(axis=1) + nears, "right")
    hanging = np.zeros(len(nodes), bool)
    sums = np.concatenate(([0], np.cumsum(last - first)))
    begin = 0
    while begin < len(rims):
        end = max(begin + 1, int(np.searchsorted(sums, sums[begin] + _PAIRS_AT_A_TIME, "right")) - 1)
        sizes = (last - first)[begin:end]
        sides = np.repeat(np.arange(begin, end), sizes)
        others = np.arange(sizes.sum()) - np.repeat(sums[begin:end] - sums[begin] - first[begin:end], sizes)
        a, b, p, near = ends[sides, 0], ends[sides, 1], points[nodes[others]], nears[sides]
        along = b - a
        share = _divide(((p - a) * along).sum(axis=1), (along * along).sum(axis=1), 0.0).clip(0, 1)
        lies = _norm(p - (a + share[:, None] * along)) <= near
        lies &= (_norm(p - a) > near) & (_norm(p - b) > near) & (nodes[others, None] != rims[sides]).all(axis=1)
        hanging[others[lies]] = True
        begin = end
    return int(hanging.sum())


def _measure_sides(points: NDArray[Any], elements: NDArray[Any]) -> dict[str, int]:
    follower = np.roll(elements, -1, axis=1)
    is_triangle = elements[:, 3] < 0
    follower[is_triangle, 2] = elements[is_triangle, 0]
    is_side = elements >= 0
    owners = np.nonzero(is_side)[0]
    a, b = elements[is_side], follower[is_side]
    low, high = np.minimum(a, b), np.maximum(a, b)
    order = np.lexsort((high, low))
    low, high, owners, is_up = low[order], high[order], owners[order], (a < b)[order]
    begins = np.flatnonzero(np.concatenate(([True], (low[1:] != low[:-1]) | (high[1:] != high[:-1]))))
    numbers = np.diff(np.concatenate((begins, [len(low)])))
    pairs = begins[numbers == 2]
    rims = begins[numbers == 1]
    alike = is_up[pairs] == is_up[pairs + 1]
    walls, one_sided, turned = _count_walls(len(elements), owners[pairs], owners[pairs + 1], alike)
    return {
        "rim_sides": len(rims),
        "junction_sides": int((numbers > 2).sum()),
        "walls": walls,
        "one_sided_walls": one_sided,
        "turned_walls": turned,
        "hanging_nodes": _count_hanging(points, np.stack((low[rims], high[rims]), axis=1)),
    }


def measure(points: NDArray[Any], elements: NDArray[Any], least_jacobian: float = 0.3, most_aspect: float = 5.0) -> dict[str, Any]:
    """The quality of a mesh of at least one element, as `mesh.quality` of the program's report has it.

    points: (n, 3), finite. elements: (m, 4). least_jacobian, most_aspect: limits of scaled Jacobian and aspect ratio, which
    99 % of the elements are to keep."""
    is_triangle = elements[:, 3] < 0
    shapes = [_measure_shapes(points, elements[is_triangle, :3]), _measure_shapes(points, elements[~is_triangle])]
    jacobians, aspects = (np.concatenate(values) for values in zip(*shapes))
    last = len(elements) - 1
    low, high = int(0.01 * last), int(0.99 * last)
    sides = _measure_sides(points, elements)
    used = np.unique(elements[elements >= 0])
    limits: list[tuple[str, float, str, float]] = [
        ("elements without a positive Jacobian", int((~(jacobians > 0)).sum()), "most", 0),
        ("scaled Jacobian of 99 %", float(np.partition(jacobians, low)[low]), "least", least_jacobian),
        ("aspect ratio of 99 %", float(np.partition(aspects, high)[high]), "most", most_aspect),
        ("nodes at one place", _count_repeated(points[used]), "most", 0),
        ("elements with the same nodes", _count_repeated(np.sort(elements, axis=1)), "most", 0),
        ("hanging nodes", sides.pop("hanging_nodes"), "most", 0),
        ("walls turned both ways", sides.pop("turned_walls"), "most", 0),
    ]
    return {
        "nodes": len(used),
        "triangles": int(is_triangle.sum()),
        "quadrilaterals": int((~is_triangle).sum()),
        **sides,
        "least_scaled_jacobian": float(jacobians.min()),
        "largest_aspect_ratio": float(aspects.max()),
        **_measure_sizes(points, elements),
        "limits": [
            {"name": name, "value": value, kind: limit, "holds": value >= limit if kind == "least" else value <= limit}
            for name, value, kind, limit in limits
        ],
    }


def _read(path: pathlib.Path) -> Any:
    """What meshio makes of the file."""
    try:
        import meshio
        from meshio._helpers import reader_map
    except ImportError:
        raise CheckError(_REFUSED, "check reads files with meshio, which is missing: pip install meshio") from None
    kinds = meshio.extension_to_filetypes.items()
    known = sorted(extension for extension, formats in kinds if any(name in reader_map for name in formats))
    if not path.name.lower().endswith(tuple(known)):
        raise CheckError(_USAGE, f"meshio does not read the mesh {path}; it reads {', '.join(known)}")
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):  # which might be waited for
            raise CheckError(_REFUSED, f"cannot open {path}: it is {'a folder' if path.is_dir() else 'not a regular file'}")
        path.open("rb").close()
    except OSError as error:
        raise CheckError(_REFUSED, f"cannot open {path}: {error.strerror}") from None
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            return meshio.read(path)
    except MemoryError:
        raise CheckError(_REFUSED, f"{path}: the mesh needs more memory than there is") from None
    except (Exception, SystemExit) as error:  # readers raise what they meet; meshio ends the process where none succeeds
        reason = said.getvalue() if isinstance(error, SystemExit) else f"{type(error).__name__}: {error}"
        raise CheckError(_CORRUPT, f"{path}: meshio does not understand it: {' '.join(reason.split())}") from None


def read(file_name: str | os.PathLike[str]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Points and elements of a file; what is no shell, such as beams and solids, is left out.

    Raises CheckError, also for shells of more than four nodes and for places that are not finite or beyond 1e30."""
    path = pathlib.Path(file_name)
    mesh = _read(path)
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points
    blocks = [np.empty((0, 4), np.int64)]
    for block in mesh.cells:
        if block.type in ("triangle", "quad"):
            corners = np.asarray(block.data, np.int64)
            blocks.append(np.pad(corners, ((0, 0), (0, 4 - corners.shape[1])), constant_values=-1))
        elif block.dim == 2:
            raise CheckError(_CORRUPT, f"{path}: elements of type {block.type} are not checked; triangles and quadrilaterals are")
    elements = np.concatenate(blocks)
    if not len(elements):
        raise CheckError(_CORRUPT, f"{path}: has no shell elements of three or four nodes")
    if elements[:, :3].min() < 0 or elements[:, 3].min() < -1 or elements.max() >= len(points):
        raise CheckError(_CORRUPT, f"{path}: an element names a node that is missing")
    wrong = np.flatnonzero(~(np.abs(points) <= _LARGEST_COORDINATE).all(axis=1))
    if len(wrong):
        place = ", ".join(map(str, points[wrong[0]].tolist()))
        raise CheckError(_CORRUPT, f"{path}: node {wrong[0] + 1} is at {place}; places must be finite and not beyond 1e30")
    return points, elements


def _to_json(value: Any) -> Any:
    """The aspect ratio of flat elements is infinite, which JSON has no number for: null."""
    if isinstance(value, dict):
        return {key: _to_json(of_key) for key, of_key in value.items()}
    if isinstance(value, list):
        return [_to_json(entry) for entry in value]
    return None if value == math.inf else value


def _format(limit: dict[str, Any]) -> str:
    kind = "least" if "least" in limit else "most"
    relation = f"at {kind}" if limit["holds"] else {"least": "less than", "most": "more than"}[kind]
    return f"{limit['value']:.4g}, {relation} {limit[kind]:.4g}"


def _print_table(quality: dict[str, Any]) -> None:
    table = {name: quality[key] if isinstance(quality[key], int) else f"{quality[key]:.4g}" for name, key in _ROWS.items()}
    table |= {limit["name"]: _format(limit) for limit in quality["limits"]}
    table["all limits hold"] = "yes" if all(limit["holds"] for limit in quality["limits"]) else "no"
    width = max(map(len, table)) + 2
    for name, value in table.items():
        print(f"{name:{width}}{value}")


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < math.inf:
        raise ValueError
    return value


def _parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m medialvoxel check",
        description="Check the elements of a shell mesh, of a file that meshio reads: .inp .bdf .vtu .ply .stl .obj and others.",
        epilog="Exit status: 0 all limits hold, 1 a limit fails, 2 wrong usage, 3 the file cannot be opened or meshio is missing, "
        "4 corrupt input.",
    )
    parser.add_argument("mesh", metavar="MESH", help="shell mesh")
    parser.add_argument("--json", action="store_true", help="print it as JSON")
    for name, default, what in (("--min-scaled-jacobian", 0.3, "reach"), ("--max-aspect-ratio", 5.0, "do not exceed")):
        parser.add_argument(
            name, type=_positive, default=default, metavar="X", help=f"that 99 %% of the elements {what}, above 0 (%(default)s)"
        )
    return parser.parse_args(arguments)


def main(arguments: Sequence[str]) -> NoReturn:
    """Prints the quality of a mesh, and ends the process with a status that says whether its limits hold."""
    options = _parse(arguments)
    try:
        quality = measure(*read(options.mesh), options.min_scaled_jacobian, options.max_aspect_ratio)
    except CheckError as error:
        print(f"medialvoxel: {error}", file=sys.stderr)
        sys.exit(error.status)
    if options.json:
        print(json.dumps(_to_json({"mesh": options.mesh, **quality}), indent=2))
    else:
        _print_table(quality)
    sys.exit(_DONE if all(limit["holds"] for limit in quality["limits"]) else _LIMIT_FAILS)
