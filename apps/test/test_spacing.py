# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Spacings of any size: measured alike, or refused with the file's name and the range; --spacing for any input."""

import array
import json
import math
import pathlib
import shutil
import unittest

import volumes
import zarr_folder
from program import CORRUPT, READS_TIFF, USAGE, ProgramTestCase, needs_tiff

SHARED = pathlib.Path(__file__).resolve().parents[3] / "shared" / "data" / "hostile" / "spacing-1e103.mha"

RANGE = "from 1e-12 to 1e+12"

# Spacings that no reader may pass on. Those that are no positive number have a message of their own in texts.
BEYOND = ["1e103", "1e78", "1e300", "1e13", "1e-13", "1e-80", "1e-160", "1e-300", "5e-324"]
NO_LENGTHS = ["0", "-1", "nan", "inf", "1e999", "1e-999"]

# Powers of two scale every number exactly.
SCALES = [2.0**-38, 2.0**-7, 2.0**9, 2.0**38]


class SpacingTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()

    def assert_refused(self, name, parts, status=CORRUPT, arguments=()):
        """By each command, in one line that names the file and no function of a library."""
        for command in (
            ["info", name],
            ["extract", name, "out.mha"],
            ["extract", name, "out.mha", "--thickness", 3],
            ["distance", name, "out.mha"],
            *([["mesh", name, "out.vtp"]] if len(self.volume.size) == 3 else []),
            ["plan", name, "out.mha", "job"],
        ):
            self.assert_fails(status, [name, *parts], *command, *arguments)

    def with_spacing(self, text):
        """The volume in formats that keep spacing as text, with it along each axis in turn, and along all of them."""
        for axis in (0, 2, None):
            spacings = " ".join(text if axis in (None, i) else "1" for i in range(3))
            volumes.write_meta(self.folder / "in.mha", self.volume, ElementSpacing=spacings)
            yield "in.mha"
            volumes.write_nrrd(self.folder / "in.nrrd", self.volume, spacings=spacings)
            yield "in.nrrd"

    @unittest.skipUnless(SHARED.exists(), "the file that was found is not here")
    def test_file_that_was_found(self):
        (self.folder / "found.mha").write_bytes(SHARED.read_bytes())
        self.assert_refused("found.mha", ["spacing along axis 0 is 1e+103", RANGE])

    def test_texts(self):
        for text in BEYOND:
            for name in self.with_spacing(text):
                self.assert_refused(name, ["spacing along axis", RANGE])
        for text in NO_LENGTHS:
            for name in self.with_spacing(text):
                self.assert_refused(name, ["greater than 0"])

    def test_binary_headers(self):
        for spacing in (0.0, -1.0, math.nan, math.inf, 1e-40, 1e-13, 1e13, 1e38):
            volumes.write_nifti(self.folder / "in.nii", self.volume, pixdim=(1, 1, 1, spacing, 1, 1, 1, 1))
            self.assert_refused("in.nii", ["spacing along axis 2", RANGE])
        # A unit of meters multiplies by a thousand.
        volumes.write_nifti(self.folder / "in.nii", self.volume, pixdim=(1, 1e10, 1, 1, 1, 1, 1, 1), xyzt_units=1)
        self.assert_refused("in.nii", ["spacing along axis 0", RANGE])

    @needs_tiff
    def test_resolutions(self):
        for numerator, denominator in ((1, 2**32 - 1), (2**32 - 1, 1)):
            resolution = {"tag_282": (numerator, denominator), "tag_283": (numerator, denominator), "tag_296": 3}
            volumes.write_tiff(self.folder / "in.tif", self.volume, **resolution)
            self.assert_refused("in.tif", ["largest spacing to its smallest", "must not exceed 1000"])

    def spacing(self, name):
        text = self.run_program("info", name).stdout.split("\nspacing")[1].split("\n")[0]
        return [float(part) for part in text.split(" x ")]

    def test_units_of_mrc(self):
        """A cell is in Angstroms; without one the spacing is 1. The origin is that of the header, or of the start."""
        for steps in ((1e-7, 2e-7, 3e-7), (2.5e-4, 5e-4, 2.5e-4), (3.0, 4.0, 5.0)):
            volume = volumes.Volume(self.volume.size, self.volume.voxels, steps)
            volumes.write_mrc(self.folder / "in.mrc", volume)
            for found, step in zip(self.spacing("in.mrc"), steps):
                self.assertAlmostEqual(found, step, delta=1e-6 * step)
        volumes.write_mrc(self.folder / "in.mrc", self.volume, cell=(0, 0, 0), intervals=(0, 0, 0))
        self.assertEqual(self.spacing("in.mrc"), [1, 1, 1])
        for changes, origin in (
            ({"origin": (1e7, -2e7, 5e6), "start": (1, 1, 1)}, "1, -2, 0.5"),
            ({"start": (3, -4, 5)}, "3, -4, 5"),
            ({}, "0, 0, 0"),
        ):
            volumes.write_mrc(self.folder / "in.mrc", self.volume, **changes)
            self.assertRegex(self.run_program("info", "in.mrc").stdout, rf"\norigin +{origin}\n")
        volumes.write_mrc(self.folder / "in.mrc", self.volume, cell=(1, 20e7, 16e7))
        self.assert_refused("in.mrc", ["ratio of its largest spacing to its smallest"])

    @needs_tiff
    def test_descriptions(self):
        """ImageJ and OME-TIFF tell the distance of slices; resolutions are 4 voxels per unit."""
        ome = '<OME><Image><Pixels SizeC="1" SizeT="{}" SizeZ="{}" PhysicalSizeX="{}" PhysicalSizeZ="3"{}/></Image></OME>'
        for text, unit, expected in (
            ("ImageJ=1.53t\nimages=16\nslices=16\nunit=mm\nspacing=0.5\n", 1, [0.25, 0.25, 0.5]),
            ("ImageJ=1.53t\nimages=16\nunit=\\u00B5m\nspacing=2\n", 1, [0.00025, 0.00025, 0.002]),
            ("ImageJ=1.53t\nimages=16\nframes=16\nunit=cm\n", 1, [2.5, 2.5, 10]),
            ("ImageJ=1.53t\nimages=16\nunit=pixel\nspacing=2\n", 1, [0.25, 0.25, 2]),
            ("ImageJ=1.53t\nimages=16\nunit=mm\nspacing=-2\n", 1, [0.25, 0.25, 1]),
            ("ImageJ=1.53t\nspacing=2\n", 3, [2.5, 2.5, 20]),
            ("spacing=2\nunit=mm\n", 1, [1, 1, 1]),
            (ome.format(1, 16, 250, ' PhysicalSizeZUnit="mm"'), 1, [0.25, 1, 3]),
            (ome.format(1, 16, 2, ' PhysicalSizeXUnit="&#181;m"'), 1, [0.002, 1, 0.003]),
            (ome.format(1, 16, "wide", ' PhysicalSizeZUnit="furlong"'), 1, [1, 1, 1]),
            (ome.format(16, 1, 1000, ' PhysicalSizeYUnit="mm" PhysicalSizeY="0.5"'), 1, [1, 0.5, 0.003]),
        ):
            with self.subTest(text):
                tags = {"tag_270": text.encode() + b"\0", "tag_282": (4, 1), "tag_283": (4, 1), "tag_296": unit}
                volumes.write_tiff(self.folder / "in.tif", self.volume, **tags)
                self.assertEqual(self.spacing("in.tif"), expected)

    @needs_tiff
    def test_descriptions_of_several_volumes(self):
        for text, part in (
            ("ImageJ=1.53t\nimages=16\nchannels=2\nslices=8\n", "2 channels"),
            ("ImageJ=1.53t\nimages=16\nslices=8\nframes=2\n", "2 points in time"),
            ('<OME><Pixels SizeC="3" SizeT="1" SizeZ="16"/></OME>', "3 channels"),
            ('<OME><Pixels SizeC="1" SizeT="2" SizeZ="8"/></OME>', "2 points in time"),
            ('<OME><Pixels SizeC="1"/><Pixels SizeC="1"/></OME>', "several images"),
        ):
            volumes.write_tiff(self.folder / "in.tif", self.volume, tag_270=text.encode() + b"\0")
            self.assert_refused("in.tif", [part, "only one v"])

    def test_scales_of_zarr(self):
        for scale in (0.0, -2.0, 1e13, 1e300, 1e-160):
            volume = volumes.Volume(self.volume.size, self.volume.voxels, (scale, 1.0, 1.0))
            zarr_folder.write_image(self.folder / "in.zarr", volume, (20, 20, 24))
            self.assert_refused("in.zarr", ["spacing along axis 0", RANGE])
            shutil.rmtree(self.folder / "in.zarr")

    def test_ratio(self):
        for spacings in ("1 1 1001", "0.0009 1 1", "1e-6 1e6 1"):
            volumes.write_meta(self.folder / "in.mha", self.volume, ElementSpacing=spacings)
            self.assert_refused("in.mha", ["ratio of its largest spacing to its smallest", "not exceed 1000"])
        # The thickness of a single slice has no neighbors to be compared with.
        self.volume = volumes.Volume((24, 20, 1), self.volume.voxels[: 24 * 20])
        volumes.write_meta(self.folder / "in.mha", self.volume, ElementSpacing="1 1 5000")
        self.extract("in.mha", "out.mha")

    def test_extents_and_origins(self):
        for origin in ("1e19 0 0", "0 -2e18 0", "0 0 1e300"):
            volumes.write_meta(self.folder / "in.mha", self.volume, Offset=origin)
            self.assert_refused("in.mha", ["origin along axis", "-1e+18 to 1e+18"])
        row = volumes.Volume((2000001, 1), [0] * 2000001)
        volumes.write_meta(self.folder / "row.mha", row, ElementSpacing="9e11 1")
        for command in (["info", "row.mha"], ["extract", "row.mha", "out.mha"]):
            self.assert_fails(CORRUPT, ["row.mha", "extent along axis 0", "not exceed 1e+18"], *command)

    def test_directions(self):
        for matrix in (
            "1 0 0 0 1 0 0 0 0",
            "2 0 0 0 1 0 0 0 1",
            "1e200 0 0 0 1 0 0 0 1",
            "1e-200 0 0 0 1e-200 0 0 0 1e-200",
        ):
            volumes.write_meta(self.folder / "in.mha", self.volume, TransformMatrix=matrix)
            self.assert_refused("in.mha", ["directions", "must have the length 1"])
        volumes.write_meta(self.folder / "in.mha", self.volume, TransformMatrix="1 0 0 1 0 0 0 0 1")
        self.assert_refused("in.mha", ["axes x and y"])
        for matrix in ("1 nan 0 0 1 0 0 0 1", "inf 0 0 0 1 0 0 0 1"):
            volumes.write_meta(self.folder / "in.mha", self.volume, TransformMatrix=matrix)
            self.assert_refused("in.mha", ["TransformMatrix"])

    def results(self, scale, *arguments):
        """Voxels of the outputs, those that are lengths divided by the scale."""
        spacing = [scale * s for s in (1.0, 0.5, 1.25)]
        volumes.write_meta(self.folder / "in.mha", self.volume, ElementSpacing=" ".join(map(repr, spacing)))
        outputs = ["--vectors", "v.mha", "--thickness-map", "t.mha", "--distance", "d.mha", "--overwrite"]
        self.run_program("extract", "in.mha", "out.mha", "--lower", 72, *outputs, *arguments)
        lengths = [volumes.read_floats(self.folder / name) for name in ("v.mha", "t.mha", "d.mha")]
        return volumes.read_data(self.folder / "out.mha"), [array.array("f", (v / scale for v in x)) for x in lengths]

    def test_results_do_not_depend_on_the_unit(self):
        for thickness in (["--thickness", 2.3], [], ["--sub-voxel"]):
            scaled = [2 * thickness[1]] if len(thickness) > 1 else []
            plain = self.results(1.0, *thickness)
            for scale in SCALES:
                arguments = ["--thickness", repr(scale * thickness[1])] if scaled else thickness
                labels, lengths = self.results(scale, *arguments)
                self.assertEqual(labels, plain[0], (thickness, scale))
                for actual, expected in zip(lengths, plain[1]):
                    self.assertEqual(actual.tobytes(), expected.tobytes(), (thickness, scale))

    def test_limits_of_the_automatic_thickness(self):
        volumes.write_meta(self.folder / "in.mha", self.volume)
        for limits in (["--max-thickness", "1e18"], ["--min-thickness", "1e-300"]):
            self.run_program("extract", "in.mha", "out.mha", "--overwrite", "--lower", 72, *limits)
        self.assert_fails(
            USAGE, ["--max-thickness", "1e+18"], "extract", "in.mha", "o.mha", "--max-thickness", "2e18"
        )

    def test_spacing_of_any_input(self):
        """--spacing is as good as a header that has it."""
        spacing = (0.5, 0.25, 2)
        text = ",".join(map(str, spacing))
        expected = volumes.write_meta(self.folder / "with.mha", volumes.box_with_plate(spacing=spacing))
        run = ("--lower", 72, "--resample", "off")
        self.extract(expected, "expected.mha", *run, "--thickness-map", "expected-t.mha")
        sources = [
            volumes.write_meta(self.folder / "a.mha", self.volume),
            volumes.write_nrrd(self.folder / "b.nrrd", self.volume, compressed=True),
            volumes.write_nifti(self.folder / "c.nii", self.volume, pixdim=(1, 7, 7, 7, 1, 1, 1, 1)),
            *([volumes.write_tiff(self.folder / "d.tif", self.volume)] if READS_TIFF else []),
        ]
        for source in sources:
            self.extract(source, "out.mha", *run, "--thickness-map", "t.mha", "--spacing", text, "--overwrite")
            for made, wanted in (("out.mha", "expected.mha"), ("t.mha", "expected-t.mha")):
                self.assertEqual(
                    volumes.read_data(self.folder / made), volumes.read_data(self.folder / wanted), source.name
                )
            self.assertEqual(volumes.read_header(self.folder / "out.mha")[0]["ElementSpacing"], "0.5 0.25 2")
            self.assertRegex(self.run_program("info", source, "--spacing", text).stdout, r"spacing +0.5 x 0.25 x 2\n")
        raw = volumes.write_raw(self.folder / "e.raw", self.volume)
        options = volumes.raw_options(self.volume)[:4]
        self.extract(raw, "out.mha", *run, *options, "--spacing", text, "--overwrite")
        made, wanted = (volumes.read_data(self.folder / out) for out in ("out.mha", "expected.mha"))
        self.assertEqual(made, wanted)

    def test_spacing_that_is_no_spacing(self):
        volumes.write_meta(self.folder / "in.mha", self.volume)
        volumes.write_raw(self.folder / "in.raw", self.volume)
        for text in ("0,1,1", "-1,1,1", "nan,1,1", "inf,1,1", "1e13,1,1", "1e-13,1,1"):
            for command in (["info", "in.mha"], ["extract", "in.mha", "out.mha"], ["distance", "in.mha", "out.mha"]):
                self.assert_fails(USAGE, ["--spacing", "greater than 0", "from 1e-12 to 1e+12"], *command, "--spacing", text)
        for text in ("1,1", "1,1,1,1"):
            self.assert_refused("in.mha", ["spacing", text, "3 axes"], USAGE, ["--spacing", text])
        self.assert_fails(USAGE, ["--spacing", "'x'"], "info", "in.mha", "--spacing", "1,x,1")
        raw = ["in.raw", *volumes.raw_options(self.volume)[:4]]
        self.assert_fails(USAGE, ["--spacing 1,1", "3 axes"], "info", *raw, "--spacing", "1,1")

    def test_warning_of_unequal_spacing(self):
        """Beyond a ratio of 4, on the error stream and in the report; not where the lengths do not count."""
        for spacing, arguments, warns in (
            ("1,1,4", [], False),
            ("1,1,5", [], False),
            ("1,1,5", ["--resample", "off"], True),
            ("0.4,2.5,0.4", ["--resample", "off"], True),
        ):
            volumes.write_meta(self.folder / "in.mha", self.volume)
            options = ["--spacing", spacing, "--lower", 72, "--report", "r.json", "--overwrite", *arguments]
            result = self.extract("in.mha", "out.mha", *options)
            found = json.loads((self.folder / "r.json").read_text())["warnings"]
            codes = [warning["code"] for warning in found]
            self.assertEqual("unequal_spacing" in codes, warns, (spacing, arguments))
            self.assertEqual(any("sheets have holes" in warning for warning in result.warnings), warns, result.warnings)

    def test_unequal_spacing_is_resampled(self):
        """Beyond a ratio of 4 sheets and thickness need equal spacing; vectors do not."""
        volumes.write_meta(self.folder / "in.mha", self.volume)
        size = self.volume.size
        for command, spacing, arguments, resamples in (
            ("extract", "1,1,4", [], False),
            ("extract", "1,1,4.5", [], True),
            ("extract", "2,0.4,0.4", [], True),
            ("mesh", "1,1,4.5", [], True),
            ("surface", "1,1,4.5", [], True),
            ("distance", "1,1,4.5", [], False),
            ("extract", "1,1,4.5", ["--resample", "off"], False),
        ):
            with self.subTest(command=command, spacing=spacing, arguments=arguments):
                output = "out.ply" if command in ("mesh", "surface") else "out.mha"
                options = ["--spacing", spacing, "--lower", 72, "--report", "r.json", "--overwrite"]
                table = self.run_program(command, "in.mha", output, *options, *arguments).stdout
                found = json.loads((self.folder / "r.json").read_text())["parameters"]["resampled_spacing"]
                least = min(float(step) for step in spacing.split(","))
                self.assertEqual(found, [least] * 3 if resamples else None)
                self.assertEqual("resampled " in table, resamples, table)
        self.run_program("extract", "in.mha", "auto.mha", "--spacing", "1,1,4.5", "--lower", 72, "--resample", "auto")
        self.run_program("extract", "in.mha", "out.mha", "--spacing", "1,1,4.5", "--lower", 72, "--overwrite")
        self.assertEqual((self.folder / "out.mha").read_bytes(), (self.folder / "auto.mha").read_bytes())
        self.run_program("plan", "in.mha", "jobs.mha", "job", "--spacing", "1,1,4.5", "--lower", 72, "--divisions", 3)
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertEqual((self.folder / "jobs.mha").read_bytes(), (self.folder / "auto.mha").read_bytes())
        self.run_program("plan", "in.mha", "kept.mha", "kept", "--spacing", "1,1,4.5", "--lower", 72, "--resample", "off")
        self.run_program("work", "kept")
        self.run_program("finalize", "kept")
        self.assertEqual(volumes.read_header(self.folder / "kept.mha")[0]["DimSize"], " ".join(map(str, size)))

    def test_sizes_that_resampling_cannot_have(self):
        (self.folder / "in.raw").write_bytes(bytes(2 * 2200000))
        options = ["in.raw", "out.mha", "--raw-size", "2200000,2", "--raw-type", "uint8", "--spacing", "1,0.001"]
        self.assert_fails(USAGE, ["in.raw", "resampled spacing 0.001", "--resample off"], "extract", *options)

    def test_jobs_keep_the_spacing(self):
        volumes.write_meta(self.folder / "in.mha", self.volume)
        self.extract("in.mha", "whole.mha", "--lower", 72, "--spacing", "0.5,0.25,2")
        plan = ["--lower", 72, "--spacing", "0.5,0.25,2", "--divisions", 3, "--thickness", 3]
        self.run_program("plan", "in.mha", "out.mha", "job", *plan)
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertEqual((self.folder / "out.mha").read_bytes(), (self.folder / "whole.mha").read_bytes())


if __name__ == "__main__":
    unittest.main()
