# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Finds in the description of a 3D Slicer module what Slicer's parser takes and the module then does wrong."""

import re
import xml.etree.ElementTree

from slicer_module import BUILT_IN, ENUMERATIONS, FILES, NUMBERS, SIMPLE, VECTORS, is_result, parameters_of, text_of

TRUTH = ("true", "false")
SYSTEMS = ("ijk", "lps", "ras")
IMAGE_TYPES = ("any", "scalar", "label", "tensor", "diffusion-weighted", "vector", "signal", "multichannel")
ANY = None

# First extensions of volumes that stream when Slicer writes them as it does for modules.
STREAMED = (".mha", ".nrrd", ".seg.nrrd")
# Parameters of this module that may be segmentations.
SEGMENTATIONS = ("inputVolume",)

# The attributes that Slicer's parser takes of each element, and their values. It refuses a whole module for one more, or
# for another value, in files and places; in the others it takes no notice of them, so that they do nothing.
ATTRIBUTES = {
    "parameters": {"advanced": TRUTH},
    **{kind: {"hidden": TRUTH, "multiple": TRUTH} for kind in NUMBERS},
    **{kind: {"hidden": TRUTH} for kind in ("boolean", "string", *ENUMERATIONS, *VECTORS)},
    **{kind: {"multiple": TRUTH, "coordinateSystem": SYSTEMS} for kind in ("point", "region")},
    "pointfile": {
        "multiple": TRUTH,
        "type": ("any", "point", "line", "angle", "curve"),
        "fileExtensions": ANY,
        "coordinateSystem": SYSTEMS,
    },
    "file": {"multiple": TRUTH, "fileExtensions": ANY},
    "directory": {"multiple": TRUTH},
    "image": {
        "multiple": TRUTH,
        "type": (*IMAGE_TYPES, "dynamic-contrast-enhanced"),
        "fileExtensions": ANY,
        "hidden": TRUTH,
        "reference": ANY,
    },
    "transform": {
        "multiple": TRUTH,
        "type": ("linear", "nonlinear", "bspline"),
        "fileExtensions": ANY,
        "reference": ANY,
    },
    "geometry": {
        "multiple": TRUTH,
        "aggregate": TRUTH,
        "type": ("fiberbundle", "model"),
        "fileExtensions": ANY,
        "reference": ANY,
    },
    "table": {"multiple": TRUTH, "hidden": TRUTH, "reference": ANY, "type": ("color",), "fileExtensions": ANY},
    "measurement": {"multiple": TRUTH, "hidden": TRUTH, "reference": ANY, "type": ANY, "fileExtensions": ANY},
}


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def lint_names(element, name):
    for tag in ("name", "label", "description"):
        if not text_of(element, tag):
            yield f"{name}: no {tag}"
    for tag in ("name", "longflag"):
        text = text_of(element, tag)
        if text is not None and not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", text):
            yield f"{name}: {tag} '{text}' has other characters than letters, digits and _"
    flag = text_of(element, "flag")
    if flag is not None and not re.fullmatch(r"[A-Za-z]", flag):
        yield f"{name}: flag '{flag}' is not one letter"
    if text_of(element, "longflag") in BUILT_IN:
        yield f"{name}: its flag is one that every module has"


def lint_place(element, name):
    has_flag = element.find("flag") is not None or element.find("longflag") is not None
    if element.find("index") is not None and has_flag:
        yield f"{name}: index and flag"
    if element.find("index") is None and not has_flag and not (is_result(element) and element.tag in SIMPLE):
        yield f"{name}: neither flag nor index"
    if element.tag in FILES and text_of(element, "channel") not in ("input", "output"):
        yield f"{name}: no channel"


def lint_default(element, name):
    default = text_of(element, "default")
    if element.tag == "boolean" and default != "false":
        yield f"{name}: a boolean that is not false by default"
    if element.tag in NUMBERS and not is_result(element):
        if number(default) is None:
            yield f"{name}: default '{default}' is no number"
        else:
            yield from lint_constraints(element, name, number(default))
    if element.tag in ENUMERATIONS:
        elements = [child.text for child in element.findall("element")]
        if default not in elements:
            yield f"{name}: default '{default}' is not one of its elements"
        if len(set(elements)) != len(elements):
            yield f"{name}: an element twice"


def lint_constraints(element, name, default):
    constraints = element.find("constraints")
    if constraints is None:
        return
    minimum, maximum = number(text_of(constraints, "minimum")), number(text_of(constraints, "maximum"))
    step = number(text_of(constraints, "step"))
    if minimum is None or maximum is None or step is None or step <= 0:
        yield f"{name}: constraints without minimum, maximum or step"
    elif minimum > maximum:
        yield f"{name}: minimum above maximum"
    elif not minimum <= default <= maximum:
        yield f"{name}: default outside the constraints"


def lint_attributes(element, name):
    known = ATTRIBUTES.get(element.tag, {})
    for attribute, value in element.attrib.items():
        if attribute not in known:
            yield f"{name}: {element.tag} has the unknown attribute {attribute}"
        elif known[attribute] is not ANY and value not in known[attribute]:
            yield f"{name}: unknown {attribute} '{value}' of {element.tag}"


def lint_volume(element, name, root):
    first = element.get("fileExtensions", "").split(",")[0]
    if element.tag == "image" and first not in STREAMED:
        yield f"{name}: {first} is not the first extension of a file that streams"
    if element.tag == "image" and first == ".mha" and text_of(element, "channel") == "input" and name in SEGMENTATIONS:
        yield f"{name}: Slicer writes segmentations as NRRD, whatever their name"
    images = [text_of(other, "name") for other in parameters_of(root) if other.tag == "image"]
    if "reference" in element.attrib and element.get("reference") not in images:
        yield f"{name}: reference to no image"


def lint_duplicates(root):
    for tag in ("name", "longflag", "flag", "index"):
        texts = [text_of(element, tag) for element in parameters_of(root) if element.find(tag) is not None]
        yield from (f"{tag} {text} twice" for text in sorted({text for text in texts if texts.count(text) > 1}))
    indices = sorted(int(element.findtext("index")) for element in root.iter() if element.find("index") is not None)
    if indices != list(range(len(indices))):
        yield "indices do not count from 0"


def lint(content):
    """Everything that is wrong with a description, given as bytes; empty when nothing is."""
    root = xml.etree.ElementTree.fromstring(content)
    if root.tag != "executable":
        return ["the root is not executable"]
    errors = [] if content.startswith(b"<?xml ") else ["the first bytes are not <?xml"]
    errors += [f"no {tag}" for tag in ("category", "title", "description", "version") if not text_of(root, tag)]
    for group in root.findall("parameters"):
        errors += [f"a group without {tag}" for tag in ("label", "description") if not text_of(group, tag)]
        errors += lint_attributes(group, "a group")
    for element in parameters_of(root):
        name = text_of(element, "name") or "?"
        if element.tag not in ATTRIBUTES:
            errors.append(f"{name}: unknown kind {element.tag}")
        for check in (lint_names, lint_place, lint_default, lint_attributes):
            errors += check(element, name)
        errors += lint_volume(element, name, root)
    return errors + list(lint_duplicates(root))
