# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Files by way of the program, and the command."""

import csv
import json
import subprocess
import sys
import unittest

import medialvoxel
import numpy as np

from interrupts import interrupt
from support import Folder, program, read, run, scene, slow_noise, write
from processes import PATIENCE


def fail(done):
    raise KeyError("enough")


class Files(Folder):
    def setUp(self):
        super().setUp()
        program()
        self.input = self.folder / "in.mha"
        write(self.input, scene().astype("uint8"), (2.0, 1.0, 0.5))

    def test_a_file_gives_what_an_array_gives(self):
        report = medialvoxel.extract_file(
            self.input, self.folder / "out.mha", lower=40, thickness_map=self.folder / "map.mha"
        )
        found = medialvoxel.extract(scene().astype("uint8"), lower=40, spacing=(2.0, 1.0, 0.5))
        np.testing.assert_array_equal(read(self.folder / "out.mha"), found.labels)
        thickness = read(self.folder / "map.mha")
        np.testing.assert_array_equal(np.maximum(thickness, 0), found.thickness)
        np.testing.assert_array_equal(thickness < 0, found.rims)
        for name, number in found.counts.items():
            self.assertEqual(report["counts"][name], number)

    def test_thick_walls_raise_the_maximum_of_both(self):
        mask = np.zeros((60, 64, 68), np.uint8)
        mask[4:-4, 4:-4, 4:-4] = 1
        mask[26:-26, 26:-26, 26:-26] = 0
        write(self.input, mask, (0.5, 0.5, 0.5))
        report = medialvoxel.extract_file(self.input, self.folder / "out.mha", overwrite=True)
        found = medialvoxel.extract(mask, spacing=0.5)
        self.assertEqual(report["parameters"]["raised_from"], 8)
        self.assertEqual(found.max_thickness, report["parameters"]["max_thickness"])
        self.assertGreaterEqual(found.max_thickness, 11)
        np.testing.assert_array_equal(read(self.folder / "out.mha"), found.labels)
        given = medialvoxel.extract(mask, spacing=0.5, max_thickness=8)
        self.assertEqual(given.max_thickness, 8)
        self.assertNotEqual(given.counts["medial_cells"], found.counts["medial_cells"])
        self.assertIsNone(medialvoxel.extract(mask, thickness=3).max_thickness)

    def test_values_of_all_axes_are_z_first(self):
        raw = self.folder / "in.raw"
        raw.write_bytes(scene().astype("uint8").tobytes())
        options = {"raw_type": "uint8", "lower": 40, "overwrite": True}
        expected = medialvoxel.extract(scene().astype("uint8"), lower=40, spacing=(2.0, 1.0, 0.5)).labels
        for size, spacing in ((scene().shape, (2, 1, 0.5)), ("34,30,22", "0.5,1,2")):
            medialvoxel.extract_file(raw, self.folder / "out.mha", raw_size=size, spacing=spacing, **options)
            np.testing.assert_array_equal(read(self.folder / "out.mha"), expected)

    def test_a_report_of_ones_own(self):
        report = medialvoxel.extract_file(self.input, self.folder / "out.mha", report=self.folder / "r.json", lower=40)
        self.assertEqual(json.loads((self.folder / "r.json").read_text()), report)

    def test_thin_places(self):
        table = self.folder / "places.csv"
        options = {"lower": 40, "thin_below": (2.5, 3, 0), "places": table, "overwrite": True}
        map_file = self.folder / "map.mha"
        report = medialvoxel.extract_file(self.input, self.folder / "out.mha", thickness_map=map_file, **options)
        thin = report["places"]["thin"]
        self.assertEqual((thin["limit"], thin["grow_limit"]), (2.5, 3))
        self.assertGreater(thin["number"], 0)
        self.assertIsNone(report["places"]["thick"])
        thickness = read(map_file)
        with table.open(newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), thin["number"])
        for row in rows:
            index = tuple(int(row[f"index_{axis}"]) for axis in "zyx")
            self.assertEqual(float(row["minimum"]), thickness[index])
        # With a limit of all places their cells are those that the map has.
        every = medialvoxel.extract_file(self.input, self.folder / "out.mha", **{**options, "thin_below": 99})
        self.assertEqual(every["places"]["thin"]["cells"], np.count_nonzero(thickness > 0))
        before = table.read_bytes()
        with self.assertRaises(medialvoxel.ThinPlacesError) as caught:
            medialvoxel.extract_file(self.input, self.folder / "out.mha", fail_if_thin=True, **options)
        self.assertEqual(caught.exception.report["places"]["thin"], thin)
        self.assertEqual(str(caught.exception), f"{thin['number']} thin places")
        self.assertNotEqual(table.read_bytes(), before)
        options["thin_below"] = 0.01
        report = medialvoxel.extract_file(self.input, self.folder / "out.mha", fail_if_thin=True, **options)
        self.assertEqual(report["places"]["thin"]["number"], 0)
        with self.assertRaisesRegex(medialvoxel.NotMeasuredError, "no verdict .* no object") as caught:
            medialvoxel.extract_file(self.input, self.folder / "out.mha", fail_if_thin=True, **{**options, "lower": 1e4})
        self.assertEqual(caught.exception.report["warnings"][0]["code"], "no_object")

    def test_every_command_with_its_progress(self):
        """What the program writes for the same arguments."""
        mask = self.folder / "mask.mha"
        write(mask, (scene() >= 40).astype("uint8"), (2.0, 1.0, 0.5))
        for call, command, name in (
            (medialvoxel.extract_file, "extract", "out.mha"),
            (medialvoxel.mesh_file, "mesh", "out.ply"),
            (medialvoxel.surface_file, "surface", "out.vtp"),
            (medialvoxel.distance_file, "distance", "out.nrrd"),
        ):
            with self.subTest(command):
                seen = []
                report = call(mask, self.folder / name, progress=seen.append, threads=1)
                self.assertEqual((seen, seen[-1]), (sorted(seen), 1.0))
                self.assertGreater(len(seen), 1)
                self.assertEqual(report["input"]["file"], str(mask))
                written = (self.folder / name).read_bytes()
                status, errors = run([command, mask, self.folder / name, "--overwrite", "--quiet"])
                self.assertEqual((status, (self.folder / name).read_bytes()), (0, written), errors)
                with self.assertRaisesRegex(KeyError, "enough"):
                    call(mask, self.folder / f"stopped_{name}", progress=fail)
                self.assertFalse((self.folder / f"stopped_{name}").exists())

    def test_the_program_has_the_threads_that_the_process_may_use(self):
        source = "import os; os.sched_setaffinity(0, list(os.sched_getaffinity(0))[:1]); import medialvoxel\n"
        source += f"print(medialvoxel.extract_file({str(self.input)!r}, {str(self.folder / 'out.mha')!r}, lower=40)['threads'])"
        done = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True)
        self.assertEqual(done.stdout, "1\n", done.stderr)

    def test_info(self):
        found = medialvoxel.info(self.input, values=True)
        self.assertEqual((found["format"], found["size"], found["spacing"]), ("MetaImage", "34 x 30 x 22", "0.5 x 1 x 2"))
        self.assertEqual(float(found["maximum"]), scene().astype("uint8").max())
        with self.assertRaises(FileNotFoundError):
            medialvoxel.info(self.folder / "absent.mha")

    def test_errors(self):
        out = self.folder / "out.mha"
        cases = [
            ((self.folder / "absent.mha", out), {}, FileNotFoundError, "absent.mha"),
            ((self.input, out), {"lower": 5, "upper": 3}, ValueError, "lower threshold 5 is greater than upper"),
            ((self.input, out), {"loewr": 5}, ValueError, "'--loewr' is not an option of extract"),
            ((self.input, out), {"memory": 1000}, MemoryError, "needs at least"),
            ((self.input, self.folder / "none" / "out.mha"), {}, ValueError, "does not exist"),
        ]
        for files, options, kind, message in cases:
            with self.subTest(message), self.assertRaises(kind) as caught:
                medialvoxel.extract_file(*files, **options)
            self.assertIn(message, str(caught.exception))
            self.assertFalse(out.exists())

    def test_ctrl_c(self):
        write(self.input, slow_noise().astype("uint8"))
        files = f"{str(self.input)!r}, {str(self.folder / 'out.mha')!r}"
        self.assertLess(interrupt(f"extract_file({files}, thickness=154)", None), 1 * PATIENCE)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["in.mha"])

    def test_the_command(self):
        for command in ([sys.executable, "-m", "medialvoxel"], [program()]):
            done = subprocess.run([*command, "--version"], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (0, f"medialvoxel {medialvoxel.__version__}\n"))
        done = subprocess.run([sys.executable, "-m", "medialvoxel", "info"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("medialvoxel: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
