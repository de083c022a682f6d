# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""How results look in the views of 3D Slicer."""

import numpy as np
import slicer
import vtk
from vtk.util.numpy_support import vtk_to_numpy

THICKNESS_COLORS = "vtkMRMLColorTableNodeFileViridis.txt"
# As in MedialVoxel.ctbl, the color table of the command line module.
LABELS = (
    ("no_object", 0, 0, 0, 0),
    ("not_medial", 95, 95, 100, 255),
    ("medial_by_bound", 255, 255, 255, 255),
    ("medial_by_geodesic", 255, 45, 35, 255),
    ("added_for_topology", 255, 200, 40, 255),
)
LABELS_NAME = "Medial voxels"


def label_colors():
    """The color table of the labels; made once in a scene."""
    node = slicer.mrmlScene.GetFirstNode(LABELS_NAME, "vtkMRMLColorTableNode")
    if node:
        return node
    node = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLColorTableNode", LABELS_NAME)
    node.SetTypeToUser()
    node.SetNumberOfColors(len(LABELS))
    for label, (name, *color) in enumerate(LABELS):
        node.SetColor(label, name, *(value / 255 for value in color))
    return node


def show_labels(labels):
    """The label map over the slices."""
    labels.CreateDefaultDisplayNodes()
    labels.GetDisplayNode().SetAndObserveColorNodeID(label_colors().GetID())
    slicer.util.setSliceViewerLayers(label=labels, labelOpacity=0.7)


def show_model(model):
    """The model, colored by its thickness from the 1st to the 99th percentile, with a color legend."""
    model.CreateDefaultDisplayNodes()
    display = model.GetDisplayNode()
    display.SetActiveScalar("Thickness", vtk.vtkAssignAttribute.POINT_DATA)
    display.SetAndObserveColorNodeID(THICKNESS_COLORS)
    display.SetScalarRangeFlag(display.UseManualScalarRange)
    display.SetScalarRange(*thickness_range(model.GetPolyData()))
    display.SetScalarVisibility(True)
    display.SetBackfaceCulling(False)
    display.SetVisibility2D(True)
    legend = slicer.modules.colors.logic().AddDefaultColorLegendDisplayNode(model)
    legend.SetTitleText("Thickness (mm)")
    slicer.util.resetThreeDViews()


def thickness_range(surface):
    """Two different thicknesses between which nearly all of a surface are; a few outliers would take all colors."""
    thickness = surface.GetPointData().GetArray("Thickness")
    if not thickness or not thickness.GetNumberOfTuples():
        return 0.0, 1.0
    low, high = map(float, np.percentile(vtk_to_numpy(thickness), (1, 99)))
    return (low, high) if low < high else (low, low + 1.0)


def center_views(point):
    """Centers slices and 3-D views at a point (r, a, s)."""
    slicer.modules.markups.logic().JumpSlicesToLocation(*point, True)
    layout = slicer.app.layoutManager()
    for number in range(layout.threeDViewCount):
        view = layout.threeDWidget(number).threeDView()
        camera = slicer.modules.cameras.logic().GetViewActiveCameraNode(view.mrmlViewNode())
        if camera:
            camera.SetFocalPoint(*point)
            camera.ResetClippingRange()
