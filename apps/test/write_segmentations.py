# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes segmentations with slicerio, and prints as JSON what it reads from one.

Usage: write_segmentations.py write FOLDER     one.seg.nrrd, and layers.seg.nrrd with segments that overlap
       write_segmentations.py read FILE
"""

import json
import pathlib
import sys

import numpy
import slicerio

SHAPE = (24, 20, 18)


def make_segments():
    """Two plates side by side, and a box across both."""
    masks = [numpy.zeros(SHAPE, bool) for _ in range(3)]
    masks[0][2:6, 2:18, 2:16] = True
    masks[1][6:14, 2:18, 2:16] = True
    masks[2][4:10, 4:10, 4:10] = True
    return masks


def terminology(code, meaning):
    return {
        "contextName": "Segmentation category and type - 3D Slicer General Anatomy list",
        "category": ["SCT", "123037004", "Anatomical Structure"],
        "type": ["SCT", code, meaning],
    }


def write(folder):
    left, right, across = make_segments()
    matrix = numpy.diag([0.5, 0.5, 0.75, 1.0])
    matrix[:3, 3] = (10, -20, 30)
    voxels = numpy.zeros(SHAPE, "uint8")
    voxels[left], voxels[right] = 3, 7
    segments = [
        {"id": "Segment_2", "labelValue": 7, "layer": 0, "name": 'right <b>"rib"</b> & more', "color": [1, 0.5, 0.25]},
        {"id": "Segment_1", "labelValue": 3, "layer": 0, "name": "left rib", "color": [0.25, 0.75, 0]},
    ]
    segments[1]["terminology"] = terminology("113197003", "Rib")
    segmentation = {"voxels": voxels, "ijkToLPS": matrix, "segments": segments}
    slicerio.write_segmentation(str(folder / "one.seg.nrrd"), segmentation)
    layers = numpy.stack([voxels, across.astype("uint8")])
    third = {"id": "Segment_3", "labelValue": 1, "layer": 1, "name": "across", "color": [0, 0, 1]}
    overlapping = {"voxels": layers, "ijkToLPS": matrix, "segments": [*segments, third]}
    slicerio.write_segmentation(str(folder / "layers.seg.nrrd"), overlapping)


def read(path):
    segmentation = slicerio.read_segmentation(str(path))
    voxels = segmentation["voxels"]
    values = {int(value): int(count) for value, count in zip(*numpy.unique(voxels, return_counts=True))}
    masks = {segment["name"]: int((voxels == segment["labelValue"]).sum()) for segment in segmentation["segments"]}
    return {
        "segments": segmentation["segments"],
        "values": values,
        "masks": masks,
        "shape": voxels.shape,
        "matrix": segmentation["ijkToLPS"].tolist(),
        "representation": segmentation["masterRepresentation"],
        "representations": segmentation.get("containedRepresentationNames"),
        "offset": segmentation["referenceImageExtentOffset"],
    }


if sys.argv[1] == "write":
    write(pathlib.Path(sys.argv[2]))
else:
    print(json.dumps(read(sys.argv[2])))
