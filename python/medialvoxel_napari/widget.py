# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The widget: choose a layer, a threshold and the mode of the thickness; the viewer stays alive while it works."""

import math
import threading

import napari
import numpy as np
from magicgui.widgets import CheckBox, ComboBox, Container, FloatSpinBox, Label, ProgressBar, PushButton
from napari.layers import Image, Labels, Layer
from napari.qt.threading import create_worker
from qtpy.QtCore import QTimer

from .layers import Settings, describe, find_walls, layers_of, volume_of

AUTOMATIC, FIXED = "automatic", "fixed"
POLL_MILLISECONDS = 100


class _Canceled(Exception):
    """The user does not want the result any more."""


class WallsWidget(Container):
    """Shows the medial cells of a layer, the thickness of its walls, and their surface colored by it."""

    def __init__(self, viewer: napari.Viewer):
        super().__init__()
        self._viewer = viewer
        self._worker = None
        self._stop = threading.Event()
        self._done = 0.0
        self._layer = ComboBox(label="Layer", choices=self._volumes, tooltip="Image or labels layer with 2 or 3 axes")
        self._use_lower = CheckBox(label="Lower threshold", value=True, tooltip="Off: all values but 0 are the object")
        self._lower = FloatSpinBox(label="  from", min=-1e9, max=1e9, value=1)
        self._otsu = CheckBox(label="  by Otsu", value=False, tooltip="The threshold that splits the values best into two classes")
        self._use_upper = CheckBox(label="Upper threshold", value=False)
        self._upper = FloatSpinBox(label="  to", min=-1e9, max=1e9, value=255, enabled=False)
        self._mode = ComboBox(label="Thickness", choices=[AUTOMATIC, FIXED], tooltip="automatic: each wall by its own")
        self._thickness = FloatSpinBox(label="  of walls", min=0, max=1e9, enabled=False)
        self._run, self._cancel = PushButton(text="Find walls"), PushButton(text="Cancel", enabled=False)
        self._progress, self._status = ProgressBar(min=0, max=100, visible=False), Label(value="")
        self.extend([self._layer, self._use_lower, self._lower, self._otsu, self._use_upper, self._upper, self._mode, self._thickness,
                     self._run, self._cancel, self._progress, self._status])  # fmt: skip
        self._layer.changed.connect(self._on_layer_chosen)
        self._status.native.setWordWrap(True)
        for box in (self._use_lower, self._otsu):
            box.changed.connect(self._on_lower_chosen)
        self._use_upper.changed.connect(lambda on: setattr(self._upper, "enabled", on))
        self._mode.changed.connect(lambda mode: setattr(self._thickness, "enabled", mode == FIXED))
        self._run.changed.connect(self.start)
        self._cancel.changed.connect(self.cancel)
        self._timer = QTimer(self.native)
        self._timer.timeout.connect(self._show_progress)
        for event in (viewer.layers.events.inserted, viewer.layers.events.removed):
            event.connect(self._layer.reset_choices)
        viewer.dims.events.ndisplay.connect(self._show_walls)
        self._on_layer_chosen(self._layer.value)

    def _volumes(self, _widget=None):
        return [layer for layer in self._viewer.layers if isinstance(layer, (Image, Labels)) and not layer.metadata.get("walls")]

    def _on_layer_chosen(self, layer):
        """Labels are an object as they are; of an image, the middle of its values is the first threshold. Walls of three voxels."""
        if layer is None:
            return
        voxel = float(min(layer.scale))
        self._thickness.step = 0.5 * voxel
        self._thickness.native.setDecimals(max(2, 2 - math.floor(math.log10(voxel))))
        self._thickness.value = 3 * voxel
        self._use_lower.value = isinstance(layer, Image)
        if isinstance(layer, Image):
            low, high = layer.contrast_limits
            self._lower.value, self._upper.value = (low + high) / 2, high

    def _on_lower_chosen(self, _on=None):
        self._otsu.enabled = self._use_lower.value
        self._lower.enabled = self._use_lower.value and not self._otsu.value

    def _show_walls(self, _event=None):
        """In three dimensions what lies around the walls hides them."""
        for layer in self._viewer.layers:
            if layer.metadata.get("hides walls"):
                layer.visible = self._viewer.dims.ndisplay == 2

    def settings(self):
        """What the user chose."""
        return Settings(
            lower=None if not self._use_lower.value else "otsu" if self._otsu.value else self._lower.value,
            upper=self._upper.value if self._use_upper.value else None,
            thickness=self._thickness.value if self._mode.value == FIXED else "auto",
        )

    def start(self):
        """Begins in a thread of its own; does nothing while one is at work."""
        layer = self._layer.value
        if self._worker is not None:
            return
        if layer is None:
            self._status.value = "Open an image first."
            return
        try:
            values, spacing = volume_of(layer)
        except ValueError as error:
            self._status.value = str(error)
            return
        self._stop.clear()
        self._done = 0.0
        translate = np.array(layer.translate)
        self._worker = create_worker(self._attempt, values, spacing, self.settings(), _start_thread=False)
        self._worker.returned.connect(lambda result: self._show(layer, translate, *result))
        self._worker.finished.connect(self._end)
        self._set_busy(True)
        self._worker.start()

    def cancel(self):
        """Stops the work, if any, without a result."""
        self._stop.set()

    def is_busy(self):
        return self._worker is not None

    def _attempt(self, values, spacing, settings):
        """In the thread at work: what was found, and why not; an error that leaves the thread would end the application."""
        try:
            return find_walls(values, spacing, settings, self._on_progress), ""
        except _Canceled:
            return None, "Canceled"
        except (ValueError, MemoryError, RuntimeError) as error:
            return None, str(error)

    def _on_progress(self, done):
        """Called by the thread at work, which may not touch widgets."""
        if self._stop.is_set():
            raise _Canceled
        self._done = done

    def _show_progress(self):
        self._progress.value = round(100 * self._done)

    def _set_busy(self, is_busy):
        self._run.enabled, self._cancel.enabled, self._progress.visible = not is_busy, is_busy, is_busy
        if is_busy:
            self._status.value = "Working"
            self._timer.start(POLL_MILLISECONDS)
        else:
            self._timer.stop()

    def _show(self, source, translate, found, error):
        if found is None:
            self._status.value = error
            return
        medial, surface = found
        self._status.value = describe(medial)
        if medial.lower is not None:
            self._lower.value = medial.lower
        if surface is not None:
            source.metadata["hides walls"] = True
        for data, options, kind in layers_of(source.name, translate, medial, surface):
            if options["name"] in self._viewer.layers:
                self._viewer.layers.remove(options["name"])
            metadata = {"walls": True, "hides walls": kind == "labels" and surface is not None}
            layer = Layer.create(data, options | {"metadata": metadata}, kind)
            self._viewer.add_layer(layer)
            if kind == "surface":
                layer.colorbar.visible = True
        if self._viewer.dims.ndisplay == 3:
            self._show_walls()

    def _end(self):
        self._worker = None
        self._set_busy(False)
