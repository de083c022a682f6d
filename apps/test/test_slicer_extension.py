# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The extension of 3D Slicer: its metadata, its pictures, and its build against a stand-in for Slicer."""

import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import urllib.parse
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
macro(slicerMacroBuildScriptedModule)
  cmake_parse_arguments(_scripted "WITH_GENERIC_TESTS;WITH_SUBDIR;VERBOSE" NAME "SCRIPTS;RESOURCES" ${ARGN})
  if(_scripted_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "Unknown keywords: ${_scripted_UNPARSED_ARGUMENTS}")
  endif()
  file(APPEND "${CMAKE_BINARY_DIR}/extension.txt" "${_scripted_NAME}=${_scripted_SCRIPTS};${_scripted_RESOURCES}\n")
endmacro()
"""
STAND_IN_WRITE = """
foreach(name IN ITEMS NAME HOMEPAGE CATEGORY CONTRIBUTORS DESCRIPTION ICONURL SCREENSHOTURLS DEPENDS README_FILE LICENSE_FILE)
  file(APPEND "${CMAKE_BINARY_DIR}/extension.txt" "${name}=${EXTENSION_${name}}\\n")
endforeach()
file(APPEND "${CMAKE_BINARY_DIR}/extension.txt" "version=${MedialVoxel_VERSION}\\n")
"""


# How scripts/check_description_files.py of Slicer/ExtensionsIndex (August 2026) reads the CMakeLists.txt of the root, and the
# names that it takes.
INDEX_PROJECT = r"project\s*\(\s*([^\s\)\n\r]+)"
INDEX_ICON = r'set\s*\(EXTENSION_ICONURL\s*"([^"]+)"[ ]*\)'
INDEX_SCREENSHOTS = r'set\s*\(EXTENSION_SCREENSHOTURLS\s*"([^"]+)"\)'
INDEX_LICENSES = ("LICENSE", "LICENCE", "License.txt", "license.txt", "LICENSE.txt", "COPYING", "COPYING.txt")
INDEX_CATEGORIES = ("Filtering", "Filtering.Morphology", "Quantification", "Shape Analysis", "Surface Models")
INDEX_BYTES = 100 * 2**20


def configure(source, folder, *options, done=True):
    """Configures the extension and returns what it tells Slicer; not done: its error."""
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
        [CMAKE, "-S", source, "-B", folder / "build", f"-DSlicer_DIR={slicer}", "-DCMAKE_BUILD_TYPE=Release", *options],
        capture_output=True,
        check=False,
        text=True,
    )
    if (result.returncode == 0) != done:
        raise AssertionError(result.stdout + result.stderr)
    if not done:
        return result.stderr
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
        for name in ("HOMEPAGE", "ICONURL", "SCREENSHOTURLS"):
            self.assert_in_repository(told[name])

    def assert_in_repository(self, address):
        """The address is one of the file in the repository of the catalog."""
        path = urllib.parse.urlsplit(self.catalog["scm_url"].removesuffix(".git")).path
        places = (f"https://github.com{path}/blob/", f"https://raw.githubusercontent.com{path}/")
        self.assertTrue(address.startswith(places), address)
        file = address.split(f"/{self.catalog['scm_revision']}/", 1)[1]
        self.assertTrue((SOURCE / file).is_file(), file)

    def test_configured_from_the_root(self):
        """As the machines that build extensions do."""
        told = configure(SOURCE, self.folder)
        self.assert_told(told)
        self.assertRegex(told["version"], r"^\d+\.\d+\.\d+$")

    def test_the_scripted_module_is_whole(self):
        """Slicer installs the files that are listed, and no others."""
        listed = configure(SOURCE, self.folder)["MedialVoxelWalls"].split(";")
        folder = SOURCE / "apps/MedialVoxelWalls"
        there = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
        self.assertEqual(set(listed), {name for name in there if "__pycache__" not in name} - {"CMakeLists.txt"})

    def test_its_folder_by_itself_is_refused(self):
        self.assertIn("Configure the root", configure(SOURCE / "slicer", self.folder, done=False))

    def test_what_the_index_reads(self):
        """With the index's own expressions; the extension's name is that of the file."""
        text = (SOURCE / "CMakeLists.txt").read_text()
        flags = re.IGNORECASE | re.MULTILINE
        self.assertEqual(re.findall(INDEX_PROJECT, text, flags)[0].strip().strip("\"'"), "MedialVoxel")
        (icon,) = re.findall(INDEX_ICON, text, flags)
        (screenshots,) = re.findall(INDEX_SCREENSHOTS, text, flags)
        for address in (icon, *screenshots.split()):
            self.assertRegex(address, r"^https://.*\.(png|jpg|jpeg|gif)$")
            self.assert_in_repository(address)

    def test_what_the_index_checks(self):
        address = urllib.parse.urlsplit(self.catalog["scm_url"])
        self.assertIn(address.scheme, ("git", "https"))
        self.assertTrue(pathlib.PurePosixPath(address.path).stem.startswith("Slicer"))
        self.assertIn(self.catalog["category"], INDEX_CATEGORIES)
        self.assertEqual(self.catalog["build_dependencies"], [])
        self.assertTrue(any((SOURCE / name).is_file() for name in INDEX_LICENSES))
        self.assertNotIn(b"\r", (SOURCE / "slicer/MedialVoxel.json").read_bytes())
        files = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, capture_output=True, check=False, text=True).stdout
        self.assertLess(sum((SOURCE / name).stat().st_size for name in files.split("\0") if (SOURCE / name).is_file()), INDEX_BYTES)

    def test_another_header_library_is_refused(self):
        """Slicer builds no JSON library. What is fetched must be the known file."""
        other = self.folder / "json.hpp"
        other.write_text("// another\n")
        options = ("-DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON", f"-DMedialVoxel_JSON_URL=file://{self.folder}")
        self.assertIn("HASH mismatch", configure(SOURCE, self.folder, *options, done=False))

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
