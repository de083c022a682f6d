# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the parameters of the functions mean, a row each, and how docstrings get them."""

import inspect
import textwrap
from collections.abc import Callable
from typing import Any, TypeVar

F = TypeVar("F", bound=Callable[..., Any])

# A name, or function and name where a function has a text of its own.
_TEXTS = {
    "array": "2 or 3 axes of bool, integers of 8 to 64 bits or real numbers of 16, 32 or 64 bits; any order, strides and byte order. "
    "A contiguous array of native numbers is not copied.",
    "thin_below": "The limit, (limit, second limit), or (limit, second limit, area): each place has a cell thinner than the first one, "
    "and all its cells are thinner than the second one, by default (None) an eighth more. Its cells thinner than the first one have at "
    "least the area, in squared units; default that of ten faces of voxels.",
    "thin_places.options": "Others of the program, as of extract_file(): ``threads=2``, ``memory=\"1G\"``, ``materials=(40, 180)``.",
    "surface_thickness.options": "Others of the program, as of surface_file(): ``largest_ball=20``, ``sub_voxel=False``, ``open=True``.",
    "spacing": "(z, y, x), from 1e-12 to 1e12, or one number for all axes; default 1.",
    "lower": 'Smallest value of the object; "otsu" measures it. Default: all values but 0 are the object.',
    "extract.lower": 'Smallest value of the object; "otsu" measures it. Default: all values but 0 are the object. With `lower` or `upper` '
    "walls are fitted to gray values, which takes several times as long as a mask.",
    "upper": "Largest value of the object.",
    "label": "The one value of the object.",
    "labels": 'Each of these values, or "all", is an object of its own.',
    "thickness": 'Of the walls that become sheets, > 0; "auto": each wall by its own thickness. Each length is a number in units of the '
    'spacing, or a text with a unit: "3vx" is three voxels of the smallest spacing, "2mm" two units of the spacing.',
    "smooth": 'Noise of the object is smoothed: True, False, or "auto", the default with automatic thickness, where it is rough.',
    "min_thickness": 'Lower limit of thickness="auto"; default 3 voxels of the smallest spacing.',
    "max_thickness": 'Upper limit of thickness="auto"; default 16 voxels of the smallest spacing, up to 32 where many walls are thicker.',
    "max_pore_size": "Largest pore or grain that is left out, from 0 to 1000000 voxels; default 32 with automatic thickness, otherwise 0.",
    "thickness_map": "Make `thickness` and `rims` too, of 5 bytes for each voxel.",
    "uncertainty": "Make this output too, of 4 bytes for each voxel; it needs `lower` or `upper`, and walls that can be fitted.",
    "importance": "Make this output too, of 4 bytes for each voxel; not with `labels`.",
    "same_topology": "Add cells with the label 4, so that the labels 2, 3 and 4 have the topology of the object; with `labels`, of each.",
    "vectors": "Make this output too, of 12 bytes for each voxel.",
    "extract.vectors": "Make this output too, of 12 bytes for each voxel; not with `labels`.",
    "vector_boundary": "Voxels that vectors lead to: those of the object, or of the background.",
    "sub_voxel": "Measure the thickness on gray values, which needs `lower` or `upper`: by fits of blurred walls, or, where these cannot "
    "be, where values cross the threshold. False: on the object. Default: by fits, else on the object.",
    "walls.sub_voxel": "Measure thickness and points on gray values, which needs `lower` or `upper`. False: on the object. Default: on "
    "where one threshold cuts the values.",
    "mesh.sub_voxel": "Measure the thickness on gray values, which needs `lower` or `upper`, and place points between voxels. Default: on "
    "for elements of a size with one of `lower` and `upper`, else off. A mask is measured halfway between its two values.",
    "materials": "Values of (background, material) for these fits, which differ; default those of the scan.",
    "triangles": "Split the quadrilaterals.",
    "min_component_size": "Leave out connected pieces of fewer quadrilaterals.",
    "min_branch_length": "Leave out branches that are shorter, in units of the spacing.",
    "element_size": "Length of the sides of the faces, in units of the spacing, at least its smallest one; at junctions and bends they are "
    'as long as the wall is thick at least. "auto": as long as the wall is thick, at least two voxels, for solvers. "voxel" (default): '
    "a face for each voxel. Elements of a size are quadrilaterals and triangles, or triangles alone with `triangles`.",
    "extend_rims": "Carry the sheet on in its plane to the free edges of the part. Needs an element size.",
    "boundary": "Voxels that distances are measured to: those of the object, or of the background.",
    "region": "Voxels that get a value; 0 elsewhere.",
    "max_distance": 'Voxels further away are NaN; > 0, or a text such as "3vx", in voxels of the smallest spacing.',
    "method": '"wall": the thickness of walls; edges and corners that no wall covers are NaN. "sphere": the diameter of the largest ball '
    "inside the object that covers a voxel, as Hildebrand and Rüegsegger (1997) define it, for comparison with other programs.",
    "local_thickness.sub_voxel": 'As in extract(). Not with "sphere".',
    "largest_ball": "Diameter at which balls are cut, and the largest thickness, > 0, at most 256 voxels of the smallest spacing, as text "
    "256vx; default 32 voxels of the largest spacing. Time and memory grow with it.",
    "threads": "1 or more; default one for each processor that this process may use. Results do not depend on it.",
    "memory": 'Limit of what the work takes beside arrays, in bytes or as text such as "2G"; default none. Results do not depend on it.',
    "input": "Any file or folder that the program reads.",
    "output": "Its ending names its format.",
    "options": 'Those of the program, with underscores: ``thickness_map="map.mha", lower=72, memory="2G", overwrite=True``. True '
    "switches an option on; None and False leave it to its default. ``smooth=False`` and ``sub_voxel=False`` switch off. Values of all "
    'axes are (z, y, x) as numbers, and as the program takes them as a text: ``spacing=(2, 1, 1)`` is ``spacing="1,1,2"``. Limits '
    "of places are a tuple: ``thin_below=(2, 2.5, 6)``.",
    "progress": "Called with the share that is done, from 0 to 1, about 20 times a second; an exception of it stops the work. True shows a "
    "bar of tqdm.",
}

_RAISES = """
Raises
------
ValueError
    For wrong values, with the message of the program.
MemoryError
    For a limit of memory that is too small, and where there is none left.
KeyboardInterrupt
    By Ctrl-C, which stops the work.

Warns
-----
MedialVoxelWarning
    Of what makes results doubtful.
"""

_RAISES_OF_FILES = """FileNotFoundError
    For an input that is not there, and where the program is not.
ThinPlacesError
    With ``fail_if_thin=True``, when there are thin places.
NotMeasuredError
    With ``fail_if_thin=True``, when too little was measured to know.
RuntimeError
    For other failures, such as those of a disk.
"""


def find_text(function: str, name: str) -> str:
    """What a parameter of a function means."""
    return _TEXTS.get(f"{function}.{name}") or _TEXTS[name]


def describe(function: F) -> F:
    """Puts the parameters, as the signature has them, and the errors of all functions into a docstring, before its examples."""
    if function.__doc__ is None:  # python -OO
        return function
    lines = ["Parameters", "----------"]
    for name, parameter in inspect.signature(function).parameters.items():
        default = "" if parameter.default is parameter.empty else f", default {parameter.default!r}"
        stars = "**" if parameter.kind is parameter.VAR_KEYWORD else ""
        lines += [f"{stars}{name} : {parameter.annotation}{default}", textwrap.indent(textwrap.fill(find_text(function.__name__, name), 116), "    ")]
    begin, examples, end = inspect.cleandoc(function.__doc__).partition("\nExamples\n")
    raises = _RAISES if "options" not in inspect.signature(function).parameters else _RAISES.replace("\nWarns", _RAISES_OF_FILES + "\nWarns")
    begin, returns, end_of_returns = begin.partition("\nReturns\n")
    function.__doc__ = "\n".join([begin, *lines, "", returns.strip() + "\n" + end_of_returns.rstrip(), raises]) + examples + end
    return function
