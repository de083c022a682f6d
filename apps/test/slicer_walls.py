# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Tests of the module MedialVoxelWalls with stand-ins for 3D Slicer. test_slicer_walls.py runs them where VTK is.

Runs of the command line module are real: what 3D Slicer would pass is passed, and its files are read with VTK.
"""

import collections
import pathlib
import subprocess
import sys
import unittest

import numpy as np
import slicer_stand_in as stand_in
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

import volumes
from program import ProgramTestCase
from slicer_module import MODULE, Description
from slicer_stand_in import CALLS, STATUS, StandIn

MODULE_FOLDER = pathlib.Path(__file__).resolve().parents[1] / "MedialVoxelWalls"
RUNS = []
slicer = stand_in.install(lambda node, parameters: RUNS.append((node, parameters)))
sys.path.insert(0, str(MODULE_FOLDER))

import MedialVoxelWalls as walls_module  # noqa: E402
from MedialVoxelWallsLib import display, settings, walls  # noqa: E402


def read_surface(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def image_of(values):
    """An image of VTK with the range of the values."""
    image = vtk.vtkImageData()
    image.SetDimensions(*values.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
    return image


def write(path, values):
    volumes.write_meta(path, volumes.Volume(values.shape[::-1], values.ravel().tolist()))


def surface_of(points, faces, thickness, areas, junctions):
    """A surface of quadrilaterals as the module writes it."""
    surface, cells, corners = vtk.vtkPolyData(), vtk.vtkCellArray(), vtk.vtkPoints()
    corners.SetData(numpy_to_vtk(np.asarray(points, float), deep=True))
    surface.SetPoints(corners)
    flat = np.asarray(faces, np.int64)
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.arange(0, flat.size + 1, 4, dtype=np.int64), deep=True),
        numpy_to_vtkIdTypeArray(flat.ravel(), deep=True),
    )
    surface.SetPolys(cells)
    for data, name, values in (
        (surface.GetPointData(), "Thickness", np.asarray(thickness, np.float32)),
        (surface.GetCellData(), "Area", np.asarray(areas, np.float32)),
        (surface.GetCellData(), "JunctionEdges", np.asarray(junctions, np.uint8)),
    ):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.AddArray(array)
    return surface


def t_shape():
    """Two voxel walls of 4 and 6 that meet, with a plate."""
    volume = np.zeros((40, 60, 60), np.uint8)
    volume[10:14, 8:52, 8:52] = 200
    volume[14:36, 8:52, 20:26] = 200
    return volume


class SettingsTest(unittest.TestCase):
    def test_objects(self):
        for limits, expected in (
            ({}, {"objectSelection": "NonZero"}),
            ({"lower": 3}, {"objectSelection": "AboveLower", "lowerThreshold": 3.0}),
            ({"upper": 9}, {"objectSelection": "BelowUpper", "upperThreshold": 9.0}),
            ({"lower": 3, "upper": 9}, {"objectSelection": "Between", "lowerThreshold": 3.0, "upperThreshold": 9.0}),
        ):
            self.assertEqual(settings.selection(settings.Settings(**limits)), expected)

    def test_what_cannot_run_is_refused(self):
        for wrong, part in (
            ({"lower": 5.0, "upper": 4.0}, "lower threshold 5"),
            ({"lower": float("nan")}, "nan"),
            ({"thickness": 0.0}, "thickness is 0 mm"),
            ({"thickness": -1.0}, "thickness is -1 mm"),
            ({"branches": -1.0}, "branch length is -1 mm"),
        ):
            with self.assertRaisesRegex(ValueError, part):
                settings.Settings(**wrong).check()

    def test_the_command_line_module_has_the_parameters(self):
        description = Description()
        known = {element.findtext("name"): element for element in description.root.iter() if element.find("name") is not None}
        for chosen in (settings.Settings(), settings.Settings(1, 2, 3, 4), settings.Settings(upper=2)):
            given = settings.module_parameters(chosen, "v", "l", "m", "r")
            self.assertLessEqual(set(given), set(known))
            for name, value in given.items():
                elements = [element.text for element in known[name].findall("element")]
                self.assertTrue(not elements or value in elements, f"{name}: {value}")

    def test_the_labels_have_the_colors_of_the_color_table(self):
        table = (MODULE_FOLDER.parent / "MedialVoxelExtraction/MedialVoxel.ctbl").read_text().splitlines()
        rows = [line.split() for line in table if not line.startswith("#")]
        self.assertEqual([(row[1], *map(int, row[2:])) for row in rows], list(display.LABELS))


class WallsTest(unittest.TestCase):
    def test_three_walls_at_a_junction(self):
        """Three faces at one side, which is marked as a junction in each."""
        points = [(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, 1, 0), (0, 0, 1), (0, 1, 1), (2, 0, 0), (2, 1, 0)]
        faces = [(0, 1, 3, 2), (0, 1, 5, 4), (6, 7, 1, 0), (2, 3, 9, 8)]
        found = walls.walls_of(
            surface_of(points, faces, [3, 3, 5, 5, 1, 2, 4, 4, 7, 7], [1, 1, 1, 1], [1, 1, 4, 0])
        )
        self.assertEqual([wall.area for wall in found], [2, 1, 1])
        self.assertEqual([(wall.minimum, wall.mean, wall.maximum) for wall in found], [(3, 5, 7), (1, 2.25, 3), (3, 3.5, 4)])
        self.assertEqual(found[1].thinnest, (-1, 0, 0))

    def test_like_a_flood(self):
        """The same walls as a flood face by face over sides that are no junctions."""
        rng = np.random.default_rng(5)
        size = 30
        number = np.arange((size + 1) ** 2).reshape(size + 1, size + 1)
        faces = np.stack((number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]), axis=-1).reshape(-1, 4)
        faces = faces[rng.random(len(faces)) < 0.8]
        cut = collections.defaultdict(lambda: rng.random() < 0.3)
        sides = [[tuple(sorted((face[k], face[(k + 1) % 4]))) for k in range(4)] for face in faces.tolist()]
        junctions = [sum(1 << k for k in range(4) if cut[row[k]]) for row in sides]
        thickness = rng.random(number.size).astype(np.float32)
        points = np.stack((np.repeat(np.arange(size + 1), size + 1), np.tile(np.arange(size + 1), size + 1), 0 * number.ravel()), 1)
        found = walls.walls_of(surface_of(points, faces, thickness, np.ones(len(faces)), junctions), most=10**6)
        beside = collections.defaultdict(list)
        for face, row in enumerate(sides):
            for side in row:
                if not cut[side]:
                    beside[side].append(face)
        left, expected = set(range(len(faces))), []
        while left:
            todo, part = [left.pop()], []
            while todo:
                part.append(todo.pop())
                following = {face for side in sides[part[-1]] for face in beside[side]} & left
                left -= following
                todo += following
            corners = thickness[faces[part]]
            expected.append((len(part), float(corners.min()), round(float(corners.mean()), 5), float(corners.max())))
        self.assertGreater(len(expected), 20)
        self.assertEqual(sorted((wall.area, wall.minimum, round(wall.mean, 5), wall.maximum) for wall in found), sorted(expected))
        self.assertEqual([wall.area for wall in found], sorted((wall.area for wall in found), reverse=True))
        for wall in found:
            self.assertIn(wall.minimum, thickness[(points == wall.thinnest).all(axis=1)])

    def test_small_and_many(self):
        grid = [(x, y, 0) for y in range(2) for x in range(6)]
        surface = surface_of(grid, [(k, k + 1, k + 7, k + 6) for k in (0, 2, 4)], [1] * 12, [3, 1, 2], [0] * 3)
        self.assertEqual([wall.area for wall in walls.walls_of(surface)], [3, 2, 1])
        self.assertEqual([wall.area for wall in walls.walls_of(surface, smallest=1.5)], [3, 2])
        self.assertEqual([wall.area for wall in walls.walls_of(surface, most=1)], [3])

    def test_without_what_it_needs(self):
        self.assertEqual(walls.walls_of(surface_of(np.zeros((0, 3)), [], [], [], [])), [])
        surface = surface_of([(0, 0, 0)] * 4, [(0, 1, 2, 3)], [1] * 4, [1], [0])
        surface.GetCellData().RemoveArray("JunctionEdges")
        with self.assertRaisesRegex(ValueError, "JunctionEdges"):
            walls.walls_of(surface)


class RunTest(ProgramTestCase):
    """The widget and its logic: what a user does, and what the application is told."""

    def setUp(self):
        super().setUp()
        RUNS.clear()
        CALLS.clear()
        slicer.mrmlScene.state.clear()
        write(self.folder / "in.mha", t_shape())
        self.widget = walls_module.MedialVoxelWallsWidget(StandIn("QWidget"))
        self.widget.setup()
        self.panel = self.widget.panel
        self.volume = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLScalarVolumeNode", "CT")
        self.volume.state.update(image=image_of(t_shape()), file=self.folder / "in.mha")
        self.panel.volume.state["node"] = self.volume
        self.panel.volume.emit("currentNodeChanged(vtkMRMLNode*)", self.volume)

    def press(self, button):
        button.emit("clicked()")

    def names(self):
        return [node.state["name"] for node in slicer.mrmlScene.state["nodes"]]

    def run_module(self):
        """Does what Slicer does with the last run: starts the module with its arguments, loads what it wrote."""
        node, parameters = RUNS[-1]
        outputs = {"outputVolume": self.folder / "out.mha", "meshModel": self.folder / "out.vtp"}
        words = []
        for name, value in parameters.items():
            if isinstance(value, StandIn):
                value = outputs.get(name) or value.state["file"]
            words += [str(value)] if name in ("inputVolume", "outputVolume") else [f"--{name}", str(value)]
        result = subprocess.run([MODULE, *words], capture_output=True, text=True, check=False)
        node.state["progress"] = 50
        stand_in.tell(node, status=STATUS["Running"])
        if result.returncode:
            stand_in.tell(node, errors=result.stderr, status=STATUS["CompletedWithErrors"])
            return
        parameters["meshModel"].state["surface"] = read_surface(outputs["meshModel"])
        stand_in.tell(node, status=STATUS["Completing"])
        stand_in.tell(node, status=STATUS["Completed"])

    def test_threshold_to_walls(self):
        self.assertTrue(self.panel.apply.enabled)
        self.assertEqual((self.panel.threshold.minimumValue, self.panel.threshold.maximum), (100, 200))
        self.press(self.panel.apply)
        self.assertFalse(self.panel.apply.enabled)
        self.assertTrue(self.panel.cancel.enabled)
        parameters = RUNS[0][1]
        self.assertEqual(parameters["objectSelection"], "AboveLower")
        self.assertEqual(parameters["thicknessMode"], "Automatic")
        self.run_module()
        self.assertTrue(self.panel.apply.enabled)
        self.assertRegex(self.panel.status.text, r"^[\d,]+ medial cells; walls [\d.]+ to [\d.]+ mm, mean [\d.]+ mm$")
        # Each plate that the rib divides, and the rib.
        rows = [self.panel.table.state["items"][row, 0] for row in range(3)]
        self.assertEqual(len(self.widget.walls), 3, rows)
        areas = [wall.area for wall in self.widget.walls]
        self.assertEqual(rows, [f"{area:.3g}" if area < 1000 else f"{area:.0f}" for area in areas])
        means = sorted(wall.mean for wall in self.widget.walls)
        self.assertAlmostEqual(means[0], 4, delta=0.3)
        self.assertAlmostEqual(means[2], 6, delta=0.3)
        self.assertEqual(self.names(), ["CT", "CT medial voxels", "CT walls", "run", "Medial voxels"])
        stand_in.do_later()
        self.assertNotIn("run", self.names())
        told = "\n".join(CALLS)
        for call in (
            "vtkMRMLModelDisplayNode.SetActiveScalar('Thickness', 0)",
            "vtkMRMLModelDisplayNode.SetAndObserveColorNodeID('vtkMRMLColorTableNodeFileViridis.txt')",
            "vtkSlicerColorLogic.AddDefaultColorLegendDisplayNode(CT walls)",
            "vtkMRMLColorLegendDisplayNode.SetTitleText('Thickness (mm)')",
            "slicer.util.setSliceViewerLayers(label=CT medial voxels, labelOpacity=0.7)",
        ):
            self.assertIn(call, told)

    def test_click_centers_the_views(self):
        self.press(self.panel.apply)
        self.run_module()
        self.panel.table.emit("cellClicked(int,int)", 1, 0)
        place = ", ".join(map(repr, self.widget.walls[1].thinnest))
        self.assertIn(f"vtkSlicerMarkupsLogic.JumpSlicesToLocation({place}, True)", CALLS)
        self.assertIn(f"vtkMRMLCameraNode.SetFocalPoint({place})", CALLS)

    def test_segment(self):
        """A segment becomes a label map with the geometry of the volume, which goes when the run has ended."""
        segmentation = StandIn("vtkMRMLSegmentationNode")
        mask = (t_shape() != 0).astype(np.uint8)
        write(self.folder / "segment.mha", mask)
        segmentation.state["segments"] = {"Segment_1": self.folder / "segment.mha"}
        self.panel.segment.state.update(node=segmentation, segment="Segment_1")
        self.panel.segment.emit("currentSegmentChanged(QString)", "Segment_1")
        self.assertFalse(self.panel.threshold.enabled)
        self.press(self.panel.apply)
        self.assertEqual(RUNS[0][1]["objectSelection"], "NonZero")
        self.assertIn("Segment", self.names())
        self.run_module()
        self.assertEqual(len(self.widget.walls), 3)
        self.assertNotIn("Segment", self.names())
        self.panel.segment.state["segment"] = "Segment_2"
        self.press(self.panel.apply)
        self.assertIn("message: The segment could not be converted to a label map.", CALLS)

    def test_cancel(self):
        self.press(self.panel.apply)
        self.press(self.panel.apply)
        self.assertIn("message: A run is under way.", CALLS)
        self.press(self.panel.cancel)
        self.assertEqual(self.panel.status.text, "Cancelling")
        stand_in.tell(RUNS[0][0], status=STATUS["Cancelled"])
        self.assertEqual(self.panel.status.text, "Canceled")
        self.assertEqual(self.names(), ["CT", "run"])
        self.assertEqual(RUNS[0][0].state["observers"], {})
        self.press(self.panel.apply)
        self.assertEqual(len(RUNS), 2)

    def test_errors_of_the_module(self):
        (self.folder / "in.mha").write_text("nothing")
        self.press(self.panel.apply)
        self.run_module()
        self.assertIn("in.mha", self.panel.status.text)
        self.assertEqual(self.names(), ["CT", "run"])
        self.assertEqual(self.widget.walls, [])

    def test_nothing_medial(self):
        write(self.folder / "in.mha", np.zeros((8, 8, 8), np.uint8))
        self.press(self.panel.apply)
        self.run_module()
        self.assertRegex(self.panel.status.text, "^0 medial cells|^Failed")
        self.assertTrue(self.panel.apply.enabled)

    def test_no_volume_no_module(self):
        self.panel.volume.state["node"] = None
        self.panel.volume.emit("currentNodeChanged(vtkMRMLNode*)", None)
        self.assertFalse(self.panel.apply.enabled)
        self.press(self.panel.apply)
        self.assertIn("message: Choose a volume.", CALLS)
        module = slicer.modules.medialvoxelextraction
        del slicer.modules.medialvoxelextraction
        self.addCleanup(setattr, slicer.modules, "medialvoxelextraction", module)
        self.panel.volume.state["node"] = self.volume
        self.press(self.panel.apply)
        self.assertIn("message: The module Medial Voxel Extraction is not installed.", CALLS)

    def test_scene_closes(self):
        self.press(self.panel.apply)
        slicer.mrmlScene.state["nodes"] = []
        self.widget.on_scene_closed(slicer.mrmlScene, None)
        stand_in.tell(RUNS[0][0], status=STATUS["Cancelled"])
        self.assertTrue(self.panel.apply.enabled)
        self.widget.cleanup()
        self.assertIn("VTKObservationMixin.removeObservers()", CALLS)

    def test_what_slicer_shows(self):
        parent = StandIn("qSlicerScriptedLoadableModule")
        walls_module.MedialVoxelWalls(parent)
        self.assertEqual(parent.title, "Medial Voxel Walls")
        self.assertIn("MedialVoxelExtraction", parent.dependencies)


class StandInTest(unittest.TestCase):
    """The stand-ins refuse what 3D Slicer does not have."""

    def test_unknown_names(self):
        node = StandIn("vtkMRMLModelDisplayNode")
        for action in (
            lambda: node.SetThickness(1),
            lambda: StandIn("vtkMRMLWallNode"),
            lambda: StandIn("QPushButton").connect("pushed()", print),
            lambda: setattr(StandIn("QLabel"), "words", 1),
            lambda: slicer.modules.walls,
            lambda: slicer.util.showEverything(),
        ):
            self.assertRaises(AttributeError, action)
        self.assertRaises(TypeError, node.SetActiveScalar, "Thickness")
        self.assertRaises(TypeError, slicer.util.setSliceViewerLayers, picture=1)

    def test_getters_that_are_properties_are_none(self):
        with self.assertRaises(TypeError):
            StandIn("QDoubleSpinBox").value()


if __name__ == "__main__":
    unittest.main()
