# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Sheets of voxels by their properties: in the mask, near every cell, of the same topology, and one voxel thick in plain walls."""

import itertools
import unittest

import medialvoxel
import numpy as np

from support import scan, scene

CORNERS = list(itertools.product((0, 1), repeat=3))
AROUND = [step for step in itertools.product((-1, 0, 1), repeat=3) if any(step)]


def spread(cells):
    """The voxels of cells, each of which stands at its lowest one."""
    found = np.zeros(np.add(cells.shape, 1), bool)
    for corner in CORNERS:
        found[tuple(slice(i, i + size) for i, size in zip(corner, cells.shape))] |= cells
    return found[:-1, :-1, :-1]


def any_corner(voxels):
    """Of each cell, whether one of its voxels is marked."""
    padded = np.pad(voxels, [(0, 1)] * 3)
    return np.any([padded[tuple(slice(i, i + size) for i, size in zip(corner, voxels.shape))] for corner in CORNERS], axis=0)


def full_blocks(voxels):
    """Numbers of 2 x 2 x 2 voxels in the sheet, which is two voxels thick there."""
    return np.count_nonzero(~any_corner(~voxels)[:-1, :-1, :-1])


def euler_number(voxels):
    """Vertices - edges + faces - cubes of closed voxels."""
    padded = np.pad(voxels, 1)
    total = 0
    for spans in itertools.product((0, 1), repeat=3):  # 1: the element is as long as a voxel along this axis
        element = padded
        for axis, span in enumerate(spans):
            if not span:
                element = np.moveaxis(element, axis, 0)
                element = np.moveaxis(element[:-1] | element[1:], 0, axis)
        total += (-1) ** sum(spans) * np.count_nonzero(element)
    return total


def parts(voxels, by_corner):
    """The number of connected components, found one voxel after the other."""
    left, number = set(map(tuple, np.argwhere(voxels))), 0
    steps = [step for step in AROUND if by_corner or np.abs(step).sum() == 1]
    while left:
        number, ends = number + 1, [left.pop()]
        while ends:
            here = ends.pop()
            near = left.intersection(tuple(np.add(here, step)) for step in steps)
            left -= near
            ends.extend(near)
    return number


def topology(voxels):
    """Parts, cavities and Euler number, which also tell the number of tunnels."""
    return parts(voxels, True), parts(~np.pad(voxels, 1), False), euler_number(voxels)


def solids():
    z, y, x = np.indices((26, 28, 30), float)
    yield "plates", (abs(z - 6.5) < 2) | (abs(z - 19) < 2)
    yield "cross", ((abs(z - 13) < 3) | (abs(y + z - 27) < 4)) & (abs(x - 15) < 10)
    yield "ball", abs(np.sqrt((z - 13) ** 2 + (y - 14) ** 2 + (x - 15) ** 2) - 9) < 2.3
    yield "slanted", (abs(0.3 * z + 0.5 * y + 0.81 * x - 20) < 2.2) & (y > 2) & (y < 26) & (z > 2) & (z < 24)
    yield "scan", scan((26, 28, 30)) > 60
    yield "noise", scene((20, 20, 20)) >= 40


class Voxels(unittest.TestCase):
    def test_properties(self):
        for name, mask in solids():
            with self.subTest(name):
                before = mask.copy()
                sheet = medialvoxel.extract(mask, smooth=False, max_pore_size=0)
                found = sheet.voxels(mask)
                np.testing.assert_array_equal(mask, before)
                self.assertEqual((found.dtype, found.shape, found.flags.owndata), (bool, mask.shape, True))
                self.assertFalse((found & ~mask).any())
                self.assertTrue(any_corner(found)[sheet.medial].all())
                thick = spread(sheet.medial) & mask
                self.assertEqual(topology(found), topology(thick))
                self.assertLess(found.sum(), sheet.medial.sum())
                if name in ("plates", "cross", "slanted", "scan"):
                    self.assertEqual(full_blocks(found), 0)

    def test_walls_are_one_voxel_thick(self):
        for width in (3, 4, 5, 6, 7, 8):
            mask = np.zeros((20, 36, 36), bool)
            mask[6 : 6 + width, 3:33, 3:33] = True
            found = medialvoxel.extract(mask).voxels(mask)
            self.assertLessEqual(found.sum(axis=0).max(), 1)
            self.assertTrue(found[:, 10:26, 10:26].any(axis=0).all())
            layers = np.argwhere(found[:, 10:26, 10:26])[:, 0]
            self.assertLessEqual(abs(layers - (6 + (width - 1) / 2)).max(), 0.5)

    def test_two_dimensions(self):
        z, y, x = np.indices((1, 40, 44), float)
        ring = abs(np.hypot(y[0] - 20, x[0] - 22) - 12) < 2.4
        sheet = medialvoxel.extract(ring)
        found = sheet.voxels(ring)
        self.assertEqual(found.shape, ring.shape)
        self.assertFalse((found & ~ring).any())
        self.assertEqual(topology(found[None]), topology(ring[None]))
        self.assertLess(found.sum(), 2 * np.pi * 12 * 1.1)

    def test_what_smoothing_and_pores_changed_is_not_in_the_mask(self):
        mask = np.zeros((20, 36, 36), bool)
        mask[6:12, 3:33, 3:33] = True
        mask[8:10, 17:19, 17:19] = False  # a pore that is closed
        found = medialvoxel.extract(mask).voxels(mask)
        self.assertFalse((found & ~mask).any())
        self.assertTrue(found.any())

    def test_labels_and_gray_values(self):
        values = scan((26, 28, 30))
        sheet = medialvoxel.extract(values, lower=60)
        self.assertGreater(sheet.voxels(values >= sheet.lower).sum(), 100)
        with self.assertRaisesRegex(ValueError, r"the mask has the shape \(26, 28\); it must be that of the sheet, \(26, 28, 30\)"):
            sheet.voxels(values[..., 0])


if __name__ == "__main__":
    unittest.main()
