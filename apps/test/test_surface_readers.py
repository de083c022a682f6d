# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Mesh files of all formats hold what libraries of others read from them. Needs scripts/mesh-readers."""

import collections
import json
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest

from interpreters import python_with

WRITE_SURFACE = os.environ["MEDIALVOXEL_WRITE_SURFACE"]
READ_SURFACE = pathlib.Path(__file__).with_name("read_surface.py")

SHAPES = ("plate", "mixed", "cylinder", "cube", "junction")
FAR_SHAPES = ("far-mixed", "far-cylinder")  # coordinates need 64 bits
EXTENSIONS = ("vtp", "vtu", "vtk", "ply", "stl", "obj", "inp", "bdf", "k", "glb")
ONLY_32_BITS = ("stl", "glb")
READERS = {
    "pyvista": ("vtp", "vtu", "vtk", "ply", "stl", "obj", "glb"),
    "meshio": ("vtu", "ply", "stl", "obj", "inp", "bdf"),
    "gmsh": ("stl", "obj", "bdf"),
    "pyNastran": ("bdf",),
    "trimesh": ("glb",),
    "pydyna": ("k",),
}
READ_AS_32_BITS = (("pyvista", "ply"), ("pyvista", "obj"))  # by VTK, whatever the file holds
MODULES = {"pyNastran": "pyNastran.bdf.bdf", "pydyna": "ansys.dyna.core"}
AT_NODES = {"meshio": ("inp",), "pyNastran": ("bdf",), "pydyna": ("k",)}  # with the thickness at nodes
CLASS_WIDTH = 0.2


def as_float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def squared_distance(a, b):
    # Not sum(), which newer interpreters round less: ties would not be the program's.
    x, y, z = ((p - q) * (p - q) for p, q in zip(a, b))
    return x + y + z


def split(points, face):
    """A quad as two triangles, along its shorter diagonal; a tie takes the first."""
    if len(face) == 3:
        return [face]
    a, b, c, d = face
    if squared_distance(points[b], points[d]) < squared_distance(points[a], points[c]):
        return [[a, b, d], [b, c, d]]
    return [[a, b, c], [a, c, d]]


def outline(points, face, digits):
    """Corners of a face as points, from the smallest on: the same for the same face with the same orientation."""
    corners = [tuple(float(f"{coordinate:.{digits}g}") for coordinate in points[corner]) for corner in face]
    start = corners.index(min(corners))
    return tuple(corners[start:] + corners[:start])


def write_all(folder):
    """Writes all shapes in all formats; the surfaces by shape, with numbers as files have them."""
    surfaces = {}
    for shape in (*SHAPES, *FAR_SHAPES, "empty"):
        extensions = [extension for extension in EXTENSIONS if shape not in FAR_SHAPES or extension not in ONLY_32_BITS]
        command = [WRITE_SURFACE, shape, str(CLASS_WIDTH), *(f"{shape}.{extension}" for extension in extensions)]
        surface = json.loads(subprocess.run(command, capture_output=True, check=True, cwd=folder).stdout)
        for key in ("thickness", "area"):
            surface[key] = [as_float32(value) for value in surface[key]]
        if shape not in FAR_SHAPES:
            surface["points"] = [[as_float32(coordinate) for coordinate in point] for point in surface["points"]]
        surfaces[shape] = surface
    for shape in SHAPES:
        names = [f"{shape}-nodes.{extension}" for extensions in AT_NODES.values() for extension in extensions]
        subprocess.run([WRITE_SURFACE, shape, "nodes", *names], capture_output=True, check=True, cwd=folder)
    return surfaces


def far_extensions(reader):
    """Formats of 64 bits that the reader reads as such."""
    return [name for name in READERS[reader] if name not in ONLY_32_BITS and (reader, name) not in READ_AS_32_BITS]


def read_all(folder, reader):
    """What the reader makes of all files of its formats, by name; None where it is not installed."""
    python = python_with(MODULES.get(reader, reader))
    if python is None:
        return None
    names = [f"{shape}.{extension}" for shape in SHAPES for extension in READERS[reader]]
    names += [f"{shape}.{extension}" for shape in FAR_SHAPES for extension in far_extensions(reader)]
    names += [f"{shape}-nodes.{extension}" for shape in SHAPES for extension in AT_NODES.get(reader, ())]
    if reader in ("pyvista", "pyNastran", "pydyna"):
        names += [f"empty.{extension}" for extension in ("vtp", "vtu", "vtk", "bdf", "k") if extension in READERS[reader]]
    command = [python, "-B", READ_SURFACE, reader, f"{reader}.json", *names]
    result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    if result.returncode != 0:
        raise AssertionError(f"{reader} does not read the files\n{result.stdout}{result.stderr}")
    return json.loads((folder / f"{reader}.json").read_text(encoding="ascii"))


def nodes_of(surface, key):
    """Ends of the marked sides, as a set."""
    nodes = set()
    for corners, edges in zip(surface["faces"], surface[key]):
        for side, corner in enumerate(corners):
            if edges >> side & 1:
                nodes |= {corner, corners[(side + 1) % len(corners)]}
    return nodes


def ranks(surface):
    """Of the vertices: 0 inside of walls, 1 at junctions, 2 at rims."""
    rims, junctions = nodes_of(surface, "rim"), nodes_of(surface, "junction")
    return [2 if vertex in rims else 1 if vertex in junctions else 0 for vertex in range(len(surface["points"]))]


def face_thickness(surface, face):
    """Mean of the corners farthest inside."""
    rank, corners = ranks(surface), surface["faces"][face]
    best = [corner for corner in corners if rank[corner] == min(rank[corner] for corner in corners)]
    return sum(surface["thickness"][corner] for corner in best) / len(best)


def corner_thickness(surface):
    """Of the corners of each face: their own inside of walls, elsewhere that of the face."""
    rank = ranks(surface)
    return [
        [face_thickness(surface, face) if rank[corner] else surface["thickness"][corner] for corner in corners]
        for face, corners in enumerate(surface["faces"])
    ]


def node_thickness(surface):
    """Their own inside of walls, elsewhere the mean by area of the faces that reach farther inside."""
    rank = ranks(surface)
    thickness = []
    for vertex, own in enumerate(surface["thickness"]):
        inner = [
            face
            for face, corners in enumerate(surface["faces"])
            if vertex in corners and min(rank[corner] for corner in corners) < rank[vertex]
        ]
        area = sum(surface["area"][face] for face in inner)
        thickness.append(sum(surface["area"][face] * face_thickness(surface, face) for face in inner) / area if inner else own)
    return thickness


class SurfaceReadersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="medialvoxel-test-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        cls.surfaces = write_all(cls.folder)
        cls.contents = {reader: read_all(cls.folder, reader) for reader in READERS}

    def need(self, reader):
        if self.contents[reader] is None:
            self.skipTest(f"the Python package {reader} is not installed; scripts/mesh-readers does it")

    def check_each(self, extensions, check):
        """Calls check(surface, content, extension) with what each reader made of each file; one missing is a skip."""
        for reader, known in READERS.items():
            with self.subTest(reader):
                self.need(reader)
                for name in (f"{shape}.{extension}" for shape in SHAPES for extension in known if extension in extensions):
                    with self.subTest(f"{name} with {reader}"):
                        shape, extension = name.split(".")
                        check(self.surfaces[shape], self.contents[reader][name], extension)

    def test_faces_and_coordinates(self):
        def check(surface, content, extension):
            faces = surface["faces"]
            if extension in ("stl", "glb"):
                faces = [triangle for face in faces for triangle in split(surface["points"], face)]
            expected = collections.Counter(outline(surface["points"], face, 7) for face in faces)
            found = collections.Counter(outline(content["points"], face, 7) for face in content["faces"])
            self.assertEqual(found, expected)
            self.assertEqual(len(content["points"]), len(surface["points"]))

        self.check_each(EXTENSIONS, check)

    def test_far_from_the_origin(self):
        for reader in READERS:
            for name in (f"{shape}.{extension}" for shape in FAR_SHAPES for extension in far_extensions(reader)):
                with self.subTest(f"{name} with {reader}"):
                    self.need(reader)
                    surface, content = self.surfaces[name.split(".")[0]], self.contents[reader][name]
                    # Fields of Nastran have room for 14 digits and a sign.
                    expected = collections.Counter(outline(surface["points"], face, 13) for face in surface["faces"])
                    found = collections.Counter(outline(content["points"], face, 13) for face in content["faces"])
                    self.assertEqual(found, expected)
                    self.assertEqual(len({tuple(point) for point in content["points"]}), len(surface["points"]))
                    if name.endswith(("vtp", "vtu", "vtk", "ply")):
                        self.assertEqual(content["points"], surface["points"])

    def test_order_of_vertices_and_faces(self):
        def check(surface, content, extension):
            self.assertEqual(content["points"], surface["points"])
            if extension != "glb":  # triangles only
                self.assertEqual(content["faces"], surface["faces"])

        self.check_each(("vtp", "vtu", "vtk", "ply", "glb"), check)

    def test_thickness_of_vertices(self):
        found = collections.Counter()

        def check(surface, content, extension):
            # PyVista leaves out what it does not know of a PLY file, meshio does not.
            if "thickness" in content:
                self.assertEqual(content["thickness"], surface["thickness"])
                found[extension] += 1

        self.check_each(("vtp", "vtu", "vtk", "ply", "glb"), check)
        if self.contents["meshio"] and self.contents["pyvista"]:
            self.assertEqual(set(found), {"vtp", "vtu", "vtk", "ply", "glb"})

    def test_data_of_faces(self):
        def check(surface, content, _):
            for key in ("area", "rim", "junction"):
                self.assertEqual(content[key], surface[key], key)

        self.check_each(("vtp", "vtu", "vtk"), check)

    def check_sections(self, surface, thickness):
        """Thicknesses of the elements, in their order: none is far from its own, and the volume is right."""
        self.assertEqual(len(thickness), len(surface["faces"]))
        volume = expected_volume = 0
        for face, (area, found) in enumerate(zip(surface["area"], thickness)):
            expected = face_thickness(surface, face)
            self.assertLessEqual(abs(found - expected), CLASS_WIDTH)
            volume += area * found
            expected_volume += area * expected
        self.assertAlmostEqual(volume / expected_volume, 1, delta=1e-6)
        self.assertGreaterEqual(len(set(thickness)), 2)

    def test_sections_of_nastran(self):
        self.need("pyNastran")
        for shape in SHAPES:
            with self.subTest(shape):
                surface = self.surfaces[shape]
                self.check_sections(surface, self.contents["pyNastran"][f"{shape}.bdf"]["section_thickness"])

    def test_sections_of_abaqus(self):
        self.need("meshio")
        for shape in SHAPES:
            with self.subTest(shape):
                surface = self.surfaces[shape]
                content = self.contents["meshio"][f"{shape}.inp"]
                text = (self.folder / f"{shape}.inp").read_text(encoding="ascii")
                sections = dict(re.findall(r"^\*SHELL SECTION, ELSET=(\w+), MATERIAL=\w+\n(\S+)$", text, re.MULTILINE))
                # meshio counts the triangles first, the file counts in the order of the surface.
                place_of_face = {}
                for size in (3, 4):
                    for face, corners in enumerate(surface["faces"]):
                        if len(corners) == size:
                            place_of_face[len(place_of_face)] = face
                thickness = [None] * len(surface["faces"])
                for name, value in sections.items():
                    for place in content["sets"][name]:
                        self.assertIsNone(thickness[place_of_face[place]], "an element has two sections")
                        thickness[place_of_face[place]] = float(value)
                self.check_sections(surface, thickness)
                for name, key in (("RIM", "rim"), ("JUNCTION", "junction")):
                    members = {place_of_face[place] for place in content["sets"].get(name, [])}
                    self.assertEqual(members, {face for face, edges in enumerate(surface[key]) if edges}, name)
                    for side in range(4):
                        members = {place_of_face[place] for place in content["sets"].get(f"{name}_E{side + 1}", [])}
                        expected = {face for face, edges in enumerate(surface[key]) if edges >> side & 1}
                        self.assertEqual(members, expected, f"{name}_E{side + 1}")

    def test_sections_of_ls_dyna(self):
        self.need("pydyna")
        for shape in SHAPES:
            with self.subTest(shape):
                surface, content = self.surfaces[shape], self.contents["pydyna"][f"{shape}.k"]
                self.check_sections(surface, content["section_thickness"])
                for name, key in (("RIM", "rim"), ("JUNCTION", "junction")):
                    expected = [face for face, edges in enumerate(surface[key]) if edges]
                    self.assertEqual(content["sets"].get(name, []), expected, name)

    def check_at_nodes(self, reader, check):
        """Calls check(surface, content, name) with the files that have the thickness at nodes."""
        self.need(reader)
        for shape in SHAPES:
            for extension in AT_NODES[reader]:
                name = f"{shape}-nodes.{extension}"
                with self.subTest(name):
                    check(self.surfaces[shape], self.contents[reader][name], name)

    def test_sets_of_nodes(self):
        def check(surface, content, _):
            for name, key in (("RIM", "rim"), ("JUNCTION", "junction")):
                self.assertEqual(content["node_sets"].get(name, []), sorted(nodes_of(surface, key)), name)

        for reader in AT_NODES:
            self.check_at_nodes(reader, check)

    def test_thickness_of_corners(self):
        def check(surface, content, _):
            for found, expected in zip(content["corner_thickness"], corner_thickness(surface), strict=True):
                for one, other in zip(found, expected, strict=True):
                    self.assertAlmostEqual(one / other, 1, delta=1e-5)

        for reader in ("pyNastran", "pydyna"):
            self.check_at_nodes(reader, check)

    def test_thickness_of_nodes(self):
        def check(surface, _, name):
            text = (self.folder / name).read_text(encoding="ascii")
            (lines,) = re.findall(r"^\*NODAL THICKNESS\n((?:\d.*\n)+)", text, re.MULTILINE)
            rows = [line.split(",") for line in lines.splitlines()]
            self.assertEqual([int(row[0]) for row in rows], list(range(1, len(surface["points"]) + 1)))
            for row, expected in zip(rows, node_thickness(surface)):
                self.assertAlmostEqual(float(row[1]) / expected, 1, delta=1e-6)

        self.check_at_nodes("meshio", check)

    def test_no_face(self):
        for reader, extensions in (("pyvista", ("vtp", "vtu", "vtk")), ("pyNastran", ("bdf",)), ("pydyna", ("k",))):
            with self.subTest(reader):
                self.need(reader)
                for extension in extensions:
                    content = self.contents[reader][f"empty.{extension}"]
                    self.assertEqual((content["points"], content["faces"]), ([], []), extension)


if __name__ == "__main__":
    unittest.main()
