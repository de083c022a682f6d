# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Zarr folders as inputs: those of the program and of others, and what is wrong with some."""

import json
import random
import unittest

import volumes
import zarr_folder
from program import CORRUPT, FAILURE, REFUSED, ProgramTestCase

PACKERS = (None, {"id": "zlib", "level": 1}, {"id": "gzip", "level": 1})


class ZarrInputTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(size=(24, 20, 16), spacing=(0.5, 1.0, 2.0))
        self.expect(self.volume)

    def expect(self, volume):
        volumes.write_meta(self.folder / "in.mha", volume)
        self.extract("in.mha", "expected.mha", "--lower", 50, "--overwrite")

    def assert_same(self, name, *arguments):
        """Labels and geometry are those of the MetaImage, whose origin is 0."""
        self.extract(name, "out.mha", "--lower", 50, "--overwrite", *arguments)
        data = volumes.read_data(self.folder / "out.mha")
        self.assertEqual(data, volumes.read_data(self.folder / "expected.mha"), f"{name} {arguments}")
        fields, _ = volumes.read_header(self.folder / "out.mha")
        self.assertEqual(fields["ElementSpacing"], "0.5 1 2")
        self.assertEqual(fields["Offset"], "6.25 5.5 5")

    def test_types_orders_and_packings(self):
        for number, kind in enumerate(volumes.TYPES):
            name = f"{kind}.zarr"
            zarr_folder.write_image(
                self.folder / name, self.volume.as_type(kind), (5, 7, 9), PACKERS[number % 3],
                big_endian=number % 2 == 0, leading=number % 3, separator="./"[number % 2],
            )  # fmt: skip
            self.assert_same(name)

    def test_own_outputs(self):
        self.run_program("distance", "in.mha", "v.mha", "--distance", "d.mha", "--lower", 50)
        for compression in ("none", "gzip"):
            self.run_program(
                "distance", "in.mha", "v.zarr", "--distance", "d.zarr", "--lower", 50,
                "--compress", compression, "--overwrite",
            )  # fmt: skip
            self.extract("d.mha", "a.mha", "--upper", -0.1, "--overwrite")
            self.extract("d.zarr/", "b.mha", "--upper", -0.1, "--overwrite")
            self.assertEqual((self.folder / "a.mha").read_bytes(), (self.folder / "b.mha").read_bytes())
            self.extract("d.zarr/0", "b.mha", "--upper", -0.1, "--overwrite")

    def test_any_division_reads_the_same(self):
        rng = random.Random(3)
        for number in range(12):
            size = tuple(rng.randint(1, 40) for _ in range(3))
            volume = volumes.Volume(size, [rng.choice((0, 0, 100)) for _ in range(size[0] * size[1] * size[2])])
            volume.spacing = (0.5, 1.0, 2.0)
            self.expect(volume)
            chunks = [rng.randint(1, 50) for _ in range(3)]
            zarr_folder.write_image(self.folder / f"{number}.zarr", volume, chunks, PACKERS[number % 3])
            self.assert_same(f"{number}.zarr", "--divisions", rng.randint(1, 40))

    def test_chunks_without_a_file_have_the_fill_value(self):
        empty = volumes.Volume(self.volume.size, [0] * len(self.volume.voxels), kind="int16")
        for number, packer in enumerate(PACKERS):
            name = f"{number}.zarr"
            zarr_folder.write_image(self.folder / name, empty, (8, 8, 8), packer, fill_value=300, big_endian=True)
            self.extract(name, "full.mha", "--lower", 300, "--report", "r.json", "--overwrite")
            report = json.loads((self.folder / "r.json").read_text())
            self.assertEqual(report["counts"]["object_voxels"], len(empty.voxels))

    def test_info(self):
        zarr_folder.write_image(self.folder / "a.zarr", self.volume, (8, 8, 8))
        text = self.run_program("info", "a.zarr").stdout
        self.assertRegex(text, r"format +Zarr\n")
        self.assertRegex(text, r"origin +6, 5, 4\n")
        self.assertIn("streams", text)
        zarr_folder.write_image(self.folder / "b.zarr", self.volume, (8, 10, 12), PACKERS[1])
        self.assertRegex(
            self.run_program("info", "b.zarr").stdout, "streams: chunks of 12 x 10 x 8, packed by zlib, are read as"
        )

    def test_two_dimensions(self):
        volume = volumes.Volume((40, 30), [100 if 10 <= x < 13 else 0 for y in range(30) for x in range(40)])
        volumes.write_meta(self.folder / "flat.mha", volume)
        for number, packer in enumerate(PACKERS):
            zarr_folder.write_image(self.folder / f"{number}.zarr", volume, (7, 16), packer, leading=1)
            for source in ("flat.mha", f"{number}.zarr"):
                self.extract(source, source + ".out.mha", "--overwrite")
            outputs = [volumes.read_data(self.folder / f"{name}.out.mha") for name in ("flat.mha", f"{number}.zarr")]
            self.assertEqual(*outputs)

    def test_memory_of_a_chunk_is_planned(self):
        volume = volumes.Volume((600, 600, 64), [])
        volume.voxels = bytes(600 * 600 * 64)
        zarr_folder.write_image(self.folder / "a.zarr", volume, (64, 600, 600), PACKERS[1])
        self.assert_fails(REFUSED, ["memory"], "extract", "a.zarr", "out.mha", "--memory", "50M", "--threads", 1)
        zarr_folder.write_image(self.folder / "b.zarr", volume, (64, 100, 100), PACKERS[1])
        self.extract("b.zarr", "out.mha", "--memory", "50M", "--threads", 1)


class BadZarrTest(ProgramTestCase):
    def refuse(self, parts, status=CORRUPT, attributes=None, description=None, **changes):
        """A folder with changed metadata is refused: fields of .zarray, or what functions make of .zattrs and .zarray."""
        folder = self.folder / "bad.zarr"
        volume = volumes.Volume((6, 5, 4), range(120))
        zarr_folder.write_image(folder, volume, (2, 5, 6))
        array = json.loads((folder / "s0/.zarray").read_text()) | changes
        array = {name: value for name, value in array.items() if value != "missing"}
        (folder / "s0/.zarray").write_text(json.dumps(array))
        for name, change in ((".zattrs", attributes), ("s0/.zarray", description)):
            if change:
                text = change(json.loads((folder / name).read_text()))
                (folder / name).write_text(text if isinstance(text, str) else json.dumps(text))
        self.assert_fails(status, ["bad.zarr", *parts], "extract", "bad.zarr", "out.mha", "--thickness", 3)
        for path in sorted(folder.rglob("*"), reverse=True):
            path.unlink() if path.is_file() else path.rmdir()
        folder.rmdir()

    def test_array(self):
        self.refuse(["lzma", "gzip, zlib"], compressor={"id": "lzma"})
        self.refuse(["order", "X"], order="X")
        self.refuse(["dtype", "<f2"], dtype="<f2")
        self.refuse(["dtype"], dtype=[["r", "|u1"]])
        self.refuse(["dtype"], dtype="<u")
        self.refuse(["zarr_format is 3", "must be 2"], zarr_format=3)
        self.refuse(["filters"], filters=[{"id": "delta"}])
        self.refuse(["fill_value"], fill_value=256)
        self.refuse(["fill_value"], fill_value="AAAA")
        self.refuse(["separator", "x"], dimension_separator="x")
        self.refuse(["only one value per voxel"], shape=[2, 2, 4, 5, 6], chunks=[1, 1, 2, 5, 6])
        self.refuse(["chunks"], chunks=[2, 5])
        for name in ("shape", "chunks"):
            for value in ([0, 5, 6], [-1, 5, 6], [4.5, 5, 6], ["4", 5, 6], [], "456", None, [1 << 40] * 3, [1] * 9):
                self.refuse([name], **{name: value})
        for name in ("shape", "chunks", "dtype", "order", "compressor", "fill_value", "zarr_format"):
            self.refuse([name], **{name: "missing"})
        self.refuse(["not JSON"], description=lambda _: "{")
        self.refuse(["not the metadata"], description=lambda _: "[]")
        self.refuse(["within each other"], description=lambda _: "[" * 100000)
        self.refuse(["within each other"], description=lambda _: "[" * 100000 + "]" * 100000)
        self.refuse(["not JSON"], description=lambda _: "[" + "1" * 100000 + "x")
        self.refuse(["100000 values"], description=lambda _: "[" + "[]," * 10**6 + "[]]")
        self.refuse(["not JSON"], description=lambda _: "1e999")
        self.refuse(["64 MiB"], chunks=[1, 1 << 20, 1 << 20])
        self.refuse(["64 MiB"], chunks=[1, 1 << 20, 1 << 20], compressor={"id": "gzip"})
        self.refuse(["bytes allowed"], description=lambda _: " " * (5 << 20))
        self.refuse(["id"], compressor={})

    def test_image(self):
        def change(**values):
            return lambda attributes: {"multiscales": [{**attributes["multiscales"][0], **values}]}

        self.refuse(["multiscales"], attributes=lambda _: {})
        self.refuse(["metadata"], attributes=lambda _: {"multiscales": [5]})
        self.refuse(["metadata"], attributes=change(datasets=[]))
        self.refuse(["stay in the folder"], attributes=change(datasets=[{"path": "../s0"}]))
        self.refuse(["stay in the folder"], attributes=change(datasets=[{"path": "/s0"}]))
        self.refuse(["s1"], attributes=change(datasets=[{"path": "s1"}]))
        self.refuse(["axes"], attributes=change(axes=[{"name": name, "type": "space"} for name in "xyz"]))
        transforms = [
            [{"type": "affine", "affine": []}],
            [{"type": "scale", "scale": [1.0]}],
            [{"type": "scale"}],
            [{"type": "scale", "scale": [1.0, -1.0, 1.0]}],
            [{"type": "scale", "scale": [1.0, 0.0, 1.0]}],
            [{"type": "translation", "translation": [1e308, 0.0, 0.0]}] * 2,
        ]
        for transform in transforms:
            self.refuse([], attributes=change(datasets=[{"path": "s0", "coordinateTransformations": transform}]))
        (self.folder / "bad.zarr").mkdir()
        run = ("extract", "bad.zarr", "out.mha", "--thickness", 3)
        self.assert_fails(CORRUPT, ["not a Zarr folder"], *run)
        (self.folder / "bad.zarr/zarr.json").write_text("{}")
        self.assert_fails(CORRUPT, ["zarr.json", "multiscales"], *run)
        self.assert_fails(FAILURE, ["missing.zarr"], "extract", "missing.zarr", "out.mha", "--thickness", 3)

    def test_chunk_that_is_cut_or_damaged(self):
        volume = volumes.Volume((6, 5, 4), range(120))
        for number, packer in enumerate(PACKERS):
            chunk = zarr_folder.write_image(self.folder / f"{number}.zarr", volume, (2, 5, 6), packer) / "s0/1.0.0"
            content = chunk.read_bytes()
            run = ("extract", f"{number}.zarr", "out.mha", "--thickness", 3)
            self.run_program(*run)
            (self.folder / "out.mha").unlink()
            for bad in (content[:-1], content[:5], b"", content + b"x" if packer is None else content[:9] + b"x" * 40):
                chunk.write_bytes(bad)
                self.assert_fails(CORRUPT, ["1.0.0"], *run)


if __name__ == "__main__":
    unittest.main()
