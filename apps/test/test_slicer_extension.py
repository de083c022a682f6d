# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The extension of 3D Slicer: its metadata, its pictures, and its build against a stand-in for Slicer."""

import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
CMAKE = os.environ["MEDIALVOXEL_CMAKE"]

# What find_package(Slicer) gives an extension, as far as ours uses it.
STAND_IN = """
set(Slicer_USE_FILE "${CMAKE_CURRENT_LIST_DIR}/Use.cmake")
set(Slicer_EXTENSION_GENERATE_CONFIG "${CMAKE_CURRENT_LIST_DIR}/Write.cmake")
set(Slicer_EXTENSION_CPACK "${CMAKE_CURRENT_LIST_DIR}/Nothing.cmake")
"""
STAND_IN_USE = """
set(EXTENSION_README_FILE "of Slicer")
set(EXTENSION_LICENSE_FILE "of Slicer")
set(SlicerExecutionModel_DEFAULT_CLI_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib/Slicer-5.9/cli-modules")
set(SlicerExecutionModel_DEFAULT_CLI_INSTALL_RUNTIME_DESTINATION "lib/Slicer-5.9/cli-modules")
set(Slicer_INSTALL_CLIMODULES_SHARE_DIR "share/Slicer-5.9/cli-modules")
"""
STAND_IN_WRITE = """
foreach(name IN ITEMS NAME HOMEPAGE CATEGORY CONTRIBUTORS DESCRIPTION ICONURL SCREENSHOTURLS DEPENDS README_FILE LICENSE_FILE)
  file(APPEND "${CMAKE_BINARY_DIR}/extension.txt" "${name}=${EXTENSION_${name}}\\n")
endforeach()
file(APPEND "${CMAKE_BINARY_DIR}/extension.txt" "version=${MedialVoxel_VERSION}\\n")
"""


def configure(source, folder):
    """Configures the extension and returns what it tells Slicer."""
    slicer = folder / "slicer"
    slicer.mkdir(parents=True)
    for name, text in {
        "SlicerConfig.cmake": STAND_IN,
        "Use.cmake": STAND_IN_USE,
        "Write.cmake": STAND_IN_WRITE,
        "Nothing.cmake": "",
    }.items():
        (slicer / name).write_text(text)
    result = subprocess.run(
        [CMAKE, "-S", source, "-B", folder / "build", f"-DSlicer_DIR={slicer}", "-DCMAKE_BUILD_TYPE=Release"],
        capture_output=True,
        check=False,
        text=True,
    )
    if result.returncode:
        raise AssertionError(result.stdout + result.stderr)
    lines = (folder / "build" / "extension.txt").read_text().splitlines()
    return dict(line.split("=", 1) for line in lines)


def read_picture(path):
    """Size and unpacked pixels of a PNG file with one chunk of pixels."""
    content = path.read_bytes()
    start = content.index(b"IDAT") + 4
    return struct.unpack(">II", content[16:24]), zlib.decompress(content[start : content.rindex(b"IEND") - 8])


class ExtensionTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="medialvoxel-test-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.catalog = json.loads((SOURCE / "slicer/MedialVoxel.json").read_text())

    def assert_told(self, told):
        self.assertEqual(told["NAME"], "MedialVoxel")
        self.assertEqual(told["CATEGORY"], self.catalog["category"])
        self.assertEqual(told["DEPENDS"], "NA")
        self.assertTrue(told["DESCRIPTION"] and told["CONTRIBUTORS"])
        for name in ("README_FILE", "LICENSE_FILE"):
            self.assertTrue(pathlib.Path(told[name]).is_file(), told[name])
        repository = self.catalog["scm_url"].removesuffix(".git")
        page = told["HOMEPAGE"].removeprefix(f"{repository}/blob/{self.catalog['scm_revision']}/")
        self.assertTrue((SOURCE / page).is_file(), page)
        for name in ("ICONURL", "SCREENSHOTURLS"):
            path = told[name].split(f"/{self.catalog['scm_revision']}/")[1]
            self.assertTrue((SOURCE / path).is_file(), path)

    def test_configured_from_its_folder_and_from_the_root(self):
        """Developers name the folder; the build machines of the Extensions Index configure the root."""
        for number, source in enumerate((SOURCE / "slicer", SOURCE)):
            told = configure(source, self.folder / str(number))
            self.assert_told(told)
            self.assertRegex(told["version"], r"^\d+\.\d+\.\d+$")
            modules = self.folder / str(number) / "build/lib/Slicer-5.9/cli-modules"
            xml = SOURCE / "apps/MedialVoxelExtraction/MedialVoxelExtraction.xml"
            self.assertEqual((modules / xml.name).read_bytes(), xml.read_bytes())

    def test_catalog_has_the_keys_of_its_schema(self):
        known = {"$schema", "category", "scm_url", "scm_revision", "scm_type", "build_dependencies"}
        known |= {"build_subdirectory", "enabled", "tier"}
        self.assertLessEqual(set(self.catalog), known)
        self.assertLessEqual({"$schema", "category", "scm_url"}, set(self.catalog))
        self.assertIn(self.catalog["tier"], (1, 3, 5))

    def test_icon(self):
        picture = SOURCE / "slicer/MedialVoxel.png"
        subprocess.run([sys.executable, SOURCE / "slicer/make_icon.py", self.folder / "icon.png"], check=True)
        self.assertEqual(read_picture(picture), read_picture(self.folder / "icon.png"))
        self.assertEqual(read_picture(picture)[0], (128, 128))


if __name__ == "__main__":
    unittest.main()
