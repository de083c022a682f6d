# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Walls of the faces of meshes: those of the nearest cells, in all formats and runs, cut at the seams of known parts."""

import collections
import json
import math
import re
import shutil
import struct
import subprocess
import unittest

import volumes
from program import REFUSED, USAGE, ProgramTestCase
from test_label_meshes import read_with
from test_mesh import Mesh
from test_walls import SIZE, beam, box, part, tee, turned

SIZES = ("--element-size", "auto")


def mean(points):
    return tuple(sum(values) / len(points) for values in zip(*points))


def numbers(path):
    data = volumes.read_data(path)
    return struct.unpack(f"<{len(data) // 4}I", data)


class MeshWallsTest(ProgramTestCase):
    def write(self, shape, degrees=0.0, **options):
        volumes.write_meta(self.folder / "in.mha", part(shape, degrees, **options))

    def mesh(self, name, *arguments):
        self.run_program("mesh", "in.mha", name, "--label", 1, "--mesh-walls", "--overwrite", "--quiet", *arguments)
        return (self.folder / name).read_bytes()

    def read(self, name, *arguments):
        """Corners of the faces as points, and their walls."""
        self.mesh(name, *arguments)
        mesh = Mesh(self.folder / name)
        return [[mesh.vertices[corner][:3] for corner in face] for face in mesh.faces], mesh.walls

    def test_wall_of_the_nearest_cell(self):
        """A mesh with a face a voxel has its cells as vertices, in the order of the voxels of the volume."""
        for shape, degrees in ((tee, 0), (beam, 33), (box, 20)):
            self.write(shape, degrees)
            self.mesh("cells.ply", "--walls", "w.mha", "--element-size", "voxel")
            cells = [vertex[:3] for vertex in Mesh(self.folder / "cells.ply").vertices]
            walls = [number for number in numbers(self.folder / "w.mha") if number > 0]
            self.assertEqual(len(walls), len(cells))
            for arguments in (SIZES, ("--element-size", "voxel"), ("--element-size", 3, "--extend-rims")):
                faces, found = self.read("m.ply", *arguments)
                self.assertEqual(set(found), set(walls))
                for corners, wall in zip(faces[::17], found[::17]):
                    middle = mean(corners)
                    distances = [math.dist(middle, cell) for cell in cells]
                    least = min(distances) + 1e-4  # files round the coordinates
                    near = {known for known, distance in zip(walls, distances) if distance < least}
                    self.assertIn(wall, near, (shape.__name__, arguments))

    def test_formats_agree(self):
        self.write(beam, 33)
        names = {extension: f"m.{extension}" for extension in ("vtp", "vtu", "vtk", "ply", "obj", "inp", "bdf", "k")}
        for name in names.values():
            self.mesh(name, *SIZES, "--extend-rims=off", "--min-component-size", 0)
        mesh = Mesh(self.folder / "m.ply")
        walls = mesh.walls
        self.assertEqual(set(walls), {1, 2, 3, 4, 5})
        text = (self.folder / "m.obj").read_text()
        groups = [(line[2:], "") if line[0] == "g" else ("", line) for line in text.splitlines() if line[0] in "gf"]
        found, last = [], None
        for group, face in groups:
            last = group or last
            found += [last] if face else []
        self.assertEqual(found, [f"WALL_{wall}" for wall in walls])
        expected = collections.defaultdict(list)
        for place, wall in enumerate(walls):
            expected[f"WALL_{wall}"].append(place)
        for reader, extensions in (
            ("pyvista", ("vtp", "vtu", "vtk")), ("meshio", ("vtu", "inp")), ("pyNastran", ("bdf",)), ("pydyna", ("k",)),
        ):  # fmt: skip
            contents = read_with(reader, self.folder, [names[extension] for extension in extensions])
            if contents is None:
                self.skipTest(f"the Python package {reader} is not installed; scripts/mesh-readers does it")
            for extension in extensions:
                with self.subTest(f"{extension} with {reader}"):
                    content = contents[names[extension]]
                    if extension == "vtu" and reader == "meshio":  # by kinds of cells
                        self.assertEqual(sorted(content["wall"]), sorted(walls))
                    elif extension.startswith("vt"):
                        self.assertEqual(content["wall"], list(walls))
                    elif extension == "inp":
                        outline = lambda places, faces: sorted(tuple(faces[place]) for place in places)  # noqa: E731
                        sets = {name: places for name, places in content["sets"].items() if name in expected}
                        self.assertEqual(set(sets), set(expected))
                        for name, places in sets.items():
                            self.assertEqual(outline(places, content["faces"]), outline(expected[name], mesh.faces))
                    else:
                        sets = {name: places for name, places in content["sets"].items() if name.startswith("WALL")}
                        self.assertEqual(sets, expected)

    def test_triangles_in_ply(self):
        self.write(tee)
        self.mesh("m.ply", *SIZES, "--triangles")
        contents = read_with("trimesh", self.folder, ["m.ply"])
        if contents is None:
            self.skipTest("the Python package trimesh is not installed; scripts/mesh-readers does it")
        mesh = Mesh(self.folder / "m.ply")
        self.assertEqual(contents["m.ply"]["wall"], mesh.walls)
        self.assertEqual(contents["m.ply"]["faces"], [list(face) for face in mesh.faces])

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed: Debian package calculix-ccx")
    def test_calculix_takes_the_sets(self):
        self.write(tee)
        self.mesh("m.inp")
        text = (self.folder / "m.inp").read_text()
        (listed,) = re.findall(r"\*ELSET, ELSET=WALL_3\n([\d,\s]+)", text)
        elements = {int(number) for number in listed.replace(",", " ").split()}
        step = (
            "*BOUNDARY\nRIM, 1, 6\n*STEP\n*STATIC\n*DLOAD\nWALL_3, P, 1.\n*EL PRINT, ELSET=WALL_3, TOTALS=NO\nS\n*END STEP\n"
        )
        (self.folder / "run.inp").write_text(text + step)
        run = subprocess.run(["ccx", "run"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout[-2000:])
        rows = re.findall(r"^ +(\d+) +\d+ +[-+\d.E]+ ", (self.folder / "run.dat").read_text(), re.MULTILINE)
        self.assertEqual({int(row) for row in rows}, elements)

    def test_any_run_has_the_same_bytes(self):
        self.write(beam, 25, flips=0.05)
        for name, size in (("m.ply", "voxel"), ("m.vtp", "auto"), ("m.inp", "auto"), ("m.k", 3)):
            known = self.mesh(name, "--element-size", size, "--divisions", 1, "--threads", 1)
            for arguments in (("--divisions", 5), ("--threads", 2), ("--threads", 5), ("--memory", "160M")):
                self.assertEqual(self.mesh(name, "--element-size", size, *arguments), known, (name, arguments))

    def test_walls_are_those_of_extract(self):
        """One sheet is built for mesh and walls, whose bytes are those of runs of their own."""
        self.write(beam, 25, flips=0.05)
        outputs = ("--walls", "w.mha", "--wall-table", "w.csv", "--seam-table", "s.csv")
        alone = ("extract", "in.mha", *outputs, "--label", 1, "--overwrite", "--quiet")
        self.run_program(*alone)
        names = ("w.mha", "w.csv", "s.csv")
        known = [(self.folder / name).read_bytes() for name in names]
        plain = ("mesh", "in.mha", "plain.vtp", "--label", 1, *SIZES, "--overwrite", "--quiet")
        self.run_program(*plain)
        known_mesh = self.mesh("m.vtp", *SIZES)
        self.assertNotIn(b"Wall", (self.folder / "plain.vtp").read_bytes())
        for arguments, mesh in (
            (("--mesh", "m.vtp", *SIZES, "--mesh-walls"), known_mesh),
            (("--mesh", "m.vtp", *SIZES), (self.folder / "plain.vtp").read_bytes()),
        ):
            self.run_program(*alone, *arguments)
            self.assertEqual([(self.folder / name).read_bytes() for name in names], known, arguments)
            self.assertEqual((self.folder / "m.vtp").read_bytes(), mesh, arguments)
        self.assertEqual(self.mesh("m.vtp", *SIZES, *outputs), known_mesh)
        self.assertEqual([(self.folder / name).read_bytes() for name in names], known)

    def test_report(self):
        self.write(tee)
        self.mesh("m.inp", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["parameters"]["mesh_walls"])
        self.assertEqual((report["walls"]["number_of_walls"], report["walls"]["number_of_seams"]), (3, 1))
        self.assertGreater(report["seconds"]["walls"], 0)

    def test_elements_end_at_seams(self):
        """Of T and I-beam: how far corners of elements are beyond the seams of their wall, in sides of the element."""
        for shape, degrees in ((tee, 0), (tee, 33), (beam, 0), (beam, 33)):
            self.write(shape, degrees)
            faces, walls = self.read("m.ply", *SIZES)
            places = [
                [turned(tuple(p - (n - 1) / 2 + 0.1 for p, n in zip(corner, SIZE)), degrees) for corner in face] for face in faces
            ]
            beyond = []
            for wall in set(walls):
                own = [face for face, number in zip(places, walls) if number == wall]
                x, _, z = mean([mean(face) for face in own])
                is_web = abs(x) < 2
                level = 13 if z > 0 else -13
                for face in own:
                    side = mean([(math.dist(a, b),) for a, b in zip(face, face[1:] + face[:1])])[0]
                    for x_of_corner, _, z_of_corner in face:
                        if shape is tee:
                            distance = -10 - z_of_corner if is_web else -x_of_corner * math.copysign(1, x)
                        elif is_web:
                            distance = abs(z_of_corner) - 13
                        else:
                            distance = -x_of_corner * math.copysign(1, x)
                            self.assertLess(abs(z_of_corner - level), 4)
                        beyond.append(distance / side)
            beyond.sort()
            self.assertLess(beyond[int(0.99 * len(beyond))], 0.1, (shape.__name__, degrees))
            self.assertLess(beyond[-1], 0.5, (shape.__name__, degrees))

    def test_elements_at_sharp_bends(self):
        """Of a box: few elements are of the wall beside theirs, and none of these is a side away from its plane."""
        levels = (15, 14, 13)
        for degrees in (0, 33):
            self.write(box, degrees)
            faces, walls = self.read("m.ply", *SIZES)
            off, planes = [], {}
            for corners, wall in zip(faces, walls):
                side = mean([(math.dist(a, b),) for a, b in zip(corners, corners[1:] + corners[:1])])[0]
                middle = turned(tuple(p - (n - 1) / 2 + 0.1 for p, n in zip(mean(corners), SIZE)), degrees)
                distances = [(abs(abs(p) - level) / side, axis, p > 0) for axis, (p, level) in enumerate(zip(middle, levels))]
                planes.setdefault(wall, collections.Counter())[min(distances)[1:]] += 1
                off.append((wall, distances, min(distances)[1:]))
            own = {wall: counter.most_common(1)[0][0] for wall, counter in planes.items()}
            self.assertEqual(len(set(own.values())), 6)
            wrong = [distances[own[wall][0]][0] for wall, distances, plane in off if plane != own[wall]]
            self.assertLess(len(wrong), 0.05 * len(faces), degrees)
            self.assertLess(max(wrong), 1, degrees)

    def test_errors(self):
        self.write(tee)
        options = ("--label", 1, "--mesh-walls")
        for name in ("m.stl", "m.glb"):
            self.assert_fails(USAGE, ["walls of faces", ".vtp", ".inp"], "mesh", "in.mha", name, *options)
        self.assert_fails(USAGE, ["--mesh-walls", "--mesh"], "extract", "in.mha", "o.mha", *options)
        labels = ("extract", "in.mha", "--labels", "all", "--mesh", "m.vtp", "--mesh-walls")
        self.assert_fails(USAGE, ["labels of several objects", "walls"], *labels)
        self.assert_fails(REFUSED, ["mesh", "clusters"], "plan", "in.mha", "o.mha", "job", "--mesh", "m.vtp", "--mesh-walls")


if __name__ == "__main__":
    unittest.main()
