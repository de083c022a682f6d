# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Functions and results of the package for arrays, from its sources, for doc/make_reference.py. Needs neither it nor NumPy."""

import ast
import importlib.util
import inspect
import pathlib
import re

PACKAGE = pathlib.Path(__file__).resolve().parents[1] / "python/medialvoxel"
FUNCTIONS = ("_arrays.py", "_by_program.py", "_program.py")
RESULTS = ("_results.py", "_walls.py")


def _load_texts():
    spec = importlib.util.spec_from_file_location("_parameters", PACKAGE / "_parameters.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.find_text


def _public(files, kind):
    for file in files:
        for node in ast.parse((PACKAGE / file).read_text(encoding="utf-8")).body:
            if isinstance(node, kind) and not node.name.startswith("_"):
                yield node


def _sections(node):
    """The parts of a docstring by their headings; the first has none."""
    parts = re.split(r"^(\w+)\n-+\n", inspect.cleandoc(ast.get_docstring(node)), flags=re.MULTILINE)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2]))}


def _prose(text):
    return " ".join(text.replace("``", "`").split())


def _rows(text):
    """Name, type and meaning of each entry of a section."""
    for name, kind, meaning in re.findall(r"^(\S.*?)(?: : (.*))?\n((?:    .*\n?)+)", text, re.MULTILINE):
        yield [f"`{name}`", f"`{kind}`" if kind else "", _prose(meaning)]


def _parameters(function, find_text):
    arguments = function.args
    defaults = [None] * len(arguments.args) + arguments.kw_defaults
    for argument, default in zip(arguments.args + arguments.kwonlyargs, defaults):
        kind = f"`{ast.unparse(argument.annotation)}`" + (f", default `{ast.unparse(default)}`" if default else "")
        yield [f"`{argument.arg}`", kind, _prose(find_text(function.name, argument.arg))]
    if arguments.kwarg:
        yield [f"`**{arguments.kwarg.arg}`", "`Any`", _prose(find_text(function.name, arguments.kwarg.arg))]


def make_arrays(notice, table):
    """The page; table(header, rows) makes a table."""
    find_text = _load_texts()
    parts = [
        notice,
        "# NumPy functions and results\n",
        "After this page you know every parameter and result of the package `medialvoxel`. `help(medialvoxel.extract)` shows the same text.\n"
        "[Use it from NumPy](../how-to/numpy.md) has examples. Axes are (z, y, x), or (y, x) in two dimensions. `Number` is a number of\n"
        "Python or NumPy, `FileName` a text or a path; `Progress` is a function, True, False or None.\n",
        "Wrong values are a `ValueError` with the message of the program, a limit of memory that is too small is a `MemoryError`. A result\n"
        "that may mislead is a `MedialVoxelWarning`. Ctrl-C stops the work.\n",
    ]
    for function in _public(FUNCTIONS, ast.FunctionDef):
        if not function.decorator_list:
            continue
        sections = _sections(function)
        parts.append(f"## {function.name}\n\n{_prose(sections[''])}\n")
        parts.append(table(["parameter", "type", "meaning"], list(_parameters(function, find_text))))
        kind, _, meaning = sections["Returns"].partition("\n")
        parts.append(f"Returns `{kind.strip()}`. {_prose(meaning)}".rstrip() + "\n")
    for result in _public(RESULTS, ast.ClassDef):
        sections = _sections(result)
        parts.append(f"## {result.name}\n\n{_prose(sections[''])}\n")
        parts.append(table(["attribute", "type", "meaning"], list(_rows(sections["Attributes"]))))
        methods = [node for node in result.body if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")]
        rows = []
        for method in methods:
            is_property = any(ast.unparse(decorator) == "property" for decorator in method.decorator_list)
            names = "" if is_property else f"({', '.join(argument.arg for argument in method.args.args[1:])})"
            texts = _sections(method)
            meaning = " ".join([_prose(texts[""]), *(f"{name}: {text}" for name, _, text in _rows(texts.get("Parameters", "")))])
            rows.append([f"`{method.name}{names}`", f"`{ast.unparse(method.returns)}`", meaning])
        if rows:
            parts.append(table(["property or method", "type", "meaning"], rows))
    return "\n".join(parts)
