# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The picture: its colors, its size, the slices that it shows."""

import struct
import unittest
import zlib

import volumes
from program import ProgramTestCase
from test_identity import rough_shell

BLACK = (0, 0, 0)
RED = (255, 45, 35)
GRAY = (95, 95, 100)


def read_png(path):
    """Rows of red, green, blue of a picture with eight bits per color."""
    content = path.read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    position, packed = 8, b""
    while position < len(content):
        length, name = struct.unpack(">I4s", content[position : position + 8])
        chunk = content[position + 8 : position + 8 + length]
        if name == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", chunk[:10])
            assert (depth, color) == (8, 2)
        elif name == b"IDAT":
            packed += chunk
        position += 12 + length
    data = zlib.decompress(packed)
    stride = 3 * width
    rows, previous = [], bytearray(stride)
    for y in range(height):
        kind, *line = data[y * (stride + 1) : (y + 1) * (stride + 1)]
        for i in range(stride):
            left = line[i - 3] if i >= 3 else 0
            above = previous[i]
            corner = previous[i - 3] if i >= 3 else 0
            if kind == 4:
                estimate = left + above - corner
                nearest = min((left, above, corner), key=lambda value: abs(estimate - value))
                line[i] = (line[i] + nearest) & 255
            else:
                line[i] = (line[i] + (0, left, above, (left + above) // 2)[kind]) & 255
        rows.append([tuple(line[i : i + 3]) for i in range(0, stride, 3)])
        previous = line
    return rows


class PreviewTest(ProgramTestCase):
    def preview(self, volume, *arguments, thickness=3):
        volumes.write_meta(self.folder / "in.mha", volume)
        self.extract("in.mha", "out.mha", "--preview", "p.png", "--overwrite", *arguments, thickness=thickness)
        return read_png(self.folder / "p.png")

    def colors(self, rows):
        counts = {}
        for row in rows:
            for color in row:
                counts[color] = counts.get(color, 0) + 1
        return counts

    def test_cells_for_the_topology_are_in_the_legend(self):
        """A cube of 3 voxels has no sheet for a thickness of 8, but one cell for its topology."""
        yellow = (255, 200, 40)
        volume = volumes.Volume((20, 20, 20), [])
        volume.voxels = [1 if max(abs(c - 10) for c in index) <= 1 else 0 for index in volume.indices()]
        self.assertNotIn(yellow, self.colors(self.preview(volume, thickness="8vx")))
        rows = self.preview(volume, "--same-topology", thickness="8vx")
        self.assertIn(yellow, self.colors(rows[-15:]))
        self.assertIn(yellow, self.colors(rows[: len(rows) // 2]))

    def test_colors_of_three_slices(self):
        volume = volumes.box_with_plate()
        colors = self.colors(self.preview(volume, "--lower", 72))
        for color in (BLACK, RED, GRAY):
            self.assertGreater(colors[color], 1000)
        self.assertGreater(self.colors(self.preview(rough_shell()))[RED], 1000)

    def test_projection_and_scale_bar(self):
        """A plate across z lies in one slice, and fills the projection along z wherever that slice is."""
        volume = volumes.Volume((60, 60, 40), [], (0.5, 0.5, 0.5))
        volume.voxels = [1 if 4 <= z < 7 and x >= 30 and 5 <= y < 55 else 0 for x, y, z in volume.indices()]
        rows = self.preview(volume, thickness="3vx")
        scale = 8
        top = 14 + 20
        left, right = 14, 14 + 60 * scale + 14
        middle = rows[top + 30 * scale]
        self.assertEqual(middle[right + 45 * scale], RED, "medial cells of the plate, the most that a ray has")
        self.assertEqual(middle[right + 10 * scale], BLACK)
        self.assertEqual(middle[left + 10 * scale], BLACK)
        # The bar has ticks at its ends and is 1, 2 or 5 times a power of ten long.
        legend = rows[len(rows) - 14 - 14 + 7]
        text = (200, 200, 205)
        runs = [run for run in "".join("#" if color == text else " " for color in legend).split() if len(run) > 40]
        self.assertEqual([len(run) for run in runs], [5 / 0.5 * scale])

    def test_the_legend_is_not_cut(self):
        """Narrow volumes of any spacing, whose pictures are as wide as the legend."""
        for spacing in (1e-7, 2e-5, 0.0003, 0.07, 1, 30, 12345, 1e6):
            volume = volumes.Volume((6, 5, 4), [1] * 120, (spacing,) * 3)
            for options in ([], ["--thickness-map", "t.mha"]):
                rows = self.preview(volume, *options, thickness="3vx")
                legend = rows[len(rows) - 14 - 14 : len(rows) - 14]
                self.assertTrue(all(color == BLACK for row in legend for color in row[-14:]), (spacing, options))

    def test_pieces_do_not_change_the_picture(self):
        volume = volumes.box_with_plate()
        whole = self.preview(volume, "--lower", 72)
        self.assertEqual(self.preview(volume, "--lower", 72, "--divisions", 5), whole)

    def test_spacing_sets_the_proportions(self):
        """A cube of 10 mm from flat voxels: all views are squares, and the object fills the middle of each."""
        volume = volumes.Volume((40, 40, 10), [], (0.25, 0.25, 1.0))
        volume.voxels = [1 if 10 <= x < 30 and 10 <= y < 30 else 0 for x, y, z in volume.indices()]
        rows = self.preview(volume)
        first = next(y for y, row in enumerate(rows) if GRAY in row)
        heights = [sum(1 for row in rows if row[x] in (GRAY, RED)) for x in range(len(rows[0]))]
        tall = [x for x, height in enumerate(heights) if height > 100]
        self.assertTrue(tall)
        self.assertLess(first, len(rows) // 2)
        self.assertLessEqual(max(len(rows), len(rows[0])), 1600)

    def test_very_different_lengths(self):
        for size in ((1, 1, 1), (3, 2, 1), (2000, 3, 2), (2, 3, 2000)):
            volume = volumes.Volume(size, [])
            volume.voxels = [1 if sum(index) % 5 else 0 for index in volume.indices()]
            rows = self.preview(volume)
            self.assertLessEqual(len(rows), 1700, size)
            self.assertLessEqual(len(rows[0]), 1700, size)

    def test_slices_cross_the_sheet(self):
        """A plate that lies in a slice of z is shown by the slices that cut it, not as a blot alone."""
        volume = volumes.Volume((40, 40, 40), [])
        volume.voxels = [1 if 18 <= z < 22 or 30 <= x < 34 and z > 4 else 0 for x, y, z in volume.indices()]
        colors = self.colors(self.preview(volume))
        self.assertLess(colors[RED], colors[GRAY])


if __name__ == "__main__":
    unittest.main()
