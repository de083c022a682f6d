# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Builds the program without formats that can be left out, in a folder of its own, and tests it; run by ctest -C Large,
as it takes minutes."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import test_left_out

BUILD = pathlib.Path(os.environ["MEDIALVOXEL_BUILD"])
CMAKE = os.environ["MEDIALVOXEL_CMAKE"]

# As the build beside it, but for optimization, which takes half of the time and changes no result.
KEPT = ("ITK_DIR", "CLI11_DIR", "nlohmann_json_DIR") + tuple(
    f"CMAKE_{language}_COMPILER{end}" for language in ("C", "CXX") for end in ("", "_LAUNCHER")
)
LEFT_OUT = [f"-DMedialVoxel_FORMAT_{name}=OFF" for name in ("TEXT", "ZARR", "SLICES")]
OTHERS = [f"-DMedialVoxel_BUILD_{name}=OFF" for name in ("BENCH", "EXAMPLES", "PYTHON")]
UNKNOWN = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("TIFF", "PNG", "JPEG")]


class BuildWithoutFormatsTest(test_left_out.LeftOutFormatsTest):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="medialvoxel-test-")
        cls.addClassCleanup(temporary.cleanup)
        cache = (BUILD / "CMakeCache.txt").read_text(encoding="utf-8")
        kept = [f"-D{key}={value}" for key, value in re.findall(r"^(\w+):\w+=(.+)$", cache, re.MULTILINE) if key in KEPT]
        options = [*kept, *LEFT_OUT, *OTHERS, *UNKNOWN, "-DBUILD_TESTING=OFF", "-DMedialVoxel_BUILD_APPS=ON"]
        options += ["-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O0"]
        source = os.environ["MEDIALVOXEL_SOURCE"]
        subprocess.run([CMAKE, "-S", source, "-B", temporary.name, *options], check=True, capture_output=True)
        build = [CMAKE, "--build", temporary.name, "--target", "medialvoxel", "--parallel", str(os.cpu_count())]
        result = subprocess.run(build, check=False, capture_output=True, text=True)
        if result.returncode:
            raise AssertionError(result.stdout[-10000:] + result.stderr[-10000:])
        cls.PROGRAM = f"{temporary.name}/apps/medialvoxel/medialvoxel"

    def test_libraries_of_formats_are_not_linked(self):
        linked = subprocess.run(["ldd", self.PROGRAM], check=True, capture_output=True, text=True).stdout
        self.assertIn("libz.", linked)
        self.assertNotRegex(linked, "lib(tiff|png|jpeg|blosc|zstd|gdcm)")


if __name__ == "__main__":
    unittest.main()
