#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Lists what classes and functions of 3D Slicer, CTK and Qt have, for the stand-ins of slicer_stand_in.py: as far as the
modules of Slicer and their tests name it.

Usage: make_slicer_names.py SLICER CTK [OUTPUT]     source folders; needs PyQt6, whose classes tell Qt's names

Reads the headers and Python files. A method is written with the least and the largest number of its arguments, a signal
with its signature as connect() takes it.
"""

import ast
import json
import pathlib
import re
import sys

SLICER_CLASSES = (
    "vtkMRMLScene vtkMRMLCommandLineModuleNode vtkMRMLLabelMapVolumeNode vtkMRMLScalarVolumeNode vtkMRMLModelNode "
    "vtkMRMLModelDisplayNode vtkMRMLLabelMapVolumeDisplayNode vtkMRMLColorTableNode vtkMRMLColorLegendDisplayNode "
    "vtkMRMLSegmentationNode vtkMRMLCameraNode vtkMRMLViewNode vtkSlicerColorLogic vtkSlicerMarkupsLogic "
    "vtkSlicerCamerasModuleLogic vtkSlicerSegmentationsModuleLogic vtkSlicerCLIModuleLogic qMRMLNodeComboBox "
    "qMRMLSegmentSelectorWidget qMRMLLayoutManager qMRMLThreeDWidget qMRMLThreeDView qSlicerApplication "
    "qSlicerScriptedLoadableModule"
).split()
CTK_CLASSES = ("ctkRangeWidget", "ctkCollapsibleButton")
QT_CLASSES = (
    "QPushButton QLabel QProgressBar QDoubleSpinBox QTableWidget QTableWidgetItem QHeaderView QAbstractItemView "
    "QFormLayout QHBoxLayout QVBoxLayout QTimer"
).split()
# Functions without an object that have the name of a property.
STATIC_FUNCTIONS = {"QTimer": ["singleShot"]}
FUNCTIONS = {
    "slicer.util": "Base/Python/slicer/util.py",
    "slicer.cli": "Base/Python/slicer/cli.py",
    "slicer.ScriptedLoadableModule": "Base/Python/slicer/ScriptedLoadableModule.py",
}
# What VTK's macros declare: prefix of the method, and its numbers of arguments.
MACROS = {
    r"vtkGet\w*Macro": ("Get", [0, 0]),
    r"vtkSet(?!Vector)\w*Macro": ("Set", [1, 1]),
    r"vtkSetVector[23]Macro": ("Set", [1, 3]),
    r"vtkGetVector\w*Macro": ("Get", [0, 3]),
}


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)


def find_class(text, name):
    """Base class and body of a class in a header."""
    match = re.search(rf"\bclass\s+(?:\w+\s+)?{name}\s*:\s*public\s+(\w+)[^{{]*{{", text)
    if not match:
        return None
    depth, end = 1, match.end()
    while depth and end < len(text):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        end += 1
    return match[1], text[match.end() : end - 1]


def public_part(body):
    """The members of a class that are public: its sections from public or signals to protected or private."""
    parts = re.split(r"\b(public|protected|private|signals|Q_SIGNALS)\b(\s+slots|\s+Q_SLOTS)?\s*:", body)
    sections = [("header", parts[0])] + [(parts[k], parts[k + 2]) for k in range(1, len(parts), 3)]
    return [(kind, text) for kind, text in sections if kind not in ("protected", "private")]


def count_arguments(arguments):
    flat = re.sub(r"<[^<>]*>", "", arguments).strip()
    if flat in ("", "void"):
        return [0, 0]
    words = flat.split(",")
    return [sum("=" not in word for word in words), len(words)]


def signature(name, arguments):
    """Of a signal, as connect() names it."""
    kinds = [re.sub(r"\bconst\s+|&", "", word.split("=")[0]).strip() for word in arguments.split(",") if word.strip()]
    kinds = [re.sub(r"\s*\*\s*\w*$", "*", kind) if "*" in kind else kind.split()[0] for kind in kinds]
    return f"{name}({','.join(kinds)})"


def describe(text):
    """Methods, properties, signals and constants of the body of a class."""
    methods, properties, signals, constants = {}, [], [], []
    for kind, part in public_part(text):
        for macro, (prefix, count) in MACROS.items():
            for name in re.findall(rf"\b{macro}\(\s*(\w+)", part):
                methods[prefix + name] = count
        for name in re.findall(r"\bvtkBooleanMacro\(\s*(\w+)", part):
            methods |= {f"{name}On": [0, 0], f"{name}Off": [0, 0]}
        properties += re.findall(r"Q_PROPERTY\([\w:]+\s+(\w+)", part)
        for block in re.findall(r"\benum\s+\w*\s*{([^}]*)}", part):
            constants += re.findall(r"(?:^|,)\s*(\w+)", block)
        plain = re.sub(r"Q_PROPERTY\([^\n]*\)", "", re.sub(r"{[^{}]*}", ";", part))
        for name, arguments in re.findall(r"[\w:>*&]\s+\*?&?(\w+)\s*\(([^()]*(?:\([^()]*\)[^()]*)*)\)", plain):
            if kind in ("signals", "Q_SIGNALS"):
                signals.append(signature(name, arguments))
            low, high = count_arguments(arguments)
            known = methods.get(name, [low, high])
            methods[name] = [min(known[0], low), max(known[1], high)]
    return {"methods": methods, "properties": properties, "signals": signals, "constants": constants}


def read_classes(folders, wanted):
    """The classes and all their bases of which there are headers."""
    headers = {path.stem: path for folder in folders for path in pathlib.Path(folder).rglob("*.h")}
    result, queue = {}, list(wanted)
    while queue:
        name = queue.pop()
        if name in result or name not in headers:
            continue
        found = find_class(without_comments(headers[name].read_text(encoding="utf-8", errors="replace")), name)
        if not found:
            raise SystemExit(f"no class {name} in {headers[name]}")
        result[name] = {"base": found[0]} | describe(found[1])
        queue.append(found[0])
    return result


def read_qt_class(kind):
    """What a class of Qt adds to its base; a getter that is a property is no method in PythonQt."""
    base = kind.__mro__[1]
    inherited = set(dir(base))
    properties, signals = [], []
    meta = getattr(kind, "staticMetaObject", None)
    if meta:
        properties = [meta.property(k).name() for k in range(meta.propertyOffset(), meta.propertyCount())]
        every = [meta.method(k) for k in range(meta.methodOffset(), meta.methodCount())]
        signals = [bytes(one.methodSignature()).decode() for one in every if one.methodType().name == "Signal"]
    methods = [word for word in dir(kind) if word[0].islower() and word not in inherited and word not in properties]
    methods += STATIC_FUNCTIONS.get(kind.__name__, [])
    values = [entry.name for word in vars(kind) if hasattr(getattr(kind, word), "__members__") for entry in getattr(kind, word)]
    return {
        "base": base.__name__,
        "methods": dict.fromkeys(methods, [0, 9]),
        "properties": properties,
        "signals": signals,
        "constants": values,
    }


def read_qt():
    """Qt's classes with their bases, and the flags of items."""
    from PyQt6 import QtCore, QtWidgets

    result, queue = {}, [getattr(QtWidgets, name, None) or getattr(QtCore, name) for name in QT_CLASSES]
    while queue:
        kind = queue.pop()
        if kind.__name__ not in result and kind.__name__.startswith("Q"):
            result[kind.__name__] = read_qt_class(kind)
            queue.append(kind.__mro__[1])
    flags = [entry.name for entry in QtCore.Qt.ItemFlag]
    result["Qt"] = {"base": None, "methods": {}, "properties": [], "signals": [], "constants": flags}
    return result


def read_functions(path):
    """Functions, and methods as CLASS.METHOD, with the names of their arguments and how many are required."""
    tree = ast.parse(pathlib.Path(path).read_text(encoding="utf-8"))
    found = [("", node) for node in tree.body if isinstance(node, ast.FunctionDef)]
    for kind in (node for node in tree.body if isinstance(node, ast.ClassDef)):
        found += [(f"{kind.name}.", node) for node in kind.body if isinstance(node, ast.FunctionDef)]
    return {
        prefix + node.name: {
            "arguments": [word.arg for word in node.args.args],
            "required": len(node.args.args) - len(node.args.defaults),
            "any": bool(node.args.kwarg),
        }
        for prefix, node in found
    }


def list_words():
    """Of the sources of the modules and of their tests."""
    tests = pathlib.Path(__file__).parent
    sources = [*tests.glob("*slicer_*.py"), *(tests.parent / "MedialVoxelWalls").rglob("*.py")]
    sources = [source for source in sources if source.name != pathlib.Path(__file__).name]
    return {word for source in sources for word in re.findall(r"\w+", source.read_text(encoding="utf-8"))}


def keep_used(names, words):
    """Of classes that nothing names, only the base of others stays."""
    classes, functions = names["classes"], names["functions"]
    for kind in classes.values():
        kind["methods"] = {name: count for name, count in kind["methods"].items() if name in words}
        kind["signals"] = [name for name in kind["signals"] if name.split("(")[0] in words]
        for part in ("properties", "constants"):
            kind[part] = [name for name in kind[part] if name in words]
    used = set()
    for kind in words & classes.keys():
        while kind in classes:
            used.add(kind)
            kind = classes[kind]["base"]
    functions = {
        module: {name: arguments for name, arguments in listed.items() if name.split(".")[-1] in words}
        for module, listed in functions.items()
    }
    return {"classes": {name: classes[name] for name in used}, "functions": functions}


def write_names(names, output):
    text = json.dumps(names, indent=0, sort_keys=True)
    text = re.sub(r"\[\s*(\d+),\s*(\d+)\s*\]", r"[\1, \2]", text)
    output.write_text(re.sub(r"\[\s*\]", "[]", text) + "\n", encoding="utf-8")


def main():
    slicer, ctk = (pathlib.Path(word) for word in sys.argv[1:3])
    output = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else pathlib.Path(__file__).with_name("slicer_names.json")
    classes = read_qt() | read_classes([ctk / "Libs/Widgets"], CTK_CLASSES)
    classes |= read_classes([slicer / "Libs", slicer / "Base", slicer / "Modules/Loadable", ctk / "Libs/Widgets"], SLICER_CLASSES)
    functions = {name: read_functions(slicer / path) for name, path in FUNCTIONS.items()}
    write_names(keep_used({"classes": classes, "functions": functions}, list_words()), output)


if __name__ == "__main__":
    main()
