# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Every file of the fuzzers' corpus, and headers made to harm a reader: read, or refused in one line of text, within two
seconds of the processor and 100 MB of memory, and without a file that looks like a result."""

import os
import pathlib
import resource
import shutil
import subprocess
import unittest

import volumes
import zarr_folder
from program import CORRUPT, DONE, FAILURE, PROGRAM, READS_TIFF, USAGE, ProgramTestCase

CORPUS = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "fuzz" / "corpus"
SANITIZED = os.environ.get("MEDIALVOXEL_SANITIZED", "0") == "1"

# Folder of the corpus and the name that a file of it gets.
FORMATS = {
    "MetaImageHeader": "in.mha",
    "NrrdHeader": "in.nrrd",
    "NiftiHeader": "in.nii",
    "PackedNifti": "in.nii.gz",
    "MrcHeader": "in.mrc",
    "VgiHeader": "voxels.vgi",
    "PyHstHeader": "voxels.vol.info",
    **({"TiffHeader": "in.tif"} if READS_TIFF else {}),
}

SECONDS = 2
BYTES = 100 * 1000 * 1000

MILLION = 10**6
MAX_INT = 2**31 - 1


def meta(fields, voxels=b"\1\1"):
    """A MetaImage of fields that replace, or come before, those of a small one."""
    names = [field.split(" = ")[0] for field in fields]
    preset = ["ObjectType = Image", "NDims = 3", "DimSize = 2 1 1", "ElementType = MET_UCHAR", "ElementDataFile = LOCAL"]
    kept = [field for field in preset[:-1] if field.split(" = ")[0] not in names]
    end = [field for field in fields if field.startswith("ElementDataFile")] or preset[-1:]
    rest = [field for field in fields if not field.startswith("ElementDataFile")]
    return "\n".join(kept + rest + end).encode() + b"\n" + voxels


# What is known to break readers of this format: tables of fixed length, counts that become negative, products that
# overflow, texts that are copied into short buffers, names of files that are formats of printf.
HOSTILE_META = {
    "a million cubed": meta([f"DimSize = {MILLION} {MILLION} {MILLION}"]),
    "product that overflows to 0": meta([f"DimSize = {2**32} {2**32} {2**32}"]),
    "product that overflows to 2": meta([f"DimSize = {2**63 + 1} 2 1"]),
    "negative sizes": meta(["DimSize = -2 -1 1"]),
    "eleven dimensions": meta(["NDims = 11", "DimSize =" + " 1" * 11]),
    "a billion dimensions": meta([f"NDims = {MAX_INT}"]),
    "negative dimensions": meta(["NDims = -1"]),
    "no sizes": meta(["DimSize = "]),
    "thousands of sizes": meta(["DimSize =" + " 1" * 20000]),
    "spacing that is no number": meta(["ElementSpacing = 1 nan 1"]),
    "infinite spacing": meta(["ElementSpacing = 1 inf 1"]),
    "spacing that is too small": meta(["ElementSpacing = 1 1e-999 1"]),
    "spacing of a galaxy": meta(["ElementSpacing = 1e103 1e103 1e103"]),
    "spacing of nothing": meta(["ElementSpacing = 1e-300 1e-300 1e-300"]),
    "spacing that is no normal number": meta(["ElementSpacing = 5e-324 5e-324 5e-324"]),
    "extent that overflows": meta([f"DimSize = {MAX_INT} 1 1", "ElementSpacing = 1e300 1 1"]),
    "origin at the end of numbers": meta(["Offset = 1e308 0 0"]),
    "directions that stretch": meta(["TransformMatrix = 1e150 0 0 0 1e150 0 0 0 1e150"]),
    "directions that vanish": meta(["TransformMatrix = 1e-150 0 0 0 1e-150 0 0 0 1e-150"]),
    "negative channels": meta(["ElementNumberOfChannels = -1"]),
    "billions of channels": meta([f"ElementNumberOfChannels = {2**32}"]),
    "data file that is a long list": meta([f"ElementDataFile = LIST {MAX_INT}"], b"in.mha\n" * 1000),
    "list of negative dimension": meta(["ElementDataFile = LIST -1"]),
    "list of this file": meta(["ElementDataFile = LIST"], b"in.mha\nin.mha\n"),
    "pattern of many files": meta([f"ElementDataFile = slice%d.raw 0 {MAX_INT} 1"]),
    "pattern without step": meta([f"ElementDataFile = slice%d.raw 0 {MAX_INT} 0"]),
    "pattern that writes": meta(["ElementDataFile = %n%n%n%s%s%s 1 2 1"]),
    "data file that is a device": meta(["ElementDataFile = /dev/zero"]),
    "data file that is a folder": meta(["ElementDataFile = /"]),
    "data file of another owner": meta(["ElementDataFile = ../../../../../../etc/shadow.none"]),
    "data file with a long name": meta(["ElementDataFile = " + "a" * 60000]),
    "long name of a type": meta(["ElementType = MET_" + "U" * 60000]),
    "long name of a field": meta(["N" * 60000 + " = 1", "DimSize = 3 1 1"]),
    "long value": meta(["Comment = " + "c" * 60000, "DimSize = 3 1 1"]),
    "many fields": meta([f"Field{i} = {i}" for i in range(90000)] + ["DimSize = 3 1 1"]),
    "negative header size": meta(["HeaderSize = -2"]),
    "header size that overflows": meta([f"HeaderSize = {2**63 - 1}"]),
    "packed billions": meta(["CompressedData = True", f"CompressedDataSize = {2**63 - 1}", "DimSize = 100000 100000 9"]),
    "gigantic fields": meta([f"{i} = " + "v" * 60000 for i in range(300)] + ["DimSize = 3 1 1"]),
    "matrix of wrong length": meta(["TransformMatrix = " + "1 " * 9999]),
    "escape sequence": meta(["ElementType = \x1b[2J\x1b]0;title\x07"]),
    "nothing but a field": b"NDims = 3\nDimSize = 9999 9999 9999\nElementType = MET_DOUBLE\nElementDataFile = LOCAL\n",
}

HOSTILE_NRRD = {
    "a million cubed": {"sizes": f"{MILLION} {MILLION} {MILLION}"},
    "product that overflows": {"sizes": f"{2**32} {2**32} {2**32}"},
    "negative sizes": {"sizes": "24 -20 16"},
    "spacing that is no number": {"spacings": "1 nan 1"},
    "many dimensions": {"dimension": 16, "sizes": "1 " * 16},
    "pattern of many files": {"data_file": f"slice%09d.raw 0 {MAX_INT} 1"},
    "pattern of a million files": {"data_file": f"{'s' * 200}%09d.raw 1 {2**20} 1", "sizes": f"1 1 {2**20}"},
    "pattern without step": {"data_file": "slice%d.raw 0 9 0"},
    "pattern that writes": {"data_file": "%n%n%n%s 1 16 1"},
    "pattern of wide names": {"data_file": f"s%0{MAX_INT}d.raw 1 16 1"},
    "list of nothing": {"data_file": "LIST"},
    "list of a million files": {"sizes": f"1 1 {2**20}", "data_file": "LIST" + "\nf" * 2**20},
    "a million keys": {"sizes": "1 1 1" + "".join(f"\n{key}:=" for key in range(10**6))},
    "data file that is a device": {"data_file": "/dev/zero"},
    "skips that overflow": {"byte_skip": 2**63 - 1, "line_skip": 2**63 - 1},
    "billions of lines": {"line_skip": 10**15},
}


class HostileTest(ProgramTestCase):
    def run_limited(self, *arguments):
        """Status and message of a run; beyond the limits of time and memory it would be killed, or fail."""

        def limit():
            if not SANITIZED:
                resource.setrlimit(resource.RLIMIT_DATA, (BYTES, BYTES))
                resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))

        result = subprocess.run(
            [PROGRAM, *map(str, arguments)],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            check=False,
            preexec_fn=limit,
        )
        return result.returncode, result.stderr

    def assert_clear(self, name, statuses, what):
        """Read by both commands or refused by both, but for voxels that only one of them looks at."""
        for arguments in (["info", name], ["extract", name, "out.mha", "--thickness", 3, "--resample", "off", "--threads", 1]):
            status, message = self.run_limited(*arguments)
            self.assertIn(status, statuses, (what, arguments[0], message))
            if status != DONE:
                self.assertTrue(message.startswith("medialvoxel: "), (what, message))
                # Warnings of what the header lacks come before.
                lines = [line for line in message.splitlines() if not line.startswith("medialvoxel: warning: ")]
                self.assertEqual(len(lines), 1, (what, message))
                self.assertTrue(lines[0].isprintable(), (what, message))
                self.assertLess(len(message), 1000, what)
                self.assertFalse((self.folder / "out.mha").exists(), what)
            (self.folder / "out.mha").unlink(missing_ok=True)
            self.assertEqual(list(self.folder.glob("*.partial")), [], what)

    def write_nrrd(self, volume, data_file=None, **changes):
        content = volumes.nrrd_header(volume, data_file, **changes) + volume.data()
        (self.folder / "in.nrrd").write_bytes(content)

    def test_corpus_of_the_fuzzers(self):
        for name in ("voxels.img", "voxels.vol"):
            (self.folder / name).write_bytes(b"\1" * 4096)
        for format_name, file_name in FORMATS.items():
            files = sorted((CORPUS / format_name).iterdir())
            self.assertGreater(len(files), 3, format_name)
            for path in files:
                (self.folder / file_name).write_bytes(path.read_bytes())
                self.assert_clear(file_name, (DONE, CORRUPT), f"{format_name}/{path.name}")
            (self.folder / file_name).unlink()

    def test_zarr_corpus_of_the_fuzzers(self):
        folder = self.folder / "in.zarr"
        for path in sorted((CORPUS / "ZarrFolder").iterdir()):
            (folder / "0/0/0").mkdir(parents=True)
            (folder / ".zgroup").write_text("{}")
            for part in (b"\n" + path.read_bytes()).split(b"\n@")[1:]:
                name, _, content = part.partition(b"\n")
                (folder / name.decode()).parent.mkdir(parents=True, exist_ok=True)
                (folder / name.decode()).write_bytes(content)
            self.assert_clear("in.zarr", (DONE, CORRUPT), path.name)
            shutil.rmtree(folder)

    def test_meta_image(self):
        (self.folder / "in.mha").write_bytes(meta([]))
        self.assert_clear("in.mha", (DONE,), "the one that the others are made from")
        for what, content in HOSTILE_META.items():
            (self.folder / "in.mha").write_bytes(content)
            self.assert_clear("in.mha", (CORRUPT,), what)

    def test_packed_nonsense(self):
        voxels = b"\x78\x9c" + b"\xff" * 90
        (self.folder / "in.mha").write_bytes(meta(["CompressedData = True", "DimSize = 9 9 9"], voxels))
        status, message = self.run_limited("extract", "in.mha", "out.mha")
        self.assertEqual((status, message.count("\n")), (CORRUPT, 1), message)
        self.assertFalse((self.folder / "out.mha").exists())

    def test_nrrd(self):
        volume = volumes.box_with_plate()
        for what, changes in HOSTILE_NRRD.items():
            self.write_nrrd(volume, **changes)
            self.assert_clear("in.nrrd", (CORRUPT,), what)

    def test_headerless(self):
        (self.folder / "in.raw").write_bytes(b"\1" * 64)
        for size in ("1000000,1000000,1000000", "4294967296,4294967296,4294967296", "-4,4,4", "0,4,4", "4", "4,4,4,1"):
            for kind in ("uint8", "float64"):
                for command in (["info", "in.raw"], ["extract", "in.raw", "out.mha"]):
                    status, message = self.run_limited(*command, f"--raw-size={size}", "--raw-type", kind)
                    self.assertIn(status, (USAGE, CORRUPT), (size, kind, message))
                    self.assertEqual(message.count("\n"), 1, message)

    def test_links_and_pipes(self):
        """What is no regular file is not opened, so that nothing waits for a writer."""
        os.mkfifo(self.folder / "pipe.mha")
        (self.folder / "device.nrrd").symlink_to("/dev/zero")
        (self.folder / "circle.nii").symlink_to("circle.nii")
        for name in ("pipe.mha", "device.nrrd", "circle.nii"):
            self.assert_clear(name, (FAILURE,), name)
        os.mkfifo(self.folder / "voxels.img")
        self.write_nrrd(volumes.box_with_plate(), data_file="voxels.img")
        self.assert_clear("in.nrrd", (FAILURE, CORRUPT), "data file that is a pipe")

    def test_pipes_in_zarr_folders(self):
        for packer in (None, {"id": "gzip", "level": 1}):
            for name in (".zattrs", "s0/.zarray", "s0/0.0.0"):
                folder = self.folder / "in.zarr"
                zarr_folder.write_image(folder, volumes.box_with_plate(), (20, 20, 24), packer)
                (folder / name).unlink()
                os.mkfifo(folder / name)
                # A chunk is not opened before its voxels are needed.
                statuses = (DONE, FAILURE) if name.endswith("0.0") else (FAILURE, CORRUPT)
                self.assert_clear("in.zarr", statuses, name)
                status, message = self.run_limited("extract", "in.zarr", "out.mha", "--thickness", 3)
                self.assertNotEqual(status, DONE, name)
                self.assertIn(name, message)
                shutil.rmtree(folder)


if __name__ == "__main__":
    unittest.main()
