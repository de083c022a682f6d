# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The same bytes for any division and any number of threads, and labels that are what the report says."""

import json
import random
import unittest

import volumes
from program import ProgramTestCase


def rough_shell(size=(40, 36, 33)):
    """A shell with a rough surface: many ties, thin and thick places, an object that touches the end of the image."""
    noise = random.Random(7)
    center = [n / 2 for n in size]

    def value(*index):
        radius = sum((c - m) ** 2 for c, m in zip(index, center)) ** 0.5
        return 1 if 10 + noise.choice([0, 0, 1]) <= radius < 15 or index[1] > 30 else 0

    volume = volumes.Volume(size, [], (0.5, 0.5, 0.8))
    volume.voxels = [value(*index) for index in volume.indices()]
    return volume


class IdentityTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = rough_shell()
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def results(self, *arguments, source="in.mha"):
        self.extract(
            source,
            "l.mha",
            "--vectors",
            "v.mha",
            "--distance",
            "d.mha",
            "--thickness-map",
            "t.mha",
            "--report",
            "r.json",
            "--overwrite",
            *arguments,
            thickness=2,
        )
        report = json.loads((self.folder / "r.json").read_text())
        data = tuple(volumes.read_data(self.folder / name) for name in ("l.mha", "v.mha", "d.mha", "t.mha"))
        return data, report["counts"], report["percent"]

    def test_divisions_and_threads(self):
        expected = self.results("--divisions", 1, "--threads", 1)
        for divisions in (1, 3, 7):
            for threads in (1, 2, 5):
                self.assertEqual(
                    self.results("--divisions", divisions, "--threads", threads), expected, (divisions, threads)
                )

    def test_more_divisions_than_slices(self):
        expected = self.results()
        self.assertEqual(self.results("--divisions", 1000), expected)

    def test_input_that_streams_and_input_that_does_not(self):
        expected = self.results()
        volumes.write_nrrd(self.folder / "packed.nrrd", self.volume, compressed=True)
        self.assertEqual(self.results("--divisions", 4, source="packed.nrrd"), expected)

    def test_distance_command(self):
        def distance(*arguments):
            self.run_program("distance", "in.mha", "v.mha", "--distance", "d.mha", "--overwrite", *arguments)
            return [volumes.read_data(self.folder / name) for name in ("v.mha", "d.mha")]

        expected = distance("--threads", 1)
        self.assertEqual(distance("--divisions", 7, "--threads", 5), expected)

    def test_distance_of_both_commands_is_the_same(self):
        results = self.results()[0]
        self.run_program("distance", "in.mha", "v2.mha", "--distance", "d2.mha")
        self.assertEqual(volumes.read_data(self.folder / "d2.mha"), results[2])

    def test_counts_are_those_of_the_labels(self):
        (labels, _, _, thicknesses), counts, _ = self.results()
        self.assertEqual(labels.count(2), counts["bound"])
        self.assertEqual(labels.count(3), counts["geodesic_medial"])
        self.assertEqual(labels.count(1), counts["trivial"] + counts["geodesic_non_medial"])
        self.assertEqual(sum(1 for label in labels if label), counts["candidate_cells"])
        self.assertEqual([label >= 2 for label in labels], [value != 0 for value in memoryview(thicknesses).cast("f")])
        self.assertEqual(sum(self.volume.voxels), counts["object_voxels"])
        self.assertGreater(counts["bound"], 0)
        self.assertGreater(counts["geodesic_medial"], 0)
        self.assertGreater(counts["geodesic_non_medial"], 0)


if __name__ == "__main__":
    unittest.main()
