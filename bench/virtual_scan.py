# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A scan without projections: the mean of the blurred part over each voxel, and noise. Lengths are voxels.

The blur is a Gaussian on top of the mean over the voxel, which has a standard deviation of 1/sqrt(12) along each axis.
"""

import numpy as np
from scipy import ndimage

CONTRAST = 1000
BACKGROUND = 3000
THRESHOLD = BACKGROUND + CONTRAST // 2
DIVISION = 2
CORRELATION = 0.7


def blur(fine, sigma, division=DIVISION):
    """Mean over each voxel of the blurred share; on divided voxels a sampled Gaussian has the stated width."""
    if sigma:
        fine = ndimage.gaussian_filter(fine, sigma * division, mode="nearest", truncate=5)
    z, y, x = (n // division for n in fine.shape)
    return fine.reshape(z, division, y, division, x, division).mean(axis=(1, 3, 5))


def make_noise(shape, deviation, is_correlated, random):
    """White, or white smoothed by a Gaussian of 0.7 voxels, with the same standard deviation."""
    if not is_correlated:
        return deviation * random.standard_normal(shape)
    pad = 4
    noise = ndimage.gaussian_filter(random.standard_normal([n + 2 * pad for n in shape]), CORRELATION)
    impulse = np.zeros((4 * pad + 1,) * 3)
    impulse[2 * pad, 2 * pad, 2 * pad] = 1
    gain = np.sqrt((ndimage.gaussian_filter(impulse, CORRELATION) ** 2).sum())
    return deviation / gain * noise[pad:-pad, pad:-pad, pad:-pad]


def digitize(values):
    """Gray values of 16 bits; background at 3000, material at 4000."""
    return np.clip(np.rint(BACKGROUND + CONTRAST * values), 0, 65535).astype(np.uint16)
