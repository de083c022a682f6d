#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Puts the Doxygen comments of the headers into the docstrings of the Python classes that SWIG made.

Filters, which ITK offers as one object for all types of images, get a docstring on that object too.

Usage: add_docstrings.py INCLUDE-FOLDER PYTHON-FOLDER
The Python files named after the headers are rewritten; a second run changes nothing.
"""

import pathlib
import re
import sys
import textwrap

BASE = "MedialVoxelImageFilterBase"
FILTERS = ("MedialVoxelImageFilter", "VectorDistanceMapImageFilter")
CLASSES = (
    "MedialVoxelEnums",
    BASE,
    *FILTERS,
    "StreamingNrrdImageIO",
    "StreamingNrrdImageIOFactory",
    "StreamingRawImageIO",
)
MACROS = {
    "itkSetMacro": ("Set{}",),
    "itkSetEnumMacro": ("Set{}",),
    "itkMedialVoxelSetEnumMacro": ("Set{}",),
    "itkGetConstMacro": ("Get{}",),
    "itkGetConstReferenceMacro": ("Get{}",),
    "itkGetEnumMacro": ("Get{}",),
    "itkBooleanMacro": ("{}On", "{}Off"),
}
COMMENT = re.compile(r"/\*\*(.*?)\*/(.*?)(?=/\*\*|\Z)", re.DOTALL)
NAME = re.compile(r"\b(\w+)\(\s*(\w*)")
MARK = "\n\nFrom C++:\n"


def plain(comment):
    """The text of a Doxygen comment without its marks."""
    text = "\n".join(re.sub(r"^\s*\* ?", "", line) for line in comment.strip().splitlines())
    text = re.sub(r"^\\(class|ingroup)\b.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"^\\par (.*)$", r"\1:", text, flags=re.MULTILINE)
    text = re.sub(r"^\\sa (.*)$", r"See also \1.", text, flags=re.MULTILINE)
    text = re.sub(r"\\(brief|a) ", "", text)
    return re.sub(r"\n{3,}", "\n\n", text).strip().replace('"""', "'''")


def members_of(code):
    """Names of the members that are declared before the next empty line."""
    for name, argument in NAME.findall(re.split(r"\n\s*\n", code.lstrip("\n"), maxsplit=1)[0]):
        if name in MACROS:
            yield from (form.format(argument) for form in MACROS[name])
        elif name[0].isupper():
            yield name


def read_header(path):
    """Text of the class, and of its members by name."""
    class_text, members = "", {}
    for comment, code in COMMENT.findall(path.read_text(encoding="utf-8")):
        if re.search(rf"\\class {path.stem.removeprefix('itk')}\b", comment):
            class_text = plain(comment)
        else:
            members.update((name, plain(comment)) for name in members_of(code))
    return class_text, members


def extend_docstring(code, header, text):
    """The docstring that follows the line \\a header, and the text, in the indentation that it has."""

    def replace(match):
        indent = match["indent"]
        old = match["text"].split(textwrap.indent(MARK, indent).rstrip(" "))[0].rstrip()
        added = textwrap.indent(MARK.strip("\n") + "\n" + text, indent).rstrip()
        return f'{match["header"]}{indent}r"""{old}\n\n{added}\n{indent}"""'

    pattern = rf'(?P<header>^ *{header}[^\n]*:\n)(?P<indent> +)r?"""(?P<text>.*?)"""'
    return re.sub(pattern, replace, code, flags=re.DOTALL | re.MULTILINE)


def describe_parameters(members, code):
    """The arguments of the function, which are the setters that are wrapped, with the text that each has."""
    for name, text in members.items():
        if name.startswith("Set") and f"def {name}(" in code:
            argument = re.sub(r"(?<!^)(?=[A-Z])", "_", name.removeprefix("Set")).lower()
            yield textwrap.fill(" ".join(text.split()), 116, initial_indent=f"{argument}: ", subsequent_indent="    ")


def template_docstring(name, class_text, parameters):
    """Code that gives the object of all types its docstring, whoever makes the object first."""
    text = "\n".join([class_text, "", "Parameters:", *parameters])
    return (
        "\n\nfrom itk.support.template_class import itkTemplate as _itkTemplate\n\n"
        f'_itkTemplate("itk::{name}").__doc__ = r"""{text}\n"""\n'
    )


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    include, package = map(pathlib.Path, sys.argv[1:])
    for name in CLASSES:
        # A factory is wrapped together with its class.
        python = package / f"itk{name.removesuffix('Factory')}Python.py"
        if not python.is_file():
            sys.exit(f"add_docstrings.py: {python}: no such file")
        code = before = python.read_text(encoding="utf-8")
        class_text, members = read_header(include / f"itk{name}.h")
        if MARK.strip() in code and not name.endswith("Factory"):
            continue
        code = extend_docstring(code, rf"class itk{name}(?!Factory|Base)\w*\b", class_text)
        if name in FILTERS:
            all_members = {**members, **read_header(include / f"itk{BASE}.h")[1]}
            all_code = code + (package / f"itk{BASE}Python.py").read_text(encoding="utf-8")
            code += template_docstring(name, class_text, describe_parameters(all_members, all_code))
        for member, text in members.items():
            code = extend_docstring(code, rf"def {member}\(", text)
        if code != before:
            python.write_text(code, encoding="utf-8")


if __name__ == "__main__":
    main()
