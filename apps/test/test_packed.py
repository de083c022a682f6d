# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Packed volumes and NIfTI: the voxels and the place of the others, the same bytes for any division, read by others."""

import gzip
import json
import struct
import unittest
import zlib

import volumes
from program import REFUSED, USAGE, ProgramTestCase
from test_identity import rough_shell


def unpack(path):
    """Bytes of the voxels."""
    content = path.read_bytes()
    if path.name.endswith(".nii.gz"):
        return gzip.decompress(content)[352:]
    if path.name.endswith(".nii"):
        return content[352:]
    packed = volumes.read_data(path)
    if path.suffix == ".mha":
        fields, _ = volumes.read_header(path)
        assert (fields["CompressedData"], int(fields["CompressedDataSize"])) == ("True", len(packed))
        return zlib.decompress(packed)
    return gzip.decompress(packed)


class PackedTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = rough_shell()
        self.volume.spacing = (0.5, 0.75, 1.25)
        volumes.write_meta(self.folder / "in.mha", self.volume, Offset="10 -20 3.5")

    def run_all(self, name, suffix, *arguments):
        """Runs with all scalar outputs; their names."""
        names = {"": f"{name}{suffix}", "--distance": f"{name}-d{suffix}", "--thickness-map": f"{name}-t{suffix}"}
        further = [word for option, output in names.items() if option for word in (option, output)]
        self.run_program("extract", "in.mha", names[""], *further, "--thickness", 2, *arguments)
        return [self.folder / output for output in names.values()]

    def test_same_voxels_and_bytes_for_any_division(self):
        expected = [volumes.read_data(path) for path in self.run_all("plain", ".mha")]
        for suffix, *options in ((".mha", "--compress"), (".nrrd", "--compress"), (".nii.gz",), (".nii",)):
            first = None
            for i, run in enumerate((["--threads", 2], ["--divisions", 1], ["--divisions", 33], ["--memory", "48M"], ["--sparse"])):
                paths = self.run_all(f"p{i}", suffix, *options, *run)
                found = [path.read_bytes() for path in paths]
                self.assertEqual([unpack(path) for path in paths], expected, (suffix, run))
                first = first or found
                self.assertEqual(found, first, (suffix, run))
            if suffix != ".nii":
                self.assertLess(sum(map(len, first)), sum(map(len, expected)) / 2)

    def test_pictures_are_the_same(self):
        pictures = ["--preview", "p.png", "--html", "h.html", "--overwrite"]
        self.run_all("plain", ".mha", *pictures)
        expected = (self.folder / "p.png").read_bytes()
        for suffix, *options in ((".mha", "--compress"), (".nii.gz",), (".nii",)):
            self.run_all("packed", suffix, *options, *pictures)
            self.assertEqual((self.folder / "p.png").read_bytes(), expected, suffix)

    def test_the_program_reads_them(self):
        self.run_all("plain", ".mha")
        expected = self.run_program("info", "plain.mha", "--values").stdout.split("\n")[2:]
        for suffix, *options in ((".mha", "--compress"), (".nrrd", "--compress"), (".nii.gz",), (".nii",)):
            self.run_all("packed", suffix, *options)
            found = self.run_program("info", f"packed{suffix}", "--values").stdout.split("\n")[2:]
            # How they are read, and that the unit is told, are matters of the format.
            found, plain = ([line for line in lines if "stream" not in line and "unit" not in line] for lines in (found, expected))
            self.assertEqual(found, plain, suffix)
            self.run_program("extract", f"packed{suffix}", "again.mha", "--overwrite")

    def test_places_of_nifti(self):
        for direction in ("1 0 0 0 1 0 0 0 1", "0 1 0 -1 0 0 0 0 1", "0.8 0.6 0 -0.6 0.8 0 0 0 -1"):
            changes = {"Offset": "10 -20 3.5", "TransformMatrix": direction}
            volumes.write_meta(self.folder / "in.mha", self.volume, **changes)
            self.run_program("extract", "in.mha", "out.nii", "--overwrite", "--thickness", 2)
            self.run_program("extract", "in.mha", "out.mha", "--overwrite", "--thickness", 2)
            header = (self.folder / "out.nii").read_bytes()[:352]
            self.assertEqual(struct.unpack_from("i", header)[0], 348)
            self.assertEqual(struct.unpack_from("8h", header, 40), (3, *self.volume.size, 1, 1, 1, 1))
            rows = struct.unpack_from("12f", header, 280)
            fields, _ = volumes.read_header(self.folder / "out.mha")
            origin = [float(value) for value in fields["Offset"].split()]
            axes = [float(value) for value in fields["TransformMatrix"].split()]
            for row, sign in enumerate((-1, -1, 1)):
                expected = [sign * axes[3 * axis + row] * self.volume.spacing[axis] for axis in range(3)]
                for value, other in zip(rows[4 * row : 4 * row + 4], [*expected, sign * origin[row]]):
                    self.assertAlmostEqual(value, other, places=5)

    def test_readers_of_others(self):
        try:
            import nibabel
            import SimpleITK
        except ImportError:
            self.skipTest("nibabel or SimpleITK is not installed")
        plain = SimpleITK.ReadImage(str(self.run_all("plain", ".mha")[0]))
        expected = SimpleITK.GetArrayFromImage(plain)
        for suffix, *options in ((".mha", "--compress"), (".nrrd", "--compress"), (".nii.gz",), (".nii",)):
            path = self.run_all("packed", suffix, *options)[0]
            image = SimpleITK.ReadImage(str(path))
            self.assertTrue((SimpleITK.GetArrayFromImage(image) == expected).all(), suffix)
            self.assertEqual(image.GetPixelID(), plain.GetPixelID())
            for found, other in ((image.GetSpacing(), plain.GetSpacing()), (image.GetOrigin(), plain.GetOrigin()),
                                 (image.GetDirection(), plain.GetDirection())):  # fmt: skip
                for value, wanted in zip(found, other):
                    self.assertAlmostEqual(value, wanted, places=5)
            if ".nii" in suffix:
                other = nibabel.load(path)
                self.assertTrue((other.get_fdata().T == expected).all(), suffix)
                corner = other.affine[:3, 3]
                for value, wanted in zip((-corner[0], -corner[1], corner[2]), plain.GetOrigin()):
                    self.assertAlmostEqual(value, wanted, places=5)

    def test_two_dimensions(self):
        plane = volumes.Volume((40, 30), [1 if 5 <= x < 30 and 8 <= y < 20 else 0 for y in range(30) for x in range(40)])
        volumes.write_meta(self.folder / "in.mha", plane)
        expected = [volumes.read_data(path) for path in self.run_all("plain", ".mha")]
        for suffix, *options in ((".mha", "--compress"), (".nrrd", "--compress"), (".nii.gz",), (".nii",)):
            self.assertEqual([unpack(path) for path in self.run_all("packed", suffix, *options)], expected, suffix)

    def test_what_cannot_be(self):
        command = ["extract", "in.mha"]
        for name in ("out.mhd", "out.nhdr", "out.nii"):
            self.assert_fails(USAGE, [name, "--compress on", "has none;"], *command, name, "--compress")
        for name, kind, known in (
            ("out.mha", "gzip", "on or none"), ("out.nrrd", "blosc-zstd", "on or gzip or none"), ("out.nii.gz", "none", "on or gzip"),
        ):  # fmt: skip
            self.assert_fails(USAGE, [f"{name}: --compress {kind} is not for", f"has {known} (see"], *command, name, "--compress", kind)
        for name in ("v.nii", "v.nii.gz"):
            parts = [name, "vectors are not written as .nii"]
            self.assert_fails(USAGE, parts, *command, "out.mha", "--vectors", name)
            self.assert_fails(USAGE, parts, "distance", "in.mha", name)
        for name, *options in (("out.nii.gz",), ("out.mha", "--compress")):
            parts = ["a packed volume, which is one stream, cannot be made by a job"]
            self.assert_fails(REFUSED, parts, "plan", "in.mha", name, "job", *options)
            self.assert_fails(REFUSED, parts, *command, name, "--resume", *options)
        long = volumes.Volume((40000, 2, 2), [0, 1] * 80000)
        volumes.write_meta(self.folder / "long.mha", long)
        self.assert_fails(USAGE, ["40000 voxels", "32767"], "extract", "long.mha", "out.nii")

    def test_jobs_write_nifti(self):
        self.run_program("extract", "in.mha", "expected.nii", "--thickness", 2)
        self.run_program("plan", "in.mha", "out.nii", "job", "--thickness", 2, "--report", "r.json")
        self.run_program("work", "job")
        self.run_program("finalize", "job")
        self.assertEqual((self.folder / "out.nii").read_bytes(), (self.folder / "expected.nii").read_bytes())
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["outputs"]["labels"], "out.nii")


if __name__ == "__main__":
    unittest.main()
