# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Wrong values are a ValueError with what the program says of a file with the same values."""

import unittest
import warnings

import medialvoxel
import numpy as np

from support import Folder, run, scene, write

# Keywords of extract, and the same as options of the program.
OF_THE_PROGRAM = [
    ({"lower": 5, "upper": 3}, ["--lower=5", "--upper=3"]),
    ({"lower": "nan"}, ["--lower=nan"]),
    ({"lower": float("nan")}, ["--lower=nan"]),
    ({"lower": "many"}, ["--lower=many"]),
    ({"label": 300}, ["--label=300"]),
    ({"label": 1.5}, ["--label=1.5"]),
    ({"label": 3, "lower": 1}, ["--label=3", "--lower=1"]),
    ({"thickness": -1}, ["--thickness=-1"]),
    ({"thickness": "thick"}, ["--thickness=thick"]),
    ({"thickness": float("inf")}, ["--thickness=inf"]),
    ({"min_thickness": 5, "max_thickness": 4}, ["--min-thickness=5", "--max-thickness=4"]),
    ({"thickness": 3, "max_thickness": 4}, ["--thickness=3", "--max-thickness=4"]),
    ({"max_pore_size": 10**7}, ["--max-pore-size=10000000"]),
    ({"max_pore_size": -1}, ["--max-pore-size=-1"]),
    ({"smooth": "maybe"}, ["--smooth=maybe"]),
    ({"sub_voxel": True}, ["--sub-voxel"]),
    ({"materials": (1, 2)}, ["--materials=1,2"]),
    ({"materials": (2, 2), "lower": 1}, ["--materials=2,2", "--lower=1"]),
    ({"materials": (9, 2), "lower": 5}, ["--materials=9,2", "--lower=5"]),
    ({"materials": (float("nan"), 2), "lower": 1}, ["--materials=nan,2", "--lower=1"]),
    ({"materials": (1, 2, 3), "lower": 1}, ["--materials=1,2,3", "--lower=1"]),
    ({"materials": (1, 2), "lower": 1, "sub_voxel": False}, ["--materials=1,2", "--lower=1", "--sub-voxel=off"]),
    ({"uncertainty": True}, ["--uncertainty-map={folder}/u.mha"]),
    ({"uncertainty": True, "lower": 1, "sub_voxel": False}, ["--uncertainty-map={folder}/u.mha", "--lower=1", "--sub-voxel=off"]),
    ({"labels": "all", "lower": 3}, ["--labels=all", "--lower=3"]),
    ({"labels": [0]}, ["--labels=0"]),
    ({"threads": 0}, ["--threads=0"]),
    ({"memory": "much"}, ["--memory=much"]),
    ({"vectors": True, "vector_boundary": "none"}, ["--vectors={folder}/v.mha", "--vector-boundary=none"]),
]

# Of NumPy alone: what is refused, and a part of the message.
OF_ARRAYS = [
    (np.zeros((3, 3, 3), complex), "the values are complex128"),
    (np.zeros((3, 3, 3), np.longdouble), "the values are float128"),
    (np.zeros((3, 3, 3), object), "the values are object"),
    (np.zeros((3, 3, 3), "U3"), "the values are <U3"),
    (np.zeros((3, 3, 3), "datetime64[s]"), "the values are datetime64[s]"),
    (np.zeros((3, 3, 3), [("a", "u1")]), "the values are [('a', 'u1')]"),
    (np.ma.masked_array(np.zeros((3, 3, 3)), True), "masked"),
    (np.zeros(5), "the array has 1 axes"),
    (np.zeros((2, 2, 2, 2)), "the array has 4 axes"),
    (np.float32(3), "the array has 0 axes"),
    (np.zeros((3, 0, 3)), "the array has the shape (3, 0, 3)"),
    (None, "the array has 0 axes"),
]

SPACINGS = [
    (0, "axis 0"),
    ((1, 1, 0), "axis 2 is 0"),
    ((-1, 1, 1), "axis 0 is -1"),
    ((1, float("nan"), 1), "axis 1"),
    ((1, 1), "one for each axis, (z, y, x)"),
    ("wide", "one for each axis"),
    ((1, 1, 5000), "ratio"),
]


class Errors(Folder):
    def test_messages_of_the_program(self):
        values = scene().astype("uint8")
        write(self.folder / "in.mha", values)
        for keywords, options in OF_THE_PROGRAM:
            with self.subTest(keywords):
                options = [option.format(folder=self.folder) for option in options]
                status, errors = run(["extract", self.folder / "in.mha", self.folder / "out.mha", *options])
                self.assertIn(status, (2, 3, 4))
                said = errors.splitlines()[-1].removeprefix("medialvoxel: ").removesuffix(" (see medialvoxel extract --help)")
                with self.assertRaises(ValueError) as caught:
                    medialvoxel.extract(values, **keywords)
                self.assertEqual(str(caught.exception), said.replace(str(self.folder / "in.mha"), "array"))

    def test_arrays(self):
        for array, message in OF_ARRAYS:
            with self.subTest(message), self.assertRaises(ValueError) as caught:
                medialvoxel.extract(array)
            self.assertIn(message, str(caught.exception))

    def test_spacings(self):
        for spacing, message in SPACINGS:
            with self.subTest(spacing), self.assertRaises(ValueError) as caught:
                medialvoxel.distance(scene(), spacing=spacing)
            self.assertIn(message, str(caught.exception))

    def test_labels(self):
        cells = np.ones((4, 4, 4), np.int16)
        for labels, message in (([7], "no value is the label 7"), (["bone"], "is a name"), ([], "is empty")):
            with self.subTest(labels), self.assertRaises(ValueError) as caught:
                medialvoxel.extract(cells, labels=labels)
            self.assertIn(message, str(caught.exception))

    def test_lack_of_memory(self):
        with self.assertRaises(MemoryError) as caught:
            medialvoxel.extract(scene(), lower=40, memory=1)
        self.assertIn("1 bytes are allowed", str(caught.exception))
        with self.assertRaises(MemoryError):
            medialvoxel.extract(np.broadcast_to(np.uint8(1), (2**16, 2**16, 2**16)))

    def test_otsu_of_equal_values(self):
        with self.assertRaises(ValueError) as caught:
            medialvoxel.mesh(np.ones((4, 4, 4)), lower="otsu")
        self.assertIn("array: all its values are 1; the threshold of Otsu needs two", str(caught.exception))

    def test_a_mesh_needs_three_axes(self):
        with self.assertRaises(ValueError):
            medialvoxel.mesh(scene()[0])

    def test_unequal_spacing_is_a_warning(self):
        for call in (medialvoxel.extract, medialvoxel.local_thickness, medialvoxel.mesh):
            with self.assertWarnsRegex(medialvoxel.MedialVoxelWarning, "resample the array") as caught:
                call(scene(), lower=40, spacing=(8, 1, 1))
            self.assertEqual((caught.warning.code, caught.filename), ("unequal_spacing", __file__))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            medialvoxel.extract(scene(), lower=40, spacing=(2, 1, 1))

    def test_what_was_found_is_a_warning(self):
        """With the codes that the report of the program has."""
        ball = ((np.indices((21, 21, 21)) - 10.0) ** 2).sum(axis=0) < 64
        nothing = np.zeros((5, 6, 7))
        for call, array, keywords, code in (
            (medialvoxel.extract, nothing, {}, "no_object"),
            (medialvoxel.distance, nothing, {}, "no_object"),
            (medialvoxel.local_thickness, nothing, {}, "no_object"),
            (medialvoxel.extract, 1 - nothing, {}, "no_background"),
            (medialvoxel.extract, ball, {}, "no_medial_cells"),
            (medialvoxel.extract, ball, {"max_thickness": 101}, "unusual_max_thickness"),
            (medialvoxel.local_thickness, ball, {"method": "sphere", "largest_ball": 4}, "beyond_largest_ball"),
        ):
            with self.subTest(code, call=call.__name__), warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                call(array, **keywords)
                self.assertEqual({one.category for one in caught}, {medialvoxel.MedialVoxelWarning})
                self.assertIn(code, [one.message.code for one in caught])
                self.assertEqual(caught[0].filename, __file__)

    def test_flags_take_the_words_of_the_program(self):
        for value, is_on in ((False, False), ("off", False), ("no", False), (0, False), (np.False_, False), ("on", True), (1, True)):
            found = medialvoxel.extract(scene(), lower=40, vectors=value, thickness_map=value)
            self.assertEqual((hasattr(found, "vectors"), hasattr(found, "thickness")), (is_on, is_on), value)
        for name in ("vectors", "thickness_map", "uncertainty", "importance", "same_topology"):
            for value in ("maybe", 2, 1.0, [True]):
                with self.assertRaisesRegex(ValueError, f"{name} is .*; it must be True or False"):
                    medialvoxel.extract(scene(), lower=40, **{name: value})
        with self.assertRaisesRegex(ValueError, "--sub-voxel: 'maybe' is not one of"):
            medialvoxel.local_thickness(scene(), lower=40, sub_voxel="maybe")

    def test_unknown_keywords(self):
        for name in ("lower_threshold", "voxel_units"):
            with self.assertRaises(TypeError):
                medialvoxel.extract(scene(), **{name: 3})

    def test_lengths_of_other_units(self):
        for text in ("3 vx", "3voxels", "vx", "-3vx", "0vx", "infvx", "2cm"):
            with self.assertRaisesRegex(ValueError, "--thickness: '.*' is not a finite number greater than 0"):
                medialvoxel.extract(scene(), lower=40, thickness=text)


if __name__ == "__main__":
    unittest.main()
