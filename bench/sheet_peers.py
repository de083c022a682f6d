#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the skeleton and thickness of one peer on one volume; prints one line of JSON.

Usage: bench/sheet_peers.py NAME VOLUME X,Y,Z OUTPUT
       VOLUME: headerless bytes, object is not 0; OUTPUT: headerless float32, thickness at the skeleton, elsewhere NaN
"""

import importlib.metadata
import json
import sys
import time

import numpy


def run_thickness3d(mask):
    """ITKThickness3D: the thickness filter, which thins too; and the thinning again, to know where the skeleton is."""
    import itk

    itk.MultiThreaderBase.SetGlobalDefaultNumberOfThreads(1)
    image = itk.image_view_from_array(mask)
    # Naming a filter loads its library, which is not part of the call.
    medial = itk.MedialThicknessImageFilter3D[type(image), itk.Image[itk.F, 3]].New(image)
    thinning = itk.BinaryThinningImageFilter3D[type(image), type(image)].New(image)
    clock = time.process_time()
    medial.Update()
    seconds = time.process_time() - clock
    thinning.Update()
    skeleton = itk.array_from_image(thinning.GetOutput()) != 0
    return skeleton, itk.array_from_image(medial.GetOutput()), seconds, importlib.metadata.version("itk-thickness3d")


def run_skimage(mask):
    """scikit-image: Lee's skeleton, with twice the distance to the background as thickness."""
    import skimage
    from scipy import ndimage
    from skimage import morphology

    clock = time.process_time()
    skeleton = morphology.skeletonize(mask, method="lee") != 0
    thickness = 2 * ndimage.distance_transform_edt(mask)
    return skeleton, thickness, time.process_time() - clock, skimage.__version__


def run_three_axes(mask):
    """scikit-image: the 2-D skeletons of the slices along each axis, put together; thickness as above."""
    import skimage
    from scipy import ndimage
    from skimage import morphology

    clock = time.process_time()
    skeleton = numpy.zeros(mask.shape, bool)
    for axis in range(3):
        slices, result = numpy.moveaxis(mask, axis, 0), numpy.moveaxis(skeleton, axis, 0)
        for k, part in enumerate(slices):
            result[k] |= morphology.skeletonize(part)
    thickness = 2 * ndimage.distance_transform_edt(mask)
    return skeleton, thickness, time.process_time() - clock, skimage.__version__


RUNS = {"itk-thickness3d": run_thickness3d, "skimage": run_skimage, "three-axes": run_three_axes}


def main():
    name, volume, size, output = sys.argv[1:]
    x, y, z = (int(number) for number in size.split(","))
    mask = (numpy.fromfile(volume, numpy.uint8) != 0).view(numpy.uint8).reshape(z, y, x)
    skeleton, thickness, seconds, version = RUNS[name](mask)
    numpy.where(skeleton, thickness, numpy.nan).astype(numpy.float32).tofile(output)
    print(json.dumps({"call_cpu_seconds": seconds, "version": version}))


if __name__ == "__main__":
    main()
