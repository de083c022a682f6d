# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the headers say about the classes that are wrapped: Doxygen comments, setters and enumerations."""

import pathlib
import re

INCLUDE = pathlib.Path(__file__).resolve().parents[1] / "include"

BASE, OBJECT, SHEET = "MedialVoxelImageFilterBase", "MedialVoxelObjectProperties", "MedialVoxelSheetProperties"
# Each filter, and the classes of the module that it inherits from.
PARENTS = {
    "MedialVoxelImageFilter": (SHEET, BASE, OBJECT),
    "MedialVoxelObjectsImageFilter": ("MedialVoxelImageFilter", SHEET, BASE, OBJECT),
    "VectorDistanceMapImageFilter": (BASE, OBJECT),
    "LocalThicknessImageFilter": (BASE, OBJECT),
    "MedialSurfaceMeshFilter": (SHEET, OBJECT),
}
FILTERS = tuple(PARENTS)
ENUMERATIONS = "MedialVoxelEnums"
MACROS = {
    "itkSetMacro": ("Set{}",),
    "itkMedialVoxelSetEnumMacro": ("Set{}",),
    "itkGetConstMacro": ("Get{}",),
    "itkGetConstReferenceMacro": ("Get{}",),
    "itkGetEnumMacro": ("Get{}",),
    "itkBooleanMacro": ("{}On", "{}Off"),
}
COMMENT = re.compile(r"/\*\*(.*?)\*/(.*?)(?=/\*\*|\Z)", re.DOTALL)
NAME = re.compile(r"\b(\w+)\(\s*(\w*)")
SETTER = re.compile(r"^  (?:itk\w*Set\w*Macro\((\w+), ([\w ]+)\)|Set(\w+)\(([^()]+)\)(?=;|\n))", re.MULTILINE)
WRAPPED = re.compile(r"#ifdef ITK_WRAPPING_PARSER\n(.*?)#else.*?#endif\n", re.DOTALL)


def plain(comment):
    """The text of a Doxygen comment without its marks."""
    text = "\n".join(re.sub(r"^\s*\* ?", "", line) for line in comment.strip().splitlines())
    text = re.sub(r"^\\(class|ingroup)\b.*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"^\\par (.*)$", r"\1:", text, flags=re.MULTILINE)
    text = re.sub(r"^\\sa (.*)$", r"See also \1.", text, flags=re.MULTILINE)
    text = re.sub(r"\\(brief|a) ", "", text)
    return re.sub(r"\n{3,}", "\n\n", text).strip().replace('"""', "'''")


def to_snake(name):
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()


def read(name):
    return (INCLUDE / f"itk{name}.h").read_text(encoding="utf-8")


def members_of(code):
    """Names of the members that are declared before the next empty line."""
    for name, argument in NAME.findall(re.split(r"\n\s*\n", code.lstrip("\n"), maxsplit=1)[0]):
        if name in MACROS:
            yield from (form.format(argument) for form in MACROS[name])
        elif name[0].isupper():
            yield name


def read_comments(name):
    """Text of the class, and of its members by name."""
    class_text, members = "", {}
    for comment, code in COMMENT.findall(read(name)):
        if re.search(rf"\\class {name}\b", comment):
            class_text = plain(comment)
        else:
            members.update((member, plain(comment)) for member in members_of(code))
    return class_text, members


def read_public(name):
    """What of a header is wrapped."""
    return WRAPPED.sub(r"\1", read(name).split("\nprotected:")[0])


def type_of(argument):
    """Such as double for "const double & value"."""
    return re.sub(r"\bconst\b|&", "", argument).split()[0]


def read_setters(name):
    """Types of the arguments of each setter of a filter and of what it inherits from."""
    found = {}
    for header in (name, *PARENTS[name]):
        for macro_name, macro_type, method, arguments in SETTER.findall(read_public(header)):
            types = [macro_type] if macro_name else [type_of(argument) for argument in arguments.split(",")]
            found.setdefault(macro_name or method, types)
    return found


def read_parameters(name):
    """Comment of each setter, in the order of the headers, those of what the filter inherits from last."""
    members = {}
    for header in reversed((name, *PARENTS[name])):
        members.update(read_comments(header)[1])
    return {setter: " ".join(members["Set" + setter].split()) for setter in read_setters(name)}


def read_enumerators():
    """Names of the enumerators of each enumeration, from the value 0 on."""
    code = re.sub(r"/\*\*.*?\*/", "", read(ENUMERATIONS), flags=re.DOTALL)
    return {name: re.findall(r"(\w+) = \d", values) for name, values in re.findall(r"enum class (\w+)[^{]*\{(.*?)\}", code, re.DOTALL)}


def enumerators_of(argument_type):
    """Names of the numbers that a setter of this type takes, in Python; none for other types."""
    name = argument_type.removesuffix("Enum")
    return [f"{name}_{value}" for value in read_enumerators().get(name, [])]
