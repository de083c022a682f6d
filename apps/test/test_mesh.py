# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of the medial surface: the same bytes for any division, where they lie, and what is refused."""

import array
import json
import math
import re
import struct
import subprocess
import unittest

import volumes
from program import PROGRAM, REFUSED, USAGE, ProgramTestCase
from test_identity import rough_shell


class Mesh:
    """Vertices (x, y, z, thickness), of a label map with the label of the object, faces, and perhaps walls of a PLY file."""

    def __init__(self, path):
        header, data = path.read_bytes().split(b"end_header\n", 1)
        vertices = int(re.search(rb"element vertex (\d+)", header)[1])
        faces = int(re.search(rb"element face (\d+)", header)[1])
        self.is_double = b"property double x" in header
        record = struct.Struct(("<dddf" if self.is_double else "<ffff") + ("i" if b"property int object" in header else ""))
        position = record.size * vertices
        self.vertices = list(record.iter_unpack(data[:position]))
        self.faces, self.walls = [], []
        for _ in range(faces):
            end = position + 1 + 4 * data[position]
            self.faces.append(tuple(array.array("I", data[position + 1 : end])))
            position = end
            if b"property uint wall" in header:
                self.walls += struct.unpack_from("<I", data, position)
                position += 4
        assert position == len(data), "bytes after the last face"


def plate(size=(14, 13, 12), spacing=(0.5, 0.5, 0.5)):
    """A plate of four voxels across z through the whole image."""
    volume = volumes.Volume(size, [], spacing)
    volume.voxels = [1 if 4 <= z < 8 else 0 for _, _, z in volume.indices()]
    return volume


class MeshTest(ProgramTestCase):
    def mesh(self, source, target, *arguments, thickness=2, **options):
        return self.run_program("mesh", source, target, "--thickness", thickness, *arguments, **options)

    def write(self, volume, name="in.mha", **changes):
        volumes.write_meta(self.folder / name, volume, **changes)

    def test_divisions_threads_and_memory(self):
        self.write(rough_shell())
        for name in ("m.ply", "m.vtp", "m.inp"):
            # Elements of a size take more memory: test_elements has their divisions and threads.
            size = ("--element-size", "voxel")
            self.mesh("in.mha", name, *size, "--divisions", 1, "--threads", 1)
            expected = (self.folder / name).read_bytes()
            for arguments in (("--divisions", 3), ("--divisions", 33, "--threads", 3), ("--memory", "60M")):
                self.mesh("in.mha", name, "--overwrite", *size, *arguments)
                self.assertEqual((self.folder / name).read_bytes(), expected, (name, arguments))
        self.assertGreater(len(Mesh(self.folder / "m.ply").faces), 1000)

    def test_pieces_of_many_cells(self):
        """Cells wait for their piece to be done: many at a time only where memory allows."""
        size = (96, 96, 96)
        volume = volumes.Volume(size, [])
        volume.voxels = [1 if z % 6 < 2 else 0 for z in range(size[2]) for _ in range(size[0] * size[1])]
        self.write(volume)

        def smallest_memory():
            for memory in range(16, 200):
                plan = ("mesh", "in.mha", "m.ply", "--thickness", 2, "--threads", 1, "--divisions", 1, "--dry-run", "--memory", f"{memory}M")
                if subprocess.run([PROGRAM, *map(str, plan)], cwd=self.folder, capture_output=True, check=False).returncode == 0:
                    return memory
            return None

        def shortened(name, *arguments):
            log = self.folder / f"{name}.log"
            self.mesh("in.mha", name, "--threads", 1, "--divisions", 1, "--log-file", log, "--report", "r.json", *arguments)
            report = json.loads((self.folder / "r.json").read_text())
            self.assertLessEqual(report["peak_memory_bytes"], report["planned_peak_bytes"], arguments)
            return log.read_text().count(" shorten ")

        memory = smallest_memory()
        self.assertEqual(shortened("ample.ply", "--memory", "1G"), 0)
        self.assertIn(shortened("small.ply", "--memory", f"{memory}M", "--overwrite"), (1, 2, 3))
        self.assertEqual((self.folder / "small.ply").read_bytes(), (self.folder / "ample.ply").read_bytes())
        self.assertGreater(len(Mesh(self.folder / "ample.ply").vertices), 1 << 16)

    def test_automatic_thickness(self):
        self.write(rough_shell())
        self.mesh("in.mha", "m.ply", "--divisions", 1, thickness="auto")
        expected = (self.folder / "m.ply").read_bytes()
        for arguments in (("--divisions", 5), ("--threads", 3)):
            self.mesh("in.mha", "m.ply", "--overwrite", *arguments, thickness="auto")
            self.assertEqual((self.folder / "m.ply").read_bytes(), expected, arguments)
        self.assertGreater(len(Mesh(self.folder / "m.ply").faces), 1000)

    def test_compressed_input_and_scratch_folder(self):
        self.write(rough_shell())
        self.write(rough_shell(), "packed.mha", compressed=True)
        self.mesh("in.mha", "expected.ply")
        (self.folder / "scratch").mkdir()
        self.mesh("packed.mha", "m.ply", "--scratch", "scratch")
        self.assertEqual((self.folder / "m.ply").read_bytes(), (self.folder / "expected.ply").read_bytes())
        self.assertEqual(list((self.folder / "scratch").iterdir()), [])

    def test_beside_the_labels(self):
        self.write(rough_shell())
        self.extract("in.mha", "labels.mha", thickness=2)
        self.mesh("in.mha", "alone.ply")
        self.extract("in.mha", "both.mha", "--mesh", "both.ply", "--report", "r.json", "--html", "r.html", thickness=2)
        self.assertEqual((self.folder / "both.ply").read_bytes(), (self.folder / "alone.ply").read_bytes())
        self.assertEqual((self.folder / "both.mha").read_bytes(), (self.folder / "labels.mha").read_bytes())
        mesh = Mesh(self.folder / "both.ply")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["mesh"]["vertices"], len(mesh.vertices))
        self.assertEqual(report["mesh"]["faces"], len(mesh.faces))
        self.assertEqual(report["outputs"]["mesh"], "both.ply")

    def test_a_plate_in_physical_space(self):
        changes = {"Offset": "10 20 30", "TransformMatrix": "0 1 0 0 0 1 1 0 0"}
        self.write(plate(), **changes)
        result = self.mesh("in.mha", "m.ply", "--report", "r.json")
        self.assertIn("156 vertices, 132 faces", result.stdout)
        mesh = Mesh(self.folder / "m.ply")
        for x, y, z, thickness in mesh.vertices:
            # The axes of the image run along y, z and x.
            self.assertAlmostEqual(x, 10 + 5.5 * 0.5, delta=0.01)
            self.assertTrue(20 < y < 20 + 13 * 0.5)
            self.assertTrue(30 < z < 30 + 12 * 0.5)
            self.assertEqual(thickness, 2.0)
        area = json.loads((self.folder / "r.json").read_text())["mesh"]["area"]
        self.assertAlmostEqual(area, 12 * 11 * 0.25, delta=2)

    def test_far_from_the_origin(self):
        shell = rough_shell()
        self.write(shell, "far.mha", Offset="2e7 -2e7 1e7", ElementSpacing="0.3 0.3 0.3")
        self.write(shell, "near.mha", ElementSpacing="0.3 0.3 0.3")
        tau = {"thickness": 1.2}
        self.mesh("near.mha", "near.ply", **tau)
        self.mesh("far.mha", "far.ply", **tau)
        near, far = Mesh(self.folder / "near.ply"), Mesh(self.folder / "far.ply")
        self.assertFalse(near.is_double)
        self.assertTrue(far.is_double)
        self.assertEqual(far.faces, near.faces)
        self.assertEqual(len({vertex[:3] for vertex in far.vertices}), len(far.vertices))
        for a, b in zip(near.vertices, far.vertices):
            for k, origin in enumerate((2e7, -2e7, 1e7)):
                self.assertAlmostEqual(a[k] + origin, b[k], delta=1e-5)
        self.mesh("far.mha", "cut.ply", "--min-component-size", 2, **tau)
        self.assertEqual((self.folder / "cut.ply").read_bytes(), (self.folder / "far.ply").read_bytes())
        self.assert_fails(
            USAGE, ["m.stl", "far.mha", "20000", "0.3"], "mesh", "far.mha", "m.stl", "--thickness", 1.2
        )
        self.assertFalse((self.folder / "m.stl").exists())

    def test_lengths_in_voxels(self):
        self.write(plate())
        self.mesh("in.mha", "physical.ply", thickness=2)
        self.mesh("in.mha", "voxels.ply", thickness="4vx")
        self.assertEqual((self.folder / "voxels.ply").read_bytes(), (self.folder / "physical.ply").read_bytes())

    def test_triangles(self):
        self.write(rough_shell())
        self.mesh("in.mha", "quads.ply")
        self.mesh("in.mha", "triangles.ply", "--triangles")
        quads = Mesh(self.folder / "quads.ply")
        triangles = Mesh(self.folder / "triangles.ply")
        self.assertEqual(triangles.vertices, quads.vertices)
        self.assertEqual(len(triangles.faces), 2 * len(quads.faces))

        def length(a, b):
            return math.dist(quads.vertices[a][:3], quads.vertices[b][:3])

        for quad, one, other in zip(quads.faces, triangles.faces[::2], triangles.faces[1::2]):
            self.assertEqual({*one, *other}, {*quad})
            diagonal = {*one} & {*other}
            self.assertEqual(len(diagonal), 2)
            self.assertLessEqual(length(*diagonal), length(*({*quad} - diagonal)) + 1e-6)

    def test_bytes_of_vtk_arrays_have_the_order_of_their_names(self):
        """Compilers choose in which order the parts of an expression are computed."""
        self.write(rough_shell())
        for name in ("m.vtp", "m.vtu"):
            self.mesh("in.mha", name)
            head = (self.folder / name).read_bytes().split(b"<AppendedData")[0]
            offsets = [int(offset) for offset in re.findall(rb'offset="(\d+)"', head)]
            self.assertGreaterEqual(len(offsets), 7)
            self.assertEqual(offsets, sorted(offsets), name)

    def test_small_components_are_left_out(self):
        def plates(with_small_one):
            volume = volumes.Volume((30, 24, 20), [])
            for x, y, z in volume.indices():
                small = x >= 22 and y < 10 and 10 <= z < 13
                volume.voxels.append(1 if (x < 18 and 4 <= z < 7) or (with_small_one and small) else 0)
            return volume

        self.write(plates(False), "one.mha")
        self.write(plates(True), "both.mha")
        self.mesh("one.mha", "one.ply", "--report", "r.json")
        self.mesh("both.mha", "both.ply", "--min-component-size", 100, "--divisions", 6, "--report", "both.json")
        self.assertEqual((self.folder / "both.ply").read_bytes(), (self.folder / "one.ply").read_bytes())
        one, both = (json.loads((self.folder / name).read_text())["mesh"] for name in ("r.json", "both.json"))
        area = one.pop("area")
        self.assertAlmostEqual(area, both.pop("area"), places=2)
        pieces = both.pop("pieces_left_out")
        self.assertIsNone(one.pop("pieces_left_out"))
        self.assertEqual(one, both)
        self.mesh("both.mha", "all.ply")
        self.assertGreater(len(Mesh(self.folder / "all.ply").faces), one["faces"])
        self.mesh("both.mha", "all.vtp", "--report", "all.json")
        whole = json.loads((self.folder / "all.json").read_text())["mesh"]["area"]
        self.assertEqual(pieces["number"], 1)
        self.assertAlmostEqual(pieces["area"], whole - area, places=2)
        self.mesh("both.mha", "none.ply", "--min-component-size", 100000)
        self.assertEqual(Mesh(self.folder / "none.ply").faces, [])

    def write_rib(self):
        """A plate with a rib, both of three voxels, and a small plate by itself."""
        volume = volumes.Volume((34, 26, 24), [])
        for x, y, z in volume.indices():
            part = 3 <= y < 23 and ((3 <= x < 31 and 3 <= z < 6) or (16 <= x < 19 and 6 <= z < 16))
            volume.voxels.append(1 if part or (x < 6 and y < 8 and 14 <= z < 17) else 0)
        self.write(volume)

    def test_short_branches_are_left_out(self):
        self.write_rib()
        report = ("--report", "r.json", "--overwrite")
        sizes = []
        for arguments in ([], ["--min-branch-length", 5], ["--min-branch-length", 12], ["--min-component-size", 60]):
            self.mesh("in.mha", "m.ply", *arguments, *report, thickness=3)
            mesh = Mesh(self.folder / "m.ply")
            told = json.loads((self.folder / "r.json").read_text())
            self.assertEqual(told["mesh"]["faces"], len(mesh.faces))
            self.assertEqual({v for face in mesh.faces for v in face}, set(range(len(mesh.vertices))))
            sizes.append(len(mesh.faces))
        self.assertEqual(told["parameters"]["min_branch_length"], 0)
        self.assertEqual(sizes[1], sizes[0])
        self.assertLess(sizes[2], sizes[0] - 100)
        both = ("--min-branch-length", 12, "--min-component-size", 60)
        self.mesh("in.mha", "both.vtp", *both, thickness=3)
        expected = (self.folder / "both.vtp").read_bytes()
        for arguments in (("--divisions", 7, "--threads", 3), ("--divisions", 24), ("--memory", "60M")):
            self.mesh("in.mha", "m.vtp", *both, *arguments, "--overwrite", thickness=3)
            self.assertEqual((self.folder / "m.vtp").read_bytes(), expected, arguments)
        self.mesh("in.mha", "quads.ply", *both, thickness=3)
        self.mesh("in.mha", "triangles.ply", *both, "--triangles", thickness=3)
        quads, triangles = (Mesh(self.folder / f"{name}.ply") for name in ("quads", "triangles"))
        self.assertEqual(triangles.vertices, quads.vertices)
        self.assertEqual(len(quads.faces), sizes[2] - (sizes[0] - sizes[3]))
        for quad, one, other in zip(quads.faces, triangles.faces[::2], triangles.faces[1::2]):
            self.assertEqual({*one, *other}, {*quad})

    def test_surfaces_that_are_too_large_to_be_cut(self):
        """Sheets on every third slice have many more vertices than are planned for."""
        size = 200
        data = (b"\1" * size**2 + bytes(2 * size**2)) * (size // 3)
        (self.folder / "in.raw").write_bytes(data)
        raw = ("--raw-size", f"{size},{size},{len(data) // size**2}", "--raw-type", "uint8")
        self.mesh("in.raw", "m.ply", *raw, "--memory", "48M")
        (self.folder / "m.ply").unlink()
        arguments = ("mesh", "in.raw", "m.ply", *raw, "--thickness", 1)
        parts = ["vertices", "of memory", "--memory"]
        for cleaning in (("--min-branch-length", 1, "--memory", "48M"), ("--min-component-size", 10, "--memory", "40M")):
            self.assert_fails(REFUSED, parts, *arguments, *cleaning)

    def test_gray_values_move_the_surface(self):
        self.write(volumes.blurred_wall(), "gray.mha")

        def mesh(*arguments):
            self.mesh("gray.mha", "m.ply", "--lower", 1000, "--overwrite", *arguments, thickness=3)
            return (self.folder / "m.ply").read_bytes()

        def mean_distance():
            """To the middle of the wall, further than three voxels from the faces of the volume."""
            normal, size = (0.2, 0.37, 0.91), (40, 36, 34)
            length = math.hypot(*normal)
            inside = [
                point
                for *point, _ in Mesh(self.folder / "m.ply").vertices
                if all(3 < c < s - 4 for c, s in zip(point, size))
            ]
            self.assertGreater(len(inside), 500)
            distances = (sum(n * (c - s / 2.1) for n, c, s in zip(normal, point, size)) for point in inside)
            return sum(map(abs, distances)) / length / len(inside)

        binary = mesh("--sub-voxel=off")
        self.assertGreater(mean_distance(), 0.015)
        gray = mesh("--divisions", 1, "--threads", 1)
        self.assertLess(mean_distance(), 0.005)
        self.assertNotEqual(gray, binary)
        for arguments in (("--divisions", 7, "--threads", 3), ("--divisions", 34), ("--memory", "50M")):
            self.assertEqual(mesh(*arguments), gray, arguments)
        self.extract("gray.mha", "l.mha", "--mesh", "beside.ply", "--lower", 1000, thickness=3)
        self.assertEqual((self.folder / "beside.ply").read_bytes(), gray)
        self.assert_fails(USAGE, ["threshold"], "mesh", "gray.mha", "x.ply", "--thickness", 3, "--sub-voxel")

    def test_volumes_without_surface(self):
        for name, volume in (
            ("empty.mha", volumes.Volume((6, 5, 4), [0] * 120)),
            ("full.mha", volumes.Volume((6, 5, 4), [1] * 120)),
            ("slice.mha", volumes.Volume((6, 5, 1), [0, 1, 1, 1, 1, 0] * 5)),
        ):
            self.write(volume, name)
            self.mesh(name, name + ".ply")
            mesh = Mesh(self.folder / (name + ".ply"))
            self.assertEqual((mesh.vertices, mesh.faces), ([], []), name)

    def test_refusals(self):
        self.write(plate())
        self.write(volumes.Volume((6, 5), [0, 1, 1, 1, 1, 0] * 5), "flat.mha")
        (self.folder / "there.ply").write_bytes(b"")
        mesh = ("mesh", "in.mha")
        tau = ("--thickness", 2)
        self.assert_fails(USAGE, ["m.xyz", ".vtp"], *mesh, "m.xyz", *tau)
        self.assert_fails(USAGE, ["flat.mha", "2 dimensions"], "mesh", "flat.mha", "m.ply", *tau)
        self.assert_fails(USAGE, ["thickness", "0"], *mesh, "m.ply", "--thickness", 0)
        for length in ("-1", "nan", "inf", "x"):
            self.assert_fails(USAGE, [length], *mesh, "m.ply", *tau, f"--min-branch-length={length}")
        self.assert_fails(USAGE, ["m.ply", "mesh", "report"], *mesh, "m.ply", *tau, "--report", "m.ply")
        self.assert_fails(REFUSED, ["there.ply"], *mesh, "there.ply", *tau)
        self.assert_fails(REFUSED, ["none"], *mesh, "none/m.ply", *tau)
        self.assert_fails(REFUSED, ["nowhere"], *mesh, "m.ply", *tau, "--scratch", "nowhere")

    def test_a_plan_writes_nothing(self):
        self.write(plate())
        plan = self.mesh("in.mha", "m.ply", "--dry-run")
        self.assertIn("m.ply", plan.stdout)
        self.assertRegex(plan.stdout, r"scratch +about .* in \.")
        self.assertFalse((self.folder / "m.ply").exists())


if __name__ == "__main__":
    unittest.main()
