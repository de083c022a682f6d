# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The plugin for napari, with its real viewer. Needs napari, a Qt binding and a display, such as xvfb-run gives.

MEDIALVOXEL_PICTURE=FILE.png keeps a picture of the window.
"""

import os
import pathlib
import sys
import unittest
from unittest import mock

import numpy as np

try:
    import napari
    import npe2
except ImportError:
    napari = None

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
import medialvoxel  # noqa: E402
import support  # noqa: F401, which makes the next one importable
from processes import wait_until

if napari:
    from medialvoxel_napari import layers, samples
    from medialvoxel_napari.widget import AUTOMATIC, FIXED, WallsWidget

    MANIFEST = pathlib.Path(layers.__file__).with_name("napari.yaml")


def setUpModule():
    if not napari:
        raise unittest.SkipTest("napari is not installed")


def plate():
    volume = np.zeros((24, 40, 50), np.uint8)
    volume[10:14, 4:36, 4:46] = 200
    return volume


class ManifestTest(unittest.TestCase):
    def test_manifest(self):
        manifest = npe2.PluginManifest.from_file(MANIFEST)
        manifest.validate_imports()
        self.assertEqual(manifest.name, "medialvoxel")
        self.assertEqual(len(manifest.contributions.widgets), 1)
        self.assertEqual({sample.key for sample in manifest.contributions.sample_data}, {"scroll", "ribs"})

    def test_samples(self):
        """What the samples hold is known: sheets of 4 voxels, and ribs of 3 to 8."""
        for make, middle in ((samples.scroll, 4.0), (samples.ribs, 0.5)):
            ((values, options, kind),) = make()
            self.assertEqual((values.dtype, kind), (np.uint8, "image"))
            spacing = options.get("scale", (1, 1, 1))
            medial, surface = layers.find_walls(values, spacing, layers.Settings(lower=110))
            self.assertAlmostEqual(float(np.median(medial.thickness[medial.thickness > 0])), middle, delta=0.1 * middle)
            self.assertGreater(len(surface.faces), 10000)


class LayersTest(unittest.TestCase):
    """Layers without a viewer."""

    def test_results_are_those_of_the_functions(self):
        medial, surface = layers.find_walls(plate(), (2.0, 1.0, 0.5), layers.Settings(lower=100, thickness=4))
        expected = medialvoxel.extract(plate(), thickness=4, spacing=(2.0, 1.0, 0.5), lower=100)
        np.testing.assert_array_equal(medial.labels, expected.labels)
        np.testing.assert_array_equal(medial.thickness, expected.thickness)
        np.testing.assert_array_equal(surface.points, medialvoxel.mesh(plate(), thickness=4, spacing=(2.0, 1.0, 0.5), lower=100).points)

    def test_results_lie_in_the_wall(self):
        """Whatever scale and place the layer has: world positions of the cells and points are those of the plate."""
        layer = napari.layers.Image(plate(), scale=(0.5, 1, 2), translate=(100, 20, 3))
        values, spacing = layers.volume_of(layer)
        found = layers.find_walls(values, spacing, layers.Settings(lower=100))
        made = [napari.layers.Layer.create(*data) for data in layers.layers_of("plate", layer.translate, *found)]
        thickness, cells, surface = made
        for middle in (
            np.array([cells.data_to_world(index) for index in np.argwhere(cells.data >= 2)]).mean(axis=0),
            np.array([surface.data_to_world(point) for point in surface.vertices]).mean(axis=0),
        ):
            np.testing.assert_allclose(middle, layer.data_to_world((11.5, 19.5, 24.5)), atol=0.02)
        np.testing.assert_allclose(thickness.data_to_world((0, 0, 0)), layer.data_to_world((0.5, 0.5, 0.5)))

    def test_what_cannot_be_laid_over_is_refused(self):
        turned = napari.layers.Image(plate(), rotate=30)
        for layer, part in (
            (turned, "rotated"),
            (napari.layers.Image(np.zeros((8, 8, 3), np.uint8), rgb=True), "colors"),
            (napari.layers.Image(np.zeros((2, 3, 8, 8))), "4 axes"),
            (napari.layers.Image(plate(), affine=np.diag([2, 1, 1, 1])), "rotated"),
        ):
            with self.assertRaisesRegex(ValueError, part):
                layers.volume_of(layer)

    def test_two_axes(self):
        medial, surface = layers.find_walls(plate()[:, 20], (1, 1), layers.Settings())
        self.assertIsNone(surface)
        self.assertEqual([kind for _, _, kind in layers.layers_of("line", (0, 0), medial, surface)], ["image", "labels"])

    def test_nothing(self):
        found = layers.find_walls(np.zeros((9, 9, 9)), (1, 1, 1), layers.Settings())
        self.assertIn("no wall was measured", layers.describe(found[0]))
        self.assertEqual(len(layers.layers_of("nothing", (0, 0, 0), *found)), 2)


class WidgetTest(unittest.TestCase):
    """The widget in a real viewer."""

    @classmethod
    def setUpClass(cls):
        if not os.environ.get("DISPLAY"):
            raise unittest.SkipTest("there is no display; try xvfb-run")

    def setUp(self):
        self.viewer = napari.Viewer(show=bool(os.environ.get("MEDIALVOXEL_PICTURE")))
        self.addCleanup(self.viewer.close)
        self.widget = WallsWidget(self.viewer)
        self.viewer.window.add_dock_widget(self.widget, name="Medial sheet of walls")

    def wait(self):
        wait_until(lambda: napari.qt.get_qapp().processEvents() or not self.widget.is_busy(), "the end of the work")

    def names(self):
        return [layer.name for layer in self.viewer.layers]

    def test_image(self):
        ((values, options, _),) = samples.scroll()
        self.viewer.add_image(values, **options)
        self.assertEqual(self.widget._layer.value.name, "rolled sheet")
        self.widget._lower.value = 110
        self.widget.start()
        self.assertFalse(self.widget._run.enabled)
        self.wait()
        self.assertEqual(self.names(), ["rolled sheet", *(f"rolled sheet {word}" for word in ("thickness", "medial cells", "walls"))])
        self.assertRegex(self.widget._status.value, r"^[\d,]+ medial cells; walls")
        self.assertTrue(self.widget._status.native.wordWrap())
        surface = self.viewer.layers["rolled sheet walls"]
        self.assertEqual(surface.colormap.name, "viridis")
        self.assertEqual([layer.name for layer in self.widget._volumes()], ["rolled sheet"])
        self.widget.start()  # again: no second copies
        self.wait()
        self.assertEqual(len(self.viewer.layers), 4)

    def test_walls_are_seen_at_once_in_three_dimensions(self):
        ((values, options, _),) = samples.ribs()
        self.viewer.add_image(values, **options)
        other = self.viewer.add_image(values, name="other", **{key: value for key, value in options.items() if key != "name"})
        visible = lambda: [layer.name for layer in self.viewer.layers if layer.visible]  # noqa: E731
        self.widget._layer.value = self.viewer.layers["ribs"]
        self.widget.start()
        self.wait()
        other.visible = False
        self.assertEqual(visible(), ["ribs", "ribs medial cells", "ribs walls"])
        self.viewer.dims.ndisplay = 3
        self.assertEqual(visible(), ["ribs walls"])
        self.widget.start()  # again, in 3-D
        self.wait()
        self.assertEqual(visible(), ["ribs walls"])
        self.viewer.dims.ndisplay = 2
        self.assertEqual(visible(), ["ribs", "ribs medial cells", "ribs walls"])

    def test_otsu(self):
        self.viewer.add_image(samples.ribs()[0][0], name="ribs")
        self.widget._otsu.value = True
        self.assertEqual((self.widget.settings().lower, self.widget._lower.enabled), ("otsu", False))
        self.widget.start()
        self.wait()
        self.assertEqual(self.widget._lower.value, medialvoxel.extract(samples.ribs()[0][0], lower="otsu").lower)
        self.widget._otsu.value = False
        self.assertTrue(self.widget._lower.enabled)
        self.assertEqual(self.widget.settings().lower, self.widget._lower.value)

    def test_the_first_fixed_thickness_is_that_of_three_voxels(self):
        for scale in (0.1, 2.5e-5, 40.0):
            self.viewer.add_image(plate(), name=f"{scale}", scale=(4 * scale, scale, scale))
            self.widget._layer.value = self.viewer.layers[f"{scale}"]
            self.assertAlmostEqual(self.widget._thickness.value, 3 * scale, delta=0.01 * scale)

    @unittest.skipUnless(os.environ.get("MEDIALVOXEL_PICTURE"), "no picture is wanted")
    def test_picture(self):
        """Ribs, with colors from 0.3 to 0.8: for a person to look at."""
        ((values, options, _),) = samples.ribs()
        self.viewer.add_image(values, **options)
        self.widget.start()
        self.wait()
        self.viewer.window.resize(1280, 800)
        self.viewer.dims.ndisplay = 3
        self.viewer.reset_view()
        self.viewer.camera.angles = (12, 28, -120)
        self.viewer.camera.zoom *= 0.8
        pictures = []

        def is_still():
            napari.qt.get_qapp().processEvents()
            pictures.append(self.viewer.screenshot(canvas_only=False, flash=False))
            return len(pictures) > 2 and all(np.array_equal(pictures[-1], picture) for picture in pictures[-3:])

        wait_until(is_still, "a picture that changes no more")
        self.viewer.screenshot(os.environ["MEDIALVOXEL_PICTURE"], canvas_only=False)

    def test_labels_need_no_threshold(self):
        self.viewer.add_labels((plate() > 0).astype(np.uint8), name="plate")
        self.assertIsNone(self.widget.settings().lower)
        self.widget._mode.value, self.widget._thickness.value = FIXED, 4
        self.assertEqual(self.widget.settings(), layers.Settings(thickness=4))
        self.widget.start()
        self.wait()
        expected = medialvoxel.extract(plate(), thickness=4)
        np.testing.assert_array_equal(self.viewer.layers["plate medial cells"].data, expected.labels)
        self.widget._mode.value = AUTOMATIC
        self.assertEqual(self.widget.settings().thickness, "auto")

    def test_cancel(self):
        self.viewer.add_image(np.tile(plate(), (6, 4, 4)), name="plates")
        self.widget.start()
        self.widget.cancel()
        self.wait()
        self.assertEqual(self.widget._status.value, "Canceled")
        self.assertEqual(self.names(), ["plates"])

    def test_errors_are_shown(self):
        self.widget.start()
        self.assertEqual(self.widget._status.value, "Open an image first.")
        self.viewer.add_image(plate(), name="plate")
        self.widget._lower.value, self.widget._upper.value, self.widget._use_upper.value = 9, 5, True
        self.widget.start()
        self.wait()
        self.assertRegex(self.widget._status.value, "lower|upper")
        self.assertTrue(self.widget._run.enabled)
        with mock.patch("medialvoxel.extract", side_effect=MemoryError("not enough memory")):
            self.widget.start()
            self.wait()
        self.assertEqual(self.widget._status.value, "not enough memory")


if __name__ == "__main__":
    unittest.main()
