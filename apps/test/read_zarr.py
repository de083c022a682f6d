# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Reads an OME-Zarr image with a library of others; prints scale and translation, writes the voxels, x fastest.

Usage: read_zarr.py zarr|ngff_zarr FOLDER DATA.raw
"""

import json
import sys

import numpy


def read_with_zarr(folder):
    import zarr

    group = zarr.open_group(folder, mode="r")
    dataset = group.attrs["multiscales"][0]["datasets"][0]
    transforms = {transform["type"]: transform[transform["type"]] for transform in dataset["coordinateTransformations"]}
    return numpy.asarray(group[dataset["path"]]), transforms["scale"], transforms["translation"]


def read_with_ngff_zarr(folder):
    import ngff_zarr

    image = ngff_zarr.from_ngff_zarr(folder, validate=True, version="0.4").images[0]
    scale, translation = ([values[name] for name in "zyx"] for values in (image.scale, image.translation))
    return numpy.asarray(image.data), scale, translation


module, source, target = sys.argv[1:]
voxels, scale, translation = {"zarr": read_with_zarr, "ngff_zarr": read_with_ngff_zarr}[module](source)
if voxels.ndim == 4:
    voxels = numpy.moveaxis(voxels, 0, -1)
numpy.ascontiguousarray(voxels).tofile(target)
print(json.dumps({"scale": list(scale), "translation": list(translation)}))
