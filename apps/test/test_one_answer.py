# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""One scan has one thickness: the same for every output, for any set of outputs, and for a mask whatever its threshold."""

import csv
import json
import math
import pathlib
import re
import unittest

import volumes
from program import ProgramTestCase

DATA = pathlib.Path(__file__).parents[3] / "shared/data"

# Each set of outputs, whose table and report must tell the same thickness.
OUTPUTS = (
    [],
    ["--thickness-map", "t.mha"],
    ["--thin-below", 3, "--places", "p.csv"],
    ["--thick-above", 6],
    ["--preview", "p.png"],
    ["--html", "p.html"],
    ["--local-thickness", "o.mha"],
    ["--vectors", "v.mha", "--distance", "d.mha"],
    ["--mesh", "m.vtp"],
    ["--mesh", "n.inp", "--element-size", "auto", "--thickness-map", "s.mha", "--html", "q.html"],
)


def lines_of_walls(table):
    return [line.split() for line in table[table.index("walls") :].splitlines()[:2]]


class OneAnswerTest(ProgramTestCase):
    def thickness_of(self, command, source, *arguments):
        """What report and table tell, which must agree."""
        table = self.run_program(command, source, *arguments, "--report", "r.json", "--overwrite").stdout
        report = json.loads((self.folder / "r.json").read_text("utf-8"))
        words = re.search(r"^walls .*5 %: ([^,]+), median ([^,]+),", table, re.MULTILINE).groups()
        told = report["thickness"]["percentiles"]["5"], report["thickness"]["percentiles"]["50"]
        for shown, number in zip(words, told):
            self.assertAlmostEqual(float(shown), number, delta=0.001 * number)
        measured = re.search(r"^  measured +(.+)$", table, re.MULTILINE).group(1)
        self.assertTrue(report["measure"]["scan"] or report["measure"]["reason"] in measured)
        return lines_of_walls(table), report["thickness"], report["measure"]

    def assert_one_answer(self, source, *options):
        expected = self.thickness_of("extract", source, "l.mha", *options)
        for outputs in OUTPUTS:
            self.assertEqual(self.thickness_of("extract", source, "l.mha", *outputs, *options), expected, outputs)
        self.assertEqual(self.thickness_of("mesh", source, "a.ply", *options), expected)
        alone = self.run_program("extract", source, "l.mha", *options, "--overwrite").stdout
        self.assertEqual(lines_of_walls(alone), expected[0])
        self.run_program("plan", source, "j.mha", "job", "--report", "j.json", "--thickness-map", "u.mha", *options)
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        report = json.loads((self.folder / "j.json").read_text("utf-8"))
        self.assertEqual((report["thickness"], report["measure"]), expected[1:])
        return expected

    def test_of_a_scan(self):
        volumes.write_meta(self.folder / "in.mha", volumes.blurred_wall())
        _, thickness, measure = self.assert_one_answer("in.mha", "--lower", 1000)
        self.assertEqual(measure["on"], "crossings")
        self.assertAlmostEqual(thickness["mean"], 4.3, delta=0.02)

    def test_of_a_mask_whatever_its_threshold(self):
        scan = volumes.blurred_wall()
        found = []
        for values, options in (((0, 1), []), ((0, 1), ["--lower", 1]), ((-5, 90), ["--lower", -4]), ((-5, 90), ["--lower", 90])):
            voxels = [values[value >= 1000] for value in scan.voxels]
            volumes.write_meta(self.folder / "in.mha", volumes.Volume(scan.size, voxels, scan.spacing, "int16"))
            table, thickness, measure = self.thickness_of("mesh", "in.mha", "m.ply", *options)
            found.append((table[0], thickness, measure["on"], (self.folder / "m.ply").read_bytes()))
        self.assertEqual(found, [found[0]] * len(found))
        self.assertEqual(found[0][2], "object")

    def test_surfaces_of_masks_do_not_depend_on_the_threshold(self):
        """A block of 10 x 8 x 6 voxels, whose faces are halfway to the background."""
        volume = volumes.Volume((20, 18, 16), [])
        volume.voxels = [int(5 <= x < 15 and 5 <= y < 13 and 5 <= z < 11) for x, y, z in volume.indices()]
        contents = set()
        for scale, options in ((1, []), (1, ["--lower", 1]), (200, ["--lower", 1]), (200, ["--lower", 200])):
            source = volumes.Volume(volume.size, [scale * voxel for voxel in volume.voxels])
            volumes.write_meta(self.folder / "in.mha", source)
            self.run_program("surface", "in.mha", "s.ply", *options, "--report", "r.json", "--overwrite")
            report = json.loads((self.folder / "r.json").read_text("utf-8"))
            self.assertEqual(report["measure"]["on"], "object")
            self.assertAlmostEqual(report["surface"]["volume"], 480, delta=12)  # cut edges and corners
            contents.add((self.folder / "s.ply").read_bytes())
        self.assertEqual(len(contents), 1)

    def test_a_map_and_its_places_agree(self):
        volumes.write_meta(self.folder / "in.mha", volumes.blurred_wall())
        run = ["--lower", 1000, "--thickness-map", "t.mha", "--thin-below", "4.3,4.5", "--places", "p.csv", "--overwrite"]
        self.run_program("extract", "in.mha", "l.mha", *run, "--report", "r.json")
        thinnest = min(value for value in volumes.read_floats(self.folder / "t.mha") if value > 0)
        rows = list(csv.DictReader((self.folder / "p.csv").read_text().splitlines()))
        self.assertAlmostEqual(min(float(row["minimum"]) for row in rows), thinnest, places=5)
        report = json.loads((self.folder / "r.json").read_text("utf-8"))
        self.assertEqual(report["thickness"]["minimum"], thinnest)
        self.assertEqual(report["places"]["thin"]["worst"], thinnest)

    @unittest.skipUnless(DATA.exists(), "needs the real volumes beside the repository")
    def test_of_a_real_scan(self):
        _, _, measure = self.assert_one_answer(DATA / "shell.nrrd", "--lower", 65)
        self.assertEqual(measure["on"], "fits")

    @unittest.skipUnless(DATA.exists(), "needs the real volumes beside the repository")
    def test_uncertainties_of_places_are_those_of_the_map(self):
        files = ["--thickness-map", "t.mha", "--uncertainty-map", "u.mha", "--report", "r.json"]
        self.run_program("extract", DATA / "shell.nrrd", "--lower", 65, "--thin-below", 3, *files)
        width, height, _ = map(int, volumes.read_header(self.folder / "u.mha")[0]["DimSize"].split())
        thicknesses, uncertainties = (volumes.read_floats(self.folder / name) for name in ("t.mha", "u.mha"))
        report = json.loads((self.folder / "r.json").read_text("utf-8"))
        places = report["places"]["thin"]["places"]
        self.assertGreater(len(places), 3)
        for wall in (report["thickness"]["thinnest"], *places):
            x, y, z = wall["index"]
            cell = (z * height + y) * width + x
            self.assertEqual(wall.get("minimum", report["thickness"]["minimum"]), thicknesses[cell])
            expected = None if math.isnan(uncertainties[cell]) else uncertainties[cell]
            self.assertEqual(wall["uncertainty"], expected)


if __name__ == "__main__":
    unittest.main()
