# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The thickness map and what is told about it: report, histogram, page and picture have the numbers of the map."""

import json
import math
import re
import unittest

import volumes
from program import REFUSED, USAGE, ProgramTestCase
from test_identity import rough_shell
from test_preview import read_png

PERCENTS = (1, 5, 25, 50, 75, 95, 99)


def plate(thickness=4, spacing=(0.5, 0.75, 1.5), size=(40, 36, 20)):
    volume = volumes.Volume(size, [], spacing)
    volume.voxels = [1 if 8 <= z < 8 + thickness else 0 for _, _, z in volume.indices()]
    return volume


class ThicknessTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", rough_shell())

    def map(self, *arguments, source="in.mha", name="t.mha", thickness=2):
        self.extract(
            source, "l.mha", "--thickness-map", name, "--overwrite", "--report", "r.json", *arguments, thickness=thickness
        )
        self.report = json.loads((self.folder / "r.json").read_text())
        return volumes.read_floats(self.folder / name)

    def test_plates_are_exact(self):
        for thickness in range(1, 9):
            volumes.write_meta(self.folder / "plate.mha", plate(thickness))
            values = self.map(source="plate.mha", thickness=2)
            labels = volumes.read_data(self.folder / "l.mha")
            medial = [value for value, label in zip(values, labels) if label >= 2]
            self.assertEqual(set(medial), {thickness * 1.5})
            self.assertEqual(sum(1 for value in values if value), len(medial))
            self.assertAlmostEqual(self.report["thickness"]["area"], 39 * 35 * 0.5 * 0.75, delta=1e-3)

    def test_walls_beside_gaps_are_exact(self):
        """A voxel of background between two walls belongs to neither."""
        for thickness in (1, 2, 4):
            volume = volumes.Volume((20, 20, 24), [], (0.5, 0.5, 0.5))
            walls = range(6, 6 + thickness), range(7 + thickness, 7 + 2 * thickness)
            volume.voxels = [1 if any(z in wall for wall in walls) else 0 for _, _, z in volume.indices()]
            volumes.write_meta(self.folder / "gap.mha", volume)
            for arguments in ([], ["--lower", 0.5, "--sub-voxel"]):
                values = {round(value, 5) for value in self.map(*arguments, source="gap.mha", thickness=1)}
                self.assertEqual(values, {0, 0.5 * thickness}, arguments)

    def test_rims_are_left_out(self):
        """Cells at the ends of plates and strips are negative, and in no statistics."""
        for size, thickness in (((30, 30), 4), ((30, 30), 2), ((40, 8), 4)):
            volume = volumes.Volume((50, 40, 14), [])
            volume.voxels = [
                1 if 5 <= x < 5 + size[0] and 5 <= y < 5 + size[1] and 5 <= z < 5 + thickness else 0
                for x, y, z in volume.indices()
            ]
            volumes.write_meta(self.folder / "block.mha", volume)
            values = self.map(source="block.mha", thickness=3)
            told = self.report["thickness"]
            self.assertEqual({value for value in values if value > 0}, {thickness})
            self.assertEqual(told["unpaired_cells"], sum(1 for value in values if value < 0))
            self.assertGreater(told["unpaired_cells"], 0)
            self.assertEqual((told["minimum"], told["maximum"], told["mean"]), (thickness,) * 3)

    def test_table_tells_it_without_any_report(self):
        table = self.extract("in.mha", "l.mha", "--overwrite", "--phases").stdout
        self.assertRegex(table, r"walls +thinnest .*, in units of the spacing, by area\n(.*\n)+ +at rims, junctions +\d+ \(")

    def test_map_has_the_geometry_of_the_labels(self):
        self.map()
        labels, thicknesses = (volumes.read_header(self.folder / name)[0] for name in ("l.mha", "t.mha"))
        self.assertEqual(thicknesses.pop("ElementType"), "MET_FLOAT")
        self.assertEqual(labels.pop("ElementType"), "MET_UCHAR")
        self.assertEqual(thicknesses, labels)

    def test_numbers_are_those_of_the_map(self):
        values = self.map()
        labels = volumes.read_data(self.folder / "l.mha")
        told = self.report["thickness"]
        width = told["resolution"]
        self.assertEqual(width, 0.5 / 64)
        bins = sorted(int(value / width + 0.5) for value in values if value > 0)
        self.assertGreater(len(bins), 2000)
        self.assertEqual(told["cells"], len(bins))
        self.assertEqual(told["unpaired_cells"], sum(1 for value in values if value < 0))
        self.assertEqual(told["cells"] + told["unpaired_cells"], sum(1 for label in labels if label >= 2))
        self.assertEqual([value != 0 for value in values], [label >= 2 for label in labels])
        self.assertEqual(told["one_cell_of"], 1)
        self.assertIsNone(told["standard_error"])
        walls = [value for value in values if value > 0]
        self.assertEqual((told["minimum"], told["maximum"]), (min(walls), max(walls)))
        thinnest = told["thinnest"]
        columns, lines, _ = map(int, volumes.read_header(self.folder / "t.mha")[0]["DimSize"].split())
        x, y, z = thinnest["index"]
        self.assertEqual((z * lines + y) * columns + x, values.index(min(walls)))

        histogram = told["histogram"]
        wide = round(histogram["bin_width"] / width)
        areas = [*histogram["areas"], histogram["above"]]
        self.assertAlmostEqual(told["area"], sum(areas), delta=1e-9 * sum(areas))
        filled = {min((number + wide // 2) // wide, len(areas) - 1) for number in bins}
        self.assertEqual({number for number, area in enumerate(areas) if area > 0}, filled)
        for percent in PERCENTS:
            below = 0.0
            for number, area in enumerate(areas):
                below += area
                if below >= percent / 100 * sum(areas) * (1 - 1e-12):
                    break
            self.assertEqual((round(told["percentiles"][str(percent)] / width) + wide // 2) // wide, number, percent)

    def test_any_division_gives_the_same_bytes(self):
        files = ("l.mha", "t.mha", "p.png")

        def run(*arguments):
            self.map("--preview", "p.png", *arguments)
            return [(self.folder / name).read_bytes() for name in files] + [self.report["thickness"]]

        expected = run("--divisions", 1, "--threads", 1)
        for arguments in (("--divisions", 7, "--threads", 3), ("--divisions", 33, "--memory", "48M"), ("--sparse",)):
            self.assertEqual(run(*arguments), expected, arguments)

    def test_formats(self):
        expected = self.map()
        for name in ("t.mhd", "t.nrrd", "t.nhdr"):
            self.assertEqual(self.map(name=name), expected, name)

    def test_other_outputs_do_not_depend_on_it(self):
        self.extract("in.mha", "plain.mha", "--report", "plain.json", "--preview", "plain.png", thickness=2)
        self.map("--preview", "p.png")
        self.assertEqual((self.folder / "l.mha").read_bytes(), (self.folder / "plain.mha").read_bytes())
        self.assertEqual(self.report["thickness"], json.loads((self.folder / "plain.json").read_text())["thickness"])
        labels, both = read_png(self.folder / "plain.png"), read_png(self.folder / "p.png")
        self.assertEqual([row[: len(labels[0])] for row in both[: len(labels)]], labels)

    def test_picture_has_the_colors_of_the_lengths(self):
        """A thin wall and a thick one: dark and light in the second picture, with a bar from one to the other."""
        volume = volumes.Volume((60, 60, 40), [])
        volume.voxels = [1 if 8 <= x < 11 or 34 <= x < 44 and y > 5 else 0 for x, y, z in volume.indices()]
        volumes.write_meta(self.folder / "walls.mha", volume)
        self.map("--preview", "p.png", "--html", "r.html", source="walls.mha", thickness=5)
        page = (self.folder / "r.html").read_text()
        self.assertEqual(page.count("data:image/png;base64,"), 1)
        low, high = map(float, re.search(r"The colors span ([\d.]+) to ([\d.]+), in", page).groups())
        self.assertLess(low, 4)
        self.assertGreater(high, 9)
        rows = read_png(self.folder / "p.png")
        below = rows[len(rows) // 2 :]
        beside = [row[len(row) // 2 :] for row in rows]
        second = below if len(rows) > len(rows[0]) else beside
        self.assertEqual(max(len(rows), len(rows[0])) % 2, 0)
        colored = {}
        for row in second:
            for color in row:
                if max(color) - min(color) > 20:
                    colored[color] = colored.get(color, 0) + 1
        lightness = [sum(color) for color, count in colored.items() if count > 2000]
        self.assertGreaterEqual(len(lightness), 2, "colors of the thin and of the thick wall")
        self.assertGreater(max(lightness), 1.5 * min(lightness))
        self.assertGreater(len(colored), 100, "colors of the bar")

    def test_page_has_the_map_only_when_it_is_made(self):
        self.extract("in.mha", "l.mha", "--html", "r.html")
        text = (self.folder / "r.html").read_text()
        self.assertEqual(text.count("data:image/png;base64,"), 1)
        self.assertNotIn("The colors span", text)
        self.assertIn("area of the sheet", text)

    def test_of_large_volumes_a_sample_counts(self):
        """More than 2^23 voxels: every second cell, whatever outputs are asked for."""
        size = (256, 256, 132)
        volume = volumes.Volume(size, [])
        row = bytes(1 if 40 <= x < 43 else 0 for x in range(size[0]))
        volume.voxels = row * (size[1] * size[2])
        volumes.write_raw(self.folder / "large.raw", volume)
        cells = 255 * 131
        found = []
        for arguments in (
            [], ["--thickness-map", "t.nrrd", "--thin-below", 2], ["--html", "r.html", "--thin-below", 4],
        ):  # fmt: skip
            options = [*arguments, "--report", "r.json", "--overwrite", *volumes.raw_options(volume)]
            table = self.extract("large.raw", "l.mha", *options).stdout
            self.assertRegex(table, r"measured +on the object: .*; a sample, one of 2\n")
            found.append(json.loads((self.folder / "r.json").read_text())["thickness"])
        told = found[0]
        self.assertEqual(found, [told] * 3)
        self.assertEqual((told["one_cell_of"], told["standard_error"]), (2, 0))
        self.assertAlmostEqual(told["cells"], cells / 2, delta=0.02 * cells)
        self.assertEqual((told["mean"], told["minimum"], told["maximum"]), (3, None, None))
        share = re.search("<h1>.* 1 place below 4, ([0-9.]+) % of the area</h1>", (self.folder / "r.html").read_text())[1]
        self.assertAlmostEqual(float(share), 100, delta=2, msg="places are of all cells")

    def test_nothing_to_measure(self):
        values = self.map("--lower", 5, "--preview", "p.png", "--html", "r.html")
        self.assertEqual(set(values), {0})
        self.assertEqual(self.report["thickness"]["area"], 0)
        self.assertEqual(set(self.report["thickness"]["histogram"]["areas"]), {0})

    def write_blurred(self, **changes):
        volumes.write_meta(self.folder / "gray.mha", volumes.blurred_wall(), **changes)

    def test_gray_values_tell_more(self):
        self.write_blurred()
        options = ["--lower", 1000]

        def run(*arguments):
            values = self.map(*options, *arguments, source="gray.mha", thickness=3)
            return values.tobytes(), self.report["thickness"], (self.folder / "l.mha").read_bytes()

        binary = run("--sub-voxel=off")
        spread = self.report["thickness"]["standard_deviation"]
        self.assertIs(self.report["parameters"]["sub_voxel"], False)
        self.assertEqual(self.report["measure"]["on"], "object")
        gray = run("--divisions", 1, "--threads", 1)
        self.assertIsNone(self.report["parameters"]["sub_voxel"])
        self.assertEqual(self.report["measure"]["on"], "crossings")
        self.assertEqual(gray[2], binary[2])
        self.assertNotEqual(gray[0], binary[0])
        thickness = self.report["thickness"]
        self.assertLess(abs(thickness["percentiles"]["50"] - 4.3), 0.05)
        self.assertLess(abs(thickness["mean"] - 4.3), 0.01)
        self.assertLess(thickness["standard_deviation"], 0.5 * spread)
        for arguments in (("--divisions", 7, "--threads", 3), ("--divisions", 34), ("--memory", "40M")):
            self.assertEqual(run(*arguments), gray, arguments)
            self.assertLessEqual(self.report["peak_memory_bytes"], self.report["planned_peak_bytes"], arguments)
        self.extract("gray.mha", "l.mha", *options, "--html", "r.html", "--overwrite")
        self.assertIn("measured where gray values cross the threshold", (self.folder / "r.html").read_text())

    def test_gray_values_are_planned_for(self):
        """Four bytes for each voxel of the window."""
        volume = volumes.Volume((400, 400, 60), [], kind="int16")
        row = volumes.array.array("h", [900 if 40 <= x < 43 else 0 for x in range(400)])
        volume.voxels = row * (400 * 60)
        volumes.write_meta(self.folder / "large.mha", volume)
        planned = []
        size = 2 * 400 * 400 * 60
        for arguments, most in (["--sub-voxel=off"], size), (["--sub-voxel"], 4 * size):
            self.map("--lower", 450, "--threads", 1, "--divisions", 6, *arguments, source="large.mha", thickness=3)
            planned.append(self.report["planned_peak_bytes"])
            self.assertLessEqual(self.report["peak_memory_bytes"], planned[-1])
            # Samples of the scan are read before.
            self.assertGreaterEqual(self.report["bytes_read"], size)
            self.assertLessEqual(self.report["bytes_read"], most)
        self.assertGreater(planned[1] - planned[0], 4 * 400 * 400 * 50)

    def test_gray_values_that_cannot_be_had(self):
        self.write_blurred()
        arguments = ("extract", "gray.mha", "x.mha", "--thickness", 3, "--thickness-map", "t.mha", "--sub-voxel")
        self.assert_fails(USAGE, ["threshold"], *arguments)

    def test_plane_images(self):
        volume = volumes.Volume((40, 30), [], (0.5, 0.25))
        volume.voxels = [1 if 8 <= y < 13 else 0 for _, y in volume.indices()]
        volumes.write_meta(self.folder / "plane.mha", volume)
        values = self.map("--preview", "p.png", source="plane.mha", thickness=1)
        self.assertEqual(set(values), {0, 1.25})
        self.assertEqual(self.report["thickness"]["area"], 39 * 0.5)

    def test_memory_and_disk_are_planned(self):
        for arguments in ([], ["--preview", "p.png", "--html", "h.html"]):
            self.map("--memory", "64M", *arguments)
            self.assertLessEqual(self.report["peak_memory_bytes"], self.report["planned_peak_bytes"], arguments)
        plan = self.extract("in.mha", "x.mha", "--thickness-map", "y.mha", "--dry-run").stdout
        voxels = 40 * 36 * 33
        self.assertRegex(plan, rf"disk +{voxels * 5 / 1024:.1f} KiB")
        self.assertRegex(plan, r"thickness_map +y.mha")

    def test_bad_names(self):
        arguments = ("extract", "in.mha", "x.mha", "--thickness", 3)
        self.assert_fails(USAGE, ["t.xyz", "unknown format"], *arguments, "--thickness-map", "t.xyz")
        self.assert_fails(USAGE, ["in.mha", "input"], *arguments, "--thickness-map", "in.mha", "--overwrite")
        self.assert_fails(USAGE, ["x.mha", "thickness_map"], *arguments, "--thickness-map", "x.mha")
        self.assert_fails(REFUSED, ["none"], *arguments, "--thickness-map", "none/t.mha")


if __name__ == "__main__":
    unittest.main()
