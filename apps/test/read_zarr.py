# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads an OME-Zarr image with a library of others; prints scale, translation and levels, writes the voxels, x fastest.

Smaller levels must have the largest voxel of each block of the level before.
Usage: read_zarr.py zarr|ngff_zarr|ome_zarr_models FOLDER DATA.raw
"""

import json
import sys

import numpy


def read_with_zarr(folder):
    import zarr

    group = zarr.open_group(folder, mode="r")
    datasets = group.attrs["multiscales"][0]["datasets"]
    transforms = {transform["type"]: transform[transform["type"]] for transform in datasets[0]["coordinateTransformations"]}
    levels = [numpy.asarray(group[dataset["path"]]) for dataset in datasets]
    return levels, transforms["scale"], transforms["translation"]


def read_with_ome_zarr_models(folder):
    import ome_zarr_models
    import zarr

    image = ome_zarr_models.open_ome_zarr(zarr.open_group(folder, mode="r"))
    assert image.ome_zarr_version == "0.4", image.ome_zarr_version
    return read_with_zarr(folder)


def read_with_ngff_zarr(folder):
    import ngff_zarr

    images = ngff_zarr.from_ngff_zarr(folder, validate=True, version="0.4").images
    scale, translation = ([values[name] for name in "zyx"] for values in (images[0].scale, images[0].translation))
    return [numpy.asarray(image.data) for image in images], scale, translation


def check_levels(levels):
    for large, small in zip(levels, levels[1:]):
        padded = numpy.pad(large, [(0, length % 2) for length in large.shape])
        z, y, x = (length // 2 for length in padded.shape)
        assert (padded.reshape(z, 2, y, 2, x, 2).max((1, 3, 5)) == small).all(), small.shape


module, source, target = sys.argv[1:]
read = {"zarr": read_with_zarr, "ngff_zarr": read_with_ngff_zarr, "ome_zarr_models": read_with_ome_zarr_models}[module]
levels, scale, translation = read(source)
check_levels(levels)
voxels = levels[0]
if voxels.ndim == 4:
    voxels = numpy.moveaxis(voxels, 0, -1)
numpy.ascontiguousarray(voxels).tofile(target)
print(json.dumps({"scale": list(scale), "translation": list(translation), "levels": len(levels)}))
