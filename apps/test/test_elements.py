# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Meshes with elements of a size, and their quality, against the Verdict library."""

import json
import math
import os
import pathlib
import shutil
import sys
import unittest

import volumes
from program import USAGE, ProgramTestCase

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
sys.path.append(str(SOURCE / "examples/fem"))

from shell_model import ShellModel, solve  # noqa: E402

try:
    import numpy
    import pyvista
except ImportError:
    pyvista = None

DATA = SOURCE / "../shared/data"
SAME = ("--element-size", "auto", "--extend-rims=off", "--min-component-size", 0)  # of all formats


def plate():
    volume = volumes.Volume((30, 26, 12), [], (0.5, 0.5, 0.5))
    volume.voxels = [1 if 4 <= z < 8 and 3 <= x < 27 else 0 for x, _, z in volume.indices()]
    return volume


def failing(mesh):
    """Names of the limits of a report's mesh that do not hold."""
    return [limit["name"] for limit in mesh["quality"]["limits"] if not limit["holds"]]


@unittest.skipUnless(DATA.is_dir(), f"{DATA} not found")
class RealElementsTest(ProgramTestCase):
    def mesh(self, name, *arguments):
        report = self.run_program("mesh", DATA / "engine.mha", name, "--lower", 72, "--report", "-", *arguments).stdout
        return json.loads(report)["mesh"]

    def test_engine(self):
        mesh = self.mesh("engine.inp", "--element-size", "auto", "--extend-rims=off")
        self.assertEqual(failing(mesh), [])
        remeshing = mesh["remeshing"]
        self.assertLessEqual(mesh["faces"], 15000)
        # The fine mesh on gray values is rougher than the part.
        self.assertAlmostEqual(mesh["area"] / remeshing["area_before"], 1, delta=0.03)
        mean = remeshing["distance_to_fine"]["mean"]
        self.assertLessEqual(mean, 0.5)
        # Elements are as long as the wall is thick, which shows where it bends or ends.
        elsewhere, share = remeshing["mean_distance_elsewhere"], remeshing["area_share_elsewhere"]
        self.assertLess(elsewhere, 0.25)
        self.assertAlmostEqual(share * elsewhere + (1 - share) * remeshing["mean_distance_at_lines"], mean, places=9)

    def test_limits_that_fail_are_a_warning(self):
        run = self.run_program("mesh", DATA / "shell.nrrd", "m.vtp", "--lower", 65, "--element-size", 100, "--report", "r.json", "--phases")
        report = json.loads((self.folder / "r.json").read_text())
        names = failing(report["mesh"])
        self.assertGreater(len(names), 0)
        (found,) = (warning for warning in report["warnings"] if warning["code"] == "poor_elements")
        self.assertIn(found["message"], run.warnings)
        for limit in report["mesh"]["quality"]["limits"]:
            self.assertEqual(limit["name"] in found["message"], not limit["holds"])
        self.assertRegex(run.stdout, rf"\n  {names[0]} +\S+, (less|more) than ")

    def test_same_bytes_for_any_division(self):
        contents = set()
        for number, arguments in enumerate(
            (["--divisions", 1, "--threads", 1], ["--divisions", 9, "--threads", 3], ["--memory", "240M"])
        ):
            self.mesh(f"{number}.inp", "--element-size", 6, *arguments)
            contents.add((self.folder / f"{number}.inp").read_bytes())
        self.assertEqual(len(contents), 1)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed: Debian package calculix-ccx")
    def test_calculix_takes_all_elements(self):
        # Short elements of thick walls turn over where they are bent, unless they are triangles.
        for name, threshold, size in (("engine.mha", 72, "auto"), ("engine.mha", 72, 2), ("shell.nrrd", 65, "auto"), ("cranium.mha", 200, "auto")):
            self.run_program("mesh", DATA / name, "part.inp", "--lower", threshold, "--element-size", size, "--overwrite")
            model = ShellModel(self.folder / "part.inp")
            heights = {number: point[2] for number, point in model.nodes.items()}
            held = [number for number, height in heights.items() if height < min(heights.values()) + 5]
            # Raises where the solver refuses an element.
            elements = list(model.elements())
            self.assertLessEqual(sum(len(nodes) == 3 for nodes in elements), 0.1 * len(elements), name)
            moved = solve(model, (70000.0, 0.33), held, {max(heights, key=heights.get): (0.0, 0.0, 1.0)}, self.folder)
            self.assertTrue(all(math.isfinite(value) for values in moved.values() for value in values), name)

    @unittest.skipUnless(pyvista, "pyvista is not installed")
    def test_quality_is_that_of_verdict(self):
        for size in (1, "auto"):
            report = self.run_program("mesh", DATA / "shell.nrrd", f"{size}.vtp", "--lower", 65, "--element-size", size, "--report", "-")
            found = json.loads(report.stdout)["mesh"]["quality"]
            mesh = pyvista.read(self.folder / f"{size}.vtp")
            quality = mesh.cell_quality(["scaled_jacobian", "aspect_ratio"])
            jacobians = numpy.sort(quality["scaled_jacobian"])
            aspects = numpy.sort(quality["aspect_ratio"])
            limits = {limit["name"]: limit["value"] for limit in found["limits"]}
            last = len(jacobians) - 1
            self.assertAlmostEqual(found["least_scaled_jacobian"], jacobians[0], places=5)
            self.assertAlmostEqual(found["largest_aspect_ratio"], aspects[-1], places=4)
            self.assertAlmostEqual(limits["scaled Jacobian of 99 %"], jacobians[int(0.01 * last)], places=5)
            self.assertAlmostEqual(limits["aspect ratio of 99 %"], aspects[int(0.99 * last)], places=4)
            self.assertEqual(limits["elements without a positive Jacobian"], int((jacobians <= 0).sum()))
            rims, junctions = (
                mesh.extract_feature_edges(feature_edges=False, manifold_edges=False, boundary_edges=rim, non_manifold_edges=not rim)
                for rim in (True, False)
            )
            self.assertEqual(found["rim_sides"], rims.n_cells)
            self.assertEqual(found["junction_sides"], junctions.n_cells)


def two_plates(width):
    """A plate, and one of its thickness beside it that is so wide."""
    volume = volumes.Volume((56, 40, 12), [])
    volume.voxels = [
        int(4 <= z < 8 and 4 <= y < 36 and (4 <= x < 36 or 40 <= x < 52 and y < 4 + width)) for x, y, z in volume.indices()
    ]
    return volume


class SolverMeshTest(ProgramTestCase):
    """What meshes for solvers are like without being asked to."""

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", two_plates(12))

    def report(self, name, *arguments):
        run = self.run_program("mesh", "in.mha", name, "--overwrite", "--report", "r.json", *arguments)
        return json.loads((self.folder / "r.json").read_text()), run

    def test_rims_are_extended_and_small_pieces_left_out(self):
        for name in ("m.inp", "m.bdf", "m.k"):
            report, run = self.report(name)
            self.assertEqual((report["parameters"]["extend_rims"], report["parameters"]["min_component_size"]), (True, 100))
            # The larger plate alone: 32 by 32, as large as it is.
            self.assertEqual((report["mesh"]["pieces_left_out"]["number"], report["mesh"]["quality"]["walls"]), (1, 1))
            self.assertAlmostEqual(report["mesh"]["area"], 32 * 32, delta=0.01 * 32 * 32)
            self.assertRegex(run.stdout, r"\n  walls left out .*; 1 pieces of fewer than 100 faces of a voxel\n")
            self.assertRegex(run.stdout, r"\ndecided .*, rims carried on to the edges of the part\n")
            asked = (self.folder / name).read_bytes()
            self.report(name, "--extend-rims", "--min-component-size", 100)
            self.assertEqual((self.folder / name).read_bytes(), asked)
        self.run_program("extract", "in.mha", "x.mha", "--mesh", "beside.k")
        self.assertEqual((self.folder / "beside.k").read_bytes(), asked)

    def test_both_can_be_switched_off(self):
        report, run = self.report("m.inp", "--extend-rims=off")
        self.assertIsNone(report["mesh"]["remeshing"]["rims"])
        self.assertNotIn("rims carried on", run.stdout)
        self.assertLess(report["mesh"]["area"], 29 * 29)
        report, run = self.report("m.inp", "--min-component-size", 0)
        self.assertIsNone(report["mesh"]["pieces_left_out"])
        self.assertNotIn("small pieces", run.stdout)
        self.assertEqual(report["mesh"]["quality"]["walls"], 2)

    def test_other_meshes_are_as_before(self):
        for name, *arguments in (("m.vtp", "--element-size", "auto"), ("m.ply",), ("m.inp", "--element-size", "voxel")):
            report = self.report(name, *arguments)[0]
            parameters = report["parameters"]
            self.assertEqual((parameters["extend_rims"], parameters["min_component_size"]), (False, 0))
            self.assertIsNone(report["mesh"]["pieces_left_out"])
        # Objects touch: their rims may be inside the part.
        self.run_program("extract", "in.mha", "x.mha", "--mesh", "x.inp", "--labels", "all", "--report", "r.json", "--overwrite")
        parameters = json.loads((self.folder / "r.json").read_text())["parameters"]
        self.assertEqual((parameters["extend_rims"], parameters["min_component_size"]), (False, 100))

    def test_what_is_left_out_is_a_warning_above_5_percent(self):
        for width, is_warned in ((8, False), (14, True)):
            volumes.write_meta(self.folder / "in.mha", two_plates(width))
            mesh = self.report("m.vtp")[0]["mesh"]
            report, run = self.report("m.inp")
            pieces = report["mesh"]["pieces_left_out"]
            # All that the mesh of voxels has.
            self.assertAlmostEqual(pieces["area"] + report["mesh"]["remeshing"]["area_before"], mesh["area"], places=4)
            share = pieces["area"] / mesh["area"]
            self.assertEqual(share > 0.05, is_warned)
            found = [warning for warning in report["warnings"] if warning["code"] == "walls_left_out"]
            self.assertEqual(len(found), is_warned)
            for warning in found:
                self.assertAlmostEqual(warning["values"]["area_percent"], 100 * share, places=6)
                self.assertIn(warning["message"], run.warnings)
                self.assertIn("1 pieces are small", warning["message"])

    def test_walls_left_out_are_listed(self):
        # A T whose web is lower than half an element, 4 voxels on a wall of 8.
        volume = volumes.Volume((48, 40, 24), [])
        volume.voxels = [
            int(4 <= x < 44 and (4 <= y < 36 and 4 <= z < 12 or 18 <= y < 22 and 12 <= z < 16)) for x, y, z in volume.indices()
        ]
        volumes.write_meta(self.folder / "in.mha", volume)
        report, run = self.report("m.vtp", "--element-size", 20)
        remeshing = report["mesh"]["remeshing"]
        walls = remeshing["left_out"]["walls"]
        self.assertEqual(len(walls), remeshing["walls_left_out"])
        self.assertGreater(len(walls), 0)
        self.assertEqual([wall["number"] for wall in walls], list(range(1, len(walls) + 1)))
        self.assertAlmostEqual(sum(wall["area"] for wall in walls), remeshing["left_out"]["area"], places=6)
        share = remeshing["left_out"]["area"] / remeshing["area_before"]
        self.assertAlmostEqual(share, remeshing["left_out"]["area_share"], places=9)
        largest = walls[0]
        # In the middle of the web.
        self.assertAlmostEqual(largest["position"][0], 23.5, delta=2)
        self.assertAlmostEqual(largest["position"][1], 19.5, delta=0.6)
        self.assertLess(largest["position"][2], 16)
        self.assertLess(largest["width"], 4)
        self.assertEqual(largest["reason"], "narrower than half an element")
        self.assertRegex(run.stdout, r"\n  walls left out +1 of 2, .* % of the area, the largest narrower than half an element\n")


class ElementSizeTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", plate())

    def count(self, *arguments):
        return json.loads(self.run_program("mesh", "in.mha", "m.vtp", "--overwrite", "--report", "-", *arguments).stdout)[
            "mesh"
        ]

    def test_elements_that_lose_the_part_are_a_warning(self):
        for size, is_warned in (("auto", False), (2.5, False), (100, True), (1000, True)):
            report = self.run_program("mesh", "in.mha", "m.vtp", "--overwrite", "--report", "-", "--element-size", size).stdout
            report = json.loads(report)
            found = [warning for warning in report["warnings"] if warning["code"] == "coarse_elements"]
            self.assertEqual(len(found), is_warned, size)
            if found:
                self.assertIn("--element-size", found[0]["message"])
                share = report["mesh"]["area"] / report["mesh"]["remeshing"]["area_before"]
                self.assertAlmostEqual(found[0]["values"]["area_percent"], 100 * share, places=6)

    def test_sizes(self):
        voxel = self.count()
        self.assertEqual(voxel["element_size"], "voxel")
        self.assertFalse({"remeshing", "quality"} & set(voxel))
        self.assertEqual(self.count("--element-size", "voxel"), voxel)
        faces = voxel["faces"]
        for size in (1.5, 2.5, "auto"):
            mesh = self.count("--element-size", size)
            self.assertEqual(mesh["element_size"], size)
            self.assertAlmostEqual(mesh["area"], voxel["area"], delta=0.025 * voxel["area"])
            if size != "auto":
                self.assertLess(mesh["faces"], faces)
                faces = mesh["faces"]

    def test_quality_is_printed_with_its_limits(self):
        run = self.run_program("mesh", "in.mha", "m.vtp", "--element-size", "auto", "--report", "r.json")
        mesh = json.loads((self.folder / "r.json").read_text())["mesh"]
        self.assertEqual(failing(mesh), [])
        self.assertEqual(mesh["quality"]["nodes"], mesh["vertices"])
        self.assertEqual(mesh["quality"]["triangles"] + mesh["quality"]["quadrilaterals"], mesh["faces"])
        run_with_all = self.run_program("mesh", "in.mha", "m.vtp", "--element-size", "auto", "--overwrite", "--phases")
        self.assertRegex(run_with_all.stdout, rf"\n  sides of one element +{mesh['quality']['rim_sides']}\n")
        for limit in mesh["quality"]["limits"]:
            relation, value = ("least", limit["least"]) if "least" in limit else ("most", limit["most"])
            self.assertRegex(run_with_all.stdout, rf"\n  {limit['name']} +{limit['value']:.4g}, at {relation} {value:.4g}\n")
        self.assertEqual(run.warnings, [])

    def test_quality_is_the_same_for_all_formats(self):
        found = [
            self.run_program("mesh", "in.mha", name, *SAME, "--report", "-").stdout
            for name in ("m.inp", "m.bdf", "m.k", "m.ply", "m.vtp", "m.vtu", "m.stl")
        ]
        self.assertEqual(len({json.dumps(json.loads(report)["mesh"]["quality"]) for report in found}), 1)

    def test_seconds_have_a_row(self):
        run = self.run_program("mesh", "in.mha", "m.vtp", "--element-size", "auto", "--report", "r.json", "--phases")
        self.assertRegex(run.stdout, r"\nremeshing +\d+\.\d\d s\nreading and writing +")
        seconds = json.loads((self.folder / "r.json").read_text())["seconds"]
        self.assertGreater(seconds["remeshing"], 0)
        self.assertLess(seconds["remeshing"] + seconds["input_output"], seconds["total"])
        run = self.run_program("mesh", "in.mha", "m.vtp", "--report", "r.json", "--overwrite", "--phases")
        self.assertNotIn("remeshing", run.stdout)
        self.assertNotIn("remeshing", json.loads((self.folder / "r.json").read_text())["seconds"])

    def test_sizes_that_make_no_sense(self):
        for size in ("0", "-1", "nan", "inf", "large"):
            self.assert_fails(USAGE, [size], "mesh", "in.mha", "m.vtp", f"--element-size={size}")
        self.assert_fails(USAGE, ["0.4", "0.5"], "mesh", "in.mha", "m.vtp", "--element-size", 0.4)
        self.assert_fails(USAGE, ["--element-size", "--mesh"], "extract", "in.mha", "x.mha", "--element-size", 2)


if __name__ == "__main__":
    unittest.main()
