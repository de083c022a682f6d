# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Volumes to try the plugin with; made, not downloaded."""

import numpy as np

SIZE = 96
OBJECT = 180
NOISE = 20


def _as_scan(distance, seed):
    """Gray values of a CT volume, from the distance to the surface of the part, negative inside: blur and noise."""
    share = np.clip(0.5 - distance, 0, 1)
    values = OBJECT * share + NOISE * (1 + np.random.default_rng(seed).standard_normal(distance.shape))
    return np.clip(values, 0, 255).astype(np.uint8)


def scroll():
    """A sheet of 4 voxels, rolled up three times with a pitch of 10: no winding touches another."""
    z, y, x = np.mgrid[:SIZE, :SIZE, :SIZE].astype(np.float32) - SIZE / 2
    windings = np.hypot(y, x) / 10 - np.arctan2(y, x) / (2 * np.pi)
    distance = np.abs(windings % 1 - 0.5) * 10 - 2
    outside = (windings < 1) | (windings > 4) | (np.abs(z) > 38)
    return [(_as_scan(np.where(outside, 9, distance), 1), {"name": "rolled sheet"}, "image")]


def ribs():
    """Ribs of 3, 4, 6 and 8 voxels on a plate of 5."""
    z, y, x = np.mgrid[:64, :80, :112].astype(np.float32)
    distance = np.maximum.reduce([np.abs(z - 12) - 2.5, np.abs(y - 40) - 32, np.abs(x - 56) - 50])
    for center, wall in zip((18, 40, 66, 94), (3, 4, 6, 8)):
        rib = np.maximum.reduce([np.abs(x - center) - wall / 2, np.abs(y - 40) - 32, np.abs(z - 32) - 22])
        distance = np.minimum(distance, rib)
    return [(_as_scan(distance, 2), {"name": "ribs", "scale": (0.1, 0.1, 0.1)}, "image")]
