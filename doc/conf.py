# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The documentation site: scripts/documentation builds it from these pages.

The pages stay plain Markdown that repositories show. While they are read, the lists of index.md become the navigation,
links to files outside of this folder become addresses in the repository, and the C++ classes get a page.
"""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[1]
REPOSITORY = "https://github.com/InsightSoftwareConsortium/ITKMedialVoxel/blob/main/"

project = "MedialVoxel"
author = "The MedialVoxel contributors"
copyright = "The MedialVoxel contributors"  # noqa: A001, the name that Sphinx reads
version = release = re.search(r'^version = "([^"]*)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)[1]

extensions = ["myst_parser", "breathe"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
exclude_patterns = ["figures/*.py"]
html_theme = "furo"
html_title = "MedialVoxel " + version
breathe_projects = {"MedialVoxel": str(ROOT / "build/documentation/doxygen/xml")}
breathe_default_project = "MedialVoxel"
# The names of ITK, which has pages of its own.
suppress_warnings = ["duplicate_declaration.cpp"]

CPP_CLASSES = (
    "MedialVoxelImageFilter",
    "MedialVoxelObjectsImageFilter",
    "LocalThicknessImageFilter",
    "VectorDistanceMapImageFilter",
    "MedialSurfaceMeshFilter",
    "MedialVoxelImageFilterBase",
    "MedialVoxelSheetProperties",
    "MedialVoxelObjectProperties",
    "MedialVoxelEnums",
    "StreamingNrrdImageIO",
    "StreamingRawImageIO",
)
CPP_STRUCTS = ("MedialVoxelCounts", "MedialVoxelScanResult")
CPP_PAGE = "reference/cpp"


def make_cpp_page():
    lines = ["# C++ classes", "", "After this page you know every public member of the classes of the module.", ""]
    for kind, names in (("doxygenclass", CPP_CLASSES), ("doxygenstruct", CPP_STRUCTS)):
        for name in names:
            lines += [f"## {name}", "", f"```{{{kind}}} itk::{name}", ":members:", "```", ""]
    return "\n".join(lines)


def make_navigation(index):
    """Hidden tables of contents, one for each list below a bold caption."""
    text = ""
    for caption, items in re.findall(r"^\*\*([^*]*)\*\*[^\n]*\n\n((?:- .*\n)+)", index, re.MULTILINE):
        pages = re.findall(r"\]\(([^)#]*)\.md\)", items) + ([CPP_PAGE] if caption == "Reference" else [])
        text += f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "\n".join(pages) + "\n```\n"
    return text


def point_to_repository(text, folder):
    """Links to files outside of this folder, which the site does not have; a file that is missing stays a broken link."""

    def replace(match):
        path = (folder / match[1]).resolve()
        outside = path.exists() and ROOT / "doc" not in path.parents
        return f"]({REPOSITORY}{path.relative_to(ROOT).as_posix()}{match[2] or ''})" if outside else match[0]

    return re.sub(r"\]\(((?:\.\./)+[^)#\s]*)(#[^)\s]*)?\)", replace, text)


def read_source(app, docname, source):
    del app
    text = point_to_repository(source[0], (ROOT / "doc" / docname).parent)
    source[0] = text + make_navigation(text) if docname == "index" else text


def setup(app):
    page = pathlib.Path(app.srcdir) / (CPP_PAGE + ".md")
    text = make_cpp_page()
    if not page.exists() or page.read_text(encoding="utf-8") != text:
        page.write_text(text, encoding="utf-8")
    app.connect("source-read", read_source)
