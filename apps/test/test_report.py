# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The report and the table: stable keys in a stable order, numbers that fit together."""

import json
import math
import os
import pathlib
import unittest

import volumes
from jobs import RUN_KEYS
from program import ProgramTestCase

try:
    import jsonschema
except ImportError:
    jsonschema = None

SCHEMA = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "doc" / "report.schema.json"

KEYS = [
    "version",
    "itk_version",
    "input",
    "outputs",
    "parameters",
    "size",
    "counts",
    "percent",
    "smoothed",
    "roughness",
    "measure",
    "thickness",
    "share_without_sheet",
    "warnings",
    *RUN_KEYS,
]
COUNTS = [
    "object_voxels",
    "boundary_voxels",
    "not_a_number_voxels",
    "filled_voxels",
    "removed_voxels",
    "candidate_cells",
    "trivial",
    "bound",
    "geodesic_medial",
    "geodesic_non_medial",
    "medial_cells",
]


class ReportTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(spacing=(1, 1, 1.5))
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def report(self, *arguments, source="in.mha"):
        result = self.extract(source, "out.mha", "--report", "r.json", "--overwrite", *arguments)
        return json.loads((self.folder / "r.json").read_text()), result.stdout

    def test_keys_and_numbers(self):
        report, _ = self.report("--lower", 72, "--threads", 2, "--divisions", 3)
        self.assertEqual(list(report), KEYS)
        self.assertEqual(list(report["counts"]), COUNTS)
        self.assertEqual(list(report["seconds"]), ["distance", "classification", "tiles", "input_output", "total"])
        self.assertEqual(report["size"], [24, 20, 16])
        self.assertEqual(report["input"]["spacing"], [1, 1, 1.5])
        self.assertEqual(report["outputs"], {"labels": "out.mha", "report": "r.json"})
        self.assertEqual(report["parameters"]["thickness"], 3)
        self.assertEqual(report["parameters"]["lower"], 72)
        self.assertIsNone(report["parameters"]["upper"])
        self.assertEqual((report["threads"], report["divisions"]), (2, 3))
        busy = report["seconds"]["distance"] + report["seconds"]["classification"]
        self.assertGreaterEqual(report["thread_efficiency"], busy / (2 * report["seconds"]["tiles"]))
        self.assertLessEqual(report["thread_efficiency"], 1)
        self.assertEqual(report["counts"]["object_voxels"], self.volume.voxels.count(100))
        counts = report["counts"]
        decided = sum(counts[name] for name in ("trivial", "bound", "geodesic_medial", "geodesic_non_medial"))
        self.assertEqual(decided, counts["candidate_cells"])
        self.assertEqual(counts["medial_cells"], counts["bound"] + counts["geodesic_medial"])
        searched = counts["geodesic_medial"] + counts["geodesic_non_medial"]
        self.assertAlmostEqual(report["percent"]["correct"], 100 * searched / counts["candidate_cells"])
        self.assertAlmostEqual(sum(report["percent"].values()), 100)
        self.assertGreater(report["peak_memory_bytes"], 2**20)
        self.assertGreaterEqual(report["bytes_read"], len(self.volume.data()))
        self.assertGreater(report["seconds"]["total"], 0)

    def test_part_that_does_not_depend_on_the_run(self):
        first, _ = self.report("--lower", 72, "--threads", 1)
        second, _ = self.report("--lower", 72, "--threads", 5, "--divisions", 4)
        for key in KEYS:
            if key not in RUN_KEYS:
                self.assertEqual(first[key], second[key], key)

    @unittest.skipUnless(jsonschema, "python3-jsonschema is not installed: reports are not compared with their schema")
    def test_reports_conform_to_the_schema(self):
        schema = json.loads(SCHEMA.read_text())
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        everything = ["--vectors", "v.mha", "--distance", "d.mha", "--preview", "p.png", "--html", "h.html"]
        everything += ["--thickness-map", "t.mha"]
        reports = [
            self.report("--lower", 72, *everything)[0],
            self.report("--lower", 101)[0],
            self.report("--lower", 72, "--upper", 200.5)[0],
            self.report("--lower", 72, "--thin-below", 99, "--thick-above", "0.2,0.1", "--places", "p.csv")[0],
        ]
        self.run_program("distance", "in.mha", "v2.mha", "--lower", 72, "--report", "d.json", "--max-distance", 5)
        reports.append(json.loads((self.folder / "d.json").read_text()))
        for number, options in enumerate(([], ["--ray", "--open"])):
            self.run_program("surface", "in.mha", f"s{number}.vtp", "--lower", 72, "--report", f"s{number}.json", *options)
            reports.append(json.loads((self.folder / f"s{number}.json").read_text()))
        for report in reports:
            validator.validate(report)
            for change in (lambda r: r.pop("seconds"), lambda r: r.update(more=1), lambda r: r.update(threads=0)):
                changed = json.loads(json.dumps(report))
                change(changed)
                self.assertFalse(validator.is_valid(changed))

    def test_automatic_thickness(self):
        default, table = self.report()
        self.assertEqual(default["parameters"]["thickness"], 3)
        labels = {}
        for name, options in {
            "none": [],
            "auto": ["--thickness", "auto"],
            "limits": ["--min-thickness", 3, "--max-thickness", 16],
            "divided": ["--divisions", 3, "--threads", 2],
        }.items():
            self.run_program("extract", "in.mha", "out.mha", "--overwrite", "--report", "r.json", *options)
            report = json.loads((self.folder / "r.json").read_text())
            self.assertEqual(report["parameters"]["thickness"], "auto")
            self.assertEqual(report["parameters"]["min_thickness"], 3)
            self.assertEqual(report["parameters"]["max_thickness"], 16)
            labels[name] = (self.folder / "out.mha").read_bytes()
        self.assertEqual(len(set(labels.values())), 1)
        self.assertRegex(self.run_program("extract", "in.mha", "out.mha", "--overwrite", "--phases").stdout, r"tau +auto\n")
        self.run_program("extract", "in.mha", "out.mha", "--overwrite", "--report", "r.json", "--min-thickness", 9)
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["parameters"]["min_thickness"], 9)

    def test_thickness(self):
        """A plate of 4 voxels: every cell away from its rims tells 4, in units of the spacing."""
        volume = volumes.Volume((40, 40, 20), [], (0.5, 0.5, 0.5))
        volume.voxels = [1 if 8 <= z < 12 else 0 for _, _, z in volume.indices()]
        volumes.write_meta(self.folder / "plate.mha", volume)
        unit = 0.5
        report, table = self.report(source="plate.mha")
        thickness = report["thickness"]
        self.assertEqual(thickness["cells"], 39 * 39)
        self.assertEqual(thickness["cells"], report["counts"]["medial_cells"])
        self.assertEqual(thickness["one_cell_of"], 1)
        self.assertEqual(thickness["resolution"], unit / 64)
        for name in ("mean", "minimum", "maximum"):
            self.assertEqual(thickness[name], 4 * unit)
        self.assertEqual(thickness["standard_deviation"], 0)
        self.assertEqual(set(thickness["percentiles"].values()), {4 * unit})
        self.assertEqual(thickness["area"], (39 * unit) ** 2)
        histogram = thickness["histogram"]
        self.assertEqual(sum(histogram["areas"]) + histogram["above"], thickness["area"])
        self.assertEqual(histogram["areas"].index(thickness["area"]) * histogram["bin_width"], 4 * unit)
        self.assertRegex(table, r"walls +thinnest 2, 5 %: 2, median 2, 95 %: 2, thickest 2, in .*, by area\n")
        self.assertAlmostEqual(report["share_without_sheet"], 1 - 39 * 39 / (40 * 40))
        self.assertRegex(table, r"no wall +4.94 % of the object")

    def test_table(self):
        """A few lines without words of the paper; --phases has them beside."""
        report, table = self.report("--lower", 72, "--thin-below", 3)
        long = self.report("--lower", 72, "--thin-below", 3, "--phases")[1]
        rows, long_rows = (
            {line.split("  ")[0] or line.split("  ")[1]: line.split("  ")[-1].strip() for line in text.splitlines()} for text in (table, long)
        )
        share = 100 * report["counts"]["object_voxels"] / (24 * 20 * 16)
        self.assertEqual(rows["object"], f"{report['counts']['object_voxels']} voxels, {share:.2f} % of 24 x 20 x 16")
        self.assertEqual(list(rows), ["object", "walls", "thinnest", "measured", "thin places", "no wall", "decided", "files", "run"])
        self.assertLessEqual(len(table.splitlines()), 10)
        self.assertRegex(table, r"thin places +[0-9]+, area .* below 3, .* % of the sheet")
        self.assertEqual(rows["files"], "out.mha, r.json")
        self.assertRegex(rows["run"], r"\d+\.\d\d s with \d+ threads?, [0-9.]+ MiB of memory")
        for word in ("tau", "pseudo", "correct", "geodesic", "trivial", "candidate", "bound"):
            self.assertNotRegex(table, rf"\b{word}\b")
            self.assertRegex(long, rf"\b{word}\b")
        self.assertEqual(long_rows["tau"], "3 units of the spacing")
        self.assertEqual(long_rows["medial cells"], str(report["counts"]["medial_cells"]))
        self.assertEqual(long_rows["pseudo"], f"{report['percent']['pseudo']:.2f} %")
        for name in (*rows, "distance", "classification", "total", "peak memory"):
            self.assertIn(name, long_rows)
        self.assertLessEqual(len(self.run_program("distance", "in.mha", "v.mha").stdout.splitlines()), 10)

    def test_quiet(self):
        self.assertEqual(self.extract("in.mha", "out.mha", "--quiet").stdout, "")
        self.assertEqual(self.run_program("distance", "in.mha", "v.mha", "--quiet").stdout, "")

    def test_not_a_number(self):
        volume = self.volume.as_type("float32")
        volume.voxels[5] = volume.voxels[1000] = math.nan
        volumes.write_meta(self.folder / "nan.mha", volume)
        for arguments in (["--divisions", 1], ["--divisions", 5]):
            report, table = self.report("--lower", 72, *arguments, source="nan.mha")
            self.assertEqual(report["counts"]["not_a_number_voxels"], 2)
            self.assertIn("2 voxels, taken as background", table)
        result = self.run_program("distance", "nan.mha", "v.mha", "--lower", 72, "--report", "d.json")
        self.assertIn("2 voxels", result.stdout)
        self.assertEqual(json.loads((self.folder / "d.json").read_text())["counts"]["not_a_number_voxels"], 2)

    def test_volume_without_object_and_without_background(self):
        for arguments, objects, label in ((["--lower", 101], 0, 0), (["--lower", 0], len(self.volume.voxels), 1)):
            report, _ = self.report(*arguments)
            self.assertEqual(report["counts"]["object_voxels"], objects)
            self.assertEqual(report["counts"]["medial_cells"], 0)
            self.assertEqual(report["counts"]["boundary_voxels"], 0)
            self.assertEqual(set(volumes.read_data(self.folder / "out.mha")), {0, label})
            self.assertEqual(report["percent"]["pseudo"], None if objects == 0 else 100)

    def test_report_of_distance(self):
        self.run_program("distance", "in.mha", "v.mha", "--lower", 72, "--report", "r.json", "--max-distance", 5)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(list(report), [key for key in KEYS if key not in ("percent", "smoothed", "roughness", "measure", "thickness", "share_without_sheet")])
        self.assertEqual(report["parameters"]["max_distance"], 5)
        self.assertEqual(report["parameters"]["boundary"], "object")

    def test_name_that_is_no_valid_text(self):
        source = b"scan-\xff.mha"
        (self.folder / "in.mha").rename(self.folder.joinpath(source.decode("utf-8", "surrogateescape")))
        report, _ = self.report(source=source.decode("utf-8", "surrogateescape"))
        self.assertEqual(report["input"]["file"], "scan-\ufffd.mha")


if __name__ == "__main__":
    unittest.main()
