# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Meshes with elements of a size, and the check of shell meshes, against the Verdict library."""

import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import unittest

import volumes
from program import CORRUPT, DONE, FAILURE, PROGRAM, REFUSED, USAGE, ProgramTestCase

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
sys.path.append(str(SOURCE / "examples/fem"))

from shell_model import ShellModel, solve  # noqa: E402

try:
    import numpy
    import pyvista
except ImportError:
    pyvista = None

DATA = SOURCE / "../shared/data"

SQUARES = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 2, 0, 0
6, 2, 1, 0
7, 1, 0.5, 0
8, 0, 0, 0
9, 3, 0.5, 0
10, 2.2, 0.5, 0
*ELEMENT, TYPE=S4, ELSET=ALL
"""


def plate():
    volume = volumes.Volume((30, 26, 12), [], (0.5, 0.5, 0.5))
    volume.voxels = [1 if 4 <= z < 8 and 3 <= x < 27 else 0 for x, _, z in volume.indices()]
    return volume


class ElementsTestCase(ProgramTestCase):
    def check(self, name):
        """What the check says, and the names of the limits that do not hold, which its exit status agrees with."""
        command = [PROGRAM, "check", name, "--json"]
        result = subprocess.run(command, capture_output=True, text=True, cwd=self.folder, check=False)
        check = json.loads(result.stdout)
        failed = [limit["name"] for limit in check["limits"] if not limit["holds"]]
        self.assertEqual(result.returncode, FAILURE if failed else DONE, result.stderr)
        return check, failed


@unittest.skipUnless(DATA.is_dir(), f"{DATA} not found")
class RealElementsTest(ElementsTestCase):
    def mesh(self, name, *arguments):
        report = self.run_program("mesh", DATA / "engine.mha", name, "--lower", 72, "--report", "-", *arguments).stdout
        return json.loads(report)["mesh"]

    def test_engine(self):
        mesh = self.mesh("engine.inp", "--element-size", "auto")
        self.run_program("check", "engine.inp")
        remeshing = mesh["remeshing"]
        self.assertLessEqual(mesh["faces"], 15000)
        self.assertAlmostEqual(mesh["area"] / remeshing["area_before"], 1, delta=0.02)
        self.assertLessEqual(remeshing["distance_to_fine"]["mean"], 0.5)
        self.assertEqual(remeshing["scaled_jacobian"]["not_positive"], 0)
        self.assertGreaterEqual(remeshing["scaled_jacobian"]["percentile_1"], 0.3)
        self.assertLessEqual(remeshing["aspect_ratio"]["percentile_99"], 5)

    def test_same_bytes_for_any_division(self):
        contents = set()
        for number, arguments in enumerate(
            (["--divisions", 1, "--threads", 1], ["--divisions", 9, "--threads", 3], ["--memory", "200M"])
        ):
            self.mesh(f"{number}.inp", "--element-size", 6, *arguments)
            contents.add((self.folder / f"{number}.inp").read_bytes())
        self.assertEqual(len(contents), 1)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed: Debian package calculix-ccx")
    def test_calculix_takes_all_elements(self):
        for name, threshold in (("engine.mha", 72), ("shell.nrrd", 65), ("cranium.mha", 200)):
            self.run_program("mesh", DATA / name, "part.inp", "--lower", threshold, "--element-size", "auto", "--overwrite")
            model = ShellModel(self.folder / "part.inp")
            heights = {number: point[2] for number, point in model.nodes.items()}
            held = [number for number, height in heights.items() if height < min(heights.values()) + 5]
            # Raises where the solver refuses an element.
            moved = solve(model, (70000.0, 0.33), held, {max(heights, key=heights.get): (0.0, 0.0, 1.0)}, self.folder)
            self.assertTrue(all(math.isfinite(value) for values in moved.values() for value in values), name)

    @unittest.skipUnless(pyvista, "pyvista is not installed")
    def test_check_is_that_of_verdict(self):
        # Elements of a voxel have all that can be wrong with shapes.
        for size in ("voxel", "auto"):
            source = (DATA / "shell.nrrd", "--lower", 65, "--element-size", size)
            for name in (f"{size}.ply", f"{size}.vtp"):
                self.run_program("mesh", source[0], name, *source[1:])
            mesh = pyvista.read(self.folder / f"{size}.vtp")
            quality = mesh.cell_quality(["scaled_jacobian", "aspect_ratio"])
            jacobians = numpy.sort(quality["scaled_jacobian"])
            aspects = numpy.sort(quality["aspect_ratio"])
            check, _ = self.check(f"{size}.ply")
            limits = {limit["name"]: limit["value"] for limit in check["limits"]}
            last = len(jacobians) - 1
            self.assertAlmostEqual(check["least_scaled_jacobian"], jacobians[0], places=5)
            self.assertAlmostEqual(limits["scaled Jacobian of 99 %"], jacobians[int(0.01 * last)], places=5)
            self.assertAlmostEqual(limits["aspect ratio of 99 %"], aspects[int(0.99 * last)], places=4)
            self.assertEqual(limits["elements without a positive Jacobian"], int((jacobians <= 0).sum()))
            rims = mesh.extract_feature_edges(
                boundary_edges=True, feature_edges=False, manifold_edges=False, non_manifold_edges=False
            )
            junctions = mesh.extract_feature_edges(
                boundary_edges=False, feature_edges=False, manifold_edges=False, non_manifold_edges=True
            )
            self.assertEqual(check["rim_sides"], rims.n_cells)
            self.assertEqual(check["junction_sides"], junctions.n_cells)


class CheckTest(ElementsTestCase):
    def write(self, elements, name="m.inp"):
        (self.folder / name).write_text(SQUARES + "".join(f"{k + 1}, {e}\n" for k, e in enumerate(elements)))

    def failed(self, *elements):
        """Names of the limits that do not hold."""
        self.write(elements)
        return self.check("m.inp")[1]

    def test_squares(self):
        self.assertEqual(self.failed("1, 2, 3, 4", "2, 5, 6, 3"), [])

    def test_what_is_wrong_is_named(self):
        self.assertIn("elements with the same nodes", self.failed("1, 2, 3, 4", "4, 1, 2, 3"))
        self.assertIn("nodes at one place", self.failed("1, 2, 3, 4", "8, 2, 3, 4"))
        self.assertIn("hanging nodes", self.failed("1, 2, 3, 4", "2, 5, 6, 7"))
        self.assertEqual(self.failed("1, 2, 3, 4", "2, 3, 6, 5"), ["walls turned both ways"])
        self.assertIn("elements without a positive Jacobian", self.failed("2, 10, 3, 9"))

    def test_files_that_are_not_understood(self):
        self.assert_fails(USAGE, ["m.obj", ".inp"], "check", "m.obj")
        self.write(["1, 2, 3, 99"])
        self.assert_fails(CORRUPT, ["m.inp", "element 1", "node 99"], "check", "m.inp")
        self.write(["1, 2, 3, x"])
        self.assert_fails(CORRUPT, ["m.inp", "line 13", "'x'"], "check", "m.inp")
        self.write([])
        self.assert_fails(CORRUPT, ["m.inp", "no shell elements"], "check", "m.inp")
        (self.folder / "m.inp").write_text(SQUARES.replace("S4", "S8R") + "1, 1, 2, 3, 4, 5, 6, 7, 8\n")
        self.assert_fails(CORRUPT, ["m.inp", "line 12", "s8r"], "check", "m.inp")
        (self.folder / "m.ply").write_bytes(b"ply\nformat ascii 1.0\nend_header\n")
        self.assert_fails(CORRUPT, ["m.ply", "binary_little_endian"], "check", "m.ply")
        for properties, word in (
            ("element vertex 9000000000000000000\n", "vertex"),
            ("element vertex 3\nproperty list uchar float x\n", "list"),
            ("element face 9000000000000000000\n", "face"),
        ):
            header = f"ply\nformat binary_little_endian 1.0\n{properties}end_header\n"
            (self.folder / "m.ply").write_bytes(header.encode() + bytes(64))
            self.assert_fails(CORRUPT, ["m.ply", word], "check", "m.ply")

    def test_files_that_cannot_be_opened(self):
        """A status of their own, so that a script tells a typing error from a bad mesh; none is waited for."""
        for extension in (".inp", ".bdf", ".k", ".vtp", ".vtu", ".ply", ".stl"):
            self.assert_fails(REFUSED, [f"cannot open none{extension}", "No such file"], "check", f"none{extension}")
            os.mkfifo(self.folder / f"pipe{extension}")
            self.assert_fails(REFUSED, [f"pipe{extension}", "not a regular file"], "check", f"pipe{extension}", timeout=60)
            (self.folder / f"link{extension}").symlink_to("/dev/zero")
            self.assert_fails(REFUSED, [f"link{extension}", "not a regular file"], "check", f"link{extension}", timeout=60)
            (self.folder / f"loop{extension}").symlink_to(f"loop{extension}")
            self.assert_fails(REFUSED, [f"cannot open loop{extension}"], "check", f"loop{extension}")
            (self.folder / f"folder{extension}").mkdir()
            self.assert_fails(REFUSED, [f"folder{extension}", "it is a folder"], "check", f"folder{extension}")
            (self.folder / f"zeros{extension}").touch()
            os.truncate(self.folder / f"zeros{extension}", 2**36)
            self.run_program("check", f"zeros{extension}", status=CORRUPT, timeout=60)
            (self.folder / f"zeros{extension}").unlink()

    def test_elements_over_several_lines(self):
        for text in ("1, 1, 2,\n3, 4\n", "1,\n1, 2,\n** nodes\n3,\n4\n", "1, 1, 2, 3, 4,\n2, 2, 5, 6, 3\n"):
            (self.folder / "m.inp").write_text(SQUARES.replace("S4, ", "S4,\n") + text)
            self.assertEqual(self.check("m.inp")[0]["quadrilaterals"], 1 + text.count("5"))
        (self.folder / "m.inp").write_text(SQUARES + "1, 1, 2,\n3\n")
        self.assert_fails(CORRUPT, ["m.inp", "line 14", "''"], "check", "m.inp")

    def test_text_of_stl(self):
        """The same as the binary file of the same triangles."""
        corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 2**-10))
        facets = [[corners[k] for k in triangle] for triangle in ((0, 1, 2), (0, 2, 3))]
        text = "solid part\r\n"
        for facet in facets:
            vertices = "".join(f"      VERTEX {x} {y} {z}\r\n" for x, y, z in facet)
            text += f"  facet normal 0 0 1\r\n    outer loop\r\n{vertices}    endloop\r\n  endfacet\r\n"
        (self.folder / "text.stl").write_text(text + "endsolid part\r\n", newline="")
        binary = b"solid part".ljust(80) + struct.pack("<I", len(facets))
        for facet in facets:
            binary += struct.pack("<12fH", 0, 0, 1, *sum(facet, ()), 0)
        (self.folder / "binary.stl").write_bytes(binary)
        found = [self.check(name)[0] for name in ("text.stl", "binary.stl")]
        for check in found:
            check.pop("mesh", None)
        self.assertEqual(found[0], found[1])
        for change in (("VERTEX 1 1 0", "VERTEX 1 1"), ("VERTEX 1 1 0", "VERTEX 1 1 x"), ("VERTEX 1 1 0", ""), ("endfacet", "")):
            self.assert_corrupt("bad.stl", text.replace(*change).encode(), "line")
        self.assert_corrupt("bad.stl", text[: text.rindex("endloop")].encode(), "ends before its last triangle")
        self.assert_corrupt("bad.stl", binary[:-1], "ends before its last triangle")

    def test_cards_with_few_fields(self):
        nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n*ELEMENT_SHELL\n"
        (self.folder / "m.k").write_text(nodes + "1,1,1,2,3\n*END\n")
        self.assertEqual(self.check("m.k")[0]["triangles"], 1)
        for card in ("1,1,1,2", "1,1", "1"):
            self.assert_corrupt("m.k", (nodes + card + "\n").encode(), "line 6")

    def assert_corrupt(self, name, content, *words):
        (self.folder / name).write_bytes(content)
        self.assert_fails(CORRUPT, [name, *words], "check", name)

    def test_coordinates_that_are_no_numbers(self):
        for text in ("nan", "inf", "1e31", "-1e300"):
            self.assert_corrupt("m.inp", (SQUARES.replace("2, 1, 0, 0", f"2, {text}, 0, 0") + "1, 1, 2, 3, 4\n").encode(), "node 2")

    def test_numbers_of_bytes_that_are_not_there(self):
        volumes.write_meta(self.folder / "in.mha", plate())
        for name in ("m.vtp", "m.vtu", "m.stl", "m.ply"):
            self.run_program("mesh", "in.mha", name)
            whole = (self.folder / name).read_bytes()
            self.check(name)
            for size in (0, 3, 90, len(whole) // 3):
                self.assert_corrupt(name, whole[:size])
        many = 9223372036854775807
        for name, word in (("m.vtp", b"NumberOfPolys"), ("m.vtu", b"NumberOfCells"), ("m.vtp", b"NumberOfPoints")):
            self.run_program("mesh", "in.mha", name, "--overwrite")
            whole = (self.folder / name).read_bytes()
            self.assert_corrupt(name, re.sub(word + rb'="\d+"', word + b'="%d"' % many, whole), str(many))
            self.assert_corrupt(name, re.sub(rb'offset="\d+"', b'offset="%d"' % many, whole), "array")
            begin = whole.index(b"_", whole.index(b"<AppendedData"))
            # The first array has the thickness, which is not read; all others are.
            for offset in set(map(int, re.findall(rb'Name="(?:Points|connectivity|offsets)".*?offset="(\d+)"', whole))):
                place = begin + 1 + offset
                self.assert_corrupt(name, whole[:place] + b"\xf8" + b"\xff" * 7 + whole[place + 8 :], "array")
        self.run_program("mesh", "in.mha", "m.stl", "--overwrite")
        whole = (self.folder / "m.stl").read_bytes()
        self.assert_corrupt("m.stl", whole[:80] + b"\xff" * 4 + whole[84:], "ends before")
        self.assert_corrupt("m.stl", whole + b"x", "not a binary STL")
        self.assert_corrupt("m.stl", whole[:96] + struct.pack("<f", math.nan) + whole[100:], "node 1")

    def test_keywords_that_are_not_read(self):
        nodes = "*KEYWORD\n*NODE\n" + "".join(f"{k:8}{x:16}{y:16}{0:16}\n" for k, (x, y) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1)), 1))
        shell = "       1       1       1       2       3       4\n"
        (self.folder / "m.k").write_text(f"{nodes}*ELEMENT_SHELL_OFFSET\n{shell}  0.5\n*END\nany text\n")
        self.assertEqual(self.check("m.k")[0]["quadrilaterals"], 1)
        (self.folder / "m.k").write_text(f"$ comment\n{nodes.lower()}*element_shell\n1,1,1,2,3\n2,1,1,3,4,4\n")
        self.assertEqual(self.check("m.k")[0]["triangles"], 2)
        for text, words in (
            (f"{nodes}*ELEMENT_SHELL_COMPOSITE\n{shell}", ["line 7", "composite"]),
            (f"{nodes}*ELEMENT_SHELL\n{shell.rstrip()}       7       8\n", ["line 8", "four nodes"]),
            (f"{nodes}*ELEMENT_SHELL\n{shell.replace('4', '9')}", ["node 9", "missing"]),
            ("*KEYWORD LONG=Y\n" + nodes, ["line 1", "long format"]),
            (nodes + "*INCLUDE\nother.k\n", ["line 7", "INCLUDE"]),
            (nodes, ["no shell elements"]),
        ):
            self.assert_corrupt("m.k", text.encode(), *words)

    def test_what_is_no_shell_is_left_out(self):
        (self.folder / "m.inp").write_text(
            SQUARES + "1, 1, 2, 3, 4\n*ELEMENT, TYPE=SPRINGA\n2, 1, 2\n*ELEMENT\n3, 1, 2\n"
        )
        self.assertEqual(self.check("m.inp")[1], [])

    def test_all_formats_say_the_same(self):
        volumes.write_meta(self.folder / "in.mha", plate())
        texts = set()
        for name in ("m.inp", "m.bdf", "m.k", "m.ply", "m.vtp", "m.vtu"):
            self.run_program("mesh", "in.mha", name, "--element-size", "auto")
            texts.add(self.run_program("check", name).stdout)
        for name in ("n.inp", "n.bdf", "n.k"):
            self.run_program("mesh", "in.mha", name, "--element-size", "auto", "--thickness-at", "nodes")
            texts.add(self.run_program("check", name).stdout)
        self.assertEqual(len(texts), 1)
        texts = set()
        for name in ("t.stl", "t.ply"):
            self.run_program("mesh", "in.mha", name, "--element-size", "auto", "--triangles")
            texts.add(self.run_program("check", name).stdout)
        self.assertEqual(len(texts), 1)


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
        self.assertNotIn("remeshing", voxel)
        self.assertEqual(self.count("--element-size", "voxel"), voxel)
        faces = voxel["faces"]
        for size in (1.5, 2.5, "auto"):
            mesh = self.count("--element-size", size)
            self.assertEqual(mesh["element_size"], size)
            self.assertAlmostEqual(mesh["area"], voxel["area"], delta=0.025 * voxel["area"])
            if size != "auto":
                self.assertLess(mesh["faces"], faces)
                faces = mesh["faces"]

    def test_seconds_have_a_row(self):
        run = self.run_program("mesh", "in.mha", "m.vtp", "--element-size", "auto", "--report", "r.json")
        self.assertRegex(run.stdout, r"\nremeshing +\d+\.\d\d s\nreading and writing +")
        seconds = json.loads((self.folder / "r.json").read_text())["seconds"]
        self.assertGreater(seconds["remeshing"], 0)
        self.assertLess(seconds["remeshing"] + seconds["input_output"], seconds["total"])
        run = self.run_program("mesh", "in.mha", "m.vtp", "--report", "r.json", "--overwrite")
        self.assertNotIn("remeshing", run.stdout)
        self.assertNotIn("remeshing", json.loads((self.folder / "r.json").read_text())["seconds"])

    def test_sizes_that_make_no_sense(self):
        for size in ("0", "-1", "nan", "inf", "large"):
            self.assert_fails(USAGE, [size], "mesh", "in.mha", "m.vtp", f"--element-size={size}")
        self.assert_fails(USAGE, ["0.4", "0.5"], "mesh", "in.mha", "m.vtp", "--element-size", 0.4)
        self.assert_fails(USAGE, ["--element-size", "--mesh"], "extract", "in.mha", "x.mha", "--element-size", 2)


if __name__ == "__main__":
    unittest.main()
