# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Stacks of TIFF as others write them: which pages and files belong together, and what their numbers mean."""

import json
import unittest

import volumes
from program import CORRUPT, needs_tiff
from series import SeriesTestCase

OME = (
    '<OME><Image><Pixels SizeC="1" SizeT="1" SizeZ="{}" PhysicalSizeX="500" PhysicalSizeY="500" PhysicalSizeZ="800">'
    "{}</Pixels></Image></OME>"
)


READ_MASK = """
import json, sys, numpy
spec = json.loads(sys.argv[1])
mask = numpy.fromfile(spec["raw"], spec["type"]).reshape(spec["size"][::-1]) >= 50
"""
WRITE_MASK = {
    "tifffile": READ_MASK
    + """
import tifffile
tifffile.imwrite(spec["file"], mask, photometric="minisblack", **spec["options"])
""",
    "PIL": READ_MASK
    + """
import PIL.Image
pages = [PIL.Image.fromarray(page) for page in mask]
pages[0].save(spec["file"], save_all=True, append_images=pages[1:], **spec["options"])
""",
}


@needs_tiff
class StackTest(SeriesTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()
        width, height, self.depth = self.volume.size
        self.slices = [self.volume.voxels[z * width * height :][: width * height] for z in range(self.depth)]

    def write_slices(self, folder, *names):
        (self.folder / folder).mkdir(exist_ok=True)
        for z, voxels in enumerate(self.slices):
            for name in names:
                image = volumes.Volume(self.volume.size[:2], voxels, kind=self.volume.kind)
                volumes.write_tiff(self.folder / folder / name.format(z), image)
        return self.folder / folder

    def size(self, source):
        lines = self.run_program("info", source).stdout.splitlines()
        return next(line.split("  ", 1)[1].strip() for line in lines if line.startswith("size"))

    def warnings_of(self, source):
        self.run_program("extract", source, "o.mha", "--lower", 50, "--report", "r.json", "--overwrite")
        return [warning["code"] for warning in json.loads((self.folder / "r.json").read_text())["warnings"]]

    def test_sets_in_one_folder_are_refused(self):
        whole = " x ".join(map(str, self.volume.size))
        for number, names in enumerate((("A_{:03}.tif", "B_{:03}.tif"), ("scan1_{:03}.tif", "scan2_{:03}.tif"))):
            folder = self.write_slices(f"sets{number}", *names)
            for source in (folder, folder / "*.tif"):
                self.assert_fails(CORRUPT, [names[0].format(0), "different sets", "pattern"], "info", source)
            self.assertEqual(self.size(folder / names[0].format(0).replace("000", "%03d")), whole)
        folder = self.write_slices("stray", "img{:04}.tif")
        (folder / "projection.tif").write_bytes((folder / "img0003.tif").read_bytes())
        self.assert_fails(CORRUPT, ["projection.tif", "pattern"], "info", folder)
        self.assertEqual(self.size(folder / "img%04d.tif"), whole)
        folder = self.write_slices("signed", "slice_{:03}.tif")
        (folder / "slice_000.tif").rename(folder / "slice_-01.tif")
        self.assert_fails(CORRUPT, ["slice_-01.tif"], "info", folder)

    def test_names_that_are_alike_are_one_set(self):
        whole = " x ".join(map(str, self.volume.size))
        for number, name in enumerate(("a ({}).tif", "{}.tif", "run_2024_12_{:02}.tif", "x{:05}_rec.tif")):
            self.assertEqual(self.size(self.write_slices(f"alike{number}", name)), whole)

    def test_pages_are_as_many_as_the_description_says(self):
        for text in (
            f"ImageJ=1.53t\nimages={self.depth + 4}\nslices={self.depth + 4}\nunit=mm\n",
            OME.format(self.depth + 4, ""),
        ):
            volumes.write_tiff(self.folder / "in.tif", self.volume, tag_270=text.encode() + b"\0")
            parts = [f"{self.depth + 4} slices", f"it has {self.depth}"]
            self.assert_fails(CORRUPT, ["in.tif", *parts], "info", "in.tif")

    def test_arrays_of_tifffile(self):
        """As it describes arrays whose axes it is not told."""
        width, height, depth = self.volume.size
        for shape, is_read in (
            ([depth, height, width], True),
            ([1, depth, height, width], True),
            ([depth, height, width, 1], True),
            ([2, depth // 2, height, width], False),
            ([depth + 1, height, width], False),
        ):
            volumes.write_tiff(self.folder / "in.tif", self.volume, tag_270=json.dumps({"shape": shape}).encode() + b"\0")
            if is_read:
                self.size("in.tif")
            else:
                parts = ["of the shape", ", ".join(map(str, shape))] if len(shape) == 4 else [f"{depth + 1} slices"]
                self.assert_fails(CORRUPT, ["in.tif", *parts], "info", "in.tif")

    def test_orders_of_planes(self):
        last = self.depth - 1
        planes = [f'<TiffData IFD="{z}" FirstZ="{z}" PlaneCount="1"/>' for z in range(self.depth)]
        turned = [f'<TiffData IFD="{z}" FirstZ="{last - z}" PlaneCount="1"/>' for z in range(self.depth)]
        for text, is_read in ((planes, True), ([], True), (['<TiffData/>'], True), (turned, False)):
            description = OME.format(self.depth, "".join(text)).encode() + b"\0"
            volumes.write_tiff(self.folder / "in.tif", self.volume, tag_270=description)
            if is_read:
                self.size("in.tif")
            else:
                self.assert_fails(CORRUPT, ["in.tif", "another order"], "info", "in.tif")

    def test_masks_and_label_images_of_imagej_are_read_as_stored(self):
        volumes.write_meta(self.folder / "in.mha", self.volume)
        self.extract("in.mha", "expected.mha", "--lower", 50)
        expected = volumes.read_data(self.folder / "expected.mha")
        for meaning, is_warned in ((1, False), (0, True), (3, True)):
            for packing in ("none", "deflate"):
                palette = {"tag_320": [0] * 768} if meaning == 3 else {}
                volumes.write_tiff(self.folder / "in.tif", self.volume, packing=packing, tag_262=meaning, **palette)
                self.extract("in.tif", "o.mha", "--lower", 50, "--spacing", "1,1,1", "--overwrite")
                self.assertEqual(volumes.read_data(self.folder / "o.mha"), expected, (meaning, packing))
                self.assertEqual("stored_values" in self.warnings_of("in.tif"), is_warned)
        text = b"ImageJ=1.53t\nunit=mm\nspacing=1\ncf=0\nc0=-1000\nc1=1\n\0"
        volumes.write_tiff(self.folder / "in.tif", self.volume, tag_270=text)
        self.assertIn("stored_values", self.warnings_of("in.tif"))

    def test_slices_of_tiles(self):
        folder = self.folder / "tiles"
        folder.mkdir()
        for z, voxels in enumerate(self.slices):
            image = volumes.Volume(self.volume.size[:2], voxels, kind=self.volume.kind)
            volumes.write_tiff(folder / f"{z:02}.tif", image, tile=(16, 16))
        volumes.write_meta(self.folder / "in.mha", self.volume)
        self.extract("in.mha", "expected.mha", "--lower", 50)
        self.extract(folder, "o.mha", "--lower", 50, "--spacing", "1,1,1")
        self.assertEqual(*(volumes.read_data(self.folder / name) for name in ("o.mha", "expected.mha")))

    def test_masks_of_one_bit(self):
        """As two other programs write them: rows begin at whole bytes, the highest bit is first."""
        file = self.folder / "in.tif"
        for size in ((21, 18, 12), (16, 18, 12), (3, 18, 12)):
            volume = volumes.blurred_wall(size=size)
            volumes.write_meta(self.folder / "in.mha", volume)
            self.extract("in.mha", "expected.mha", "--lower", 50, "--overwrite")
            for module, options in (
                ("tifffile", {}),
                ("tifffile", {"rowsperstrip": 5}),
                ("tifffile", {"tile": [16, 16]}),
                ("PIL", {"compression": "packbits"}),
                ("PIL", {"compression": "tiff_adobe_deflate"}),
            ):
                self.call_writer(["-c", WRITE_MASK[module]], module, volume, file=str(file), options=options)
                self.assertEqual(self.info("in.tif")["type"], "uint8")
                self.extract("in.tif", "o.mha", "--lower", 1, "--spacing", "1,1,1", "--overwrite")
                found, expected = (volumes.read_data(self.folder / name) for name in ("o.mha", "expected.mha"))
                self.assertEqual(found, expected, (size, options))
                self.extract("in.tif", "o.mha", "--lower", 1, "--spacing", "1,1,1", "--overwrite", "--divisions", 3)
                self.assertEqual(volumes.read_data(self.folder / "o.mha"), expected, (size, options))
            folder = self.folder / f"bits{size[0]}"
            folder.mkdir()
            for z in range(size[2]):
                image = volumes.Volume(size[:2], volume.voxels[z * size[0] * size[1] :][: size[0] * size[1]], kind=volume.kind)
                self.call_writer(["-c", WRITE_MASK["tifffile"]], "tifffile", image, file=str(folder / f"{z:02}.tif"), options={})
            self.extract(folder, "o.mha", "--lower", 1, "--spacing", "1,1,1", "--overwrite")
            self.assertEqual(volumes.read_data(self.folder / "o.mha"), expected, size)
        content = file.read_bytes()
        file.write_bytes(content[:-20])
        self.assert_fails(CORRUPT, ["in.tif"], "extract", "in.tif", "o.mha", "--lower", 1, "--overwrite")

    def test_a_distance_of_slices_that_is_a_guess_is_a_warning(self):
        inch = {"tag_282": (254, 1), "tag_283": (254, 1), "tag_296": 2}
        for tags, is_known in (
            ({}, False),
            (inch, False),
            ({**inch, "tag_270": b"ImageJ=1.53t\nunit=inch\n\0"}, True),
            ({**inch, "tag_270": b"ImageJ=1.53t\nunit=um\n\0"}, True),
            ({**inch, "tag_270": b"ImageJ=1.53t\nunit=furlong\n\0"}, False),
            ({**inch, "tag_270": b"ImageJ=1.53t\nunit=um\nzunit=pixel\n\0"}, False),
            ({"tag_270": OME.format(self.depth, "").encode() + b"\0"}, True),
        ):
            volumes.write_tiff(self.folder / "in.tif", self.volume, **tags)
            self.assertEqual("unknown_spacing" not in self.warnings_of("in.tif"), is_known, tags)


if __name__ == "__main__":
    unittest.main()
