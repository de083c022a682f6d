# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Functions for arrays that call the program: what it writes for a file of the same values, with the axes of NumPy."""

import json
import os
import unittest
from unittest import mock

import medialvoxel
import numpy as np

from support import INTEGERS, ORDERS, REALS, Folder, program, read_ply, run, scan, scene, write

SPACING = (1.5, 1.0, 0.75)


class ByProgram(Folder):
    def setUp(self):
        super().setUp()
        program()

    def report_of(self, command, output, values, *options):
        write(self.folder / "in.mha", values, SPACING[-values.ndim :])
        path = self.folder / "report.json"
        status, errors = run([command, self.folder / "in.mha", self.folder / output, f"--report={path}", "--overwrite", "--quiet", *options])
        self.assertEqual(status, 0, errors)
        return json.loads(path.read_text())

    def test_thin_places(self):
        for values in (scan().astype("uint8"), scan()[:, 20].astype("float32")):
            with self.subTest(values.ndim):
                options = ("--lower=60", "--thin-below=3.5,4,0")
                expected = self.report_of("extract", "out.mha", values, *options)["places"]["thin"]
                spacing = SPACING[-values.ndim :]
                found = medialvoxel.thin_places(values, thin_below=(3.5, 4, 0), lower=60, spacing=spacing)
                self.assertGreater(found.number, 0)
                self.assertEqual(len(found.places), found.number)
                for name, value in expected.items():
                    if name != "places":
                        self.assertEqual(getattr(found, name), value)
                for place, row in zip(found.places, expected["places"]):
                    for name in ("area", "cells", "minimum", "uncertainty", "at_edge"):
                        self.assertEqual(getattr(place, name), row[name])
                    for name in ("center", "index", "first", "last"):
                        self.assertEqual(list(getattr(place, name)), row[name][::-1])
                    self.assertEqual([list(side) for side in place.sides], [side[::-1] for side in row["sides"]])
                sheet = medialvoxel.extract(values, lower=60, spacing=spacing)
                self.assertEqual(float(sheet.thickness[found.places[0].index]), found.places[0].minimum)

    def test_a_thin_rib(self):
        part = np.zeros((30, 40, 40), bool)
        part[4:10, 2:-2, 2:-2] = True
        part[10:28, 10:13, 2:-2] = True
        (place,) = medialvoxel.thin_places(part, thin_below=2, spacing=0.5).places
        self.assertEqual((place.minimum, place.maximum < 2.25), (1.5, True))
        self.assertAlmostEqual(place.center[1], 0.5 * 11, delta=0.25)
        self.assertEqual(sorted(side[1] for side in place.sides), [4.5, 6.5])  # of the background
        self.assertEqual(medialvoxel.thin_places(part, thin_below=1, spacing=0.5).places, [])

    def test_surface_thickness_of_every_type_and_order(self):
        for dtype in [*INTEGERS, *REALS, "bool"]:
            values = scene((14, 16, 18)) > 40 if dtype == "bool" else scene((14, 16, 18)).astype(dtype)
            stored = values.astype({"bool": "uint8", "float16": "float32"}.get(dtype, dtype))
            lower = None if dtype == "bool" else 40
            report = self.report_of("surface", "out.ply", stored, *([] if lower is None else ["--lower=40"]))
            points, faces, thickness = read_ply(self.folder / "out.ply")
            self.assertEqual(report["surface"]["triangles"], len(faces))
            for order in (ORDERS if dtype == "int16" else list(ORDERS)[:2]):
                with self.subTest(dtype=dtype, order=order):
                    found = medialvoxel.surface_thickness(ORDERS[order](values), lower=lower, spacing=SPACING)
                    np.testing.assert_array_equal(found.points, points)
                    np.testing.assert_array_equal(found.faces, faces)
                    np.testing.assert_array_equal(found.thickness, thickness)
                    self.assertEqual(found.lower, lower)

    def test_the_thickness_of_a_plate(self):
        plate = np.zeros((12, 30, 30), bool)
        plate[4:8, 3:27, 3:27] = True
        found = medialvoxel.surface_thickness(plate, spacing=0.5, threads=1)
        self.assertEqual(float(np.nanmedian(found.thickness)), 2.0)
        np.testing.assert_allclose((found.points.min(axis=0), found.points.max(axis=0)), 0.5 * np.array([(3.5, 2.5, 2.5), (7.5, 26.5, 26.5)]))
        ball = medialvoxel.surface_thickness(plate, spacing=0.5, method="sphere", largest_ball=1)
        self.assertEqual(float(np.nanmax(ball.thickness)), 1.0)

    def test_errors(self):
        values = scene().astype("uint8")
        for call, array, keywords, kind, message in (
            (medialvoxel.thin_places, values, {"thin_below": -1}, ValueError, "--thin-below"),
            (medialvoxel.thin_places, values, {"thin_below": 2, "lower": 9, "upper": 5}, ValueError, "lower threshold 9 is greater"),
            (medialvoxel.thin_places, values, {"thin_below": 2, "lower": ""}, ValueError, "--lower: its value is empty"),
            (medialvoxel.thin_places, values, {"thin_below": 2, "loewr": 9}, ValueError, "'--loewr' is not an option"),
            (medialvoxel.thin_places, np.zeros(3), {"thin_below": 2}, ValueError, "the array has 1 axes"),
            (medialvoxel.thin_places, values, {"thin_below": 2, "spacing": (1, 2)}, ValueError, "one for each axis"),
            (medialvoxel.thin_places, 0 * values + 3, {"thin_below": 2, "lower": "otsu"}, ValueError, "array: all its values are 3"),
            (medialvoxel.surface_thickness, values[0], {}, ValueError, "the array has 2 axes; a surface needs 3"),
            (medialvoxel.surface_thickness, values, {"method": "ball"}, ValueError, "--local-thickness-method"),
            (medialvoxel.surface_thickness, values, {"lower": 40, "memory": 1000}, MemoryError, "needs at least"),
        ):
            with self.subTest(message), self.assertRaises(kind) as caught:
                call(array, **keywords)
            self.assertIn(message, str(caught.exception))

    def test_progress_and_what_is_left(self):
        seen = []
        with mock.patch("tempfile.tempdir", str(self.folder)):
            medialvoxel.thin_places(scene(), thin_below=2, lower=40, progress=lambda done: seen.append((done, os.listdir(self.folder))))
        shares = [done for done, _ in seen]
        self.assertEqual((shares, shares[-1]), (sorted(shares), 1.0))
        self.assertEqual({len(names) for _, names in seen}, {2})  # for the array, and for the report
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
