# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Blocks of shell and Python in the documents run as they stand, one after the other: those of a page in a new folder with
a part, a label map and a headerless scan, and those of all pages in one folder."""

import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

import volumes
from program import PROGRAM, ProgramTestCase

SOURCE = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"])
MODULE = os.environ["MEDIALVOXEL_MODULE"]
NOTEBOOK = SOURCE / "examples/medial_sheet.ipynb"
LARGEST_NOTEBOOK = 300_000
BLOCK = re.compile(r"^( *)```(sh|bash|shell|python)\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
SECONDS = 120

# Page, begin of the block, why it is not run.
NOT_RUN = (
    ("README.md", "./scripts/demo", "installs packages, builds, and runs all tests"),
    ("README.md", "scripts/install-packages build program", "installs packages and builds"),
    ("README.md", "scripts/package", "builds ITK and an archive, half an hour; scripts/test-package runs it"),
    ("doc/getting-started/terminal.md", "scripts/install-packages build program", "installs packages and builds"),
    ("doc/getting-started/slicer.md", "scripts/install-packages build program", "installs packages and builds"),
    ("doc/getting-started/slicer.md", "cmake -S . -B build/extension", "needs a build tree of 3D Slicer"),
    ("doc/getting-started/python.md", "scripts/build-python-wheel", "builds ITK for Python, half an hour"),
    ("doc/how-to/scans.md", "medialvoxel info scan ", "needs series of slices: test_series runs them"),
    ("doc/how-to/jobs.md", "medialvoxel plan part.mha medial.mha job --memory 4G", "needs Slurm: test_slurm runs such jobs"),
    ("doc/how-to/jobs.md", "sbatch --dependency", "needs Slurm: test_slurm runs such jobs"),
    ("doc/how-to/numpy.md", "pip install ./python", "installs packages and builds"),
    ("doc/reference/platforms.md", "scripts/cross linux-arm64", "builds ITK for Arm, an hour"),
    ("doc/reference/platforms.md", "cd apps/test", "compares outputs of real volumes for minutes"),
    ("doc/reference/platforms.md", "scripts/compilers", "installs six compilers"),
    ("doc/how-to/numpy.md", "scripts/build-numpy-wheel", "builds ITK and a wheel, half an hour"),
    ("doc/how-to/meshes-and-fem.md", "pip install meshio", "installs packages: python/test/test_check.py runs the check"),
    ("doc/how-to/jobs.md", "python3 python/medialvoxel_dask.py", "needs a Dask cluster: test_dask runs such jobs"),
    ("doc/how-to/jobs.md", "from distributed import Client", "needs a Dask cluster: test_dask runs such jobs"),
    ("doc/how-to/jobs.md", "PARTS, CLUSTERS = 8, 64", "a Snakefile, which test_job_recipes runs"),
    ("doc/how-to/jobs.md", "medialvoxel plan part.mha medial.mha job --divisions 64", "test_job_recipes runs it"),
)

def all_blocks():
    """Page, language and text of each block, without the indentation that it has in a list."""
    for path in [*sorted(SOURCE.glob("*.md")), *sorted((SOURCE / "doc").rglob("*.md"))]:
        for indent, language, text in BLOCK.findall(path.read_text(encoding="utf-8")):
            yield path.relative_to(SOURCE).as_posix(), language, re.sub(rf"^{indent}", "", text, flags=re.MULTILINE)


def row_of(page, text):
    """The row of NOT_RUN that the block belongs to."""
    return next((row for row in NOT_RUN if row[0] == page and text.startswith(row[1])), None)


def missing_modules(text):
    names = set(re.findall(r"^(?:import|from) (\w+)", text, re.MULTILINE))
    return sorted(name for name in names if importlib.util.find_spec(name) is None)


class DocumentCodeTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "part.mha", volumes.blurred_wall(7))
        volumes.write_meta(self.folder / "segments.mha", volumes.box_with_plate((60, 50, 40)))
        volumes.write_raw(self.folder / "scan.raw", volumes.box_with_plate((60, 50, 40)).as_type("uint16"))
        path = [str(pathlib.Path(name).parent) for name in (PROGRAM, MODULE)]
        self.environment = {**os.environ, "PATH": os.pathsep.join([*path, os.environ["PATH"]])}
        self.run_block("sh", "medialvoxel extract segments.mha scan.seg.nrrd --quiet")

    def run_block(self, language, text):
        shell = ["bash", "-e", "-u", "-o", "pipefail", "-c"]
        command = [sys.executable, "-B", "-c", text] if language == "python" else [*shell, text]
        result = subprocess.run(
            command, cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False, timeout=SECONDS
        )
        self.assertEqual(result.returncode, 0, f"{text}\n{result.stdout}{result.stderr}")
        return result.stdout

    def test_each_row_is_of_a_block(self):
        blocks = list(all_blocks())
        self.assertGreater(len(blocks), 30)
        for page, begin, _ in NOT_RUN:
            self.assertTrue(any(page == name and text.startswith(begin) for name, _, text in blocks), (page, begin))

    def test_the_notebook_was_run_from_its_first_to_its_last_cell(self):
        cells = [cell for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
        self.assertEqual([cell["execution_count"] for cell in cells], list(range(1, len(cells) + 1)))
        outputs = [output for cell in cells for output in cell["outputs"]]
        self.assertNotIn("error", [output["output_type"] for output in outputs])
        self.assertEqual(sum("image/png" in output.get("data", {}) for output in outputs), 3)
        self.assertLess(NOTEBOOK.stat().st_size, LARGEST_NOTEBOOK)

    def test_the_notebook_runs_and_prints_what_it_shows(self):
        cells = [cell for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
        code = "\n".join("".join(cell["source"]) for cell in cells)
        missing = missing_modules(code)
        if missing:
            self.skipTest(f"not installed: {', '.join(missing)}")
        printed = self.run_block("python", "import matplotlib\nmatplotlib.use('Agg')\n" + code)
        outputs = [output for cell in cells for output in cell["outputs"] if output["output_type"] == "stream"]
        self.assertEqual(printed, "".join("".join(output["text"]) for output in outputs))


def reason_to_skip(page, language, text):
    row = row_of(page, text)
    missing = missing_modules(text) if language == "python" else []
    if row:
        return row[2]
    if "--memory" in text and os.environ.get("MEDIALVOXEL_SANITIZED"):
        return "the checks of a sanitizer multiply memory"
    if missing:
        return f"not installed: {', '.join(missing)}"
    if "import itk" in text and not hasattr(__import__("itk"), "MedialVoxelImageFilter"):
        return "the wheel itk-medialvoxel is not installed"
    return None


def add_test(name, blocks):
    def test(self):
        for page, language, text in blocks:
            with self.subTest(page=page, block=text.splitlines()[0]):
                reason = reason_to_skip(page, language, text)
                if reason:
                    self.skipTest(reason)
                self.run_block(language, text)

    setattr(DocumentCodeTest, f"test_{re.sub('[^a-z]+', '_', name.lower())}", test)


for one_page in sorted({page for page, _, _ in all_blocks()}):
    add_test(one_page.removesuffix(".md"), [block for block in all_blocks() if block[0] == one_page])
add_test("all pages in one folder", list(all_blocks()))


if __name__ == "__main__":
    unittest.main()
