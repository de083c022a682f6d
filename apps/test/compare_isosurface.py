# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Compares a surface with that of VTK: compare_isosurface.py SURFACE.vtp VOLUME.mha THRESHOLD, as JSON."""

import json
import sys

import vtk


def measure(surface):
    mass = vtk.vtkMassProperties()
    mass.SetInputData(surface)
    mass.Update()
    return {"points": surface.GetNumberOfPoints(), "faces": surface.GetNumberOfPolys(), "area": mass.GetSurfaceArea()}


def main():
    ours, volume, threshold = sys.argv[1:]
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(ours)
    reader.Update()
    image = vtk.vtkMetaImageReader()
    image.SetFileName(volume)
    contour = vtk.vtkFlyingEdges3D()
    contour.SetInputConnection(image.GetOutputPort())
    contour.SetValue(0, float(threshold))
    contour.Update()
    distance = vtk.vtkHausdorffDistancePointSetFilter()
    distance.SetInputData(0, reader.GetOutput())
    distance.SetInputData(1, contour.GetOutput())
    distance.SetTargetDistanceMethodToPointToCell()
    distance.Update()
    result = {"ours": measure(reader.GetOutput()), "vtk": measure(contour.GetOutput())}
    print(json.dumps(result | {"distance": distance.GetHausdorffDistance()}))


if __name__ == "__main__":
    main()
