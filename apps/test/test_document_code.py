# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Blocks of shell and Python in the documents run as they stand, each in a new folder with a part and a headerless scan."""

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
    ("doc/how-to/large-volumes.md", "medialvoxel info scan ", "needs series of slices: test_series runs them"),
    ("doc/how-to/jobs.md", "medialvoxel plan part.mha medial.mha job --memory 4G", "needs Slurm: test_slurm runs such jobs"),
    ("doc/how-to/jobs.md", "sbatch --dependency", "needs Slurm: test_slurm runs such jobs"),
    ("doc/how-to/numpy.md", "pip install ./python", "installs packages and builds"),
    ("doc/how-to/numpy.md", "scripts/build-numpy-wheel", "builds ITK and a wheel, half an hour"),
    ("doc/how-to/meshes-and-fem.md", "pip install meshio", "installs packages: python/test/test_check.py runs the check"),
    ("doc/how-to/jobs.md", "python3 python/medialvoxel_dask.py", "needs a Dask cluster: test_dask runs such jobs"),
    ("doc/how-to/jobs.md", "from distributed import Client", "needs a Dask cluster: test_dask runs such jobs"),
    ("doc/how-to/jobs.md", "PARTS, CLUSTERS = 8, 64", "a Snakefile, which test_job_recipes runs"),
    ("doc/how-to/jobs.md", "medialvoxel plan part.mha medial.mha job --divisions 64", "test_job_recipes runs it"),
)

# Page, begin of the block, what it expects to be there.
PREPARED = {
    ("doc/how-to/jobs.md", "medialvoxel work job --log-file"): "medialvoxel plan part.mha medial.mha job --lower 72",
    ("doc/how-to/label-maps.md", "medialvoxel extract segments.mha"): "cp part.mha segments.mha",
    ("doc/how-to/label-maps.md", "medialvoxel extract scan.seg.nrrd"): "medialvoxel extract part.mha scan.seg.nrrd",
    ("doc/how-to/label-maps.md", "python3 -c"): "medialvoxel extract part.mha x.mha --labels all --report report.json",
    ("doc/how-to/wall-thickness.md", "medialvoxel extract part.mha fine.mha"): "cp gray.mha part.mha",
    ("doc/how-to/wall-thickness.md", "awk -F,"): "medialvoxel extract part.mha x.mha --lower 72 --thickness-csv thickness.csv",
    ("doc/how-to/large-volumes.md", "import zarr"): "medialvoxel extract part.mha part.ome.zarr --lower 72",
}


def all_blocks():
    """Page, language and text of each block, without the indentation that it has in a list."""
    for path in [*sorted(SOURCE.glob("*.md")), *sorted((SOURCE / "doc").rglob("*.md"))]:
        for indent, language, text in BLOCK.findall(path.read_text(encoding="utf-8")):
            yield path.relative_to(SOURCE).as_posix(), language, re.sub(rf"^{indent}", "", text, flags=re.MULTILINE)


def row_of(rows, page, text):
    """The row of a table that the block belongs to."""
    return next((row for row in rows if row[0] == page and text.startswith(row[1])), None)


def missing_modules(text):
    names = set(re.findall(r"^(?:import|from) (\w+)", text, re.MULTILINE))
    return sorted(name for name in names if importlib.util.find_spec(name) is None)


class DocumentCodeTest(ProgramTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "part.mha", volumes.box_with_plate((60, 50, 40)))
        volumes.write_raw(self.folder / "scan.raw", volumes.box_with_plate((60, 50, 40)).as_type("uint16"))
        volumes.write_meta(self.folder / "gray.mha", volumes.blurred_wall(7))
        path = [str(pathlib.Path(name).parent) for name in (PROGRAM, MODULE)]
        self.environment = {**os.environ, "PATH": os.pathsep.join([*path, os.environ["PATH"]])}

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
        for page, begin, *_ in [*NOT_RUN, *PREPARED]:
            self.assertTrue(any(row_of([(page, begin)], name, text) for name, _, text in blocks), (page, begin))

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


def add_test(number, page, language, text):
    def test(self):
        reason = row_of(NOT_RUN, page, text)
        if reason:
            self.skipTest(reason[2])
        if "--memory" in text and os.environ.get("MEDIALVOXEL_SANITIZED"):
            self.skipTest("the checks of a sanitizer multiply memory")
        missing = missing_modules(text) if language == "python" else []
        if missing:
            self.skipTest(f"not installed: {', '.join(missing)}")
        if "import itk" in text and not hasattr(__import__("itk"), "MedialVoxelImageFilter"):
            self.skipTest("the wheel itk-medialvoxel is not installed")
        preparation = row_of(PREPARED, page, text)
        if preparation:
            self.run_block("sh", PREPARED[preparation])
        self.run_block(language, text)

    name = f"test_{re.sub(r'[^a-z]+', '_', page.removesuffix('.md').lower())}_{number:02}"
    setattr(DocumentCodeTest, name, test)


for block_number, block in enumerate(all_blocks()):
    add_test(block_number, *block)


if __name__ == "__main__":
    unittest.main()
