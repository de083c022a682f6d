# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The surface of a part with its thickness: against the map, VTK, the geometry of phantoms, and readers of others."""

import json
import math
import pathlib
import subprocess
import unittest

import volumes
from interpreters import python_with
from program import REFUSED, USAGE, ProgramTestCase
from read_part import Part
from read_surface import READERS

SIZE = (40, 36, 34)
SPACING = (0.7, 0.7, 1.2)
SPHERE = ("--local-thickness-method", "sphere")
THRESHOLD = 100
FILES = ("out.vtp", "out.vtu", "out.ply", "out.glb")


def gyroid(size=SIZE, spacing=SPACING):
    """Curved walls of all directions, which the faces of the volume cut, with gray values that are smooth."""
    volume = volumes.Volume(size, [], spacing, "float32")
    for index in volume.indices():
        x, y, z = (0.4 * i * s for i, s in zip(index, spacing))
        wave = math.sin(x) * math.cos(y) + math.sin(y) * math.cos(z) + math.sin(z) * math.cos(x)
        volume.voxels.append(THRESHOLD + 50 * (0.6 - abs(wave)))
    return volume


def ball(radius=11.3, size=(34, 33, 32)):
    volume = volumes.Volume(size, [], None, "float32")
    for index in volume.indices():
        volume.voxels.append(THRESHOLD + 20 * (radius - math.dist(index, (16.2, 15.7, 15.9))))
    return volume


class PartSurfaceTest(ProgramTestCase):
    def build(self, *options, name="out.ply", lower=THRESHOLD, source="in.mha"):
        """Runs the command; the surface of a PLY file and the report."""
        self.run_program("surface", source, name, "--lower", lower, "--report", "r.json", "--overwrite", *options)
        self.report = json.loads((self.folder / "r.json").read_text("utf-8"))
        return Part(self.folder / name) if name.endswith(".ply") else None

    def write(self, volume):
        volumes.write_meta(self.folder / "in.mha", volume)
        return volume

    def test_the_thickness_is_that_of_the_voxel_of_the_object(self):
        volume = self.write(gyroid())
        for options in ((), ("--sub-voxel=off",), ("--local-thickness-method", "sphere")):
            with self.subTest(options):
                self.check_thickness(volume, *options)

    def check_thickness(self, volume, *options):
        self.run_program("extract", "in.mha", "l.mha", "--lower", THRESHOLD, "--smooth", "off", "--local-thickness", "t.mha", "--largest-ball", 9, "--overwrite", *options)
        thickness = dict(zip(volume.indices(), volumes.read_floats(self.folder / "t.mha")))
        values = dict(zip(volume.indices(), volume.voxels))
        part = self.build("--largest-ball", 9, *options)
        found = set()
        for point, length in zip(part.points, part.data["thickness"]):
            index = [coordinate / spacing for coordinate, spacing in zip(point, SPACING)]
            axis = max(range(3), key=lambda k: abs(index[k] - round(index[k])))
            ends = []
            for whole in (math.floor(index[axis]), math.floor(index[axis]) + 1):
                end = tuple(whole if k == axis else round(index[k]) for k in range(3))
                ends.append((values.get(end, 0) >= THRESHOLD, end))
            self.assertEqual(sorted(is_object for is_object, _ in ends), [False, True], point)
            (inside, outside) = (end for _, end in sorted(ends, reverse=True))
            expected = 0.5
            if outside in values and "--sub-voxel=off" not in options:
                expected = (values[inside] - THRESHOLD) / (values[inside] - values[outside])
            self.assertAlmostEqual(abs(index[axis] - inside[axis]), min(max(expected, 1 / 256), 255 / 256), delta=1e-4)
            self.assertEqual(repr(length), repr(thickness[inside]), "also where it is not a number")
            found.add((inside, outside))
        self.assertEqual(len(found), len(part.points), "no two vertices are on the same line")

    def test_walls_on_gray_values_and_on_the_object(self):
        self.write(volumes.blurred_wall(7))
        for options, error in (((), 0.03), (("--sub-voxel=off",), 0.5)):
            part = self.build(*options, lower=1000)
            self.assertEqual(self.report["local_thickness"]["method"], "wall")
            self.assertAlmostEqual(self.report["surface"]["thickness"]["percentiles"]["50"], 7, delta=error)
            self.assertEqual(self.report["measure"]["on"], "object" if options else "fits")
            data = (self.folder / "out.ply").read_bytes()
            for more in (("--divisions", 5, "--threads", 2), ("--threads", 3)):
                self.build(*options, *more, lower=1000)
                self.assertEqual((self.folder / "out.ply").read_bytes(), data)
            self.assertEqual(part.open_sides(), 0)

    def test_closed_with_the_numbers_of_the_report(self):
        self.write(gyroid())
        part = self.build("--ray", "--largest-ball", 9)
        surface = self.report["surface"]
        self.assertEqual(part.open_sides(), 0)
        self.assertEqual((surface["vertices"], surface["triangles"]), (len(part.points), len(part.triangles)))
        self.assertEqual(surface["placed_by"], "values")
        areas = part.areas()
        self.assertAlmostEqual(surface["area"] / sum(areas), 1, delta=1e-5)
        self.assertAlmostEqual(surface["volume"] / part.volume(), 1, delta=1e-4)
        last = [(n - 1) * s for n, s in zip(SIZE, SPACING)]
        is_cap = [
            any(not 0 <= place[k] <= last[k] + 1e-5 for place in part.corners(triangle) for k in range(3)) for triangle in part.triangles
        ]
        self.assertAlmostEqual(surface["cap_area"] / sum(a for a, cap in zip(areas, is_cap) if cap), 1, delta=1e-4)
        self.assertGreater(surface["cap_area"], 50)
        for name, key in (("thickness", "thickness"), ("ray_thickness", "ray_thickness")):
            self.check_statistics(surface[key], part, part.data[name], areas, is_cap)
        unanswered = surface["ray_thickness"]["unanswered"]
        self.assertEqual(sum(unanswered.values()), surface["ray_thickness"]["unknown_vertices"])
        outside = sum(any(not 0 <= place[k] <= last[k] + 1e-5 for k in range(3)) for place in part.points)
        self.assertGreater(unanswered["leave_volume"], outside)
        self.assertGreater(outside, 50)

    def check_statistics(self, statistics, part, lengths, areas, is_cap):
        """A corner has a third of the area of its triangle."""
        known = [
            (lengths[vertex], area / 3)
            for triangle, area, cap in zip(part.triangles, areas, is_cap)
            for vertex in triangle
            if not cap and not math.isnan(lengths[vertex])
        ]
        total = sum(area for _, area in known)
        self.assertAlmostEqual(statistics["area"] / total, 1, delta=1e-4)
        self.assertAlmostEqual(statistics["mean"], sum(length * area for length, area in known) / total, delta=0.01)
        histogram = statistics["histogram"]
        self.assertAlmostEqual(sum(histogram["areas"]) + histogram["above"], statistics["area"], delta=1e-6 * total)
        known.sort()
        half = 0
        for length, area in known:
            half += area
            if half >= total / 2:
                break
        self.assertAlmostEqual(statistics["percentiles"]["50"], length, delta=0.02)
        self.assertEqual(statistics["unknown_vertices"], sum(map(math.isnan, lengths)))

    def test_open_where_the_volume_cuts_the_part(self):
        self.write(gyroid())
        closed = self.build()
        cap_area, area = (self.report["surface"][key] for key in ("cap_area", "area"))
        part = self.build("--open")
        self.assertGreater(part.open_sides(), 0)
        self.assertLess(len(part.points), len(closed.points))
        surface = self.report["surface"]
        self.assertEqual((surface["cap_area"], surface["volume"]), (0, None))
        self.assertAlmostEqual(surface["area"], area - cap_area, delta=1e-6 * area)
        for point in part.points:
            for coordinate, size, spacing in zip(point, SIZE, SPACING):
                self.assertTrue(0 <= coordinate <= (size - 1) * spacing + 1e-5)

    def test_a_ball_has_its_area_volume_and_diameter(self):
        self.write(ball())
        part = self.build("--ray", "--largest-ball", 32, *SPHERE)
        self.assertEqual(part.open_sides(), 0)
        self.assertEqual(len(part.points) - len(part.triangles) // 2, 2)
        self.assertAlmostEqual(part.volume() / (4 / 3 * math.pi * 11.3**3), 1, delta=0.005)
        self.assertAlmostEqual(self.report["surface"]["area"] / (4 * math.pi * 11.3**2), 1, delta=0.005)
        self.assertEqual(self.report["surface"]["cap_area"], 0)
        for length in part.data["ray_thickness"]:
            self.assertAlmostEqual(length, 22.6, delta=0.15)
        # Balls lead from center to center of voxels; on the skin the largest is not all of the part.
        self.assertAlmostEqual(self.report["surface"]["thickness"]["mean"], 22.6, delta=2)

    def test_the_object_alone_places_it_between_voxels(self):
        volume = self.write(ball())
        part = self.build("--sub-voxel=off")
        self.assertEqual(self.report["surface"]["placed_by"], "object")
        for point in part.points:
            self.assertEqual(sorted(c % 1 for c in point), [0, 0, 0.5])
        mask = volumes.Volume(volume.size, [int(value >= THRESHOLD) for value in volume.voxels])
        volumes.write_meta(self.folder / "mask.mha", mask)
        self.run_program("surface", "mask.mha", "mask.ply")
        self.assertEqual((self.folder / "mask.ply").read_bytes(), (self.folder / "out.ply").read_bytes())

    def test_faces_look_outward_where_axes_are_mirrored(self):
        volume = ball()
        header = volumes.meta_header(volume, TransformMatrix="0 0 1 0 1 0 1 0 0", Offset="5 -3 100")
        (self.folder / "in.mha").write_bytes(header + volume.data())
        part = self.build()
        self.assertAlmostEqual(part.volume() / (4 / 3 * math.pi * 11.3**3), 1, delta=0.005)
        center = [sum(point[k] for point in part.points) / len(part.points) for k in range(3)]
        for found, expected in zip(center, (15.9 + 5, 15.7 - 3, 16.2 + 100)):
            self.assertAlmostEqual(found, expected, delta=0.05)

    def test_the_same_bytes_for_any_division_threads_and_memory(self):
        self.write(gyroid())
        expected = None
        for more in (("--threads", 1), ("--threads", 3), ("--divisions", 5), ("--divisions", 34, "--threads", 2), ("--memory", "64M")):
            for name in FILES:
                self.build("--ray", "--largest-ball", 6, *more, name=name)
            found = [(self.folder / name).read_bytes() for name in FILES] + [self.report["surface"]]
            expected = expected or found
            self.assertEqual(found, expected, more)
            self.assertLessEqual(self.report["peak_memory_bytes"], self.report["planned_peak_bytes"])

    def test_grains_have_no_thickness(self):
        volume = ball()
        volume.voxels[volume.size[0] * (volume.size[1] * 2 + 2) + 2] = 200.0
        self.write(volume)
        part = self.build(*SPHERE)
        self.assertEqual(sum(map(math.isnan, part.data["thickness"])), 6)
        self.assertEqual(self.report["surface"]["thickness"]["unknown_vertices"], 6)
        self.assertFalse(any(map(math.isnan, self.build("--max-pore-size", 0, *SPHERE).data["thickness"])))

    def test_values_that_are_not_a_number(self):
        volume = ball()
        middle = volume.size[0] * (volume.size[1] * 15 + 15) + 15
        volume.voxels[middle] = math.nan
        self.write(volume)
        part = self.build("--ray")
        self.assertEqual(part.open_sides(), 0)
        # The hole is seen by the surface around it, and no ray goes through it.
        self.assertEqual(len(part.points) - len(part.triangles) // 2, 4)
        self.assertGreater(self.report["surface"]["ray_thickness"]["unanswered"]["unknown"], 0)

    def test_an_empty_object(self):
        self.write(ball())
        for name in FILES:
            self.build(name=name, lower=1e6)
            surface = self.report["surface"]
            self.assertEqual((surface["vertices"], surface["area"], surface["color_range"]), (0, 0, None))
            self.assertIsNone(surface["thickness"]["mean"])

    def test_readers_of_others_find_the_same(self):
        self.write(gyroid((20, 21, 22)))
        for name in FILES:
            part = self.build("--ray", "--largest-ball", 6, name=name) or None
        part = self.build("--ray", "--largest-ball", 6)
        low, high = self.report["surface"]["color_range"]
        for reader, names in {"pyvista": FILES, "meshio": ("out.ply", "out.vtu"), "trimesh": ("out.glb",)}.items():
            with self.subTest(reader):
                python = python_with(reader)
                if python is None:
                    self.skipTest(f"the Python package {reader} is not installed; scripts/mesh-readers does it")
                command = [python, "-B", str(pathlib.Path(__file__).with_name("read_surface.py")), reader, "r.out", *names]
                result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=self.folder)
                self.assertEqual(result.returncode, 0, result.stderr)
                for name, content in json.loads((self.folder / "r.out").read_text("ascii")).items():
                    self.check_content(part, content, name, (low, high))
        self.assertLessEqual({"pyvista", "meshio", "trimesh"}, set(READERS))

    def check_content(self, part, content, name, color_range):
        self.assertEqual(list(map(tuple, content["points"])), part.points, name)
        self.assertEqual(list(map(tuple, content["faces"])), part.triangles, name)
        for key, expected in part.data.items():
            if key not in content:
                self.assertEqual(name, "out.ply", "of VTK, which leaves out what it does not know")
                continue
            for found, length in zip(content[key], expected):
                if math.isnan(length):
                    self.assertTrue(found == 0 if name == "out.glb" else math.isnan(found), name)
                else:
                    self.assertEqual(found, length, name)
        if "colors" in content:
            self.check_colors(content["colors"], part.data["thickness"], color_range)
        if "cap" in content:
            self.assertEqual(set(content["cap"]), {0, 1})

    def check_colors(self, colors, thickness, color_range):
        """Equal colors from the ends of the range on, and lightness grows with the thickness."""
        scale = 255 if max(max(color) for color in colors) > 1 else 1
        light = [sum(w * c / scale for w, c in zip((0.2126, 0.7152, 0.0722), color)) for color in colors]
        ordered = [value for _, value in sorted(pair for pair in zip(thickness, light) if not math.isnan(pair[0]))]
        for before, after in zip(ordered, ordered[1:]):
            self.assertLessEqual(before, after + 0.01)
        self.assertGreater(ordered[-1], ordered[0] + 0.5)
        self.assertEqual(len({tuple(c) for c, t in zip(colors, thickness) if t >= color_range[1] + 0.1}) <= 1, True)

    def test_equals_the_surface_of_vtk(self):
        python = python_with("vtk")
        if python is None:
            self.skipTest("the Python package vtk is not installed; scripts/mesh-readers does it")
        for volume in (gyroid(), ball(), volumes.blurred_wall()):
            threshold = 1000 if volume.kind == "int16" else THRESHOLD
            self.write(volume)
            self.build("--open", name="out.vtp", lower=threshold)
            script = str(pathlib.Path(__file__).with_name("compare_isosurface.py"))
            command = [python, "-B", script, "out.vtp", "in.mha", str(threshold)]
            result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=self.folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            found = json.loads(result.stdout)
            self.assertEqual(found["ours"]["points"], found["vtk"]["points"])
            self.assertAlmostEqual(found["ours"]["area"] / found["vtk"]["area"], 1, delta=2e-3)
            self.assertLess(found["distance"], 0.1)

    def test_errors(self):
        self.write(ball())
        flat = volumes.Volume((20, 20), [1] * 400)
        volumes.write_meta(self.folder / "flat.mha", flat)
        (self.folder / "old.ply").write_bytes(b"old")
        lower = ("--lower", THRESHOLD)
        for status, words, arguments in (
            (USAGE, ["out.stl", "surface", ".vtp, .vtu, .ply, .glb"], ("in.mha", "out.stl", *lower)),
            (USAGE, ["flat.mha", "surface", "3"], ("flat.mha", "out.ply")),
            (REFUSED, ["old.ply", "--overwrite"], ("in.mha", "old.ply", *lower)),
            (USAGE, ["0", "greater than 0"], ("in.mha", "out.ply", "--largest-ball", 0, *lower)),
            (USAGE, ["300", "at most 256 voxels"], ("in.mha", "out.ply", "--largest-ball", 300, *lower)),
            (USAGE, ["--max-pore-size", "'-1'", "0 to 1000000"], ("in.mha", "out.ply", "--max-pore-size", -1, *lower)),
            (USAGE, ["one threshold"], ("in.mha", "out.ply", "--sub-voxel", *lower, "--upper", 200)),
            (REFUSED, ["MiB", "at least"], ("in.mha", "out.ply", "--memory", "3M", *lower)),
            (USAGE, ["in.mha"], ("in.mha", "in.mha", "--overwrite", *lower)),
        ):
            self.assert_fails(status, words, "surface", *arguments)

    def test_a_run_that_fails_leaves_the_old_file(self):
        self.write(ball())
        content = (self.folder / "in.mha").read_bytes()
        (self.folder / "in.mha").write_bytes(content[: len(content) // 2])
        for name in FILES:
            (self.folder / name).write_bytes(b"old")
            before = self.snapshot()
            self.run_program("surface", "in.mha", name, "--lower", THRESHOLD, "--overwrite", status=4)
            self.assertEqual(self.snapshot(), before)


if __name__ == "__main__":
    unittest.main()
