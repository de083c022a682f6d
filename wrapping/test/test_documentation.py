# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Functions and classes are described and typed, and the examples of their docstrings run."""

import ast
import doctest
import importlib.util
import inspect
import pathlib
import pydoc
import subprocess
import sys
import tempfile
import unittest

import itk

FUNCTIONS = {
    itk.medial_voxel_image_filter: itk.MedialVoxelImageFilter,
    itk.medial_voxel_objects_image_filter: itk.MedialVoxelObjectsImageFilter,
    itk.vector_distance_map_image_filter: itk.VectorDistanceMapImageFilter,
    itk.local_thickness_image_filter: itk.LocalThicknessImageFilter,
    itk.medial_surface_mesh_filter: itk.MedialSurfaceMeshFilter,
}

# Words of the help that a reader needs: meaning, units, defaults, errors.
NEEDED = ("physical units", "(default", "Default ", "Raises RuntimeError", "TypeError", "lower_threshold: ", ">>> ")

TYPED = """
import itk
import numpy as np

mask = np.zeros((4, 5, 6), np.uint8)
labels: np.ndarray = itk.medial_voxel_image_filter(mask, thickness=np.float32(3), maximum_pore_size=np.int64(2))
labels.astype(np.int16)
itk.medial_voxel_image_filter(itk.imread("part.mha"), scan_levels=(1, 2.5))
itk.medial_voxel_objects_image_filter(mask, object_labels=[1, 2]).astype(np.int16)
itk.local_thickness_image_filter(mask, largest_ball=10, use_image_spacing=False).astype(np.float64)
itk.medial_surface_mesh_filter(mask, subvoxel_thickness=np.bool_(True))
itk.medial_surface_mesh_filter(mask, thickness_mode=itk.MedialVoxelEnums.ThicknessMode_Automatic)
itk.median_image_filter(mask, radius=2)
"""

WRONG = ('thickness="auto"', "thicknes=3", "generate_thickness=3", "scan_levels=5", "object_labels=[1.5]")


def parameters_of(function):
    """Names of the parameters of a function, but for the mesh to write to, which ITK adds."""
    kinds = inspect.signature(function).parameters.items()
    return {name for name, parameter in kinds if parameter.kind == inspect.Parameter.KEYWORD_ONLY} - {"output"}


def stub():
    """Path of the types of the functions."""
    return pathlib.Path(itk.__path__[0]).parent / "itk-stubs" / "__init__.pyi"


def declared_parameters():
    """Names of the parameters of each function that the types have."""
    found = {}
    for node in ast.parse(stub().read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef):
            found.setdefault(node.name, []).append([argument.arg for argument in node.args.kwonlyargs])
    return found


class Docstrings(unittest.TestCase):
    def test_of_functions_and_objects(self):
        for function, filter_object in FUNCTIONS.items():
            for thing in (function, filter_object):
                text = " ".join(pydoc.render_doc(thing).split())
                for words in NEEDED:
                    with self.subTest(function=function.__name__, words=words):
                        self.assertIn(words, text)

    def test_of_every_parameter(self):
        for function in FUNCTIONS:
            for name in parameters_of(function):
                self.assertIn(f"\n{name}: ", function.__doc__)

    def test_of_every_method(self):
        for filter_object in FUNCTIONS.values():
            instantiated = filter_object.values()[0]
            for name, method in vars(instantiated).items():
                if name.startswith(("Set", "Unset")) or (name.startswith("Get") and "Pointer" not in name):
                    with self.subTest(filter=instantiated.__name__, method=name):
                        self.assertIn("From C++:", inspect.getdoc(method))

    def test_examples(self):
        for function in FUNCTIONS:
            test = doctest.DocTestParser().get_doctest(function.__doc__, {}, function.__name__, None, 0)
            self.assertGreater(len(test.examples), 3)
            self.assertEqual(doctest.DocTestRunner().run(test).failed, 0)


class Types(unittest.TestCase):
    def test_have_the_parameters_of_the_functions(self):
        declared = declared_parameters()
        for function in FUNCTIONS:
            expected = parameters_of(function)
            for names in declared[function.__name__]:
                self.assertEqual(set(names) - {"number_of_work_units"}, expected)

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "skipped: mypy is not installed")
    def test_type_checker(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "use.py"
            wrong = "".join(f"itk.medial_voxel_objects_image_filter(mask, {argument})\n" for argument in WRONG)
            path.write_text(TYPED + wrong)
            command = [sys.executable, "-m", "mypy", "--no-error-summary", "--cache-dir", folder, path]
            output = subprocess.run(command, capture_output=True, text=True, cwd=folder).stdout
            lines = {int(line.split(":")[1]) for line in output.splitlines() if ": error:" in line}
            first = TYPED.count("\n") + 1
            self.assertEqual(lines, set(range(first, first + len(WRONG))), output)


if __name__ == "__main__":
    unittest.main()
