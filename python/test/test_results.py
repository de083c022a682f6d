# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Every type and memory order of arrays gives the bytes that the program writes for a file of the same values."""

import copy
import json
import pickle
import unittest

import medialvoxel
import numpy as np

from support import INTEGERS, ORDERS, REALS, Folder, read, read_ply, run, scan, scene, write

# Keywords of measures on gray values, options of the program, and what the values are measured on.
MEASURES = {
    "by itself": ({}, [], "fits"),
    "asked for": ({"sub_voxel": True}, ["--sub-voxel"], "fits"),
    "refused": ({"sub_voxel": False}, ["--sub-voxel=off"], "object"),
    "levels": ({"materials": (10, 110)}, ["--materials=10,110"], "fits"),
    "levels of NumPy": ({"materials": np.float32([5, 120])}, ["--materials=5,120"], "fits"),
    "smoothed": ({"smooth": True}, ["--smooth=on"], "fits"),
    "a limit of the type": ({"upper": 255}, ["--upper=255"], "fits"),
    "fixed, of voxels": ({"thickness": "3vx"}, ["--thickness=3vx"], "fits"),
}

SPACING = (1.5, 1.0, 0.75)

# Name: keywords, and options of the program.
EXTRACTIONS = {
    "auto": ({"lower": 40}, ["--lower", "40"]),
    "fixed": ({"lower": 40, "thickness": 2.5}, ["--lower", "40", "--thickness", "2.5"]),
    "otsu": ({"lower": "otsu", "smooth": "on"}, ["--lower", "otsu", "--smooth", "on"]),
    "range": ({"lower": 40, "upper": 90.5, "max_pore_size": 5}, ["--lower=40", "--upper=90.5", "--max-pore-size=5"]),
    "all but 0": ({"smooth": "off"}, ["--smooth", "off"]),
    "sub-voxel": ({"lower": 40.25, "sub_voxel": True}, ["--lower", "40.25", "--sub-voxel"]),
    "background": ({"lower": 40, "vector_boundary": "background"}, ["--lower=40", "--vector-boundary=background"]),
}


class Results(Folder):
    def assert_same(self, found, expected):
        self.assertEqual(found.dtype, expected.dtype)
        np.testing.assert_array_equal(found, expected)
        self.assertTrue(found.flags.owndata and found.flags.c_contiguous and found.flags.writeable)

    def assert_same_thickness(self, found, expected):
        """The file has both in one number: walls are greater than 0, rims are less."""
        self.assert_same(found.thickness, np.maximum(expected, 0))
        self.assert_same(found.rims, expected < 0)

    def assert_same_sheet(self, found, expected):
        labels, thickness, vectors = expected
        self.assert_same(found.labels, labels)
        self.assert_same_thickness(found, thickness)
        self.assert_same(found.vectors, vectors)

    def program(self, command, values, *arguments):
        write(self.folder / "in.mha", values, SPACING)
        status, errors = run([command, self.folder / "in.mha", *arguments, "--overwrite", "--quiet"])
        self.assertEqual(status, 0, errors)

    def test_extract_of_every_type_and_order(self):
        outputs = [self.folder / f"{name}.mha" for name in ("labels", "thickness", "vectors")]
        for dtype in [*INTEGERS, *REALS, "bool"]:
            values = scene() > 40 if dtype == "bool" else scene().astype(dtype)
            keywords, options = EXTRACTIONS["all but 0" if dtype == "bool" else "auto"]
            stored = values.astype({"bool": "uint8", "float16": "float32"}.get(dtype, dtype))
            files = [outputs[0], f"--thickness-map={outputs[1]}", f"--vectors={outputs[2]}"]
            self.program("extract", stored, *files, *options)
            expected = [read(path) for path in outputs]
            self.assertGreater(np.count_nonzero(expected[0] >= 2), 1000)
            for order, arrange in ORDERS.items():
                with self.subTest(dtype=dtype, order=order):
                    array = arrange(values)
                    before = array.copy()
                    self.assert_same_sheet(medialvoxel.extract(array, spacing=SPACING, vectors=True, **keywords), expected)
                    np.testing.assert_array_equal(array, before)

    def test_extract_with_every_option(self):
        outputs = [self.folder / f"{name}.mha" for name in ("labels", "thickness", "vectors")]
        files = [outputs[0], f"--thickness-map={outputs[1]}", f"--vectors={outputs[2]}"]
        for dtype in ("uint8", "float32", "int64"):
            values = scene().astype(dtype)
            for name, (keywords, options) in EXTRACTIONS.items():
                with self.subTest(dtype=dtype, options=name):
                    self.program("extract", values, *files, *options)
                    found = medialvoxel.extract(values, spacing=SPACING, vectors=True, threads=1, **keywords)
                    self.assert_same_sheet(found, map(read, outputs))

    def test_measures_on_gray_values(self):
        names = ("labels", "thickness", "uncertainty")
        outputs = [self.folder / f"{name}.mha" for name in names]
        report = self.folder / "report.json"
        for dtype in ("uint8", "float32"):
            values = scan().astype(dtype)
            for name, (keywords, options, expected) in MEASURES.items():
                if dtype == "float32" and "upper" in keywords:
                    continue
                with self.subTest(dtype=dtype, measure=name):
                    is_uncertain = expected == "fits"
                    files = [outputs[0], f"--thickness-map={outputs[1]}", f"--report={report}"]
                    files += [f"--uncertainty-map={outputs[2]}"] if is_uncertain else []
                    self.program("extract", values, *files, "--lower=60", *options)
                    found = medialvoxel.extract(values, spacing=SPACING, lower=60, uncertainty=is_uncertain, **keywords)
                    self.assertEqual(found.measure["on"], expected)
                    written = json.loads(report.read_text())["measure"]
                    for key in ("on", "reason"):
                        self.assertEqual(found.measure[key], written[key])
                    for key, value in (found.measure["scan"] or {}).items():
                        self.assertEqual(value, written["scan"][key])
                    self.assert_same(found.labels, read(outputs[0]))
                    self.assert_same_thickness(found, read(outputs[1]))
                    if is_uncertain:
                        self.assert_same(found.uncertainty, read(outputs[2]))
                        self.assertGreater(np.count_nonzero(found.uncertainty > 0), 1000)
                    else:
                        self.assertFalse(hasattr(found, "uncertainty"))

    def test_importance_is_that_of_the_program(self):
        output = self.folder / "importance.mha"
        for keywords, options in (({}, []), ({"thickness": 3.0}, ["--thickness=3"])):
            self.program("extract", scene(), f"--importance={output}", "--lower=40", *options)
            found = medialvoxel.extract(scene(), spacing=SPACING, lower=40, importance=True, **keywords)
            self.assert_same(found.importance, read(output))
        for thickness in (1.6, 2.2, 3.0):
            sheet = medialvoxel.extract(scene(), spacing=SPACING, lower=40, thickness=thickness)
            limit = np.float32(np.pi / 2 * thickness)
            self.assertGreater(np.count_nonzero(sheet.medial), 100)
            np.testing.assert_array_equal(found.importance >= limit, sheet.medial)

    def test_topology_is_that_of_the_program(self):
        labels, report = self.folder / "labels.mha", self.folder / "report.json"
        for keywords, options in (({}, []), ({"thickness": 3.0, "max_pore_size": 4}, ["--thickness=3", "--max-pore-size=4"])):
            self.program("extract", scene(), labels, "--same-topology", "--lower=40", f"--report={report}", *options)
            found = medialvoxel.extract(scene(), spacing=SPACING, lower=40, same_topology=True, **keywords)
            self.assert_same(found.labels, read(labels))
            self.assertEqual(found.topology, json.loads(report.read_text())["topology"])
            self.assertEqual(found.topology["added_cells"], np.count_nonzero(found.labels == 4))
            plain = medialvoxel.extract(scene(), spacing=SPACING, lower=40, **keywords)
            self.assertIsNone(plain.topology)
            np.testing.assert_array_equal(found.medial, plain.medial)

    def test_topology_of_objects_is_that_of_the_program(self):
        labels, objects, report = (self.folder / name for name in ("labels.mha", "objects.mha", "report.json"))
        array = np.digitize(scene(), (40, 90)).astype(np.uint8)
        options = ["--labels=all", f"--objects={objects}", f"--report={report}"]
        self.program("extract", array, labels, "--same-topology", *options)
        found = medialvoxel.extract(array, spacing=SPACING, labels="all", same_topology=True)
        told = json.loads(report.read_text())
        self.assert_same(found.labels, read(labels))
        self.assert_same(found.objects, read(objects))
        self.assertEqual(found.topology, told["topology"])
        names = ("label", "voxels", "candidate_cells", "medial_cells", "added_cells")
        self.assertEqual(found.object_counts, [{name: row[name] for name in names} for row in told["objects"]])
        self.assertNotIn("added_cells", medialvoxel.extract(array, labels="all").object_counts[0])

    def test_values_without_a_scan_are_measured_on_the_object(self):
        values = scene().astype("uint8")
        found = medialvoxel.extract(values, lower=40, upper=90)
        self.assertEqual(found.measure["on"], "object")
        self.assertEqual(medialvoxel.extract(values > 40).measure["reason"], "no threshold cuts the values")

    def test_distance_of_every_type_and_order(self):
        files = [self.folder / "vectors.mha", f"--distance={self.folder / 'distance.mha'}"]
        for dtype in [*INTEGERS, *REALS]:
            values = scene().astype(dtype)
            self.program("distance", values.astype("float32") if dtype == "float16" else values, *files, "--lower=40")
            for order, arrange in ORDERS.items():
                with self.subTest(dtype=dtype, order=order):
                    found = medialvoxel.distance(arrange(values), spacing=SPACING, lower=40, vectors=True)
                    self.assert_same(found.vectors, read(files[0]))
                    self.assert_same(found.distance, read(self.folder / "distance.mha"))

    def test_distance_with_every_option(self):
        files = [self.folder / "vectors.mha", f"--distance={self.folder / 'distance.mha'}"]
        for keywords in ({"boundary": "background"}, {"region": "inside"}, {"max_distance": 2.5}, {"max_distance": "2.5vx"}, {"max_distance": "2mm"}, {"label": 80}):
            with self.subTest(keywords):
                options = [f"--{name.replace('_', '-')}={value}" for name, value in keywords.items()]
                if "label" not in keywords:
                    keywords, options = {**keywords, "lower": 40}, [*options, "--lower=40"]
                self.program("distance", scene().astype("uint8"), *files, *options)
                found = medialvoxel.distance(scene().astype("uint8"), spacing=SPACING, vectors=True, **keywords)
                self.assert_same(found.vectors, read(files[0]))
                self.assert_same(found.distance, read(self.folder / "distance.mha"))
                alone = medialvoxel.distance(scene().astype("uint8"), spacing=SPACING, **keywords)
                self.assert_same(alone.distance, found.distance)
                self.assertFalse(hasattr(alone, "vectors"))

    def assert_same_mesh(self, found, path):
        points, faces, thickness = read_ply(path)
        np.testing.assert_array_equal(found.points.astype(points.dtype), points)
        np.testing.assert_array_equal(found.faces, faces)
        np.testing.assert_array_equal(found.thickness, thickness)

    def test_mesh_of_every_type_and_order(self):
        path = self.folder / "mesh.ply"
        for dtype in [*INTEGERS, *REALS]:
            values = scene().astype(dtype)
            self.program("mesh", values.astype("float32") if dtype == "float16" else values, path, "--lower=40")
            for order, arrange in ORDERS.items():
                with self.subTest(dtype=dtype, order=order):
                    found = medialvoxel.mesh(arrange(values), spacing=SPACING, lower=40)
                    self.assertGreater(len(found.faces), 1000)
                    self.assert_same_mesh(found, path)

    def test_mesh_with_every_option(self):
        path = self.folder / "mesh.ply"
        cases = {
            ("--triangles",): {"triangles": True},
            ("--min-component-size=50",): {"min_component_size": 50},
            ("--min-branch-length=3",): {"min_branch_length": 3},
            ("--min-branch-length=4vx",): {"min_branch_length": "4VX"},
            ("--element-size=auto",): {"element_size": "auto"},
            ("--element-size=4", "--triangles"): {"element_size": 4, "triangles": True},
            ("--element-size=auto", "--extend-rims"): {"element_size": "auto", "extend_rims": True},
            ("--element-size=auto", "--extend-rims", "--sub-voxel=off", "--smooth=on"): {
                "element_size": "auto",
                "extend_rims": True,
                "sub_voxel": False,
                "smooth": "on",
            },
            ("--sub-voxel", "--smooth=off", "--thickness=3"): {"sub_voxel": True, "smooth": False, "thickness": 3},
        }
        for options, keywords in cases.items():
            with self.subTest(keywords):
                self.program("mesh", scene().astype("int16"), path, "--lower=40", *options)
                self.assert_same_mesh(
                    medialvoxel.mesh(scene().astype("int16"), spacing=SPACING, lower=40, **keywords), path
                )

    def test_mesh_of_a_mask_with_elements_of_a_size(self):
        mask = 200 * (scene() >= 40).astype("uint8")
        for limits in ({"lower": 1}, {"upper": 199}, {}, {"lower": 1, "upper": 250}):
            with self.subTest(limits):
                options = [f"--{name}={value}" for name, value in limits.items()]
                self.program("mesh", mask, self.folder / "mesh.ply", *options, "--element-size=auto", "--extend-rims")
                found = medialvoxel.mesh(mask, spacing=SPACING, **limits, element_size="auto", extend_rims=True)
                self.assert_same_mesh(found, self.folder / "mesh.ply")

    def test_thickness_of_a_mask_does_not_depend_on_the_threshold(self):
        mask = 200 * (scene() >= 40).astype("uint8")
        files = [self.folder / "labels.mha", f"--thickness-map={self.folder / 'thickness.mha'}"]
        files += [f"--local-thickness={self.folder / 'local.mha'}", "--smooth=off", "--max-pore-size=0"]
        self.program("extract", mask, *files, "--lower=1", "--sub-voxel")
        options = {"smooth": "off", "max_pore_size": 0}
        found = medialvoxel.extract(mask, spacing=SPACING, lower=1, sub_voxel=True, **options)
        self.assert_same_thickness(found, read(self.folder / "thickness.mha"))
        for same in ({"lower": 1, "sub_voxel": False}, {"lower": 200}, {}):
            self.assert_same(medialvoxel.extract(mask, spacing=SPACING, **same, **options).thickness, found.thickness)
        local = medialvoxel.local_thickness(mask, spacing=SPACING, lower=1, sub_voxel=True)
        self.assert_same(local.thickness, read(self.folder / "local.mha"))

    def test_labels_of_every_type(self):
        cells = np.zeros((20, 24, 28))
        cells[2:18, 2:22, 2:12] = 3
        cells[2:18, 2:22, 12:26] = 70
        files = [self.folder / "labels.mha", f"--objects={self.folder / 'objects.mha'}"]
        for dtype in INTEGERS:
            for labels in ("all", [70]):
                with self.subTest(dtype=dtype, labels=labels):
                    text = labels if labels == "all" else "70"
                    self.program("extract", cells.astype(dtype), *files, f"--labels={text}", "--thickness=3")
                    found = medialvoxel.extract(cells.astype(dtype), thickness=3, spacing=SPACING, labels=labels, vectors=True)
                    self.assert_same(found.labels, read(files[0]))
                    self.assert_same(found.objects, read(self.folder / "objects.mha"))
                    self.assertEqual([row["label"] for row in found.object_counts], [70] if text == "70" else [3, 70])
                    self.assertFalse(hasattr(found, "vectors"))

    def test_two_dimensions(self):
        values = scene()[4].astype("uint8")
        outputs = [self.folder / f"{name}.mha" for name in ("labels", "thickness", "vectors")]
        write(self.folder / "in.mha", values, (1.0, 0.5))
        files = [outputs[0], f"--thickness-map={outputs[1]}", f"--vectors={outputs[2]}"]
        status, errors = run(["extract", self.folder / "in.mha", *files, "--lower=40", "--quiet"])
        self.assertEqual(status, 0, errors)
        found = medialvoxel.extract(values, spacing=(1.0, 0.5), lower=40, vectors=True)
        self.assert_same_sheet(found, map(read, outputs))

    def test_whole_numbers_of_64_bits_are_exact(self):
        values = np.full((6, 12, 12), 2**63, np.uint64)
        values[2:5, 2:10, 2:10] += np.uint64(1)
        found = medialvoxel.extract(values, thickness=3.0, lower=2**63 + 1)
        self.assertEqual(found.counts["object_voxels"], 3 * 8 * 8)

    def test_scalars_of_numpy(self):
        values = scene().astype("uint8")
        plain = medialvoxel.extract(values, thickness=3, lower=40, spacing=0.5)
        for kind in (np.float32, np.float64, np.int32, np.uint8, np.array):
            found = medialvoxel.extract(values, thickness=kind(3), lower=kind(40), spacing=np.float32([0.5] * 3))
            np.testing.assert_array_equal(found.labels, plain.labels)

    def test_counts_are_those_of_the_arrays(self):
        found = medialvoxel.extract(scene(), lower=40, smooth=False, max_pore_size=0)
        self.assertEqual(found.counts["object_voxels"], np.count_nonzero(scene() >= 40))
        self.assertEqual(found.counts["medial_cells"], np.count_nonzero(found.medial))
        self.assertEqual(found.counts["candidate_cells"], np.count_nonzero(found.labels))
        self.assertEqual((found.lower, found.smoothed, found.origin), (40.0, False, (0.5, 0.5, 0.5)))

    def test_outputs_that_are_not_wanted(self):
        found = medialvoxel.extract(scene(), lower=40, thickness_map=False)
        for name, keyword in (("thickness", "thickness_map=True"), ("rims", "thickness_map=True"), ("vectors", "vectors=True"),
                              ("objects", "labels"), ("uncertainty", "uncertainty=True"),
                              ("importance", "importance=True, without labels")):  # fmt: skip
            with self.assertRaisesRegex(AttributeError, f"Medial has no {name}; ask for it by {keyword}"):
                getattr(found, name)
        with self.assertRaisesRegex(AttributeError, "Distances has no vectors; ask for it by vectors=True"):
            medialvoxel.distance(scene(), lower=40).vectors  # noqa: B018
        with self.assertRaisesRegex(AttributeError, "Medial has no thicknes$"):
            found.thicknes  # noqa: B018

    def test_results_are_copied_and_pickled(self):
        found = medialvoxel.extract(scene(), lower=40)
        for same in (copy.deepcopy(found), pickle.loads(pickle.dumps(found))):
            np.testing.assert_array_equal(same.labels, found.labels)
            self.assertFalse(hasattr(same, "vectors"))
            self.assertEqual(repr(same), repr(found))

    def test_all_but_the_array_is_a_keyword(self):
        for call in (medialvoxel.extract, medialvoxel.mesh, medialvoxel.distance, medialvoxel.local_thickness):
            with self.assertRaises(TypeError):
                call(scene(), 0.5)

    def test_results_outlive_the_input(self):
        values = scene()
        found = medialvoxel.extract(values, lower=40)
        before = found.labels.copy()
        values[...] = 0
        del values
        medialvoxel.extract(scene(seed=4), lower=40)
        np.testing.assert_array_equal(found.labels, before)


if __name__ == "__main__":
    unittest.main()
