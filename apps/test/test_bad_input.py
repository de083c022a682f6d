# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Input that is missing, damaged, hostile or of the wrong kind: a clear message, the right status, no output."""

import os
import pathlib
import socket
import unittest

import volumes
from processes import PATIENCE
from program import CORRUPT, FAILURE, REFUSED, USAGE, ProgramTestCase, unprivileged


class BadInputTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate()

    def assert_refused(self, source, parts, status=CORRUPT, arguments=()):
        """All commands refuse the input, name the file, and leave nothing behind."""
        parts = [pathlib.Path(source).name, *parts]
        self.assert_fails(status, parts, "extract", source, "out.mha", "--thickness", 3, *arguments)
        self.assert_fails(status, parts, "distance", source, "out.nrrd", *arguments)
        self.assert_fails(status, parts, "info", source, *arguments)

    def meta(self, **changes):
        return volumes.write_meta(self.folder / "in.mha", self.volume, **changes)

    def nrrd(self, **changes):
        return volumes.write_nrrd(self.folder / "in.nrrd", self.volume, **changes)

    def test_missing_file(self):
        for name in ("none.mha", "none.mhd", "none.nrrd", "none.nhdr"):
            self.assert_refused(name, ["no such file"], FAILURE)
        self.assert_refused("none.raw", ["no such file"], FAILURE, volumes.raw_options(self.volume))
        for name in ("nope", "scans/nope", "none.xyz"):
            self.assert_refused(name, ["cannot open", "no such file or folder"], FAILURE)

    def test_axes_of_length_one_behind_the_third(self):
        """They are no axes of the volume; longer ones are refused."""
        self.extract(volumes.write_meta(self.folder / "3d.mha", self.volume), "3d-labels.mha")
        size = " ".join(map(str, self.volume.size))
        four = {"NDims": 4, "ElementSpacing": "1 1 1 7", "Offset": "0 0 0 9", "TransformMatrix": "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"}
        self.meta(DimSize=f"{size} 1", **four)
        self.nrrd(dimension=4, sizes=f"{size} 1", spacings="1 1 1 nan", kinds="domain domain domain time")
        dim = [4, *self.volume.size, 0, 1, 1, 1]
        volumes.write_nifti(self.folder / "in.nii", self.volume, dim=dim)
        for name in ("in.mha", "in.nrrd", "in.nii"):
            self.extract(name, "labels.mha", "--overwrite")
            self.assertEqual((self.folder / "labels.mha").read_bytes(), (self.folder / "3d-labels.mha").read_bytes(), name)
        self.meta(DimSize=f"{size} 2", **four)
        self.assert_refused("in.mha", ["NDims", 4])
        self.nrrd(dimension=4, sizes=f"{size} 2", spacings="1 1 1 nan")
        self.assert_refused("in.nrrd", ["dimension", 4])
        volumes.write_nifti(self.folder / "in.nii", self.volume, dim=[4, *self.volume.size, 2, 1, 1, 1])
        self.assert_refused("in.nii", ["4 dimensions"])

    def test_what_is_not_packed(self):
        volumes.write_nifti(self.folder / "in.nii", self.volume).rename(self.folder / "in.nii.gz")
        self.assert_refused("in.nii.gz", ["not packed by gzip"])

    def test_names_of_data_files_with_a_percent_sign(self):
        (self.folder / "77 % x.raw").write_bytes(self.volume.data())
        volumes.write_meta(self.folder / "in.mhd", self.volume, ElementDataFile="77 % x.raw")
        self.run_program("info", "in.mhd")
        for name in ("x%03d.raw 1 16 1", "LIST", "LIST 2"):
            volumes.write_meta(self.folder / "in.mhd", self.volume, ElementDataFile=name)
            self.assert_refused("in.mhd", ["several files"])

    def test_data_behind_the_voxels(self):
        """A warning, as the header may tell of another type than its data have."""
        for write, name in ((volumes.write_meta, "long.mha"), (volumes.write_nrrd, "long.nrrd"), (volumes.write_nifti, "long.nii")):
            path = write(self.folder / name, self.volume)
            self.assertEqual(self.run_program("extract", name, "out.mha", "--overwrite", "--dry-run").warnings, [])
            with open(path, "ab") as file:
                file.write(bytes(77))
            for command in (["extract", name, "out.mha"], ["distance", name, "out.mha"], ["mesh", name, "out.vtp"]):
                warnings = self.run_program(*command, "--overwrite").warnings
                self.assertTrue(any("77 bytes behind its last voxel" in warning for warning in warnings), (command, warnings))
            self.assertRegex(self.run_program("info", name).stdout, "bytes behind them +77")

    def test_folder_instead_of_a_file(self):
        (self.folder / "in.mha").mkdir()
        self.assert_refused("in.mha", ["it is a folder, not a regular file"], FAILURE)
        (self.folder / "slices").mkdir()
        self.assert_refused("slices", ["there are no slices"], CORRUPT)
        self.assert_refused(".", ["there are no slices"], CORRUPT)

    def test_no_extension(self):
        (self.folder / "in").write_bytes(b"\0")
        self.assert_refused("in", ["unknown format, its name has no extension; headerless files", "that end with .mha"], USAGE)

    def test_what_is_no_file_is_not_opened(self):
        """A pipe that nobody writes to would block for ever."""
        os.mkfifo(self.folder / "in.mha")
        os.mkfifo(self.folder / "pipe")
        raw = ["--raw-size", "2,2,2", "--raw-type", "uint8"]
        kinds = [("in.mha", "a pipe", []), ("pipe", "a pipe", []), ("pipe", "a pipe", raw), ("/dev/null", "a device", raw)]
        listener = socket.socket(socket.AF_UNIX)
        self.addCleanup(listener.close)
        listener.bind(str(self.folder / "in.nrrd"))
        for name, kind, arguments in (*kinds, ("in.nrrd", "a socket", [])):
            parts = [pathlib.Path(name).name, f"it is {kind}, not a regular file"]
            for command in (["info", name], ["extract", name, "out.mha"], ["mesh", name, "out.ply"]):
                self.assert_fails(FAILURE, parts, *command, *arguments, timeout=20 * PATIENCE)

    def test_data_file_that_is_a_pipe(self):
        for path in (
            volumes.write_meta(self.folder / "a.mhd", self.volume),
            volumes.write_nrrd(self.folder / "b.nhdr", self.volume),
        ):
            path.with_suffix(".img").unlink()
            os.mkfifo(path.with_suffix(".img"))
            self.assert_fails(CORRUPT, [path.with_suffix(".img").name], "info", path.name, timeout=20 * PATIENCE)

    def test_output_that_is_no_file(self):
        self.meta()
        os.mkfifo(self.folder / "out.mha")
        os.mkfifo(self.folder / "r.json")
        for options in ([], ["--overwrite"]):
            parts = ["out.mha exists and is not a regular file"]
            self.assert_fails(REFUSED, parts, "extract", "in.mha", "out.mha", *options, timeout=20 * PATIENCE)
            parts = ["r.json exists and is not a regular file"]
            command = ["extract", "in.mha", "a.mha", "--report", "r.json", *options]
            self.assert_fails(REFUSED, parts, *command, timeout=20 * PATIENCE)

    def test_names_that_are_too_long(self):
        self.meta()
        name = "n" * 300
        self.assert_refused(f"{name}.mha", ["File name too long"], FAILURE)
        self.assert_refused(f"{name}/in.mha", ["File name too long"], FAILURE)
        for output in (f"{name}.mha", f"{name}/out.mha", f"{name}.zarr", "n" * 253 + ".mha"):
            self.assert_fails(REFUSED, [output, "File name too long"], "extract", "in.mha", output)
            self.assert_fails(REFUSED, [output, "File name too long"], "extract", "in.mha", "a.mha", "--vectors", output)
            self.assert_fails(REFUSED, [output, "File name too long"], "distance", "in.mha", output)
        self.assert_fails(REFUSED, [name, "File name too long"], "plan", "in.mha", "out.mha", name)
        self.assert_fails(REFUSED, [name, "File name too long"], "extract", "in.mha", "a.mha", "--report", f"{name}.json")

    def test_unreadable_file(self):
        options = unprivileged()
        self.folder.chmod(0o777)
        self.meta().chmod(0)
        message = self.extract("in.mha", "out.mha", status=FAILURE, **options).stderr
        self.assertIn("in.mha: Permission denied", message)
        self.assertFalse((self.folder / "out.mha").exists())

    def test_unknown_extension(self):
        (self.folder / "in.xyz").write_bytes(b"\0" * 100)
        self.assert_refused("in.xyz", ["unknown format", ".xyz", ".mha"], USAGE)

    def test_content_of_another_format(self):
        for name in ("in.mha", "in.nrrd"):
            (self.folder / name).write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(range(256)))
            self.assert_refused(name, [])
            (self.folder / name).write_bytes(b"")
            self.assert_refused(name, [])

    def test_truncated_voxels(self):
        need = len(self.volume.data())
        for path in (self.meta(), self.nrrd()):
            content = path.read_bytes()
            path.write_bytes(content[:-1])
            self.assert_refused(path.name, [need, len(content) - 1])
            path.write_bytes(content[: -need // 2])
            self.assert_refused(path.name, [need])

    def test_truncated_data_file(self):
        for path in (
            volumes.write_meta(self.folder / "a.mhd", self.volume),
            volumes.write_nrrd(self.folder / "b.nhdr", self.volume),
        ):
            data_file = path.with_suffix(".img")
            data_file.write_bytes(self.volume.data()[:-1])
            self.assert_fails(CORRUPT, [data_file.name, len(self.volume.data()) - 1], "info", path.name)

    def test_truncated_compressed_voxels(self):
        for path in (self.meta(compressed=True), self.nrrd(compressed=True)):
            content = path.read_bytes()
            for cut in (1, 40):
                path.write_bytes(content[:-cut])
                self.assert_fails(CORRUPT, [path.name, "end early"], "extract", path, "out.mha", "--thickness", 3)

    def test_damaged_compressed_voxels(self):
        for path in (self.meta(compressed=True), self.nrrd(compressed=True)):
            content = bytearray(path.read_bytes())
            content[-6] ^= 0xFF
            path.write_bytes(content)
            self.assert_fails(CORRUPT, [path.name], "extract", path, "out.mha", "--thickness", 3)

    def test_more_compressed_voxels_than_declared(self):
        for path in (self.meta(compressed=True, DimSize="24 20 15"), self.nrrd(compressed=True, sizes="24 20 15")):
            self.assert_fails(CORRUPT, [path.name, "more than"], "extract", path, "out.mha", "--thickness", 3)

    def test_missing_data_file(self):
        for path in (
            volumes.write_meta(self.folder / "a.mhd", self.volume),
            volumes.write_nrrd(self.folder / "b.nhdr", self.volume),
        ):
            path.with_suffix(".img").unlink()
            self.assert_refused(path.name, [path.with_suffix(".img").name, "missing"])

    def test_header_larger_than_the_file(self):
        self.meta(HeaderSize=10**15)
        self.assert_refused("in.mha", [10**15])
        self.nrrd(byte_skip=10**15)
        self.assert_refused("in.nrrd", ["bytes of header"])
        self.nrrd(line_skip=10**6)
        self.assert_refused("in.nrrd", [10**6, "more lines"])

    def test_hostile_sizes(self):
        million = 10**6
        for size in (f"{million} {million} {million}", f"{2**31} {2**31} {2**31}", f"{2**63} 1 1", "24 20 0", "24 20 -16"):
            self.meta(DimSize=size)
            self.assert_refused("in.mha", [])
            self.nrrd(sizes=size)
            self.assert_refused("in.nrrd", [])
        self.meta(DimSize="24 20 0")
        self.assert_refused("in.mha", ["DimSize", "'0'", "from 1 on"])

    def test_hostile_sizes_of_compressed_voxels(self):
        self.meta(compressed=True, DimSize="100000 100000 100000")
        self.assert_refused("in.mha", ["cannot be packed"])
        self.nrrd(compressed=True, sizes="100000 100000 100000")
        self.assert_refused("in.nrrd", ["cannot be packed"])

    def test_wrong_number_of_sizes(self):
        self.meta(DimSize="24 20")
        self.assert_refused("in.mha", ["DimSize", "2", "3"])
        self.nrrd(sizes="24 20 16 1")
        self.assert_refused("in.nrrd", ["sizes", "4", "3"])

    def test_unsupported_dimensions(self):
        for dimension in (0, 1, 4, 999999999, "three"):
            self.meta(NDims=dimension)
            self.assert_refused("in.mha", ["NDims", dimension, "2 or 3"])
            self.nrrd(dimension=dimension)
            self.assert_refused("in.nrrd", ["dimension", dimension, "2 or 3"])

    def test_bad_spacing(self):
        for spacing in ("1 0 1", "1 -1 1", "1 nan 1", "1 inf 1", "1 x 1"):
            self.meta(ElementSpacing=spacing)
            self.assert_refused("in.mha", ["ElementSpacing", spacing.split()[1], "greater than 0"])
            self.nrrd(spacings=spacing)
            self.assert_refused("in.nrrd", ["spacings", spacing.split()[1], "greater than 0"])
        self.meta(ElementSpacing="1 1")
        self.assert_refused("in.mha", ["ElementSpacing", "2", "3"])

    def test_bad_directions(self):
        for vectors in ("(1,0,0) (0,0,0) (0,0,1)", "(1,0,0) (0,nan,0) (0,0,1)", "(1,0,0) (0,1,0)"):
            self.nrrd(spacings=None, space="left-posterior-superior", space_directions=vectors)
            self.assert_refused("in.nrrd", ["space directions"])
        self.nrrd(spacings=None, space="left-posterior-superior", space_directions="(1,0,0) (2,0,0) (0,0,1)")
        self.assert_refused("in.nrrd", [])
        self.meta(TransformMatrix="1 0 0 1 0 0 0 0 1")
        self.assert_refused("in.mha", [])
        self.meta(TransformMatrix="1 0 0 0 1 0 0 0")
        self.assert_refused("in.mha", ["TransformMatrix", "8", "9"])
        self.meta(Offset="0 0 nan")
        self.assert_refused("in.mha", ["Offset", "nan"])

    def test_colors_and_vectors(self):
        self.meta(ElementNumberOfChannels=3, DimSize="8 20 16")
        self.assert_refused("in.mha", ["3 components", "one value"])
        for kind in ("RGB-color", "vector", "3-color", "list"):
            self.nrrd(sizes="3 8 20 16", dimension=4, spacings=None, kinds=f"{kind} domain domain domain")
            self.assert_refused("in.nrrd", [kind, "one value"])

    def test_unknown_types(self):
        self.meta(ElementType="MET_STRING")
        self.assert_refused("in.mha", ["MET_STRING"])
        self.nrrd(type="block")
        self.assert_refused("in.nrrd", ["block"])

    def test_unread_variants_say_so(self):
        self.meta(BinaryData="False")
        self.assert_refused("in.mha", ["BinaryData"])
        for encoding in ("ascii", "hex", "bzip2"):
            self.nrrd(encoding=encoding)
            self.assert_refused("in.nrrd", [encoding, "raw and gzip"])
        (self.folder / "in.mhd").write_bytes(volumes.meta_header(self.volume, "LIST"))
        self.assert_refused("in.mhd", ["LIST", "several files"])
        (self.folder / "in.nhdr").write_bytes(volumes.nrrd_header(self.volume, "slice%03d.img 1 16 1", encoding="gzip"))
        self.assert_refused("in.nhdr", ["slice%03d", "several files", "gzip"])

    def test_missing_fields(self):
        for field in ("NDims", "DimSize", "ElementType"):
            self.meta(**{field: None})
            self.assert_refused("in.mha", [field])
        for field in ("type", "dimension", "sizes", "encoding"):
            self.nrrd(**{field: None})
            self.assert_refused("in.nrrd", [field])
        (self.folder / "in.mha").write_bytes(b"ObjectType = Image\nNDims = 3\n")
        self.assert_refused("in.mha", ["ElementDataFile"])
        volumes.write_nrrd(self.folder / "in.nrrd", self.volume.as_type("int16"), endian=None)
        self.assert_refused("in.nrrd", ["endian"])

    def test_endless_lines(self):
        (self.folder / "in.mha").write_bytes(b"ObjectType = Image\nComment = " + b"x" * 10**6)
        self.assert_refused("in.mha", ["line 2"])
        self.meta(Comment="x" * 100000)
        self.assert_refused("in.mha", ["line", "65536 bytes"])
        self.meta(Comment="x" * 3000)
        self.run_program("info", "in.mha")
        (self.folder / "in.nrrd").write_bytes(b"NRRD0004\ntype: " + b"x" * 3 * 10**6)
        self.assert_refused("in.nrrd", ["line 2"])

    def test_mrc(self):
        million = 10**6
        for parts, changes in (
            (["NX NY NZ", "'0'", "from 1 on"], {"size": (0, 20, 16)}),
            (["NX NY NZ", "'-24'"], {"size": (-24, 20, 16)}),
            (["more voxels"], {"size": (2**31 - 1, 2**31 - 1, 2**31 - 1)}),
            ([str(million**2), "bytes of header"], {"size": (million, million, 1)}),
            (["MODE is 12", "float16"], {"mode": 12}),
            (["MODE is 4", "0, 1, 2 and 6"], {"mode": 4}),
            (["MODE is -1"], {"mode": -1}),
            (["MAPC, MAPR, MAPS are 3 2 1", "1 2 3"], {"axes": (3, 2, 1)}),
            (["MAPC, MAPR, MAPS are 0 0 0"], {"axes": (0, 0, 0)}),
            (["90 90 120", "right angles"], {"angles": (90, 90, 120)}),
            (["ISPG is 401", "single volumes"], {"ispg": 401}),
            (["MX MY MZ are 0 20 16", "from 1 on"], {"intervals": (0, 20, 16)}),
            (["spacing along axis 1", "-1"], {"cell": (24, -2e8, 16)}),
            (["spacing along axis 0"], {"cell": (float("nan"), 20, 16)}),
            (["origin along axis 2"], {"origin": (0, 0, float("inf"))}),
            (["NSYMBT is -1", "from 0 on"], {"nsymbt": -1}),
            ([2**31 - 1 + 1024, "bytes of header"], {"nsymbt": 2**31 - 1}),
            (["MAP"], {"map": b"    "}),
            (["machine stamp", "18", "68", "17"], {"machst": (18, 0, 0, 0)}),
        ):
            path = volumes.write_mrc(self.folder / "in.mrc", self.volume, **changes)
            self.assert_refused(path, parts)
        (self.folder / "in.mrc").write_bytes(volumes.mrc_header(self.volume)[:1023])
        self.assert_refused("in.mrc", ["shorter", 1024])

    def test_raw_file_of_another_size(self):
        """What is too much may be a header; the message has the option that says so."""
        path = volumes.write_raw(self.folder / "in.raw", self.volume)
        options = volumes.raw_options(self.volume)
        need = len(self.volume.data())
        path.write_bytes(self.volume.data()[:-1])
        self.assert_refused("in.raw", [need, need - 1, "no more and no less\n"], CORRUPT, options)
        path.write_bytes(self.volume.data() + b"\0\1")
        self.assert_refused("in.raw", [need, need + 2, "a header of 2 bytes", "--raw-type uint8:2"], CORRUPT, options)
        self.assert_refused("in.raw", [need, "--raw-type uint8:2:big"], CORRUPT, volumes.raw_options(self.volume, ":1:big"))
        self.run_program("info", "in.raw", *volumes.raw_options(self.volume, ":2:big"))
        path.write_bytes(self.volume.data())
        self.assert_refused("in.raw", [need, "no more and no less\n"], CORRUPT, volumes.raw_options(self.volume, ":1"))


if __name__ == "__main__":
    unittest.main()
