#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the types of the functions of the filters for type checkers and editors: a partial package itk-stubs (PEP 561).

ITK's own wheels have no types. What is not of this module stays what it is, which __getattr__ says.

Usage: make_stubs.py FOLDER     gets itk-stubs/__init__.pyi and itk-stubs/py.typed
"""

import pathlib
import sys

from filter_functions import FUNCTIONS
from header_comments import ENUMERATIONS, read_enumerators, read_setters, to_snake

TYPES = {
    "bool": "bool | np.bool_",
    "double": "_Number",
    "InputPixelType": "_Number",
    "SizeValueType": "_Whole",
    "unsigned": "_Whole",
    "ObjectLabelsType": "Sequence[_Whole] | NDArray[np.integer[Any]]",
}

BEGIN = """# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
# Made by wrapping/make_stubs.py.
from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from itk.support.extras import *
from numpy.typing import NDArray

_Whole = int | np.integer[Any]
_Number = int | float | np.integer[Any] | np.floating[Any]

def __getattr__(name: str) -> Any: ...
"""

# Of the array that is returned for an array; a mesh is a mesh.
RESULTS = {
    "MedialVoxelImageFilter": "np.uint8",
    "MedialVoxelObjectsImageFilter": "np.uint8",
    "VectorDistanceMapImageFilter": "np.float32",
    "LocalThicknessImageFilter": "np.float32",
}


def type_of(types):
    """Type of the argument for the types of a setter, which takes several numbers as a tuple."""
    names = [TYPES.get(name.split()[0], "_Whole") for name in types]
    return names[0] if len(names) == 1 else f"tuple[{', '.join(names)}]"


def declare(name, image, result, decorator=""):
    parameters = [f"    {to_snake(setter)}: {type_of(types)} = ...," for setter, types in read_setters(name).items()]
    lines = [f"def {to_snake(name)}(", f"    image: {image},", "    /,", "    *,", *parameters]
    return "\n".join([*([decorator] if decorator else []), *lines, "    number_of_work_units: _Whole = ...,", f") -> {result}: ..."])


def declare_enumerations():
    lines = [f"    {name}_{value}: int" for name, values in read_enumerators().items() for value in values]
    return "\n".join([f"class {ENUMERATIONS}:", *lines])


def make():
    """The text of the stub."""
    parts = [BEGIN, declare_enumerations() + "\n"]
    for name in FUNCTIONS:
        if name in RESULTS:
            parts.append(declare(name, "NDArray[Any]", f"NDArray[{RESULTS[name]}]", "@overload"))
        parts.append(declare(name, "Any", "Any", "@overload" if name in RESULTS else "") + "\n")
    return "\n".join(parts)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1]) / "itk-stubs"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "__init__.pyi").write_text(make(), encoding="utf-8")
    (folder / "py.typed").write_text("partial\n", encoding="utf-8")


if __name__ == "__main__":
    main()
