# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""No result depends on how a C library rounds: functions that differ between libraries are moved by an ulp, or missing."""

import os
import pathlib
import random
import shutil
import struct
import subprocess
import unittest

import volumes
from jobs import JobTestCase, results
from program import PROGRAM
from series import needs_dicom
from test_gray_walls import scan

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
BUILD = pathlib.Path(os.environ["MEDIALVOXEL_BUILD"])
DATA = SOURCE.parent / "shared/data"
MOVED_MATH = os.environ.get("MEDIALVOXEL_MOVED_MATH", "")
DUMP = os.environ.get("MEDIALVOXEL_DUMP", "")

# Their results differ between C libraries, each with and without f or l behind it.
INEXACT = (
    "acos acosh asin asinh atan atanh atan2 cbrt cos cosh erf erfc exp exp2 exp10 expm1 hypot lgamma log log2 log10 log1p pow "
    "sin sincos sinh tan tanh tgamma"
).split()

# Code whose results are files, or arrays of Python.
FOLDERS = ("include", "src", "shell", "apps/job", "apps/medialvoxel", "python/native")
OBJECTS = ("src", "apps/job", "apps/medialvoxel", "python")

MAPS = (
    "--thickness-map t.mha --uncertainty-map u.mha --vectors v.mha --distance d.mha --local-thickness o.mha --importance i.mha --importance-threshold h.mha --walls w.mha --wall-table w.csv --seam-table s.csv "
    "--thin-below 2.5 --thick-above 6 --places p.csv --report r.json --html p.html --preview p.png"
).split()
RUNS = {
    "maps": ("extract", "l.mha", *MAPS),
    "balls": ("extract", "l.mha", "--local-thickness", "o.mha", "--local-thickness-method", "sphere", "--report", "r.json"),
    "fixed": ("extract", "l.mha", "--thickness", "4.5", "--thickness-map", "t.mha", "--mesh", "m.ply"),
    "distance": ("distance", "v.mha", "--distance", "d.mha", "--report", "r.json"),
    "glTF": ("mesh", "m.glb"),
    "elements": ("mesh", "m.inp", "--element-size", "auto", "--report", "r.json"),
    "surface": ("surface", "s.ply", "--ray", "--report", "r.json"),
}

needs_nm = unittest.skipUnless(shutil.which("nm"), "nm is not installed")


def foam(size=(40, 36, 30), spacing=(0.9, 0.9, 1.3)):
    """Round pores in a block, all edges blurred: angles of all kinds."""
    draw = random.Random(5)
    balls = [([draw.uniform(0, n) for n in size], draw.uniform(3, 8)) for _ in range(14)]
    volume = volumes.Volume(size, [], spacing, "int16")
    for index in volume.indices():
        gap = min(sum((a - b) ** 2 for a, b in zip(index, center)) ** 0.5 - radius for center, radius in balls)
        ends = min(min(i, n - 1 - i) for i, n in zip(index, size)) - 3
        volume.voxels.append(round(1000 * min(max(0.5 + 0.4 * min(gap, ends), 0), 1) + draw.gauss(0, 30)))
    return volume


def write_dicom(path, number, place, voxels, size, spacing):
    """A slice as plain as DICOM has it."""

    def element(group, tag, kind, value):
        value = value if isinstance(value, bytes) else value.encode()
        value += b"" if len(value) % 2 == 0 else b"\0" if kind == "UI" else b" "
        length = struct.pack("<xxI" if kind in ("OB", "OW") else "<H", len(value))
        return struct.pack("<HH2s", group, tag, kind.encode()) + length + value

    def short(group, tag, value):
        return element(group, tag, "US", struct.pack("<H", value))

    meta = element(2, 1, "OB", b"\0\1") + element(2, 2, "UI", "1.2.840.10008.5.1.4.1.1.2")
    meta += element(2, 3, "UI", f"1.2.9.{number}") + element(2, 0x10, "UI", "1.2.840.10008.1.2.1")
    body = element(8, 0x16, "UI", "1.2.840.10008.5.1.4.1.1.2") + element(8, 0x18, "UI", f"1.2.9.{number}")
    body += element(8, 0x60, "CS", "CT") + element(0x20, 0xD, "UI", "1.2.3") + element(0x20, 0xE, "UI", "1.2.9")
    body += element(0x20, 0x13, "IS", str(number)) + element(0x20, 0x32, "DS", f"0\\0\\{place}")
    body += element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") + short(0x28, 2, 1) + element(0x28, 4, "CS", "MONOCHROME2")
    body += short(0x28, 0x10, size[1]) + short(0x28, 0x11, size[0])
    body += element(0x28, 0x30, "DS", f"{spacing[1]}\\{spacing[0]}") + short(0x28, 0x100, 16) + short(0x28, 0x101, 16)
    body += short(0x28, 0x102, 15) + short(0x28, 0x103, 1)
    body += element(0x7FE0, 0x10, "OW", volumes.Volume((), voxels, kind="int16").data())
    length = element(2, 0, "UL", struct.pack("<I", len(meta)))
    path.write_bytes(bytes(128) + b"DICM" + length + meta + body)


def symbols_of(*command):
    """Files and the symbols that they take from others, without versions."""
    lines = subprocess.run(["nm", "-A", *map(str, command)], capture_output=True, text=True, check=True).stdout.splitlines()
    return {(line.split(":")[0], line.split()[-1].split("@")[0]) for line in lines}


def forbidden(symbols):
    names = {name + kind for name in INEXACT for kind in ("", "f", "l")}
    return sorted((path, name) for path, name in symbols if name in names)


@unittest.skipUnless(MOVED_MATH, "nothing can be preloaded here")
class MovedMathTest(JobTestCase):
    def setUp(self):
        super().setUp()
        self.called = self.folder / "called"

    def run_moved(self, *command):
        environment = {**os.environ, "LD_PRELOAD": MOVED_MATH, "MEDIALVOXEL_CALLED_MATH": str(self.called)}
        options = {"capture_output": True, "text": True, "cwd": self.target, "check": False}
        return subprocess.run(list(map(str, command)), env=environment, **options)

    def check(self, name, *arguments):
        """The same files and texts from the functions of the system, and from those beside them."""
        expected = self.in_target(*arguments)
        files = results(self.target)
        self.clear_target()
        found = self.run_moved(PROGRAM, *arguments)
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertTrue(self.called.exists(), "nothing was preloaded")
        moved = results(self.target)
        self.clear_target()
        differ = [name for name in files if files[name] != moved.get(name)]
        if arguments[0] == "info" and found.stdout != expected.stdout:
            differ.append("text")
        self.assertEqual((sorted(files), differ), (sorted(moved), []), name)

    def check_runs(self, source, *options):
        """Masks have no uncertainty."""
        left_out = () if options else ("--uncertainty-map", "u.mha")
        for name, (command, target, *arguments) in RUNS.items():
            with self.subTest(name):
                given = [word for word in arguments if word not in left_out]
                self.check(name, command, source, target, *given, *options)

    def test_the_functions_are_moved(self):
        python = "import math; print(math.acos(0.3), math.exp(0.3), math.pow(0.3, 0.7), math.atan2(1, 3), math.log10(7))"
        command = [shutil.which("python3"), "-c", python]
        plain = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
        self.assertTrue(all(a != b for a, b in zip(plain, self.run_moved(*command).stdout.split())))
        environment = {**os.environ, "LD_PRELOAD": MOVED_MATH, "LD_TRACE_LOADED_OBJECTS": "1"}
        loaded = subprocess.run([PROGRAM], capture_output=True, text=True, env=environment, check=True).stdout
        self.assertRegex(loaded, r"MovedMath(.|\n)*\blibm\.so", "the program has functions of its own")

    def test_gray_values(self):
        volumes.write_meta(self.folder / "in.mha", foam())
        self.check_runs("../in.mha", "--lower", "otsu")

    def test_a_blurred_scan(self):
        volume, _ = scan(size=(44, 40, 36))
        volume.spacing = (0.5, 0.5, 0.75)
        volumes.write_meta(self.folder / "in.mha", volume)
        self.check_runs("../in.mha", "--lower", "5000")

    def test_a_mask(self):
        volume = foam()
        volume.voxels = [int(value > 500) for value in volume.voxels]
        volumes.write_meta(self.folder / "in.mha", volume)
        self.check_runs("../in.mha")

    def test_statistics_of_values(self):
        for kind in ("int16", "int32", "float32", "float64"):
            volumes.write_meta(self.folder / "in.mha", foam().as_type(kind))
            self.check(kind, "info", "../in.mha", "--values")

    @needs_dicom
    def test_places_of_slices(self):
        volume = foam(spacing=(0.7, 0.7, 0.8))
        layer = volume.size[0] * volume.size[1]
        series = self.folder / "series"
        series.mkdir()
        for number in range(volume.size[2]):
            voxels = volume.voxels[number * layer : (number + 1) * layer]
            place = f"{0.1 + 0.8 * number:.2f}"
            write_dicom(series / f"{number}.dcm", number + 1, place, voxels, volume.size, volume.spacing)
        self.check("series", "info", "../series")
        self.check("series", "extract", "../series", "l.mha", "--lower", "otsu", "--thickness-map", "t.mha")

    @unittest.skipUnless(DATA.exists(), "needs the real volumes beside the repository")
    def test_a_real_scan(self):
        self.check_runs(DATA / "engine.mha", "--lower", "72", "--memory", "1G")

    @unittest.skipUnless(DUMP, "the dump of the filters is not built")
    def test_the_bound_of_the_paper(self):
        for fixture in ("plane", "isotropic", "anisotropic"):
            subprocess.run([DUMP, "labels", fixture, "plain"], cwd=self.target, check=True)
            self.assertEqual(self.run_moved(DUMP, "labels", fixture, "moved").returncode, 0)
            plain, moved = ((self.target / name).read_bytes() for name in ("plain", "moved"))
            self.assertTrue(plain == moved, fixture)


class ExactSourcesTest(unittest.TestCase):
    @needs_nm
    def test_no_object_calls_them(self):
        objects = [path for folder in OBJECTS for path in (BUILD / folder).rglob("*.o")]
        objects = [path for path in objects if "test" not in path.relative_to(BUILD).parts]
        symbols = symbols_of("--undefined-only", *objects)
        self.assertIn("memcpy", {name for _, name in symbols}, "symbols are not seen")
        self.assertEqual(forbidden(symbols), [])

    @needs_nm
    def test_no_library_calls_them(self):
        """Objects of files that are compiled at the link tell nothing."""
        libraries = [path for folder in ("src", "python") for path in (BUILD / folder).rglob("*.so*") if not path.is_symlink()]
        if not libraries:
            self.skipTest("no shared libraries")
        self.assertEqual(forbidden(symbols_of("--dynamic", "--undefined-only", *libraries)), [])

    def test_no_number_has_a_width_of_its_own(self):
        files = [path for folder in FOLDERS for path in (SOURCE / folder).rglob("*") if path.suffix in (".h", ".hxx", ".cxx")]
        self.assertGreater(len(files), 300)
        for path in files:
            self.assertNotRegex(path.read_text("utf-8"), r"\blong\s+double\b", path)


if __name__ == "__main__":
    unittest.main()
