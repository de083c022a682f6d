#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs one peer on one volume, in the interpreter that has it; prints one line of JSON.

Usage: bench/peers.py NAME                      the version of the peer; status 1 when it cannot be imported
       bench/peers.py NAME VOLUME X,Y,Z         seconds of the call alone; VOLUME: headerless, bytes, object is not 0
"""

import importlib.metadata
import json
import sys
import time


def load_scipy():
    import scipy
    from scipy import ndimage

    def transform(mask):
        ndimage.distance_transform_edt(mask, return_distances=False, return_indices=True)

    return scipy.__version__, transform


def load_vigra():
    import numpy
    import vigra

    def transform(mask):
        vigra.filters.vectorDistanceTransform(mask.astype(numpy.uint32), background=False)

    return vigra.version, transform


def load_skimage():
    import skimage
    from skimage import morphology

    def skeletonize(mask):
        morphology.skeletonize(mask, method="lee")

    return skimage.__version__, skeletonize


def load_edt():
    import edt

    def transform(mask):
        edt.edt(mask, parallel=1)

    return importlib.metadata.version("edt"), transform


def load_thickness3d():
    import itk

    filter_type = itk.BinaryThinningImageFilter3D
    itk.MultiThreaderBase.SetGlobalDefaultNumberOfThreads(1)

    def skeletonize(mask):
        image = itk.image_view_from_array(mask)
        thinning = filter_type[type(image), type(image)].New(image)
        thinning.Update()

    return importlib.metadata.version("itk-thickness3d"), skeletonize


PEERS = {
    "scipy": load_scipy,
    "vigra": load_vigra,
    "skimage": load_skimage,
    "edt": load_edt,
    "itk-thickness3d": load_thickness3d,
}


def main():
    name, *rest = sys.argv[1:]
    try:
        version, call = PEERS[name]()
    except (ImportError, AttributeError) as error:
        sys.exit(f"peers.py: {name}: {error}")
    if not rest:
        print(json.dumps({"version": version}))
        return
    import numpy

    x, y, z = (int(number) for number in rest[1].split(","))
    mask = (numpy.fromfile(rest[0], numpy.uint8) != 0).view(numpy.uint8).reshape(z, y, x)
    start, clock = time.perf_counter(), time.process_time()
    call(mask)
    print(json.dumps({"call_seconds": time.perf_counter() - start, "call_cpu_seconds": time.process_time() - clock}))


if __name__ == "__main__":
    main()
