# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""A disk without space: refused before the start where space is reserved, a failure where it is not, never a file."""

import resource
import unittest

import volumes
from program import FAILURE, REFUSED, ProgramTestCase

MEGABYTE = 1 << 20


class FullDiskTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        # One megabyte of labels and twelve of vectors.
        self.volume = volumes.Volume((128, 128, 64), [])
        self.volume.voxels = [1 if 20 <= x < 24 else 0 for x, y, z in self.volume.indices()]
        volumes.write_meta(self.folder / "in.mha", self.volume)
        self.disk = self.folder / "disk"
        self.disk.mkdir()

    def assert_no_space(self, status, *arguments, **options):
        (self.disk / "old.mha").write_bytes(b"precious")
        message = self.extract("in.mha", *arguments, status=status, **options).stderr
        self.assertEqual([path.name for path in self.disk.iterdir()], ["old.mha"])
        self.assertEqual((self.disk / "old.mha").read_bytes(), b"precious")
        return message

    def test_no_space_for_all_outputs(self):
        self.mount_small_disk(self.disk, 3 * MEGABYTE)
        self.extract("in.mha", "disk/fits.mha")
        (self.disk / "fits.mha").unlink()
        message = self.assert_no_space(REFUSED, "disk/out.mha", "--vectors", "disk/v.mha")
        self.assertIn("13.0 MiB", message)
        self.assert_no_space(REFUSED, "disk/old.mha", "--vectors", "disk/v.mha", "--overwrite")
        self.assert_no_space(REFUSED, "disk/out.mha", "--vectors", "disk/v.mhd")
        self.assert_no_space(REFUSED, "disk/out.mha", "--vectors", "disk/v.mhd", "--dry-run")

    def test_no_space_for_the_scratch_files_of_a_mesh(self):
        self.mount_small_disk(self.disk, 3 * MEGABYTE)
        # 72 bytes for each 64 voxels, a megabyte of labels, and the mesh itself takes less.
        (self.disk / "filler").write_bytes(b"x" * (11 * MEGABYTE // 4))
        arguments = ("mesh", "in.mha", "m.ply", "--thickness", 3, "--scratch", "disk")
        self.assert_fails(REFUSED, ["outputs and the scratch files", "1.1 MiB", "disk"], *arguments)
        self.assert_fails(REFUSED, ["2.2 MiB"], *arguments, "--min-branch-length", 3)
        self.assert_fails(REFUSED, ["scratch"], *arguments, "--dry-run")
        self.run_program(*arguments, "--sparse", status=FAILURE)
        (self.disk / "filler").unlink()
        self.run_program(*arguments)

    def test_no_space_for_the_surface_of_a_part(self):
        self.mount_small_disk(self.disk, 3 * MEGABYTE)
        (self.disk / "old.ply").write_bytes(b"precious")
        (self.disk / "filler").write_bytes(b"x" * (11 * MEGABYTE // 4))
        before = self.snapshot()
        for more, status in (([], REFUSED), (["--dry-run"], REFUSED), (["--sparse"], FAILURE)):
            result = self.run_program("surface", "in.mha", "disk/old.ply", "--overwrite", *more, status=status)
            self.assertRegex(result.stderr, "scratch|No space left")
            self.assertEqual(self.snapshot(), before)
        (self.disk / "filler").unlink()
        self.run_program("surface", "in.mha", "disk/old.ply", "--overwrite", "--scratch", ".")

    def test_disk_fills_up_on_the_way(self):
        self.mount_small_disk(self.disk, 3 * MEGABYTE)
        for name in ("disk/v.mha", "disk/v.mhd", "disk/v.nrrd"):
            message = self.assert_no_space(FAILURE, "disk/out.mha", "--distance", name, "--sparse")
            self.assertIn("No space left", message)

    def test_no_space_for_report_and_preview(self):
        self.mount_small_disk(self.disk, 3 * MEGABYTE)
        (self.disk / "filler").write_bytes(b"x" * (3 * MEGABYTE - 4096))
        for option, name in (("--report", "disk/r.json"), ("--preview", "disk/p.png")):
            before = sorted(path.name for path in self.disk.iterdir())
            self.extract("in.mha", "out.mha", option, name, status=FAILURE if option == "--preview" else 0)
            if option == "--preview":
                self.assertEqual(sorted(path.name for path in self.disk.iterdir()), before)
                self.assertFalse((self.folder / "out.mha").exists())
            else:
                (self.folder / "out.mha").unlink()
                (self.disk / "r.json").unlink()

    def test_file_size_limit(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (MEGABYTE // 2, MEGABYTE // 2))

        for name in ("disk/out.mha", "disk/out.mhd", "disk/old.mha"):
            arguments = ["--overwrite"] if name == "disk/old.mha" else []
            message = self.assert_no_space(REFUSED, name, *arguments, preexec_fn=limit)
            self.assertIn("File too large", message)


if __name__ == "__main__":
    unittest.main()
