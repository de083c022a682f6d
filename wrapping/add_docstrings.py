#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Puts the Doxygen comments of the headers into the docstrings of the Python classes that SWIG made.

Filters, which ITK offers as one object for all types of images, get a docstring on that object and on their function too.

Usage: add_docstrings.py PYTHON-FOLDER
The Python files named after the headers are rewritten; a second run changes nothing.
"""

import pathlib
import re
import sys
import textwrap

from filter_functions import describe
from header_comments import BASE, ENUMERATIONS, FILTERS, OBJECT, SHEET, read_comments, to_snake

CLASSES = (ENUMERATIONS, BASE, OBJECT, SHEET, *FILTERS, "StreamingNrrdImageIO", "StreamingNrrdImageIOFactory", "StreamingRawImageIO")
MARK = "\n\nFrom C++:\n"


def extend_docstring(code, header, text):
    """The docstring that follows the line \\a header, and the text, in the indentation that it has."""

    def replace(match):
        indent = match["indent"]
        old = match["text"].split(textwrap.indent(MARK, indent).rstrip(" "))[0].rstrip()
        added = textwrap.indent(MARK.strip("\n") + "\n" + text, indent).rstrip()
        return f'{match["header"]}{indent}r"""{old}\n\n{added}\n{indent}"""'

    pattern = rf'(?P<header>^ *{header}[^\n]*:\n)(?P<indent> +)r?"""(?P<text>.*?)"""'
    return re.sub(pattern, replace, code, flags=re.DOTALL | re.MULTILINE)


def filter_docstrings(name):
    """Code that gives the object of all types and the function their docstring, whoever makes the object first."""
    function = to_snake(name)
    return f'''

from itk.support.template_class import itkTemplate as _itkTemplate

{function}.__doc__ = r"""{describe(name)}
"""
_itkTemplate("itk::{name}").__doc__ = {function}.__doc__


def {function}_init_docstring():
    """Called by ITK, which would give the function the docstring of one type."""
    import itk

    {function}.process_object = itk.MedialVoxel.{name}
'''


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for name in CLASSES:
        # A factory is wrapped together with its class.
        python = pathlib.Path(sys.argv[1]) / f"itk{name.removesuffix('Factory')}Python.py"
        if not python.is_file():
            sys.exit(f"add_docstrings.py: {python}: no such file")
        code = before = python.read_text(encoding="utf-8")
        class_text, members = read_comments(name)
        if MARK.strip() in code and not name.endswith("Factory"):
            continue
        code = extend_docstring(code, rf"class itk{name}(?!Factory|Base)\w*\b", class_text)
        for member, text in members.items():
            code = extend_docstring(code, rf"def {member}\(", text)
        if name in FILTERS:
            code += filter_docstrings(name)
        if code != before:
            python.write_text(code, encoding="utf-8")


if __name__ == "__main__":
    main()
