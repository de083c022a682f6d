# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""How voxels are stored changes no byte of an output: plain or packed, in any format, unpacked to memory or to a disk."""

import gzip
import json
import pathlib
import re
import unittest
import zlib

import volumes
from jobs import JobTestCase, results
from program import READS_TIFF
from test_gray_walls import scan
from test_rims import DATA, PARTS

SPACING = (0.5, 0.5, 0.75)
PLAIN = "plain.mha"


def nifti_place(volume):
    """Fields for the axes of other formats: those of NIfTI run from right to left and from front to back."""
    if len(volume.size) < 3:
        return {}
    x, y, z = volume.spacing
    return {"xyzt_units": 0, "sform_code": 1, "srow": (-x, 0, 0, 0, 0, -y, 0, 0, 0, 0, z, 0)}


def write_storages(folder, volume):
    """The same voxels in eight ways. Returns the names."""
    volumes.write_meta(folder / PLAIN, volume)
    volumes.write_meta(folder / "packed.mha", volume, big_endian=True, compressed=True)
    volumes.write_nrrd(folder / "plain.nrrd", volume, big_endian=True)
    volumes.write_nrrd(folder / "packed.nrrd", volume, compressed=True)
    volumes.write_nifti(folder / "plain.nii", volume, **nifti_place(volume))
    volumes.write_nifti(folder / "packed.nii.gz", volume, big_endian=True, **nifti_place(volume))
    if READS_TIFF:
        volumes.write_tiff(folder / "plain.tif", volume)
        volumes.write_tiff(folder / "packed.tif", volume, packing="deflate")
    return sorted(path.name for path in folder.iterdir() if path.name.startswith(("plain.", "packed.")))


class StorageTestCase(JobTestCase):
    def results(self, *arguments):
        """All outputs, without what tells which file was read, and how."""
        self.clear_target()
        self.in_target(*arguments)
        found = results(self.target)
        for content in found.values():
            if isinstance(content, dict):
                for name in ("input", "outputs", "seconds", "warnings"):
                    content.pop(name, None)
                content.get("parameters", {}).pop("input", None)
        self.assertGreater(len(found), 0)
        return found

    def compare(self, name, expected, *arguments):
        found = self.results(*arguments)
        self.assertEqual(found.keys(), expected.keys(), (name, arguments))
        for output, content in expected.items():
            self.assertTrue(found[output] == content, (name, arguments, output))

    def check(self, volume, *commands, names=None):
        spacing = ("--spacing", ",".join(map(str, volume.spacing)))
        names = names or write_storages(self.folder, volume)
        for command, *options in commands:
            expected = self.results(command, f"../{PLAIN}", *options, *spacing)
            for name in names:
                self.compare(name, expected, command, f"../{name}", *options, *spacing)
        return names


class StorageIdentityTest(StorageTestCase):
    LOWER = 2500

    def test_gray_values(self):
        volume, _ = scan(size=(44, 40, 36))
        volume.spacing = SPACING
        gray = ("--lower", self.LOWER)
        everything = (
            "--vectors v.mha --distance d.mha --thickness-map t.mha --uncertainty-map u.mha --importance i.mha --importance-threshold h.mha --walls w.mha --wall-table w.csv --seam-table s.csv --sub-voxel "
            "--mesh m.ply --places p.csv --thin-below 3 --preview p.png --report r.json"
        ).split()
        self.check(
            volume,
            ("extract", "l.mha", *gray, *everything),
            ("extract", "l.mha", *gray, "--local-thickness", "t.mha", "--divisions", 3, "--threads", 3),
            ("extract", "l.mha", *gray, "--resample", "auto", "--smooth", "on", "--thickness-map", "t.mha"),
            ("extract", "l.mha", "--lower", "otsu", "--smooth", "auto", "--report", "r.json"),
            ("surface", "s.ply", *gray, "--sub-voxel", "--report", "r.json"),
            ("mesh", "m.inp", *gray, "--element-size", 3),
            ("distance", "v.mha", *gray, "--distance", "d.mha"),
        )

    def test_labels(self):
        volume = volumes.Volume((30, 28, 26), [], SPACING, "uint16")
        volume.voxels = [0 if y < 3 else 1 + x // 11 + 3 * (z // 9) for x, y, z in volume.indices()]
        objects = ("--labels", "all", "--objects", "o.mha", "--report", "r.json")
        self.check(
            volume,
            ("extract", "l.mha", *objects, "--mesh", "m.ply"),
            ("extract", "l.mha", *objects, "--resample", 0.6),
            ("extract", "l.mha", "--label", 5, "--thickness-map", "t.mha"),
        )

    def test_real_values_that_are_not_a_number(self):
        volume = volumes.blurred_wall().as_type("float32")
        volume.voxels[500:520] = [float("nan")] * 20
        self.check(volume, ("extract", "l.mha", "--lower", 1000, "--thickness-map", "t.mha", "--report", "r.json"))
        self.assertEqual(json.loads((self.target / "r.json").read_text())["counts"]["not_a_number_voxels"], 20)

    def test_scaled_values(self):
        volume, _ = scan(size=(30, 28, 26))
        volume.spacing = SPACING
        scale = {"scl_slope": 0.25, "scl_inter": -30, **nifti_place(volume)}
        volumes.write_nifti(self.folder / "plain.nii", volume, **scale)
        volumes.write_nifti(self.folder / "packed.nii.gz", volume, True, **scale)
        volume.voxels = [0.25 * voxel - 30 for voxel in volume.voxels]
        volume.kind = "float64"
        volumes.write_meta(self.folder / PLAIN, volume)
        lower = ("--lower", 0.25 * self.LOWER - 30)
        self.check(
            volume,
            ("extract", "l.mha", *lower, "--thickness-map", "t.mha", "--sub-voxel", "--report", "r.json"),
            ("extract", "l.mha", *lower, "--resample", "auto", "--smooth", "on"),
            ("surface", "s.ply", *lower, "--sub-voxel"),
            names=["plain.nii", "packed.nii.gz"],
        )

    def test_plane_images(self):
        volume = volumes.Volume((60, 50), [], (0.5, 0.25), "int16")
        volume.voxels = [100 * (8 <= y < 13 or 20 <= x < 24) for x, y in volume.indices()]
        self.check(volume, ("extract", "l.mha", "--lower", 50, "--thickness-map", "t.mha", "--sub-voxel"))

    def test_jobs(self):
        volume, _ = scan(size=(44, 40, 36))
        names = write_storages(self.folder, volume)
        options = ("--lower", self.LOWER, "--thickness-map", "t.mha", "--places", "p.csv", "--thin-below", 3)
        expected = self.results("extract", f"../{PLAIN}", "l.mha", *options)
        for name in names:
            self.compare(name, expected, "extract", f"../{name}", "l.mha", *options, "--resume", "--divisions", 4)
            if "packed" in name:
                self.clear_target()
                self.in_target("plan", f"../{name}", "l.mha", "job", *options, "--divisions", 4, "--scratch", "..")
                for clusters, more in (("0-1", ()), ("2", ("--scratch", ".")), ("3", ("--threads", 3))):
                    self.in_target("work", "job", "--clusters", clusters, *more)
                self.in_target("finalize", "job")
                found = results(self.target)
                self.assertTrue(all(found[output] == content for output, content in expected.items()), name)

    def test_scratch_folder(self):
        volume, _ = scan(size=(80, 80, 80))
        (self.folder / "scratch").mkdir()
        names = [name for name in write_storages(self.folder, volume) if name.startswith("packed")]
        command = ("l.mha", "--lower", self.LOWER, "--thickness-map", "t.mha", "--threads", 1)
        expected = self.results("extract", f"../{PLAIN}", *command)
        scratch = ("--scratch", "../scratch")
        memory = self.find_least_memory("extract", "../packed.mha", *command, *scratch, folder=self.target)
        for name in names:
            limits = ("--memory", memory, *scratch)
            plan = self.in_target("extract", f"../{name}", *command, *limits, "--dry-run", "--overwrite").stdout
            self.assertRegex(plan, "unpacked +1000.0 KiB in ../scratch")
            self.compare(name, expected, "extract", f"../{name}", *command, *limits)
            self.assertEqual(list((self.folder / "scratch").iterdir()), [])


@unittest.skipUnless(DATA.is_dir(), "the scans are not here")
class ScanStorageTest(StorageTestCase):
    """Parts of real scans."""

    SIZE = 48

    def read(self, name):
        """The middle of a scan."""
        content = (DATA / name).read_bytes()
        head, _, body = content.partition(b"ElementDataFile = LOCAL\n" if name.endswith(".mha") else b"\n\n")
        text = head.decode()
        if name.endswith(".mha"):
            size = tuple(map(int, re.search(r"DimSize = (.*)", text)[1].split()))
            kind = {"MET_UCHAR": "uint8", "MET_SHORT": "int16"}[re.search(r"ElementType = (\S*)", text)[1]]
            body = zlib.decompress(body) if "CompressedData = True" in text else body
        else:
            size = tuple(map(int, re.search(r"sizes: (.*)", text)[1].split()))
            kind = {"unsigned char": "uint8", "uint8": "uint8", "short": "int16"}[re.search(r"type: (.*)", text)[1]]
            body = gzip.decompress(body) if "gzip" in text else body
        values = memoryview(body).cast({"uint8": "B", "int16": "h"}[kind])
        begin = [max(0, (n - self.SIZE) // 2) for n in size]
        volume = volumes.Volume(tuple(min(n, self.SIZE) for n in size), [], SPACING, kind)
        volume.voxels = [
            values[(x + begin[0]) + size[0] * ((y + begin[1]) + size[1] * (z + begin[2]))] for x, y, z in volume.indices()
        ]
        return volume

    def test_scans(self):
        for name, lower in PARTS.items():
            outputs = "--vectors v.mha --thickness-map t.mha --sub-voxel --mesh m.ply --report r.json".split()
            self.check(
                self.read(name),
                ("extract", "l.mha", "--lower", lower, *outputs),
                ("extract", "l.mha", "--lower", lower, "--local-thickness", "t.mha", "--resample", "auto"),
            )


if __name__ == "__main__":
    unittest.main()
