#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""An engine block from an industrial CT: its medial voxels, looked at, and how far walls are from their middle.

Usage: engine_block.py VOLUME PICTURE     VOLUME: the engine block, 256 x 256 x 110 (.mha, or headerless uint8)
Needs itk-medialvoxel, matplotlib.
"""

import sys

import itk
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

LOWER = 72  # the smallest grey value of metal
THICKNESS = 3.0  # of the walls that are to become sheets, in voxels
SECTION = 55  # the slice that is shown


def read(path):
    """The engine block as an image, also from the headerless file that is passed around."""
    if path.endswith(".mha"):
        return itk.imread(path, itk.UC)
    image_io = itk.StreamingRawImageIO.New(component_type=itk.CommonEnums.IOComponent_UCHAR, number_of_dimensions=3)
    for axis, size in enumerate((256, 256, 110)):
        image_io.SetDimensions(axis, size)
    return itk.imread(path, itk.UC, imageio=image_io)


def extract(image):
    """Labels of the dual cells, and at each voxel the distance to the nearest background voxel at the border."""
    medial = itk.MedialVoxelImageFilter.New(
        image,
        lower_threshold=LOWER,
        thickness=THICKNESS,
        use_image_spacing=False,
        generate_vector_distance=True,
        vector_distance_boundary=itk.MedialVoxelEnums.Boundary_Background,
    )
    medial.Update()
    counts = medial.GetCounts()
    print(f"object voxels          {counts.objectVoxels:10}")
    print(f"medial by bound        {counts.boundCells:10}")
    print(f"medial by search       {counts.geodesicMedialCells:10}")
    vectors = itk.array_view_from_image(medial.GetVectorDistanceOutput())
    return itk.array_from_image(medial.GetOutput()), np.linalg.norm(vectors, axis=-1)


def draw(grey, labels, distance, path):
    figure, (section, histogram) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    section.imshow(grey[SECTION], cmap="gray", vmin=0, vmax=255)
    medial = np.ma.masked_less(labels[SECTION], 2)
    # A cell is half a voxel above the index that it is stored at.
    rows, columns = medial.shape
    section.imshow(medial, cmap="autumn_r", vmin=2, vmax=3, extent=(0, columns, rows, 0), interpolation="nearest")
    section.set(title=f"Medial cells in slice {SECTION}", xticks=[], yticks=[])
    histogram.hist(distance[labels >= 2], bins=np.arange(0.75, 8.25, 0.25), color="#c8553d")
    histogram.set(
        title="Distance from the medial cells to the background",
        xlabel="voxels",
        ylabel="cells",
    )
    figure.savefig(path, dpi=80)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    image = read(sys.argv[1])
    labels, distance = extract(image)
    draw(itk.array_view_from_image(image), labels, distance, sys.argv[2])


if __name__ == "__main__":
    main()
