# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""python -m medialvoxel check, with the meshio of an interpreter that has it: scripts/mesh-readers makes one."""

import json
import math
import os
import pathlib
import subprocess
import sys
import unittest

import medialvoxel
import numpy as np
from medialvoxel import _check

import support
from interpreters import python_with

DONE, LIMIT_FAILS, USAGE, REFUSED, CORRUPT = range(5)
PACKAGE = pathlib.Path(medialvoxel.__file__).resolve().parents[1]

# Formats of the program that meshio reads, and options that make the same mesh of each.
FORMATS = {"m.inp": [], "m.bdf": [], "m.vtu": [], "m.ply": [], "m.obj": [], "t.stl": ["--triangles"]}
TEXTS = ("m.inp", "m.bdf", "m.obj")  # of seven digits

# Two squares side by side, 0 1 2 3 and 1 4 5 2; 6 is on the side between them, 7 at the place of 0.
POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0), (1, 0.5, 0), (0, 0, 0), (3, 0.5, 0), (1.2, 0.5, 0), (4, 0, 0)]

# Elements, and the limits that fail.
BAD = (
    ([[0, 1, 2, 3], [1, 4, 5, 2]], []),
    ([[0, 1, 2, 3], [2, 1, 0, 3]], ["elements with the same nodes"]),
    ([[0, 1, 2], [7, 2, 3]], ["nodes at one place"]),
    ([[0, 1, 2, 3], [6, 4, 5], [6, 5, 2]], ["hanging nodes"]),
    ([[0, 1, 2, 3], [1, 2, 5, 4]], ["walls turned both ways"]),
    ([[1, 9, 2, 8]], ["elements without a positive Jacobian", "scaled Jacobian of 99 %"]),
    (
        [[0, 1, 4, 10]],
        ["elements without a positive Jacobian", "scaled Jacobian of 99 %", "aspect ratio of 99 %", "hanging nodes"],
    ),
)


def plate():
    """A plate with a rib, whose surface has a junction."""
    values = np.zeros((30, 40, 44), np.uint8)
    values[6:10, 3:37, 3:41] = 1
    values[10:26, 3:37, 20:24] = 1
    return values


def ring(is_moebius, number=12):
    """Quadrilaterals whose last one joins the first, perhaps after half a turn."""
    angles = np.repeat(2 * math.pi * np.arange(number) / number, 2)
    sides = np.tile([-0.5, 0.5], number)
    turns = angles / 2 if is_moebius else 0 * angles
    radius = 4 + sides * np.sin(turns)
    points = np.stack((radius * np.cos(angles), radius * np.sin(angles), sides * np.cos(turns)), axis=1)
    elements = [[2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1] for k in range(number - 1)]
    other = int(is_moebius)
    return points, np.array([*elements, [2 * number - 2, other, 1 - other, 2 * number - 1]])


def failing(quality):
    return [limit["name"] for limit in quality["limits"] if not limit["holds"]]


def fill(elements):
    """Rows of four, as the module has them."""
    return np.array([element + [-1] * (4 - len(element)) for element in elements])


class Measures(unittest.TestCase):
    """Of arrays, without meshio."""

    def test_what_is_wrong_is_named(self):
        for elements, expected in BAD:
            quality = _check.measure(np.array(POINTS, float), fill(elements))
            self.assertEqual(failing(quality), expected, elements)
            self.assertEqual(quality["triangles"] + quality["quadrilaterals"], len(elements))

    def test_counts_of_two_squares(self):
        quality = _check.measure(np.array(POINTS, float), fill(BAD[0][0]))
        del quality["limits"]
        self.assertEqual(quality, {
            "nodes": 6, "triangles": 0, "quadrilaterals": 2, "rim_sides": 6, "junction_sides": 0, "walls": 1,
            "one_sided_walls": 0, "least_scaled_jacobian": 1.0, "largest_aspect_ratio": 1.0, "warpage_percentile_99": 0.0,
            "largest_warpage": 0.0, "least_angle": 90.0, "largest_angle": 90.0, "shortest_side": 1.0, "mean_side": 1.0,
            "longest_side": 1.0,
        })  # fmt: skip

    def test_warpage_angles_and_sides(self):
        # A roof over the diagonal from the first corner, and a triangle of sides 3, sqrt(2) and sqrt(17).
        angle = 0.3
        points = [[0, 0, 0], [1, -1, 0], [2, 0, 0], [1, math.cos(angle), math.sin(angle)], [3, 0, 0], [4, 1, 0]]
        quality = _check.measure(np.array(points, float), fill([[0, 1, 2, 3], [0, 4, 5]]))
        self.assertAlmostEqual(quality["largest_warpage"], math.degrees(angle), places=9)
        self.assertAlmostEqual(quality["largest_angle"], 135, places=9)
        self.assertAlmostEqual(quality["least_angle"], math.degrees(math.atan2(1, 4)), places=9)
        self.assertAlmostEqual(quality["longest_side"], math.sqrt(17), places=12)
        flat = _check.measure(np.array(points, float), fill([[0, 4, 5]]))
        self.assertEqual((flat["largest_warpage"], flat["warpage_percentile_99"]), (0, 0))
        self.assertAlmostEqual(flat["mean_side"], (3 + math.sqrt(2) + math.sqrt(17)) / 3, places=12)

    def test_walls_of_one_side_are_no_fault(self):
        for is_moebius in (False, True):
            quality = _check.measure(*ring(is_moebius))
            self.assertEqual((quality["walls"], quality["one_sided_walls"]), (1, int(is_moebius)))
            self.assertNotIn("walls turned both ways", failing(quality))

    def test_walls_and_hanging_nodes_by_brute_force(self):
        """Random patches of a grid, some turned, some missing, some cut along a side that others do not cut."""
        generator = np.random.default_rng(11)
        for _ in range(30):
            points, elements = self.make_patches(generator)
            quality = _check.measure(points, elements)
            values = {limit["name"]: limit["value"] for limit in quality["limits"]}
            found = (quality["walls"], values["walls turned both ways"], values["hanging nodes"])
            self.assertEqual(found, self.count(points, elements))

    def make_patches(self, generator, size=7):
        points = [(x, y, 0.0) for y in range(size) for x in range(size)]
        elements = []
        for y, x in np.argwhere(generator.random((size - 1, size - 1)) < 0.7):
            a, b, c, d = corners = [y * size + x, y * size + x + 1, (y + 1) * size + x + 1, (y + 1) * size + x]
            if generator.random() < 0.15:
                points.append((x + 0.5, float(y), 0.0))
                pieces = [[a, len(points) - 1, d, -1], [len(points) - 1, b, c, d]]
            else:
                pieces = [corners if generator.random() < 0.9 else corners[::-1]]
            elements += pieces
        return np.array(points, float), np.array(elements)

    def count(self, points, elements):
        """Walls, those that are turned both ways, and hanging nodes, by comparing everything with everything."""
        sides = {}
        for number, element in enumerate(elements.tolist()):
            corners = [corner for corner in element if corner >= 0]
            for a, b in zip(corners, corners[1:] + corners[:1]):
                sides.setdefault(frozenset((a, b)), []).append((number, a < b))
        neighbors = {number: [] for number in range(len(elements))}
        for (first, up), (second, also_up) in (owners for owners in sides.values() if len(owners) == 2):
            neighbors[first].append((second, up == also_up))
            neighbors[second].append((first, up == also_up))
        walls, turned, known = 0, 0, set()
        for start in neighbors:
            if start not in known:
                known.add(start)
                waiting, is_turned = [start], False
                while waiting:
                    for other, alike in neighbors[waiting.pop()]:
                        is_turned |= alike
                        if other not in known:
                            known.add(other)
                            waiting.append(other)
                walls, turned = walls + 1, turned + is_turned
        rims = [tuple(side) for side, owners in sides.items() if len(owners) == 1]
        hanging = set()
        for node in {node for side in rims for node in side}:
            for a, b in rims:
                if node not in (a, b):
                    lengths = [np.linalg.norm(points[node] - points[end]) for end in (a, b)]
                    if sum(lengths) < np.linalg.norm(points[a] - points[b]) + 1e-9:
                        hanging.add(node)
        return walls, turned, len(hanging)


class Check(support.Folder):
    """The command, in a process of its own."""

    def run_check(self, *arguments, python=None, **environment):
        python = python or python_with("meshio")
        if python is None:
            self.skipTest("skipped: no interpreter has meshio; scripts/mesh-readers makes one")
        return subprocess.run(
            [python, "-B", "-m", "medialvoxel", "check", *map(str, arguments)], capture_output=True, text=True,
            cwd=self.folder, env={**os.environ, "PYTHONPATH": os.fspath(PACKAGE), **environment},
        )  # fmt: skip

    def check(self, *arguments):
        """What it says as JSON; the status agrees with the limits."""
        result = self.run_check(*arguments, "--json")
        self.assertIn(result.returncode, (DONE, LIMIT_FAILS), result.stderr)
        quality = json.loads(result.stdout)
        self.assertEqual(result.returncode, LIMIT_FAILS if failing(quality) else DONE)
        self.assertEqual(result.stderr, "")
        return quality

    def assert_fails(self, status, words, *arguments, **options):
        result = self.run_check(*arguments, **options)
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual((result.stdout, result.stderr.count("\n")), ("", 1), result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def write(self, points=POINTS, **cells):
        """Files of meshio by name and extension, with an underscore for the dot: pairs of type and rows."""
        python = python_with("meshio") or self.skipTest("skipped: no interpreter has meshio; scripts/mesh-readers makes one")
        code = (
            "import json, sys, meshio\npoints, files = json.load(sys.stdin)\n"
            "for name, cells in files.items(): meshio.Mesh(points, list(map(tuple, cells))).write(name.replace('_', '.'))"
        )
        command = [python, "-c", code]
        subprocess.run(command, input=json.dumps([points, cells]), text=True, check=True, cwd=self.folder, capture_output=True)

    def write_elements(self, **files):
        kinds = (("triangle", 3), ("quad", 4))
        blocks = {
            name: [(kind, [element for element in elements if len(element) == size]) for kind, size in kinds]
            for name, elements in files.items()
        }
        self.write(**{name: [block for block in of_file if block[1]] for name, of_file in blocks.items()})

    def mesh(self, name, *options):
        command = ["mesh", self.folder / "in.mha", self.folder / name, "--lower=1", "--overwrite", *options]
        status, errors = support.run([*command, f"--report={self.folder / 'r.json'}"])
        self.assertEqual(status, 0, errors)
        return json.loads((self.folder / "r.json").read_text())["mesh"]

    def assert_same(self, first, second, places):
        first_limits, second_limits = (quality.pop("limits") for quality in (first, second))
        for one, other in [(first, second), *zip(first_limits, second_limits, strict=True)]:
            self.assertEqual(one.keys(), other.keys())
            for key, value in one.items():
                if isinstance(value, float):
                    # Degrees, whose arc cosine near 1 has half of the digits.
                    digits = min(places - 2, 5) if "angle" in key or "warpage" in key else places
                    self.assertAlmostEqual(value, other[key], places=digits, msg=key)
                else:
                    self.assertEqual(value, other[key], key)

    def test_numbers_are_those_of_the_program(self):
        support.write(self.folder / "in.mha", plate(), (0.5, 0.5, 0.5))
        for name, options in FORMATS.items():
            for more in (["--element-size=auto"], ["--element-size=1.1", "--extend-rims"]):
                with self.subTest(name, more=more):
                    quality = self.mesh(name, *options, *more)["quality"]
                    self.assertGreater(quality["junction_sides"], 0)
                    found = self.check(name)
                    self.assertEqual(found.pop("mesh"), name)
                    self.assert_same(found, quality, 5 if name in TEXTS else 12)

    def test_thickness_at_nodes_changes_nothing(self):
        support.write(self.folder / "in.mha", plate())
        quality = self.mesh("m.inp", "--sections=nodes")["quality"]
        found = self.check("m.inp")
        del found["mesh"]
        self.assert_same(found, quality, 5)

    def test_faces_of_voxels(self):
        support.write(self.folder / "in.mha", plate())
        mesh = self.mesh("m.vtu")
        found = self.check("m.vtu")
        self.assertEqual((found["nodes"], found["quadrilaterals"]), (mesh["vertices"], mesh["faces"]))

    def test_what_is_wrong_is_named_in_each_format(self):
        files = {f"m{number}_vtu": case for number, case in enumerate(BAD)}
        files |= {f"m{number}_{kind}": BAD[number] for kind in ("inp", "bdf", "vtk", "ply", "obj") for number in (3, 4)}
        self.write_elements(**{name: elements for name, (elements, _) in files.items()})
        for name, (elements, expected) in files.items():
            with self.subTest(name, elements=elements):
                self.assertEqual(failing(self.check(name.replace("_", "."))), expected)

    def test_limits_can_be_chosen(self):
        self.write_elements(m_vtu=[[0, 1, 2]])
        self.assertEqual(failing(self.check("m.vtu")), [])
        strict = self.check("m.vtu", "--min-scaled-jacobian=0.9", "--max-aspect-ratio", "1.1")
        self.assertEqual(failing(strict), ["scaled Jacobian of 99 %", "aspect ratio of 99 %"])
        self.assertEqual([strict["limits"][1]["least"], strict["limits"][2]["most"]], [0.9, 1.1])
        for option in ("--min-scaled-jacobian", "--max-aspect-ratio"):
            for value in ("0", "-1", "nan", "inf", "much"):
                result = self.run_check("m.vtu", f"{option}={value}")
                self.assertEqual(result.returncode, USAGE)
                self.assertIn(option, result.stderr)
                self.assertIn(f"'{value}'", result.stderr)

    def test_table(self):
        self.write_elements(m_vtu=[[0, 1, 2, 3], [1, 2, 5, 4]])
        result = self.run_check("m.vtu")
        self.assertEqual(result.returncode, LIMIT_FAILS)
        self.assertRegex(result.stdout, r"\Anodes +6\ntriangles +0\nquadrilaterals +2\n")
        self.assertRegex(result.stdout, r"\nscaled Jacobian of 99 % +1, at least 0.3\naspect ratio of 99 % +1, at most 5\n")
        self.assertRegex(result.stdout, r"\nwalls turned both ways +1, more than 0\nall limits hold +no\n\Z")

    def test_flat_elements_are_valid_json(self):
        self.write_elements(m_vtu=[[0, 1, 4]])
        self.assertIsNone(self.check("m.vtu")["largest_aspect_ratio"])

    def test_what_is_no_shell_is_left_out(self):
        self.write(m_vtu=[("line", [[0, 1]]), ("quad", [[0, 1, 2, 3]]), ("tetra", [[0, 1, 2, 8]]), ("vertex", [[5]])])
        quality = self.check("m.vtu")
        self.assertEqual((quality["nodes"], quality["quadrilaterals"]), (4, 1))

    def test_files_that_are_not_checked(self):
        self.write(m_vtu=[("triangle6", [[0, 1, 2, 3, 4, 5]])])
        self.assert_fails(CORRUPT, ["m.vtu", "triangle6", "quadrilaterals"], "m.vtu")
        self.write(m_vtu=[("line", [[0, 1]])])
        self.assert_fails(CORRUPT, ["m.vtu", "no shell elements"], "m.vtu")
        for place in ("NaN", "Infinity", "1e31"):
            self.write([[0, 0, 0], [json.loads(place), 0, 0], [1, 1, 0]], m_vtu=[("triangle", [[0, 1, 2]])])
            self.assert_fails(CORRUPT, ["m.vtu", "node 2", "1e30"], "m.vtu")
        self.write(m_vtu=[("triangle", [[0, 1, 99]])])
        self.assert_fails(CORRUPT, ["m.vtu", "node", "missing"], "m.vtu")

    def test_files_that_meshio_does_not_understand(self):
        for name in ("m.inp", "m.bdf", "m.vtu", "m.ply", "m.stl", "m.vtk"):
            (self.folder / name).write_text("*NODE\n1, x\n")
            self.assert_fails(CORRUPT, [name, "meshio"], name)

    def test_formats_that_meshio_does_not_read(self):
        for name in ("m.k", "m.vtp", "m.glb", "m"):
            self.assert_fails(USAGE, [name, "meshio", ".inp", ".bdf", ".vtu", ".ply", ".stl"], name)

    def test_files_that_cannot_be_opened(self):
        """A status of their own, so that a script tells a typing error from a bad mesh; none is waited for."""
        self.assert_fails(REFUSED, ["cannot open none.inp", "No such file"], "none.inp")
        os.mkfifo(self.folder / "pipe.inp")
        self.assert_fails(REFUSED, ["pipe.inp", "not a regular file"], "pipe.inp")
        (self.folder / "loop.inp").symlink_to("loop.inp")
        self.assert_fails(REFUSED, ["cannot open loop.inp"], "loop.inp")
        (self.folder / "folder.inp").mkdir()
        self.assert_fails(REFUSED, ["folder.inp", "it is a folder"], "folder.inp")

    def test_without_meshio(self):
        (self.folder / "meshio.py").write_text("raise ImportError\n")
        options = {"python": sys.executable, "PYTHONPATH": os.pathsep.join((os.fspath(self.folder), os.fspath(PACKAGE)))}
        self.assert_fails(REFUSED, ["pip install meshio"], "m.inp", **options)

    def test_other_commands_are_those_of_the_program(self):
        command = [sys.executable, "-B", "-m", "medialvoxel"]
        environment = {**os.environ, "PYTHONPATH": os.fspath(PACKAGE), "MEDIALVOXEL_PROGRAM": support.program()}
        version = subprocess.run([*command, "--version"], capture_output=True, text=True, env=environment)
        self.assertEqual(version.stdout, f"medialvoxel {medialvoxel.__version__}\n")


if __name__ == "__main__":
    unittest.main()
