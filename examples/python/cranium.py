#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The bone of a skull in millimeters: medial cells of thin bone, and where bone is thin.

Usage: cranium.py VOLUME PICTURE     VOLUME: a CT of a head in Hounsfield units, with its spacing in millimeters
Needs itk-medialvoxel, matplotlib, scipy.
"""

import sys

import itk
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy import ndimage

LOWER = 200  # Hounsfield units from which on a voxel is bone
THICKNESS = 3.0  # millimeters


def extract(image):
    """Labels of the dual cells, and the distance of each voxel to the nearest background voxel in millimeters."""
    medial = itk.MedialVoxelImageFilter.New(
        image,
        lower_threshold=LOWER,
        thickness=THICKNESS,
        generate_vector_distance=True,
        vector_distance_boundary=itk.MedialVoxelEnums.Boundary_Background,
    )
    medial.Update()
    vectors = itk.array_view_from_image(medial.GetVectorDistanceOutput())
    return itk.array_from_image(medial.GetOutput()), np.linalg.norm(vectors, axis=-1)


def thickness_at_cells(labels, distance, spacing):
    """Twice the largest distance at the corners of each medial cell, less the voxel that both sides have too much."""
    # Cell and corners: the voxels at its index and one further along each axis.
    nearest = ndimage.maximum_filter(distance, size=2, origin=-1)
    return 2 * nearest[labels >= 2] - np.mean(spacing)


def draw(grey, labels, thickness, spacing, path):
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.4), layout="constrained")
    middle = [size // 2 for size in grey.shape]
    for axis, (name, cut) in enumerate({"axial": middle[0], "coronal": middle[1]}.items()):
        section = np.take(grey, cut, axis=axis)
        medial = np.ma.masked_less(np.take(labels, cut, axis=axis), 2)
        rows, columns = section.shape
        height = rows * (spacing[1] if axis == 0 else spacing[2])
        extent = (0, columns * spacing[0], height, 0) if axis == 0 else (0, columns * spacing[0], 0, height)
        origin = "upper" if axis == 0 else "lower"
        axes[axis].imshow(section, cmap="gray", vmin=-200, vmax=1500, extent=extent, origin=origin)
        axes[axis].imshow(medial, cmap="autumn_r", vmin=2, vmax=3, extent=extent, origin=origin, interpolation="nearest")
        axes[axis].set(title=f"Medial cells, {name}", xlabel="mm")
    axes[2].hist(thickness, bins=np.arange(0, 15, 0.5), color="#3d6fc8")
    median = np.median(thickness)
    axes[2].axvline(median, color="black", linewidth=1)
    axes[2].set(title=f"Thickness at the medial cells, median {median:.1f} mm", xlabel="mm", ylabel="cells")
    figure.savefig(path, dpi=80)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    image = itk.imread(sys.argv[1], itk.SS)
    spacing = list(image.GetSpacing())
    labels, distance = extract(image)
    thickness = thickness_at_cells(labels, distance, spacing)
    print(f"medial cells {len(thickness)}, thickness {np.percentile(thickness, [10, 50, 90]).round(2)} mm (10, 50, 90 %)")
    draw(itk.array_view_from_image(image), labels, thickness, spacing, sys.argv[2])


if __name__ == "__main__":
    main()
