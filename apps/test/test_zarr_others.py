# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Zarr of versions 2 and 3 as other programs write it: codecs, shards, types, and what is wrong with some."""

import json
import pathlib
import random
import shutil
import struct
import subprocess
import unittest

import volumes
from interpreters import python_with
from program import CORRUPT, PROGRAM, USAGE, ProgramTestCase

WRITE_ZARR = pathlib.Path(__file__).with_name("write_zarr.py")
SIZE = (37, 31, 23)
# Half of the values are in arrays of all types, so that int8 has them.
HALVES = ("-u1", "-i1", "-u2", "-i2", "-u4", "-i4", "-u8", "-i8", "-f4", "-f8", "shards-0", "shards-1", "shards-2")


def make_volume():
    rng = random.Random(5)
    volume = volumes.Volume(SIZE, [], spacing=(0.5, 1.0, 2.0))
    volume.voxels = bytes(
        200 if 8 <= y < 13 and 4 <= z < 20 and x < 30 else rng.choice((0, 0, 130, 90)) if 15 <= x < 18 and z > 9 else 0
        for z in range(SIZE[2])
        for y in range(SIZE[1])
        for x in range(SIZE[0])
    )
    return volume


class ZarrOfOthersTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        python = python_with("zarr.codecs, ngff_zarr")
        if not python:
            self.skipTest("no Python with zarr 3 and ngff_zarr here")
        self.volume = make_volume()
        (self.folder / "volume.raw").write_bytes(self.volume.voxels)
        result = subprocess.run(
            [python, WRITE_ZARR, self.folder, self.folder / "volume.raw", ",".join(map(str, SIZE))],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        self.names = json.loads(result.stdout.splitlines()[-1])
        for name in ("v2-blosc-3.zarr", "v2-zstd-2.zarr"):
            found = subprocess.run([PROGRAM, "info", self.folder / name], capture_output=True, text=True, check=False)
            if "built without" in found.stderr:
                self.skipTest(found.stderr)
        self.source = volumes.write_meta(self.folder / "in.mha", self.volume)
        self.expected = self.labels(self.source)

    def threshold(self, name):
        return 50 if any(half in name for half in HALVES) else 100

    def labels(self, name, *arguments):
        self.extract(name, "out.mha", "--overwrite", "--lower", self.threshold(str(name)), "--spacing", "1,1,1",
                     *arguments)  # fmt: skip
        return volumes.read_data(self.folder / "out.mha")

    def test_same_labels(self):
        self.assertGreater(len(self.names), 70)
        for name in self.names:
            self.assertEqual(self.labels(name), self.expected, name)

    def test_any_division(self):
        rng = random.Random(7)
        for name in self.names:
            if rng.random() < 0.3:
                run = ("--divisions", rng.randint(1, 23), "--threads", rng.randint(1, 4), "--memory", "30M")
                self.assertEqual(self.labels(name, *run), self.expected, f"{name} {run}")

    def test_place_in_space_and_levels(self):
        for name in (name for name in self.names if name.startswith("ngff")):
            self.extract(name, "out.mha", "--overwrite", "--lower", 100)
            fields, _ = volumes.read_header(self.folder / "out.mha")
            self.assertEqual((fields["ElementSpacing"], fields["Offset"]), ("0.5 1 2", "6.25 5.5 5"))
            text = self.run_program("info", name, "--resolution", 1).stdout
            self.assertRegex(text, r"level +1 of 0 to 2\n")
            self.assertRegex(text, r"size +18 x 15 x 11\n")
            self.assert_fails(USAGE, [name, "level 3", "0 to 2"], "info", name, "--resolution", 3)
        self.assert_fails(USAGE, ["in.mha", "level 1", "MetaImage"], "info", "in.mha", "--resolution", 1)
        self.assert_fails(USAGE, ["v3-default.zarr", "level 1"], "info", "v3-default.zarr", "--resolution", 1)

    def test_info(self):
        text = self.run_program("info", "shards-0.zarr", "--values").stdout
        self.assertRegex(text, r"streams: chunks of 5 x 4 x 3, packed by blosc \(zstd\), .* each alone from its shard")
        plain = self.run_program("info", "in.mha", "--values").stdout
        for line in ("values", "minimum", "maximum", "mean", "otsu"):
            found = [text.split(f"\n{line} ")[1].split("\n")[0].strip() for text in
                     (self.run_program("info", "v3-lz4.zarr", "--values").stdout, plain)]  # fmt: skip
            self.assertEqual(*found, line)

    def test_resampled(self):
        for name in ("ngff-0.5-shards.ome.zarr", "ngff-0.4.ome.zarr"):
            for step, source in (("a", name), ("b", "in.mha")):
                self.extract(source, f"{step}.mha", "--overwrite", "--lower", 100, "--resample", 1)
            self.assertEqual(*(volumes.read_data(self.folder / f"{step}.mha") for step in "ab"))

    def test_sub_voxel(self):
        for name in ("shards-default.zarr", "v2-f-order.zarr", "v3-transposed.zarr"):
            outputs = []
            for source in ("in.mha", name):
                self.extract(source, "out.mha", "--overwrite", "--lower", 100, "--thickness-map", "t.mha", "--sub-voxel",
                             "--spacing", "1,1,1")  # fmt: skip
                outputs.append(volumes.read_data(self.folder / "t.mha"))
            self.assertEqual(*outputs, name)

    def test_jobs(self):
        for name in ("shards-1.zarr", "v2-default.zarr"):
            run = ("--lower", self.threshold(name), "--spacing", "1,1,1", "--resume", "--overwrite")
            self.extract(name, "out.mha", *run)
            self.assertEqual(volumes.read_data(self.folder / "out.mha"), self.expected)

    def files(self, name):
        return [path for path in sorted((self.folder / name).rglob("*")) if path.is_file() and path.name[0] not in ".z"]

    def test_damaged_files(self):
        """Bytes that are changed or missing are an error, or change voxels; the program never crashes."""
        rng = random.Random(11)
        packed = [name for name in self.names if "plain" not in name and "ngff" not in name]
        for name in rng.sample(packed, 20) + ["shards-default.zarr", "shards-0.zarr", "shards-2.zarr", "v3-checked.zarr"]:
            path = rng.choice(self.files(name))
            content = path.read_bytes()
            run = ("extract", name, "bad.mha", "--overwrite", "--thickness", 3)
            for cut in (content[:-1], content[: len(content) // 2], content[:3], b""):
                path.write_bytes(cut)
                self.assert_fails(CORRUPT, [name, path.name], *run)
            for _ in range(4):
                changed = bytearray(content)
                for _ in range(rng.randint(1, 4)):
                    changed[rng.randrange(len(changed))] = rng.choice((0, 1, 127, 128, 255))
                path.write_bytes(changed)
                result = subprocess.run(
                    [PROGRAM, *map(str, run)], cwd=self.folder, capture_output=True, text=True, check=False
                )
                self.assertIn(result.returncode, (0, CORRUPT), f"{name} {result.stderr}")
            path.write_bytes(content)

    def test_shard_with_a_wrong_index(self):
        path = self.files("shards-1.zarr")[0]
        content = bytearray(path.read_bytes())
        content[-16:] = struct.pack("<QQ", len(content) - 5, 6)
        path.write_bytes(content)
        run = ("extract", "shards-1.zarr", "bad.mha", "--overwrite", "--thickness", 3)
        self.assert_fails(CORRUPT, [path.name, "its index has chunk 7 at byte"], *run)
        content[-8:] = struct.pack("<Q", 1 << 63)
        path.write_bytes(content)
        self.assert_fails(CORRUPT, [path.name, str(1 << 63)], *run)
        path = self.files("shards-0.zarr")[0]
        content = bytearray(path.read_bytes())
        content[3] ^= 1
        path.write_bytes(content)
        self.assert_fails(CORRUPT, [path.name, "checksum of its index"], *run[:1], "shards-0.zarr", *run[2:])


class BadVersion3Test(ProgramTestCase):
    """Metadata of version 3 that are refused, with the file and the value."""

    GOOD = {
        "zarr_format": 3,
        "node_type": "array",
        "shape": [4, 5, 6],
        "data_type": "uint8",
        "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [4, 5, 6]}},
        "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
        "fill_value": 0,
        "codecs": ["bytes"],
        "attributes": {},
    }

    def run_with(self, **changes):
        folder = self.folder / "bad.zarr"
        shutil.rmtree(folder, ignore_errors=True)
        (folder / "c/0/0").mkdir(parents=True)
        (folder / "c/0/0/0").write_bytes(bytes(range(120)))
        metadata = {name: value for name, value in (self.GOOD | changes).items() if value != "missing"}
        (folder / "zarr.json").write_text(json.dumps(metadata))
        return ("extract", "bad.zarr", "out.mha", "--thickness", 3, "--overwrite")

    def refuse(self, parts, **changes):
        self.assert_fails(CORRUPT, ["zarr.json", *parts], *self.run_with(**changes))

    def shards(self, **changes):
        sharding = {
            "chunk_shape": [2, 5, 3],
            "codecs": [{"name": "bytes"}],
            "index_codecs": [{"name": "bytes", "configuration": {"endian": "little"}}, {"name": "crc32c"}],
        }
        return [{"name": "sharding_indexed", "configuration": sharding | changes}]

    def test_array(self):
        self.run_program(*self.run_with())
        self.refuse(["zarr_format", "2"], zarr_format=2)
        self.refuse(["data_type", "float16"], data_type="float16")
        self.refuse(["data_type", "numpy"], data_type={"name": "numpy.datetime64"})
        self.refuse(["chunk_grid", "rectangular"], chunk_grid={"name": "rectangular", "configuration": {}})
        self.refuse(["chunk_key_encoding", "fan"], chunk_key_encoding={"name": "fan"})
        self.refuse(["separator", "x"], chunk_key_encoding={"name": "v2", "configuration": {"separator": "x"}})
        self.refuse(["fill_value", "AA"], fill_value="AA==")
        self.refuse(["fill_value", "0x00"], fill_value="0x00")
        self.refuse(["fill_value", "300"], fill_value=300)
        self.refuse(["storage_transformers"], storage_transformers=[{"name": "x"}])
        self.refuse(["64 MiB"], chunk_grid={"name": "regular", "configuration": {"chunk_shape": [1, 1 << 20, 1 << 20]}})
        self.refuse(["shape"], shape=[4, 5, "6"])
        self.refuse(["must have 3 axes"], chunk_grid={"name": "regular", "configuration": {"chunk_shape": [4, 5]}})
        self.refuse(["only one value"], shape=[2, 4, 5, 6],
                    chunk_grid={"name": "regular", "configuration": {"chunk_shape": [1, 4, 5, 6]}})  # fmt: skip
        for name in ("zarr_format", "shape", "data_type", "chunk_grid", "chunk_key_encoding", "fill_value", "codecs"):
            self.refuse([name], **{name: "missing"})

    def test_codecs(self):
        self.refuse(["bz2", "gzip"], codecs=["bytes", {"name": "bz2"}])
        self.refuse(["bytes must be"], codecs=[])
        self.refuse(["may come first"], codecs=["gzip", "bytes"])
        self.refuse(["endian", "middle"], codecs=[{"name": "bytes", "configuration": {"endian": "middle"}}])
        self.refuse(["more than 4 times"], codecs=["bytes", *["gzip"] * 5])
        for order in ([0, 0, 1], [0, 1], [1, 2, 3], []):
            self.refuse(["transposed", str(order[:1])[1:-1]],
                        codecs=[{"name": "transpose", "configuration": {"order": order}}, "bytes"])  # fmt: skip
        self.refuse(["metadata"], codecs=[{"name": "transpose", "configuration": {"order": "F"}}, "bytes"])
        self.refuse(["metadata"], codecs=[5])

    def test_shards(self):
        self.refuse(["index_location", "middle"], codecs=self.shards(index_location="middle"))
        self.refuse(["index_codecs", "gzip"], codecs=self.shards(index_codecs=["bytes", "gzip"]))
        self.refuse(["divide the shards"], codecs=self.shards(chunk_shape=[3, 5, 3]))
        self.refuse(["may come first"], codecs=[*self.shards(), "gzip"])
        self.refuse(["sharding_indexed"], codecs=self.shards(codecs=self.shards()))
        self.refuse(["shards have 8000000 chunks"], shape=[200] * 3, codecs=self.shards(chunk_shape=[1, 1, 1]),
                    chunk_grid={"name": "regular", "configuration": {"chunk_shape": [200] * 3}})  # fmt: skip
        path = self.folder / "bad.zarr/c/0/0/0"
        run = self.run_with(codecs=self.shards())
        self.assert_fails(CORRUPT, [path.name, "checksum of its index"], *run)
        path.write_bytes(b"short")
        self.assert_fails(CORRUPT, [path.name, "has 5 bytes", "68"], *run)
        path.unlink()
        self.run_program(*run)

    def test_chunk_of_another_size(self):
        run = self.run_with(codecs=["bytes", "gzip"])
        (self.folder / "bad.zarr/c/0/0/0").write_bytes(bytes(100000))
        self.assert_fails(CORRUPT, ["c/0/0/0", "has 100000 bytes", "at most"], *run)


if __name__ == "__main__":
    unittest.main()
