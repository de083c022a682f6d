# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The widgets of the module: inputs, the run, and the table of walls."""

import ctk
import qt
import slicer
from slicer.i18n import tr as _

from .settings import Settings

COLUMNS = ("Area (mm\u00b2)", "Thinnest (mm)", "Mean (mm)", "Thickest (mm)")


class Panel:
    """Makes the widgets in a layout. It reads and shows values; what happens is the business of its user."""

    def __init__(self, layout):
        self.volume, self.segment, self.threshold = _volume_selector(), _segment_selector(), ctk.ctkRangeWidget()
        self.thickness = _length_box(_("automatic"))
        self.thickness.toolTip = _("Thickness of the walls that become sheets; automatic: each wall by its own, from 3 to 16 voxels")
        self.branches = _length_box(_("keep all"))
        self.branches.toolTip = _("Shorter branches of the sheet are left out")
        self.apply, self.cancel = qt.QPushButton(_("Apply")), qt.QPushButton(_("Cancel"))
        self.progress, self.status, self.table = qt.QProgressBar(), qt.QLabel(), _wall_table()
        self.status.wordWrap = True
        form = _section(layout, _("Walls"))
        form.addRow(_("Volume:"), self.volume)
        form.addRow(_("Segment:"), self.segment)
        form.addRow(_("Threshold:"), self.threshold)
        form.addRow(_("Thickness:"), self.thickness)
        form.addRow(_("Shortest branch:"), self.branches)
        buttons = qt.QHBoxLayout()
        buttons.addWidget(self.apply)
        buttons.addWidget(self.cancel)
        form.addRow(buttons)
        form.addRow(self.progress)
        form.addRow(self.status)
        _section(layout, _("Results")).addRow(self.table)
        layout.addStretch(1)
        self.show_range()
        self.show_idle()

    def settings(self):
        """What the user chose."""
        limits = {}
        if not self.segment_id():
            limits["lower"] = self.threshold.minimumValue
            if self.threshold.maximumValue < self.threshold.maximum:
                limits["upper"] = self.threshold.maximumValue
        thickness = self.thickness.value or None
        return Settings(thickness=thickness, branches=self.branches.value, **limits)

    def segment_id(self):
        """The chosen segment; empty without one."""
        return self.segment.currentSegmentID() if self.segment.currentNode() else ""

    def show_range(self):
        """Offers the values of the chosen volume as thresholds, with the middle as the first lower one."""
        volume = self.volume.currentNode()
        image = volume.GetImageData() if volume else None
        self.threshold.enabled = bool(image) and not self.segment_id()
        if image:
            low, high = image.GetScalarRange()
            self.threshold.singleStep = (high - low) / 1000 or 1.0
            self.threshold.setRange(low, high)
            self.threshold.setValues((low + high) / 2, high)

    def show_idle(self, text=""):
        self._show_busy(False)
        self.status.text = text

    def show_progress(self, percent, text):
        self._show_busy(True)
        self.progress.value = percent
        self.status.text = text

    def _show_busy(self, is_busy):
        self.apply.enabled = bool(self.volume.currentNode()) and not is_busy
        self.cancel.enabled = is_busy
        self.progress.visible = is_busy
        self.threshold.enabled = bool(self.volume.currentNode()) and not self.segment_id()

    def show_walls(self, walls):
        """One row for each wall."""
        self.table.setRowCount(len(walls))
        for row, wall in enumerate(walls):
            for column, value in enumerate((wall.area, wall.minimum, wall.mean, wall.maximum)):
                item = qt.QTableWidgetItem(f"{value:.3g}" if value < 1000 else f"{value:.0f}")
                item.setFlags(qt.Qt.ItemIsEnabled | qt.Qt.ItemIsSelectable)
                self.table.setItem(row, column, item)


def _section(layout, title):
    """A form under a title that opens and closes it."""
    button = ctk.ctkCollapsibleButton()
    button.text = title
    layout.addWidget(button)
    return qt.QFormLayout(button)


def _volume_selector():
    selector = slicer.qMRMLNodeComboBox()
    selector.nodeTypes = ["vtkMRMLScalarVolumeNode"]
    selector.addEnabled = selector.removeEnabled = False
    selector.setMRMLScene(slicer.mrmlScene)
    selector.toolTip = _("CT volume with one value per voxel")
    return selector


def _segment_selector():
    selector = slicer.qMRMLSegmentSelectorWidget()
    selector.noneEnabled = True
    selector.setMRMLScene(slicer.mrmlScene)
    selector.toolTip = _("Segment that is the object; without one, the object is what is within the threshold")
    return selector


def _length_box(nothing):
    box = qt.QDoubleSpinBox()
    box.decimals = 3
    box.maximum = 1000.0
    box.suffix = " mm"
    box.specialValueText = nothing
    return box


def _wall_table():
    table = qt.QTableWidget()
    table.setColumnCount(len(COLUMNS))
    table.setHorizontalHeaderLabels(list(COLUMNS))
    table.setSelectionBehavior(qt.QAbstractItemView.SelectRows)
    table.horizontalHeader().setSectionResizeMode(qt.QHeaderView.Stretch)
    table.toolTip = _("Walls between rims and junctions, largest first. A click shows where a wall is thinnest")
    return table
