# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Vectors and signed distances against a search over all voxels."""

import itertools
import math
import unittest

import volumes
from program import ProgramTestCase

SIZE = (9, 8, 7)
SPACING = (0.5, 0.625, 1.25)


def is_object(x, y, z):
    return 2 <= x < 7 and 2 <= y < 7 and 1 <= z < 6 and not (x == 4 and y == 4)


class DistanceTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.Volume(SIZE, [], SPACING)
        self.indices = list(self.volume.indices())
        self.inside = {index for index in self.indices if is_object(*index)}
        self.volume.voxels = [50 if index in self.inside else 0 for index in self.indices]
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def border(self, of_object):
        """Voxels of one side with a neighbor on the other side."""

        def neighbors(index):
            for step in itertools.product((-1, 0, 1), repeat=3):
                neighbor = tuple(c + s for c, s in zip(index, step))
                if all(0 <= c < n for c, n in zip(neighbor, SIZE)):
                    yield neighbor

        return [
            index
            for index in self.indices
            if (index in self.inside) == of_object
            and any((other in self.inside) != of_object for other in neighbors(index))
        ]

    def distances(self, of_object=True, spacing=SPACING):
        border = self.border(of_object)
        return [
            min(math.hypot(*((a - b) * s for a, b, s in zip(index, point, spacing))) for point in border)
            for index in self.indices
        ]

    def compute(self, *arguments):
        """Norms of the vectors and signed distances."""
        self.run_program("distance", "in.mha", "v.mha", "--distance", "d.mha", "--overwrite", *arguments)
        vectors = volumes.read_floats(self.folder / "v.mha")
        norms = [math.hypot(*vectors[i : i + 3]) for i in range(0, len(vectors), 3)]
        return norms, list(volumes.read_floats(self.folder / "d.mha"))

    def assert_close(self, values, expected):
        self.assertEqual(len(values), len(expected))
        for value, wanted in zip(values, expected):
            self.assertAlmostEqual(value, wanted, delta=1e-5)

    def signed(self, distances):
        return [-d if index in self.inside else d for index, d in zip(self.indices, distances)]

    def test_object_border(self):
        norms, signed = self.compute()
        self.assert_close(norms, self.distances())
        self.assert_close(signed, self.signed(self.distances()))

    def test_background_border(self):
        norms, signed = self.compute("--boundary", "background")
        self.assert_close(norms, self.distances(of_object=False))
        self.assert_close(signed, self.signed(self.distances(of_object=False)))

    def test_regions(self):
        expected = self.distances()
        for region in ("inside", "outside"):
            wanted = [d if (index in self.inside) == (region == "inside") else 0 for index, d in zip(self.indices, expected)]
            norms, signed = self.compute("--region", region)
            self.assert_close(norms, wanted)
            self.assert_close(signed, self.signed(wanted))

    def test_maximum_distance_in_voxels(self):
        least = min(self.volume.spacing)
        units, voxels = (self.compute("--max-distance", limit) for limit in (2.5 * least, "2.5vx"))
        self.assertEqual(*(list(map(str, norms)) for norms, _ in (units, voxels)))
        self.assertIn(True, map(math.isnan, units[0]))

    def test_maximum_distance(self):
        norms, signed = self.compute("--max-distance", 1.0)
        for norm, value, wanted in zip(norms, signed, self.distances()):
            self.assertEqual(math.isnan(norm), wanted > 1.0)
            self.assertEqual(math.isnan(value), wanted > 1.0)

    def test_thresholds_define_the_object(self):
        self.volume.voxels = [value + 20 for value in self.volume.voxels]
        volumes.write_meta(self.folder / "in.mha", self.volume)
        for arguments in (["--lower", 70], ["--lower", 20.5], ["--lower", 21, "--upper", 1e9]):
            norms, _ = self.compute(*arguments)
            self.assert_close(norms, self.distances())
        _, signed = self.compute("--upper", 20.5)
        self.assert_close([-value for value in signed], self.signed(self.distances(of_object=False)))

    def test_vectors_of_extract(self):
        for boundary, of_object in (("object", True), ("background", False)):
            self.extract("in.mha", "l.mha", "--vectors", "v.mha", "--vector-boundary", boundary, "--overwrite")
            vectors = volumes.read_floats(self.folder / "v.mha")
            norms = [math.hypot(*vectors[i : i + 3]) for i in range(0, len(vectors), 3)]
            wanted = [d if index in self.inside else 0 for index, d in zip(self.indices, self.distances(of_object))]
            self.assert_close(norms, wanted)


if __name__ == "__main__":
    unittest.main()
