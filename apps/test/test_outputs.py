# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Outputs appear complete or not at all, and never destroy anything unasked."""

import os
import pathlib
import unittest

import volumes
from program import REFUSED, USAGE, ProgramTestCase, unprivileged

OLD = b"precious"


class OutputsTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_refused(self, parts, *arguments, status=REFUSED, target="out.mha", source="in.mha"):
        self.assert_fails(status, parts, "extract", source, target, "--thickness", 3, *arguments)

    def test_existing_outputs_are_kept(self):
        options = {
            "--vectors": "v.mha",
            "--distance": "d.nrrd",
            "--thickness-map": "t.mha",
            "--report": "r.json",
            "--preview": "p.png",
        }
        for option, name in options.items():
            (self.folder / name).write_bytes(OLD)
            self.assert_refused([name, "--overwrite"], option, name)
        (self.folder / "out.mha").write_bytes(OLD)
        self.assert_refused(["out.mha", "--overwrite"])
        self.assert_fails(REFUSED, ["out.mha", "--overwrite"], "distance", "in.mha", "out.mha")

    def test_overwrite_replaces(self):
        for name in ("out.mha", "out.nrrd"):
            (self.folder / name).write_bytes(OLD)
            self.extract("in.mha", name, "--overwrite")
            self.assertEqual(len(volumes.read_data(self.folder / name)), len(self.volume.voxels))

    def test_failed_run_keeps_the_old_output(self):
        (self.folder / "out.mha").write_bytes(OLD)
        self.assert_refused(["no-such-folder"], "--overwrite", "--vectors", "no-such-folder/v.mha")
        self.assertEqual((self.folder / "out.mha").read_bytes(), OLD)

    def test_output_that_is_the_input(self):
        (self.folder / "soft.mha").symlink_to("in.mha")
        os.link(self.folder / "in.mha", self.folder / "hard.mha")
        (self.folder / "deep").mkdir()
        for target in ("in.mha", "soft.mha", "hard.mha", "./in.mha", "deep/../in.mha", self.folder / "in.mha"):
            self.assert_refused([pathlib.Path(target).name, "input"], "--overwrite", status=USAGE, target=target)
            self.assert_refused([pathlib.Path(target).name, "input"], "--overwrite", "--vectors", target, status=USAGE)
        self.assert_fails(USAGE, ["in.mha"], "distance", "in.mha", "in.mha", "--overwrite")
        self.assert_refused(["in.mha"], "--overwrite", status=USAGE, target="in.mha", source="soft.mha")

    def test_output_that_is_the_data_of_the_input(self):
        volumes.write_meta(self.folder / "scan.mhd", self.volume, ElementDataFile="voxels.mha")
        (self.folder / "voxels.mha").write_bytes(self.volume.data())
        self.assert_refused(["voxels.mha", "input"], "--overwrite", status=USAGE, target="voxels.mha", source="scan.mhd")

    def test_output_whose_data_file_is_the_input(self):
        volumes.write_raw(self.folder / "out.raw", self.volume)
        (self.folder / "out.mhd").write_bytes(volumes.meta_header(self.volume, "out.raw"))
        options = ["--overwrite", *volumes.raw_options(self.volume)]
        self.assert_refused(["out.mhd", "out.raw"], *options, status=USAGE, target="out.mhd", source="out.raw")

    def test_one_name_for_two_outputs(self):
        self.assert_refused(["out.mha", "labels", "vectors"], "--vectors", "./out.mha", status=USAGE)
        self.assert_refused(["x.mha", "vectors", "distance"], "--vectors", "x.mha", "--distance", "x.mha", status=USAGE)

    def test_missing_folder(self):
        self.assert_refused(["none/out.mha", "folder"], target="none/out.mha")
        self.assert_refused(["none/r.json", "folder"], "--report", "none/r.json")

    def test_unwritable_folder(self):
        options = unprivileged()
        self.folder.chmod(0o755)
        message = self.extract("in.mha", "out.mha", status=REFUSED, **options).stderr
        self.assertIn("out.mha: Permission denied", message)
        self.assertEqual(self.names(), ["in.mha"])

    def test_output_that_is_no_file(self):
        (self.folder / "out.mha").mkdir()
        self.assert_refused(["out.mha", "not a regular file"], "--overwrite")

    def test_link_is_followed(self):
        (self.folder / "deep").mkdir()
        (self.folder / "out.mha").symlink_to("deep/real.mha")
        self.extract("in.mha", "out.mha")
        self.assertTrue((self.folder / "out.mha").is_symlink())
        self.assertTrue((self.folder / "deep" / "real.mha").is_file())
        self.extract("in.mha", "out.mha", "--overwrite")
        self.assertTrue((self.folder / "out.mha").is_symlink())

    def test_two_file_formats_take_a_new_name_for_the_voxels(self):
        for name in ("out.mhd", "out.nhdr"):
            self.extract("in.mha", name)
            self.assertEqual(volumes.read_header(self.folder / name)[0].get("ElementDataFile", "out-1.raw")[:3], "out")
        self.assertEqual(self.names(), ["in.mha", "out-1.raw", "out.mhd", "out.nhdr", "out.raw"])
        first = volumes.read_data(self.folder / "out.mhd")
        self.extract("in.mha", "out.mhd", "--overwrite")
        self.assertEqual(self.names(), ["in.mha", "out-1.raw", "out-2.raw", "out.mhd", "out.nhdr"])
        self.assertEqual(volumes.read_data(self.folder / "out.mhd"), first)
        self.assertEqual(volumes.read_data(self.folder / "out.nhdr"), first)

    def test_voxels_that_others_may_use_are_not_removed(self):
        (self.folder / "shared.raw").write_bytes(self.volume.data())
        (self.folder / "out.mhd").write_bytes(volumes.meta_header(self.volume, "shared.raw"))
        self.extract("in.mha", "out.mhd", "--overwrite")
        self.assertEqual((self.folder / "shared.raw").read_bytes(), self.volume.data())

    def test_dry_run_writes_nothing(self):
        before = self.snapshot()
        for command in (["extract", "in.mha", "out.mha", "--thickness", 3], ["distance", "in.mha", "out.mha"]):
            text = self.run_program(*command, "--dry-run", "--divisions", 3, "--threads", 2, "--report", "r.json").stdout
            for line in ("24 x 20 x 16", "3 of up to 6 slices", "out.mha", "r.json", "streams"):
                self.assertIn(line, text)
        self.assertEqual(self.snapshot(), before)
        (self.folder / "out.mha").write_bytes(OLD)
        self.assert_refused(["out.mha"], "--dry-run")

    def test_memory_too_small(self):
        for size in ("1M", "0", "100K"):
            self.assert_refused(["MiB", "at least"], "--memory", size)
        self.extract("in.mha", "out.mha", "--memory", "1G")

    def test_sparse_outputs_have_holes_and_the_same_bytes(self):
        plate = volumes.Volume((256, 256, 32), [])
        plate.voxels = [1 if z == 30 and 8 <= y < 12 else 0 for x, y, z in plate.indices()]
        volumes.write_meta(self.folder / "plate.mha", plate)
        for name in ("a.mha", "a.mhd"):
            self.extract("plate.mha", name)
            self.extract("plate.mha", "sparse-" + name, "--sparse")
            self.assertEqual(
                volumes.read_data(self.folder / name), volumes.read_data(self.folder / ("sparse-" + name))
            )
        blocks = {name: (self.folder / name).stat().st_blocks for name in ("a.mha", "sparse-a.mha", "sparse-a.raw")}
        self.assertLess(blocks["sparse-a.mha"], blocks["a.mha"] // 4)
        self.assertLess(blocks["sparse-a.raw"], blocks["a.mha"] // 4)

    def test_no_temporary_file_remains(self):
        self.extract("in.mha", "out.mhd", "--vectors", "v.nhdr", "--report", "r.json", "--preview", "p.png")
        self.assertEqual(self.names(), ["in.mha", "out.mhd", "out.raw", "p.png", "r.json", "v.nhdr", "v.raw"])

    def test_outputs_have_the_permissions_of_new_files(self):
        self.extract("in.mha", "out.mha", umask=0o027)
        self.assertEqual((self.folder / "out.mha").stat().st_mode & 0o777, 0o640)


if __name__ == "__main__":
    unittest.main()
