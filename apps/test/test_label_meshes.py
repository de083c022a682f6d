# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of label maps: object after object, each as it is in the run with its label alone.

MEDIALVOXEL_LABEL_MESHES is the number of random maps; default 16.
"""

import json
import os
import pathlib
import random
import re
import subprocess
import unittest

import volumes
from interpreters import python_with
from program import ProgramTestCase
from test_label_maps import make_map
from test_mesh import Mesh

NUMBER_OF_MAPS = int(os.environ.get("MEDIALVOXEL_LABEL_MESHES", 16))


def make_solid_map(dice):
    while True:
        volume = make_map(dice)
        if len(volume.size) == 3 and min(volume.size) > 7:
            return volume


def touching_shapes(size=(40, 36, 34)):
    """A tilted wall that goes through a hollow ball, a plate on it, and a bar three voxels from the plate."""
    volume = volumes.Volume(size, [], [0.5, 0.5, 0.7], "int16")

    def value(x, y, z):
        radius = ((x - 20) ** 2 + (y - 18) ** 2 + (z - 16) ** 2) ** 0.5
        if abs((x - 20) * 0.3 + (y - 18) * 0.2 + (z - 16)) < 2.2:
            return 12
        if 9 <= radius < 13:
            return -3
        if 28 <= z < 31:
            return 300
        return 7 if z < 3 and 4 < x < 14 else 0

    volume.voxels = [value(*index) for index in volume.indices()]
    return volume


def put_together(meshes):
    """Vertices with their labels, and faces, of meshes by label."""
    vertices, faces = [], []
    for label, mesh in sorted(meshes.items()):
        faces += [tuple(corner + len(vertices) for corner in face) for face in mesh.faces]
        vertices += [(*vertex, label) for vertex in mesh.vertices]
    return vertices, faces


def read_with(reader, folder, names):
    """What a library reads from mesh files, as read_surface.py tells; None where it is not installed."""
    python = python_with({"pyNastran": "pyNastran.bdf.bdf", "pydyna": "ansys.dyna.core"}.get(reader, reader))
    if python is None:
        return None
    script = pathlib.Path(__file__).with_name("read_surface.py")
    subprocess.run([python, "-B", script, reader, "read.json", *names], capture_output=True, check=True, cwd=folder)
    return json.loads((folder / "read.json").read_text(encoding="ascii"))


# Elements of a size depend on what else is in the mesh: the mean side of its faces.
OF_VOXELS = ("--element-size", "voxel")


class LabelMeshTest(ProgramTestCase):
    def mesh_labels(self, name, mesh, *options, thickness="auto"):
        arguments = ("--labels", "all", "--mesh", mesh, *OF_VOXELS, "--report", "all.json", "--overwrite", *options)
        self.extract(name, "all.mha", *arguments, thickness=thickness)
        return (self.folder / mesh).read_bytes()

    def mesh_label(self, name, mesh, label, *options, thickness="auto"):
        arguments = ("--label", label, "--smooth", "off", "--mesh", mesh, *OF_VOXELS, "--overwrite", *options)
        self.extract(name, "one.mha", *arguments, thickness=thickness)

    def check_map(self, volume, *options, run=(), thickness="auto", compressed=False):
        """Compares the mesh of all labels with those of each.

        Returns the number of faces, and whether objects shared a pass.
        """
        volumes.write_meta(self.folder / "map.mha", volume, compressed=compressed)
        self.mesh_labels("map.mha", "all.ply", *options, *run, thickness=thickness)
        alone = {}
        for label in sorted({int(v) for v in volume.voxels} - {0}):
            self.mesh_label("map.mha", "one.ply", label, *options, thickness=thickness)
            alone[label] = Mesh(self.folder / "one.ply")
        vertices, faces = put_together(alone)
        found = Mesh(self.folder / "all.ply")
        what = f"{volume.size} {volume.kind} {volume.spacing} {sorted(alone)} {thickness} {options} {run}"
        self.assertEqual(found.vertices, vertices, what)
        self.assertEqual(found.faces, faces, what)
        report = json.loads((self.folder / "all.json").read_text(encoding="utf-8"))
        self.assertEqual([report["mesh"]["vertices"], report["mesh"]["faces"]], [len(vertices), len(faces)])
        return len(faces), report["passes"] < len(alone)

    def test_random_maps(self):
        faces = joined = 0
        for seed in range(NUMBER_OF_MAPS):
            with self.subTest(seed=seed):
                dice = random.Random(seed)
                volume = make_solid_map(dice)
                options = dice.choice([(), (), ("--max-pore-size", 0), ("--max-pore-size", 300)])
                run = dice.choice([(), ("--threads", 1), ("--divisions", 3), ("--memory", "64M")])
                thickness, compressed = dice.choice(["auto", "auto", 2, 3, 6]), dice.random() < 0.3
                found = self.check_map(volume, *options, run=run, thickness=thickness, compressed=compressed)
                faces, joined = faces + found[0], joined + found[1]
        self.assertGreater(faces, 100 * NUMBER_OF_MAPS)
        self.assertGreater(joined, 0, "maps whose objects share a pass")

    def test_touching_shapes(self):
        for options in ({"thickness": 1.2}, {"run": ("--divisions", 5)}):
            faces, joined = self.check_map(touching_shapes(), **options)
            self.assertGreater(faces, 2000, options)
            self.assertTrue(joined, options)

    def test_divisions_threads_and_memory(self):
        volumes.write_meta(self.folder / "map.mha", touching_shapes())
        for mesh in ("m.ply", "m.vtp", "m.inp", "m.k", "m.obj"):
            expected = self.mesh_labels("map.mha", mesh, "--divisions", 1, "--threads", 1)
            report = json.loads((self.folder / "all.json").read_text(encoding="utf-8"))
            for run in (("--divisions", 4), ("--divisions", 34, "--threads", 3), ("--memory", "60M")):
                self.assertEqual(self.mesh_labels("map.mha", mesh, *run), expected, (mesh, run))
                other = json.loads((self.folder / "all.json").read_text(encoding="utf-8"))
                self.assertEqual(other["mesh"], report["mesh"], (mesh, run))

    def read_shapes(self, reader, extension):
        """What a library reads from the mesh of the labels of the touching shapes, and from those of each label.

        The last result is the name of the first file.
        """
        volumes.write_meta(self.folder / "map.mha", touching_shapes())
        name = f"all.{extension}"
        # Elements of another size are those of all objects together, whose sizes follow from all of them.
        self.mesh_labels("map.mha", name, thickness=1.2)
        labels = (-3, 7, 12, 300)
        for label in labels:
            self.mesh_label("map.mha", f"{label}.{extension}", label, thickness=1.2)
        contents = read_with(reader, self.folder, [name, *(f"./{label}.{extension}" for label in labels)])
        if contents is None:
            self.skipTest(f"the Python package {reader} is not installed; scripts/mesh-readers does it")
        return contents[name], {label: contents[f"./{label}.{extension}"] for label in labels}

    def read_text(self, name):
        return (self.folder / name).read_text(encoding="ascii")

    def test_objects_of_faces(self):
        for reader, extension in (("pyvista", "vtp"), ("pyvista", "vtu"), ("pyvista", "vtk"), ("meshio", "vtu")):
            with self.subTest(f"{extension} with {reader}"):
                content, alone = self.read_shapes(reader, extension)
                self.assertEqual(content["object"], [label for label, one in alone.items() for _ in one["faces"]])
                self.assertFalse(any("object" in one for one in alone.values()))

    def test_objects_of_vertices(self):
        content, alone = self.read_shapes("meshio", "ply")
        self.assertEqual(content["object_of_points"], [label for label, one in alone.items() for _ in one["points"]])

    def test_groups(self):
        content, alone = self.read_shapes("meshio", "obj")
        self.assertEqual(content["group"], [number for number, one in enumerate(alone.values()) for _ in one["faces"]])
        groups = re.findall(r"^g (\S+)$", self.read_text("all.obj"), re.MULTILINE)
        self.assertEqual(groups, ["OBJECT_MINUS_3", "OBJECT_7", "OBJECT_12", "OBJECT_300"])

    def test_sets_of_abaqus(self):
        content, alone = self.read_shapes("meshio", "inp")
        section = re.compile(r"^\*SHELL SECTION.*\n(\S+)$", re.MULTILINE)
        sections = []
        for label, one in alone.items():
            places = content["sets"][f"OBJECT_{label}".replace("-", "MINUS_")]
            found = [tuple(content["points"][corner] for corner in content["faces"][place]) for place in places]
            expected = [tuple(one["points"][corner] for corner in face) for face in one["faces"]]
            self.assertEqual(sorted(found), sorted(expected), label)
            self.assertNotIn("OBJECT", self.read_text(f"{label}.inp"))
            sections += section.findall(self.read_text(f"{label}.inp"))
        self.assertEqual(section.findall(self.read_text("all.inp")), sections)

    def test_properties_of_nastran(self):
        content, alone = self.read_shapes("pyNastran", "bdf")
        expected = [thickness for one in alone.values() for thickness in one["section_thickness"]]
        self.assertEqual(content["section_thickness"], expected)

    def test_parts_of_ls_dyna(self):
        content, alone = self.read_shapes("pydyna", "k")
        expected = [thickness for one in alone.values() for thickness in one["section_thickness"]]
        self.assertEqual(content["section_thickness"], expected)
        sizes = [len(set(one["section_thickness"])) for one in alone.values()]
        self.assertEqual([len(parts) for parts in content["part_sets"].values()], sizes)
        names = [f"OBJECT_{label}".replace("-", "MINUS_") for label in alone]
        self.assertEqual(list(content["part_sets"]), names)


if __name__ == "__main__":
    unittest.main()
