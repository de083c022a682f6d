# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Outputs that are Zarr folders have the voxels of files, and appear complete or not at all."""

import json
import pathlib
import signal
import subprocess
import time
import unittest

import volumes
import zarr_folder
from interpreters import python_with
from program import PROGRAM, REFUSED, USAGE, ProgramTestCase, unprivileged

READ_ZARR = pathlib.Path(__file__).with_name("read_zarr.py")


def make_part(size=(300, 70, 80)):
    """A plate across the chunks, and nothing in the last slices."""
    volume = volumes.Volume(size, [], spacing=(0.25, 0.5, 0.75)[: len(size)])
    row = bytes(1 if 40 <= x < 290 else 0 for x in range(size[0]))
    volume.voxels = b"".join(
        row if 3 <= y < 8 + z // 8 and z < 50 else bytes(size[0]) for z in range(size[2]) for y in range(size[1])
    )
    return volume


class ZarrOutputTest(ProgramTestCase):
    ALL = ("--vectors", "v{0}", "--distance", "d{0}", "--thickness-map", "t{0}")

    def write_all(self, source, extension, *arguments):
        self.extract(source, "l" + extension, *(a.format(extension) for a in self.ALL), *arguments)

    def folder_contents(self, name):
        root = self.folder / name
        return {str(path.relative_to(root)): path.read_bytes() for path in root.rglob("*") if path.is_file()}

    def test_same_voxels_as_files(self):
        source = volumes.write_meta(self.folder / "in.mha", make_part(), Offset="1.5 2.5 -3.5")
        self.write_all(source, ".mha")
        for compression in ("none", "gzip"):
            self.write_all(source, ".ome.zarr", "--overwrite", "--compress", compression)
            for name in "lvdt":
                data = zarr_folder.read_data(self.folder / f"{name}.ome.zarr")
                self.assertEqual(data, volumes.read_data(self.folder / f"{name}.mha"), f"{name} {compression}")
        self.assertEqual(sorted(path.suffix for path in self.folder.iterdir()), [".mha"] * 5 + [".zarr"] * 4)

    def test_metadata(self):
        source = volumes.write_meta(self.folder / "in.mha", make_part(), Offset="1.5 2.5 -3.5")
        self.extract(source, "part.ome.zarr", "--vectors", "v.zarr")
        attributes, description = zarr_folder.read_metadata(self.folder / "part.ome.zarr")
        multiscale = attributes["multiscales"][0]
        self.assertEqual(multiscale["version"], "0.4")
        self.assertEqual(multiscale["name"], "part")
        self.assertEqual([axis["name"] for axis in multiscale["axes"]], ["z", "y", "x"])
        self.assertEqual(
            multiscale["datasets"][0]["coordinateTransformations"],
            [
                {"type": "scale", "scale": [0.75, 0.5, 0.25]},
                {"type": "translation", "translation": [-3.5 + 0.375, 2.5 + 0.25, 1.5 + 0.125]},
            ],
        )
        self.assertEqual(
            multiscale["datasets"][1],
            {
                "path": "1",
                "coordinateTransformations": [
                    {"type": "scale", "scale": [1.5, 1.0, 0.5]},
                    {"type": "translation", "translation": [-3.5 + 0.75, 2.5 + 0.5, 1.5 + 0.25]},
                ],
            },
        )
        self.assertEqual(len(multiscale["datasets"]), 2)
        self.assertNotIn("medialvoxel", attributes)
        self.assertEqual(description["dtype"], "|u1")
        self.assertEqual(description["shape"], [80, 70, 300])
        self.assertEqual(description["chunks"], [27, 70, 150])
        attributes, description = zarr_folder.read_metadata(self.folder / "v.zarr")
        self.assertEqual([axis["name"] for axis in attributes["multiscales"][0]["axes"]], ["c", "z", "y", "x"])
        self.assertEqual(description["shape"], [3, 80, 70, 300])
        self.assertEqual(description["chunks"], [1, 27, 70, 150])

    def test_labels_have_smaller_levels(self):
        """Each voxel is the largest one of the block that it stands for; chunks of zeros have no file."""
        source = volumes.write_meta(self.folder / "in.mha", make_part((1100, 75, 40)))
        for name, arguments in (("a.zarr", []), ("b.zarr", ["--divisions", 7, "--sparse"])):
            self.extract(source, name, *arguments)
            shape, labels = (40, 75, 1100), zarr_folder.read_data(self.folder / name)
            for level in ("1", "2", "3"):
                half = tuple((length + 1) // 2 for length in shape)
                largest = bytearray(half[0] * half[1] * half[2])
                for z in range(shape[0]):
                    for y in range(shape[1]):
                        row = labels[(z * shape[1] + y) * shape[2] :][: shape[2]]
                        pairs = bytes(map(max, row[::2], row[1::2] + row[-1:] * (shape[2] % 2)))
                        begin = (z // 2 * half[1] + y // 2) * half[2]
                        largest[begin : begin + half[2]] = map(max, largest[begin : begin + half[2]], pairs)
                self.assertEqual(zarr_folder.read_metadata(self.folder / name, level)[1]["shape"], list(half))
                shape, labels = half, zarr_folder.read_data(self.folder / name, level)
                self.assertEqual(labels, bytes(largest), f"{name} {level}")
            self.assertFalse((self.folder / name / "4").exists())
        self.extract("a.zarr", "small.mha", "--resolution", 3, "--overwrite")
        self.assertEqual(volumes.read_header(self.folder / "small.mha")[0]["DimSize"], "138 10 5")

    def test_flat_labels_have_smaller_levels(self):
        volume = volumes.Volume((600, 1), [1 if 10 <= x < 14 else 0 for x in range(600)])
        self.extract(volumes.write_meta(self.folder / "in.mha", volume), "a.zarr")
        attributes, description = zarr_folder.read_metadata(self.folder / "a.zarr", "2")
        self.assertEqual(description["shape"], [1, 150])
        scales = [dataset["coordinateTransformations"][0]["scale"] for dataset in attributes["multiscales"][0]["datasets"]]
        self.assertEqual(scales, [[1.0, 1.0], [1.0, 2.0], [1.0, 4.0]])

    def test_directions_are_kept(self):
        matrix = "0 1 0 -1 0 0 0 0 1"
        source = volumes.write_meta(self.folder / "in.mha", make_part((20, 12, 9)), TransformMatrix=matrix)
        self.extract(source, "a.zarr", "--distance", "d.zarr")
        attributes, _ = zarr_folder.read_metadata(self.folder / "d.zarr")
        self.assertEqual(attributes["medialvoxel"]["direction"], [[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        self.extract("d.zarr", "again.mha", "--upper", -0.1)
        fields, _ = volumes.read_header(self.folder / "again.mha")
        self.assertEqual(fields["TransformMatrix"], matrix)

    def test_any_division_gives_the_same_files(self):
        source = volumes.write_meta(self.folder / "in.mha", make_part())
        for more in (["--sparse"], ["--compress", "none"], []):
            self.write_all(source, ".zarr", "--overwrite", *more)
            expected = {name: self.folder_contents(f"{name}.zarr") for name in "lvdt"}
            for run in (["--divisions", 7, "--threads", 1], ["--divisions", 40, "--threads", 3]):
                self.write_all(source, ".zarr", "--overwrite", *more, *run)
                for name in "lvdt":
                    self.assertEqual(self.folder_contents(f"{name}.zarr"), expected[name], f"{name} {more} {run}")
            if more == ["--sparse"]:
                self.assertNotIn("0/2/0/0", expected["l"])

    def test_pictures_are_those_of_files(self):
        source = volumes.write_meta(self.folder / "in.mha", make_part())
        for extension in (".mha", ".zarr"):
            names = ["--preview", f"p{extension}.png", "--thickness-map", f"t{extension}"]
            self.extract(source, "l" + extension, *names)
        pictures = [(self.folder / f"p{extension}.png").read_bytes() for extension in (".mha", ".zarr")]
        self.assertEqual(*pictures)

    def test_two_dimensions(self):
        volume = volumes.Volume((60, 40), [1 if 10 <= x < 14 else 0 for y in range(40) for x in range(60)])
        source = volumes.write_meta(self.folder / "in.mha", volume)
        self.run_program("distance", source, "v.zarr", "--distance", "d.zarr", "--compress", "none")
        self.run_program("distance", source, "v.mha", "--distance", "d.mha")
        _, description = zarr_folder.read_metadata(self.folder / "v.zarr")
        self.assertEqual(description["shape"], [2, 40, 60])
        data = (self.folder / "d.zarr/0/0/0").read_bytes()
        self.assertEqual(data, volumes.read_data(self.folder / "d.mha"))


class ZarrFolderTest(ProgramTestCase):
    """What stands where the folder is to be."""

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate())
        self.run = ("extract", "in.mha", "out.zarr", "--thickness", 3)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_existing_folder(self):
        self.run_program(*self.run)
        (self.folder / "out.zarr/mine").write_text("note")
        self.assert_fails(REFUSED, ["out.zarr exists", "--overwrite"], *self.run)
        self.assert_fails(REFUSED, ["memory"], *self.run, "--overwrite", "--memory", "1M")
        self.assertTrue((self.folder / "out.zarr/mine").exists())
        self.run_program(*self.run, "--overwrite")
        self.assertFalse((self.folder / "out.zarr/mine").exists())
        self.assertEqual(self.names(), ["in.mha", "out.zarr"])

    def test_something_else_is_never_replaced(self):
        (self.folder / "out.zarr").mkdir()
        (self.folder / "out.zarr/mine").write_text("note")
        self.assert_fails(REFUSED, ["out.zarr", "not a Zarr folder"], *self.run, "--overwrite")
        (self.folder / "out.zarr/mine").unlink()
        (self.folder / "out.zarr").rmdir()
        (self.folder / "out.zarr").write_text("note")
        self.assert_fails(REFUSED, ["out.zarr", "not a Zarr folder"], *self.run, "--overwrite")

    def test_link_is_followed(self):
        (self.folder / "there").mkdir()
        (self.folder / "out.zarr").symlink_to("there/real.zarr")
        self.run_program(*self.run)
        self.assertTrue((self.folder / "out.zarr").is_symlink())
        self.assertTrue((self.folder / "there/real.zarr/0/.zarray").exists())

    def test_folder_of_input_or_other_output(self):
        self.run_program(*self.run)
        again = ("extract", "out.zarr", "--thickness", 3, "--overwrite")
        self.assert_fails(USAGE, ["out.zarr", "one Zarr folder"], *again, "out.zarr")
        self.assert_fails(USAGE, ["one Zarr folder"], *again, "out.zarr/labels.mha")
        self.assert_fails(USAGE, ["one Zarr folder"], *again, "new.mha", "--report", "out.zarr/.zattrs")
        self.assert_fails(USAGE, ["one Zarr folder"], "extract", "out.zarr/0", "out.zarr", "--overwrite")
        self.assert_fails(USAGE, ["one Zarr folder"], *self.run, "--overwrite", "--report", "out.zarr/r.json")

    def test_folder_that_cannot_be_written(self):
        closed = self.folder / "closed"
        closed.mkdir()
        self.folder.chmod(0o755)
        closed.chmod(0o555)
        run = ("extract", "in.mha", "closed/out.zarr", "--thickness", 3)
        self.assert_fails(REFUSED, ["closed/out.zarr", "Permission denied"], *run, **unprivileged())
        self.assert_fails(REFUSED, ["missing", "does not exist"], "extract", "in.mha", "missing/out.zarr")

    def test_disk_without_space(self):
        disk = self.folder / "disk"
        self.mount_small_disk(disk, "64K")
        volumes.write_meta(self.folder / "big.mha", make_part((300, 70, 80)))
        (disk / "old.zarr").mkdir()
        (disk / "old.zarr/.zgroup").write_text("{}")
        for more in ([], ["--sparse"], ["--compress"]):
            for name in ("disk/new.zarr", "disk/old.zarr"):
                self.assert_fails(
                    1 if more else REFUSED, ["disk"], "extract", "big.mha", "l.mha", "--thickness", 3,
                    "--distance", name, "--overwrite", *(more or ["--compress", "none"]),
                )  # fmt: skip
                self.assertEqual([path.name for path in disk.iterdir()], ["old.zarr"])

    def test_kill_at_any_time(self):
        """Whenever it comes, a complete folder has the final name, or none has."""
        volumes.write_meta(self.folder / "in.mha", make_part((300, 100, 100)))
        self.run_program(*self.run, "--vectors", "v.zarr")
        expected = [zarr_folder.read_data(self.folder / name) for name in ("out.zarr", "v.zarr")]
        for name in ("out.zarr", "v.zarr"):
            (self.folder / name).rename(self.folder / ("whole-" + name))
        for number in (signal.SIGKILL, signal.SIGTERM):
            for delay in (0.01, 0.03, 0.05, 0.08, 0.12, 0.2):
                process = subprocess.Popen(
                    [PROGRAM, *map(str, self.run), "--vectors", "v.zarr", "--overwrite", "--divisions", "20"],
                    cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                )  # fmt: skip
                time.sleep(delay)  # moments all over the run, or after its end: what holds, holds at any time
                process.send_signal(number)
                process.wait()
                for name, data in zip(("out.zarr", "v.zarr"), expected):
                    if (self.folder / name).exists():
                        self.assertEqual(zarr_folder.read_data(self.folder / name), data)
                partial = list(self.folder.glob("*.partial"))
                if number == signal.SIGTERM:
                    self.assertEqual(partial, [])
                for left in partial:
                    subprocess.run(["rm", "-r", left], check=True)


class ZarrReadersTest(ProgramTestCase):
    """Programs of others read the folders."""

    def setUp(self):
        super().setUp()
        source = volumes.write_meta(self.folder / "in.mha", make_part(), Offset="1.5 2.5 -3.5")
        for compression in ("none", "gzip", "blosc-zstd"):
            names = (f"l-{compression}.zarr", "--vectors", f"v-{compression}.zarr")
            self.extract(source, *names, "--sparse", "--compress", compression)
        self.extract(source, "l.mha", "--vectors", "v.mha")

    def check(self, module):
        python = python_with(module)
        if not python:
            self.skipTest(f"no Python with the module {module} here")
        for name in ("l-none", "l-gzip", "l-blosc-zstd", "v-none", "v-gzip", "v-blosc-zstd"):
            result = subprocess.run(
                [python, READ_ZARR, module, self.folder / f"{name}.zarr", self.folder / "data.raw"],
                capture_output=True, text=True, check=False,
            )  # fmt: skip
            self.assertEqual(result.returncode, 0, result.stderr)
            data = (self.folder / "data.raw").read_bytes()
            self.assertEqual(data, volumes.read_data(self.folder / f"{name[0]}.mha"), f"{module} {name}")
            found = json.loads(result.stdout.splitlines()[-1])
            self.assertEqual(found["levels"], 2 if name[0] == "l" else 1)
            shift = 0.5 if name[0] == "l" else 0.0
            self.assertEqual(found["scale"][-3:], [0.75, 0.5, 0.25])
            self.assertEqual(
                found["translation"][-3:], [-3.5 + 0.75 * shift, 2.5 + 0.5 * shift, 1.5 + 0.25 * shift]
            )

    def test_zarr(self):
        self.check("zarr")

    def test_ngff_zarr(self):
        self.check("ngff_zarr")

    def test_ome_zarr_models(self):
        self.check("ome_zarr_models")


if __name__ == "__main__":
    unittest.main()
