# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Module of 3D Slicer: the walls of a volume or segment as a surface colored by thickness, with a table of walls."""

import json
import os

import qt
import slicer
import vtk
from slicer.i18n import tr as _
from slicer.i18n import translate
from slicer.ScriptedLoadableModule import (
    ScriptedLoadableModule,
    ScriptedLoadableModuleLogic,
    ScriptedLoadableModuleTest,
    ScriptedLoadableModuleWidget,
)
from slicer.util import VTKObservationMixin

from MedialVoxelWallsLib import display
from MedialVoxelWallsLib.panel import Panel
from MedialVoxelWallsLib.settings import Settings, module_parameters, summary
from MedialVoxelWallsLib.walls import walls_of

HELP = "https://github.com/InsightSoftwareConsortium/SlicerMedialVoxel/blob/main/doc/getting-started/slicer-walls.md"


class MedialVoxelWalls(ScriptedLoadableModule):
    """What 3D Slicer shows about the module."""

    def __init__(self, parent):
        ScriptedLoadableModule.__init__(self, parent)
        parent.title = _("Medial Voxel Walls")
        parent.categories = [translate("qSlicerAbstractCoreModule", "Filtering.Morphology")]
        parent.dependencies = ["MedialVoxelExtraction", "Colors", "Markups", "Cameras", "Segmentations"]
        parent.contributors = ["The MedialVoxel contributors"]
        parent.helpText = _(
            "Shows the sheet in the middle of walls, colored by their thickness, and a table of the walls. "
            'See the <a href="{address}">tutorial</a>.'
        ).format(address=HELP)
        parent.acknowledgementText = _(
            "The method is that of T. Michikawa and H. Suzuki, "
            "Efficient Medial Voxel Extraction for Large Volumetric Models (2012)."
        )


class MedialVoxelWallsWidget(ScriptedLoadableModuleWidget, VTKObservationMixin):
    """Connects the panel with the logic."""

    def __init__(self, parent=None):
        ScriptedLoadableModuleWidget.__init__(self, parent)
        VTKObservationMixin.__init__(self)

    def setup(self):
        ScriptedLoadableModuleWidget.setup(self)
        self.logic = MedialVoxelWallsLogic()
        self.logic.on_progress, self.logic.on_end = self.on_progress, self.on_end
        self.walls = []
        self.panel = Panel(self.layout)
        self.panel.volume.connect("currentNodeChanged(vtkMRMLNode*)", self.on_input_changed)
        self.panel.segment.connect("currentNodeChanged(vtkMRMLNode*)", self.on_input_changed)
        self.panel.segment.connect("currentSegmentChanged(QString)", self.on_input_changed)
        self.panel.apply.connect("clicked()", self.on_apply)
        self.panel.cancel.connect("clicked()", self.logic.cancel)
        self.panel.table.connect("cellClicked(int,int)", self.on_wall_clicked)
        self.addObserver(slicer.mrmlScene, slicer.mrmlScene.StartCloseEvent, self.on_scene_closed)
        self.on_input_changed()

    def cleanup(self):
        self.logic.cancel()
        self.removeObservers()

    def on_input_changed(self, *_arguments):
        if not self.logic.is_running():
            self.panel.show_range()
            self.panel.show_idle()

    def on_apply(self):
        with slicer.util.tryWithErrorDisplay(_("The walls could not be computed.")):
            self.show_walls([])
            volume, segmentation = self.panel.volume.currentNode(), self.panel.segment.currentNode()
            self.logic.start(self.panel.settings(), volume, segmentation, self.panel.segment_id())

    def on_progress(self, percent, text):
        self.panel.show_progress(percent, text)

    def on_end(self, outcome):
        self.panel.show_idle(outcome.text)
        self.show_walls(outcome.walls)

    def on_wall_clicked(self, row, _column):
        display.center_views(self.walls[row].thinnest)

    def on_scene_closed(self, _caller, _event):
        self.logic.cancel()
        self.show_walls([])

    def show_walls(self, walls):
        self.walls = walls
        self.panel.show_walls(walls)


class Outcome:
    """How a run ended: a text for the user, and the walls (none unless it was completed)."""

    def __init__(self, text, walls=()):
        self.text = text
        self.walls = list(walls)


class MedialVoxelWallsLogic(ScriptedLoadableModuleLogic):
    """Runs the command line module without blocking the application, and shows what it made.

    on_progress(percent, text) and on_end(outcome) are called as the run goes on.
    """

    def __init__(self):
        ScriptedLoadableModuleLogic.__init__(self)
        self.on_progress = lambda percent, text: None
        self.on_end = lambda outcome: None
        self._run = self._observation = None

    def is_running(self):
        return self._run is not None

    def start(self, settings, volume, segmentation=None, segment_id=""):
        """Starts a run on a volume, or on a segment with the geometry of the volume.

        Raises ValueError for settings of which no run can come, RuntimeError where 3D Slicer refuses.
        """
        if self.is_running():
            raise RuntimeError("A run is under way.")
        if not volume:
            raise ValueError("Choose a volume.")
        settings.check()
        if not hasattr(slicer.modules, "medialvoxelextraction"):
            raise RuntimeError("The module Medial Voxel Extraction is not installed.")
        name = volume.GetName()
        self._temporary = None
        if segment_id:
            settings = Settings(thickness=settings.thickness, branches=settings.branches)
            volume = self._temporary = _segment_as_label_map(volume, segmentation, segment_id)
        add = slicer.mrmlScene.AddNewNodeByClass
        self._labels = add("vtkMRMLLabelMapVolumeNode", f"{name} medial voxels")
        self._model = add("vtkMRMLModelNode", f"{name} walls")
        self._report = os.path.join(slicer.util.tempDirectory(), "report.json")
        parameters = module_parameters(settings, volume, self._labels, self._model, self._report)
        self._run = slicer.cli.run(slicer.modules.medialvoxelextraction, None, parameters, update_display=False)
        self._observation = self._run.AddObserver(vtk.vtkCommand.ModifiedEvent, self._on_modified)
        self.on_progress(0, _("Starting"))
        self._on_modified(self._run, None)  # it may have ended before it was observed

    def cancel(self):
        """Stops a run, if one is under way; on_end follows when it has stopped."""
        if self.is_running():
            self._run.Cancel()

    def _on_modified(self, run, _event):
        if run is not self._run:
            return
        status = run.GetStatus()
        if status & (run.Completed | run.Cancelled):
            self._end(run, status)
        else:
            self.on_progress(run.GetProgress(), run.GetStatusString())

    def _end(self, run, status):
        self._run = None
        run.RemoveObserver(self._observation)
        if self._temporary:
            _remove(self._temporary)
        if status & run.Cancelled:
            outcome = self._discarded(_("Canceled"))
        elif status & run.ErrorsMask:
            outcome = self._discarded(_("Failed: {errors}").format(errors=run.GetErrorText().strip()))
        else:
            outcome = self._completed()
        # Not before the application is done with what it calls us from.
        qt.QTimer.singleShot(0, lambda: _remove(run))
        self.on_end(outcome)

    def _completed(self):
        display.show_labels(self._labels)
        with open(self._report, encoding="utf-8") as file:
            text = summary(json.load(file))
        surface = self._model.GetPolyData()
        if not surface or not surface.GetNumberOfCells():
            return Outcome(text)
        display.show_model(self._model)
        return Outcome(text, walls_of(surface))

    def _discarded(self, text):
        _remove(self._labels)
        _remove(self._model)
        return Outcome(text)


def _remove(node):
    """From the scene, which may have been closed since."""
    if slicer.mrmlScene.IsNodePresent(node):
        slicer.mrmlScene.RemoveNode(node)


def _segment_as_label_map(volume, segmentation, segment_id):
    """A label map of one segment with the geometry of the volume."""
    labels = slicer.mrmlScene.AddNewNodeByClass("vtkMRMLLabelMapVolumeNode", "Segment")
    ids = vtk.vtkStringArray()
    ids.InsertNextValue(segment_id)
    if not slicer.modules.segmentations.logic().ExportSegmentsToLabelmapNode(segmentation, ids, labels, volume):
        _remove(labels)
        raise RuntimeError("The segment could not be converted to a label map.")
    return labels


class MedialVoxelWallsTest(ScriptedLoadableModuleTest):
    """Runs inside of 3D Slicer: a plate of 4 voxels of 1 mm becomes one wall of 4 mm."""

    def setUp(self):
        slicer.mrmlScene.Clear()

    def runTest(self):
        self.setUp()
        self.test_plate()

    def test_plate(self):
        import numpy as np

        values = np.zeros((24, 60, 60), np.uint8)
        values[10:14, 8:52, 8:52] = 200
        volume = slicer.util.addVolumeFromArray(values, name="Plate")
        ends = []
        logic = MedialVoxelWallsLogic()
        logic.on_end = ends.append
        logic.start(Settings(lower=100.0), volume)
        for _attempt in range(600):
            if ends:
                break
            self.delayDisplay("Waiting for the module", 100)
        (outcome,) = ends
        self.assertEqual(len(outcome.walls), 1, outcome.text)
        self.assertAlmostEqual(outcome.walls[0].mean, 4.0, delta=0.1)
