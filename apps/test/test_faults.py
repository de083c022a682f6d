# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Files that are cut, hostile or that shrink while they are read, and stops while a volume is unpacked: an error with
the right status, and never a file that looks like a result."""

import itertools
import signal
import struct
import subprocess
import time
import unittest
import unittest.mock

import text_headers
import volumes
from processes import PATIENCE, open_files_of, wait_until
from program import CORRUPT, FAILURE, PROGRAM, READS_TIFF, REFUSED, USAGE, ProgramTestCase, needs_tiff, wait_for_begin

FOUR_GIGABYTES = 1 << 32


def write_all_formats(folder, volume):
    """The volume in every format; yields each file and the one that holds its voxels."""
    for compressed in (False, True):
        for name in ("a.mha", "b.mhd"):
            path = volumes.write_meta(folder / f"{compressed}{name}", volume, compressed=compressed)
            yield path, path if path.suffix == ".mha" else path.with_suffix(".img")
        for name in ("c.nrrd", "d.nhdr"):
            path = volumes.write_nrrd(folder / f"{compressed}{name}", volume, compressed=compressed)
            yield path, path if path.suffix == ".nrrd" else path.with_suffix(".img")
    for version in (1, 2):
        for name in (f"e{version}.nii", f"f{version}.nii.gz"):
            path = volumes.write_nifti(folder / name, volume, version=version)
            yield path, path
        path = volumes.write_nifti(folder / f"g{version}.hdr", volume, version=version)
        yield path, path.with_suffix(".img")
    path = volumes.write_mrc(folder / "h.mrc", volume)
    yield path, path
    for name in ("i.vgi", "j.pcr", "k.vol.info"):
        yield from [(path, folder / (path.name[0] + ".vol")) for path in (text_headers.write(folder / name, volume),)]
    for packing in volumes.TIFF_PACKERS if READS_TIFF else ():
        for tile in (None, (16, 16)):
            name = f"{packing}{tile is not None}.tif"
            path = volumes.write_tiff(folder / name, volume, packing=packing, rows_per_strip=100, tile=tile)
            yield path, path


class CutFileTest(ProgramTestCase):
    def test_every_format_cut_anywhere(self):
        volume = volumes.box_with_plate(kind="int16")
        for path, data_file in write_all_formats(self.folder, volume):
            content = data_file.read_bytes()
            self.extract(path, "whole.mha", "--overwrite")
            for length in (0, 1, 7, len(content) // 3, len(content) // 2, len(content) - 1):
                data_file.write_bytes(content[:length])
                self.assert_fails(CORRUPT, [self.folder], "extract", path, "out.mha", "--thickness", 3)
            data_file.write_bytes(content)

    @needs_tiff
    def test_voxels_of_compressed_tiff_are_damaged(self):
        volume = volumes.box_with_plate(kind="int16")
        path = volumes.write_tiff(self.folder / "in.tif", volume, packing="deflate", rows_per_strip=100)
        content = bytearray(path.read_bytes())
        content[8:24] = b"\xff" * 16
        path.write_bytes(content)
        self.assert_fails(CORRUPT, ["in.tif", "damaged"], "extract", path, "out.mha", "--thickness", 3)


class HostileHeaderTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(kind="int16")

    def assert_refused(self, path, *parts, status=CORRUPT):
        self.assert_fails(status, [path.stem, *parts], "extract", path, "out.mha", "--thickness", 3)
        self.assert_fails(status, [path.stem, *parts], "info", path)

    def test_nifti(self):
        for name, version in itertools.product(("in.nii", "in.nii.gz", "in.hdr"), (1, 2)):
            offset = 0 if name == "in.hdr" else volumes.NIFTI_FIELDS[version][0] + 4
            for parts, changes in (
                (["dim"], {"dim": (3, 24, 20, -16, 1, 1, 1, 1)}),
                (["dim"], {"dim": (3, 24, 0, 16, 1, 1, 1, 1)}),
                ([], {"dim": (3, 32767, 32767, 32767, 1, 1, 1, 1)}),
                (["dimensions"], {"dim": (1, 24, 20, 16, 1, 1, 1, 1)}),
                (["dimensions"], {"dim": (4, 24, 20, 8, 2, 1, 1, 1)}),
                (["dimensions"], {"dim": (-3, 24, 20, 16, 1, 1, 1, 1)}),
                (["dimensions"], {"dim": (32767, 24, 20, 16, 1, 1, 1, 1)}),
                (["datatype", 128], {"datatype": 128}),
                (["bitpix", 8], {"bitpix": 8}),
                (["vox_offset", f"from {offset} on"], {"vox_offset": -352}),
                (["vox_offset"], {"vox_offset": 10**16}),
                *(([(["vox_offset"], {"vox_offset": value}) for value in (float("nan"), 1e30, 352.5)]) if version == 1 else []),
                *([(["vox_offset"], {"vox_offset": offset - 1})] if offset else []),
                (["spacing"], {"pixdim": (1, 1, -1, 1, 1, 1, 1, 1)}),
                (["spacing"], {"pixdim": (1, 1, 0, 1, 1, 1, 1, 1)}),
                (["spacing"], {"pixdim": (1, float("nan"), 1, 1, 1, 1, 1, 1)}),
                (["spacing"], {"sform_code": 1, "srow": (1, 0, 0, 0) * 3}),
                (["origin"], {"qform_code": 1, "qoffset": (0, float("inf"), 0)}),
                (["does not begin"], {"sizeof_hdr": 349}),
                ([f"NIfTI-{version}", ".img" if name == "in.hdr" else "one file"], {"magic": b"nix"}),
            ):
                path = volumes.write_nifti(self.folder / name, self.volume, version=version, **changes)
                self.assert_refused(path, *parts)
        volumes.write_nifti(self.folder / "in.nii", self.volume, sizeof_hdr=540)
        self.assert_refused(self.folder / "in.nii", "NIfTI-2")
        volumes.write_nifti(self.folder / "in.nii", self.volume, version=2, dim=(3, 2**62, 2**62, 2**62, 1, 1, 1, 1))
        self.assert_refused(self.folder / "in.nii", "dim", "more voxels than any file")
        (self.folder / "in.nii").write_bytes(volumes.nifti_header(self.volume, version=2)[:539])
        self.assert_refused(self.folder / "in.nii", "shorter", 540)
        volumes.write_nifti(self.folder / "lost.hdr", self.volume).with_suffix(".img").unlink()
        self.assert_refused(self.folder / "lost.hdr", "lost.img", "missing")
        path = volumes.write_nifti(self.folder / "in.nii", self.volume, vox_offset=1e9)
        self.assert_fails(CORRUPT, ["in.nii", 10**9], "info", path)
        path = volumes.write_nifti(self.folder / "in.nii.gz", self.volume, vox_offset=1e9)
        self.assert_fails(CORRUPT, ["in.nii.gz", "early"], "extract", path, "out.mha", "--thickness", 3)

    @needs_tiff
    def test_tiff(self):
        for packing in volumes.TIFF_PACKERS:
            for parts, changes in (
                (["libtiff"], {"tag_256": 2**32 - 1, "tag_257": 2**32 - 1}),
                (["cannot hold"], {"tag_256": 10**9}),
                (["libtiff"], {"tag_257": 10**9}),
                (["libtiff"], {"tag_256": 0}),
                (["libtiff"], {"tag_256": None}),
                (["bits"], {"tag_258": 12}),
                (["bits"], {"tag_339": 4}),
                (["compression", 7], {"tag_259": 7}),
                (["gray values", 2], {"tag_262": 2}),
                (["one value", 3], {"tag_277": 3}),
                ([], {"tag_322": 16}),
                ([], {"tag_322": 16, "tag_323": 0}),
                ([], {"tag_322": 16, "tag_323": 16, "tag_278": None}),
                (["top to bottom"], {"tag_274": 3}),
                (["highest bit first"], {"tag_266": 2}),
                (["reduced"], {"tag_254": 1}),
                (["libtiff"], {"tag_278": 0}),
                (["lie at 0"], {"tag_273": [8]}),
                (["libtiff"], {"tag_279": None}),
                (["2147483648"], {"tag_279": [2**31] * 3}),
                ([2**32 - 8], {"tag_273": [2**32 - 8] * 3}),
                (["cannot hold"], {"tag_279": [0] * 3}),
            ):
                path = self.folder / "in.tif"
                self.assert_refused(volumes.write_tiff(path, self.volume, packing=packing, **changes), *parts)
        path = volumes.write_tiff(self.folder / "in.tif", self.volume, packing="deflate", tag_317=9)
        self.assert_fails(CORRUPT, ["in.tif", "Predictor"], "extract", path, "out.mha", "--thickness", 3)

    @needs_tiff
    def test_tiles_of_tiff(self):
        for packing in volumes.TIFF_PACKERS:
            for parts, changes in (
                (["cannot hold"], {"tag_322": 2**20}),
                (["empty or has more than 64.0 MiB"], {"tag_322": 2**24, "tag_323": 2**24}),
                (["libtiff"], {"tag_322": 0}),
                (["libtiff"], {"tag_323": 0}),
                (["lie at 0"], {"tag_324": [8]}),
                (["2147483648"], {"tag_325": [2**31] * 4}),
                ([2**32 - 8], {"tag_324": [2**32 - 8] * 4}),
                (["cannot hold"], {"tag_325": [0] * 4}),
                (["one slice"], {"tag_32997": 2}),
                (["one slice"], {"tag_32998": 16}),
                (["compression", 50001], {"tag_259": 50001}),
            ):
                path = self.folder / "in.tif"
                path = volumes.write_tiff(path, self.volume, packing=packing, tile=(16, 16), **changes)
                self.assert_refused(path, *parts)
        nothing = {"nothing": (1, lambda part: b"")}
        with unittest.mock.patch.dict(volumes.TIFF_PACKERS, nothing):
            places = {"tag_324": [8] * 4, "tag_325": [512] * 4}
            volumes.write_tiff(path, self.volume, packing="nothing", tile=(16, 16), **places)
        self.assert_refused(path, "its voxels have 15360")

    @needs_tiff
    def test_directories_of_tiff(self):
        path = volumes.write_tiff(self.folder / "in.tif", self.volume)
        content = path.read_bytes()
        first = struct.unpack("<I", content[4:8])[0]
        following = first + 2 + 10 * 12
        for parts, link in ((["circle"], first), ([len(content)], 2**32 - 1), (["libtiff"], len(content) - 1)):
            changed = content[:following] + struct.pack("<I", link) + content[following + 4 :]
            path.write_bytes(changed)
            self.assert_refused(path, *parts)
        other = volumes.Volume((24, 10, 1), [0] * 240, kind="int16")
        alien = volumes.write_tiff(self.folder / "other.tif", other).read_bytes()
        moved = len(content)
        directory = bytearray(alien[struct.unpack("<I", alien[4:8])[0] :])
        path.write_bytes(content[:following] + struct.pack("<I", moved) + content[following + 4 :] + directory)
        self.assert_refused(path)
        for images in (0, -1, 10**12, "many"):
            one = volumes.Volume((24, 20), self.volume.voxels[:480], kind="int16")
            text = f"ImageJ=1.53t\nimages={images}\n\0".encode()
            self.assert_refused(volumes.write_tiff(path, one, rows_per_strip=20, tag_270=text), "number of images")
        self.assert_refused(
            volumes.write_tiff(path, one, rows_per_strip=20, packing="deflate", tag_270=b"ImageJ=1\nimages=7\n\0"), "only one"
        )

    def test_negative_skips(self):
        for changes in ({"byte_skip": -2}, {"line_skip": -1}, {"byte_skip": -(2**63)}, {"line_skip": 2**64}):
            self.assert_refused(volumes.write_nrrd(self.folder / "in.nrrd", self.volume, **changes), "skip")
        for size in (-2, -(2**63), 2**63):
            self.assert_refused(volumes.write_meta(self.folder / "in.mha", self.volume, HeaderSize=size), "HeaderSize")
        raw = volumes.write_raw(self.folder / "in.raw", self.volume)
        for size in (-1, 2**64):
            self.assert_fails(USAGE, ["--raw-type", size], "info", raw, *volumes.raw_options(self.volume, f":{size}"))

    def test_header_of_four_gigabytes(self):
        """Refused at once, whether it is text without an end or nothing."""
        starts = {"in.mha": b"ObjectType = Image\n", "in.nrrd": b"NRRD0004\n", "in.nii": b""}
        if READS_TIFF:
            starts["in.tif"] = b"II*\0"
        for name, start in starts.items():
            for line in (b"", b"# comment = x\n" * 300000):
                with open(self.folder / name, "wb") as file:
                    file.write(start + line)
                    file.truncate(FOUR_GIGABYTES + 100)
                begin = time.monotonic()
                self.run_program("info", name, status=CORRUPT)
                self.assertLess(time.monotonic() - begin, 10 * PATIENCE, name)
            (self.folder / name).unlink()

    def test_voxels_behind_four_gigabytes(self):
        """A distance in the file that 32 bits do not hold is no error."""
        expected = self.extract(volumes.write_meta(self.folder / "a.mha", self.volume), "a.nrrd") and volumes.read_data(
            self.folder / "a.nrrd"
        )
        with open(self.folder / "far.img", "wb") as file:
            file.seek(FOUR_GIGABYTES + 5)
            file.write(self.volume.data())
        (self.folder / "b.mhd").write_bytes(
            volumes.meta_header(self.volume, "far.img", HeaderSize=FOUR_GIGABYTES + 5)
        )
        (self.folder / "c.nhdr").write_bytes(
            volumes.nrrd_header(self.volume, "far.img", byte_skip=FOUR_GIGABYTES + 5)
        )
        for name in ("b.mhd", "c.nhdr"):
            self.extract(name, "out.mha", "--overwrite")
            self.assertEqual(volumes.read_data(self.folder / "out.mha"), expected)
        (self.folder / "far.img").unlink()


class RunningProgram:
    """The program while it works: once its output has begun, or once it has read so many bytes of an archive."""

    def __init__(self, test, *arguments, archive=None, read=1 << 20):
        command = [PROGRAM, *map(str, arguments), "--progress", "none"]
        self.process = subprocess.Popen(
            command, cwd=test.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        if archive is None:
            wait_for_begin(self.process, test.folder)
        else:
            name = str(test.folder.resolve() / archive)
            wait_until(lambda: open_files_of(self.process.pid).get(name, 0) >= read, "bytes of the archive")

    def finish(self):
        _, message = self.process.communicate(timeout=60)
        return self.process.returncode, message


class RunningTest(ProgramTestCase):
    """Seconds of work, so that what happens meanwhile meets the program."""

    SIZE = (300, 300, 300)

    def make_volume(self):
        volume = volumes.Volume(self.SIZE, [])
        row = (bytes([1] * 3 + [0] * 17) * 15)[: self.SIZE[0]]
        volume.voxels = row * (self.SIZE[1] * self.SIZE[2])
        return volume

    def write_slow_archive(self):
        """Two gigabytes without an object, packed into a file of two megabytes: about a second to unpack."""
        member = volumes.gzip(bytes(1 << 26))
        header = volumes.nrrd_header(volumes.Volume((1 << 10, 1 << 10, 1 << 11), []), encoding="gzip")
        (self.folder / "slow.nrrd").write_bytes(header + member * 32)
        return "slow.nrrd"

    def assert_nothing_left(self, before):
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)

    def cut_while_running(self, source, data_files, length=0, **begin):
        before = sorted(path.name for path in self.folder.iterdir())
        run = ["extract", source, "out.mha", "--thickness", 3, "--divisions", 100, "--memory", "4G"]
        running = RunningProgram(self, *run, **begin)
        running.process.send_signal(signal.SIGSTOP)
        for data_file in data_files:
            with open(self.folder / data_file, "r+b") as file:
                file.truncate(length)
        running.process.send_signal(signal.SIGCONT)
        status, message = running.finish()
        self.assertEqual(status, CORRUPT, f"{source}: {message}")
        self.assertTrue(any(name in message for name in data_files), message)
        self.assert_nothing_left(before)

    def test_file_is_cut_while_it_is_read(self):
        volume = self.make_volume()
        self.cut_while_running(volumes.write_meta(self.folder / "a.mha", volume), ["a.mha"])
        self.cut_while_running(volumes.write_nrrd(self.folder / "b.nhdr", volume), ["b.img"])
        self.cut_while_running(volumes.write_nifti(self.folder / "c.nii", volume), ["c.nii"])
        if READS_TIFF:
            self.cut_while_running(volumes.write_tiff(self.folder / "d.tif", volume, rows_per_strip=300), ["d.tif"])
        names = [f"part{number}.img" for number in range(3)]
        share = len(volume.voxels) // 3
        for number, name in enumerate(names):
            (self.folder / name).write_bytes(volume.voxels[number * share : (number + 1) * share])
        (self.folder / "e.nhdr").write_bytes(volumes.nrrd_header(volume, "part%d.img 0 2 1 3"))
        self.cut_while_running("e.nhdr", names[2:])

    def test_archive_is_cut_while_it_is_unpacked(self):
        source = self.write_slow_archive()
        self.cut_while_running(source, [source], 1 << 20, archive=source)

    def test_stop_while_unpacking(self):
        source = self.write_slow_archive()
        before = sorted(path.name for path in self.folder.iterdir())
        for number in (signal.SIGINT, signal.SIGTERM):
            run = ["extract", source, "out.mha", "--thickness", 3, "--memory", "4G"]
            running = RunningProgram(self, *run, archive=source)
            running.process.send_signal(number)
            status, message = running.finish()
            self.assertEqual(status, 128 + number, message)
            self.assert_nothing_left(before)

    def test_kill_at_any_time(self):
        """Whenever it comes, a complete file has the final name, or none has."""
        volume = volumes.box_with_plate(size=(120, 120, 60))
        source = volumes.write_nifti(self.folder / "in.nii.gz", volume)
        self.extract(source, "whole.mhd")
        expected = volumes.read_data(self.folder / "whole.mhd")
        for delay in (0, 0.01, 0.02, 0.04, 0.08, 0.16):
            running = RunningProgram(self, "extract", source, "out.mha", "--thickness", 3, "--overwrite")
            time.sleep(delay)  # moments all over the run, or after its end: what holds, holds at any time
            running.process.kill()
            status, _ = running.finish()
            self.assertIn(status, (0, -signal.SIGKILL))
            if (self.folder / "out.mha").exists():
                self.assertEqual(volumes.read_data(self.folder / "out.mha"), expected)
                (self.folder / "out.mha").unlink()
            self.assert_nothing_left(["in.nii.gz", "whole.mhd", "whole.raw"])


class ScratchDiskTest(ProgramTestCase):
    def test_scratch_folder_without_space(self):
        """Values of 27 MB do not fit a disk of one, unless they are zero."""
        self.mount_small_disk(self.folder / "disk", "1M")
        volume = volumes.Volume((300, 300, 300), [])
        volume.voxels = bytes(300**3)
        source = volumes.write_nrrd(self.folder / "in.nrrd", volume, compressed=True)
        run = ["extract", source, "out.mha", "--thickness", 3, "--scratch", "disk", "--threads", 1]
        run += ["--memory", self.find_least_memory(*run, "--sparse") + (1 << 21)]
        for more in ([], ["--dry-run"]):
            self.assert_fails(REFUSED, ["no space", "scratch files", "disk", "25.7 MiB"], *run, *more)
        self.run_program(*run, "--sparse")
        volume.voxels = bytes([1]) * 300**3
        volumes.write_nrrd(source, volume, compressed=True)
        self.assert_fails(FAILURE, ["cannot write the scratch file", "disk", "No space left"], *run, "--sparse", "--overwrite")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["disk", "in.nrrd", "out.mha"])


if __name__ == "__main__":
    unittest.main()
