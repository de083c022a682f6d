#!/usr/bin/env python3
# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Writes the pages of doc/reference from the tables of the program, the schema of reports and the headers.

Usage: doc/make_reference.py PROGRAM [--check]
--check writes nothing and ends with status 1 when a page would change. PROGRAM is the program medialvoxel.
"""

import argparse
import difflib
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[1]
REFERENCE = ROOT / "doc/reference"
sys.path[:0] = [str(ROOT / "doc"), str(ROOT / "wrapping")]

import array_reference  # noqa: E402
import header_comments  # noqa: E402

NOTICE = """<!-- SPDX-FileCopyrightText: MedialVoxel contributors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<!-- Made by doc/make_reference.py; edit the tables that it reads. -->
"""

MESH_FORMATS = {
    ".vtp": ("VTK XML PolyData, appended binary", "triangles, quads", "at vertices", "`Object` of faces", "`Wall` of faces", "none"),
    ".vtu": ("VTK XML UnstructuredGrid, appended binary", "triangles, quads", "at vertices", "`Object` of faces", "`Wall` of faces", "none"),
    ".vtk": ("VTK legacy 3.0, binary", "triangles, quads", "at vertices", "`Object` of faces", "`Wall` of faces", "2³¹ - 1 numbers in faces"),
    ".ply": ("binary, little endian", "triangles, quads", "at vertices", "`object` of vertices", "`wall` of faces", "2³¹ - 1 vertices, faces"),
    ".stl": ("binary", "triangles", "none", "none", "none", "2³² - 1 triangles"),
    ".obj": ("text", "triangles, quads", "none", "groups", "groups", "none"),
    ".inp": ("Abaqus, CalculiX", "S3, S4", "of sections, or at nodes", "sets", "sets", "999 999 999 nodes, elements"),
    ".bdf": ("Nastran", "CTRIA3, CQUAD4", "of properties, or at corners", "properties", "`SET` 1001, 1002, ...", "99 999 999 nodes, elements"),
    ".k": ("LS-DYNA", "shells", "of sections, or at corners", "parts", "`*SET_SHELL` 1001, ...", "99 999 999 nodes, elements"),
    ".glb": ("glTF 2.0, binary", "triangles", "at vertices, and as colors", "none", "none", "4 GiB"),
}

PROGRESS = {
    "auto": "`bar` on a terminal, otherwise `plain`",
    "bar": "one line that is redrawn ten times a second: share done, time left",
    "plain": "one line every 30 s: share done, time since the start, time left",
    "slicer": "`<filter-start>`, `<filter-progress>`, `<filter-end>` on the standard output, for 3D Slicer",
    "json": "one object per line: `start`; `progress` (0 to 1) with `seconds`, once per percent, and the last one again "
    "after a second; `end`; `note`; `warning` with `message`",
    "none": "notes and warnings only",
}

EVENTS = (
    ("failed", "error", "the message of the error stream, also after a signal"),
    ("warning", "warning", "code and message, [as above](#warnings)"),
    ("shorten", "warning", "memory was short: pieces are smaller from here on"),
    ("start", "info", "what the run does"),
    ("plan", "info", "input and division"),
    ("piece", "info", "slices, seconds, voxels computed again, bytes read and peak memory so far"),
    ("note", "info", "for example, that an input was unpacked"),
    ("end", "info", "seconds of the whole run"),
    ("planned, job, cluster, clusters, verified, published", "info", "steps of [jobs](../how-to/jobs.md#logs)"),
)


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines) + "\n"


def sentence(text):
    return text if not text or text.endswith(".") else text + "."


def describe_option(option):
    """Text of an option, with its choices."""
    text = option["description"]
    choices = [f"`{choice}`" for choice in option.get("choices", ())]
    if choices:
        text += ": " + ", ".join(choices)
        text += f" (default `{option['default']}`)" if "default" in option else ""
    return " ".join(filter(None, (sentence(text), option["details"])))


FURTHER = "Further options"  # that --help-all shows


def shared_options(catalog):
    """Options that at least three commands have with the same text, with these commands."""
    commands = {}
    for command in catalog["commands"]:
        for option in command["options"]:
            commands.setdefault((option["group"], option["usage"], describe_option(option)), []).append(command["name"])
    return {option: names for option, names in commands.items() if len(names) >= 3}


def make_commands(catalog):
    """A section for each command, and one of the options that several commands share."""
    shared = shared_options(catalog)
    parts = [
        NOTICE,
        "# Commands and options\n",
        "After this page you know every option of the program. `medialvoxel COMMAND --help` prints the options that most users need,\n"
        "`--help-all` further ones too, and `man medialvoxel-COMMAND` this text. The first of several choices is the default.\n",
        table(["command", "what it does"], [[f"[{c['name']}](#{c['name']})", c["description"]] for c in catalog["commands"]]),
        "Write `--lower 72` or `--lower=72`. Choices may be in upper or lower case. Options that would have no effect are refused.\n"
        "An option is given once. The value of a flag is `true`, `on` or `yes`, or `false`, `off` or `no`: `--sub-voxel off`, or\n"
        "`--sub-voxel=off`; behind an equals sign also `1` or `0`. Without a value it is `true`. Lengths are in units of the spacing, and\n"
        "may have a unit: `2mm` is 2, and `3vx` is three times the smallest spacing.\n",
    ]
    for command in catalog["commands"]:
        arguments = " ".join(argument["usage"] for argument in command["arguments"])
        parts.append(f"## {command['name']}\n\n{sentence(command['description'])}\n")
        parts.append(f"    medialvoxel {command['name']} {arguments} [OPTION...]\n")
        rows = {False: [[f"`{a['usage']}`", describe_option(a)] for a in command["arguments"]], True: []}
        others = []
        for option in command["options"]:
            text = describe_option(option)
            if (option["group"], option["usage"], text) in shared:
                others.append(option["usage"].split()[0])
            else:
                rows[option["group"] == FURTHER].append([f"`{option['usage']}`", text])
        parts += [table([title, "meaning"], rows[few]) for few, title in ((False, "argument or option"), (True, "further option")) if rows[few]]
        if others:
            names = ", ".join(f"`{name}`" for name in others)
            parts.append(f"[Shared options](#shared-options): {names}.\n")
        parts.append("Examples:\n\n" + "\n".join(f"    {example}" for example in command["examples"]) + "\n")
    parts.append("## Shared options\n")
    for group in dict.fromkeys(group for group, _, _ in shared):
        rows = [[f"`{usage}`", text, ", ".join(names)] for (title, usage, text), names in shared.items() if title == group]
        parts.append(table([group.lower().rstrip("s") if group == "Options" else group.lower(), "meaning", "of"], rows))
    parts.append("## Exit status\n")
    parts.append(table(["status", "meaning"], exit_statuses(catalog["notes"])))
    parts.append("An error is one line on the error stream. A failed run leaves no output and changes no file.\n")
    return "\n".join(parts)


def exit_statuses(notes):
    """Rows of the list at the end of the program's help."""
    text = re.search(r"Exit status: (.*?)\.\n", notes, re.DOTALL)[1].replace("\n", " ")
    return [list(re.match(r"([\d or]*\d) (.*)", part.strip()).groups()) for part in text.split(",")]


def mark(value):
    return "yes" if value else "no"


def make_formats(catalog):
    unknown = set(MESH_FORMATS).symmetric_difference(catalog["mesh_formats"])
    if unknown:
        sys.exit(f"make_reference.py: the table of mesh formats differs from the program: {sorted(unknown)}")
    volumes = [
        [f"`{row['extension']}`", row["format"], mark(row["written"]), mark(row["vectors"]),
         "always" if row["always_packed"] else "with `--compress`" if row["packed_on_request"] else
         "in chunks" if row["format"] == "Zarr" else "no"]
        for row in catalog["volume_formats"]
    ]  # fmt: skip
    meshes = [[f"`{extension}`", *MESH_FORMATS[extension]] for extension in catalog["mesh_formats"]]
    options = {o["usage"].split()[0] for c in catalog["commands"] for o in c["options"]}
    outputs = []
    for command, rows in catalog["outputs"].items():
        for number, row in enumerate(rows):
            option = "--" + row["role"].replace("_", "-")
            # The volume that stands for the command comes first; it is an argument.
            if number and option not in options:
                continue
            what = ", ".join(f"`{extension}`" for extension in row["extensions"]) or {"mesh": "a mesh", "surface": "a mesh"}.get(row["role"], "")
            if "type" in row:
                what = f"volume of {row['type']}" + (f", {row['components']} components" if row["components"] > 1 else "")
            name = f"`{option}`" if number else "argument"
            grid = row.get("grid", "")
            outputs.append([f"`{command}`", f"`{row['role']}`", name, what or "JSON", grid, mark(row["in_jobs"] and command == "extract")])
    return "\n".join([
        NOTICE,
        "# Formats\n",
        "After this page you know which files the program reads and writes.\n",
        "## Volumes\n",
        "All are read. Headerless files are read with `--raw-size` and `--raw-type`, series of DICOM, TIFF, PNG, JPEG and BMP slices by\n"
        "[their folder or a pattern](../how-to/scans.md#series-of-slices).\n",
        table(["extension", "format", "written", "vectors written", "packed"], volumes),
        "[Read scans](../how-to/scans.md#which-files-stream) lists which variants are read and which of them stream.\n"
        "A program can be [built without](../getting-started/terminal.md#install) the formats below `.hdr`.\n"
        "TIFF needs a program built with libtiff; Zarr that is packed by Blosc or zstd needs one built with libblosc or libzstd.\n",
        "## Meshes\n",
        "All are written.\n",
        table(["extension", "format", "faces", "thickness", "objects of a label map", "walls", "limit"], meshes),
        "[Meshes and FEM](../how-to/meshes-and-fem.md#in-the-files) has the details.\n",
        "## Outputs\n",
        "*Cells*: the grid of the dual cells, half a voxel from that of the input. *Jobs*: whether jobs of several processes\n"
        "(`plan`, `work`, `finalize`) write it. The role is the key under `outputs` of the report.\n",
        table(["command", "role", "option", "file", "grid", "jobs"], outputs),
        "`mesh` writes the mesh as its argument, and the report. `surface` writes `.vtp`, `.vtu`, `.ply` and `.glb`.\n",
    ])  # fmt: skip


def type_of(schema, definitions):
    """A short name of the type of a value."""
    if "$ref" in schema:
        return type_of(definitions[schema["$ref"].split("/")[-1]], definitions)
    if "enum" in schema:
        return ", ".join("null" if value is None else f"`{value}`" for value in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    if "oneOf" in schema:
        return " or ".join(type_of(part, definitions) for part in schema["oneOf"])
    kind = schema.get("type", "object")
    names = [kind] if isinstance(kind, str) else kind
    if names == ["array"]:
        return f"list of {type_of(schema['items'], definitions)}"
    return " or ".join(names)


def keys_of(schema, definitions, prefix=""):
    """Rows of all keys in a schema, nested ones with their path."""
    for name, part in schema.get("properties", {}).items():
        target = definitions[part["$ref"].split("/")[-1]] if "$ref" in part else part
        description = part.get("description", target.get("description"))
        path = prefix + name
        if path == "warnings":
            yield [f"`{path}`", "list", "[warnings](#warnings); empty when there are none"]
            continue
        if not description:
            sys.exit(f"make_reference.py: report.schema.json does not describe {path}")
        kind = "object by percentage" if "patternProperties" in target else type_of(part, definitions)
        yield [f"`{path}`", kind, description]
        if path not in ("parameters", "counts", "outputs"):
            yield from keys_of(target, definitions, path + ".")


def make_report(catalog, schema):
    definitions = schema["$defs"]
    warnings = schema["properties"]["warnings"]["items"]["properties"]["code"]["oneOf"]
    styles = next(o["choices"] for c in catalog["commands"] for o in c["options"] if o["usage"].startswith("--progress"))
    if list(PROGRESS) != styles:
        sys.exit(f"make_reference.py: the table of progress styles differs from the program: {styles}")
    roles = ", ".join(f"`{name}`" for name in schema["properties"]["outputs"]["propertyNames"]["enum"])
    percentiles = ", ".join(definitions["percentiles"]["required"])

    def section(name, prefix):
        return table(["key", "type", "meaning"], list(keys_of(definitions[name], definitions, prefix)))

    return "\n".join([
        NOTICE,
        "# Report, warnings, progress and log\n",
        "After this page you can read every key of `--report`, every warning, and every line of progress and log.\n",
        "## Report keys\n",
        "Keys keep their names and order; later versions may add keys. [report.schema.json](../report.schema.json) is the JSON Schema\n"
        "(2020-12), which a test compares with real reports.\n",
        schema["description"] + "\n",
        table(["key", "type", "meaning"], list(keys_of(schema, definitions))),
        f"Percentiles are those of {percentiles} percent. Roles of `outputs` are {roles}.\n",
        "### Parameters of extract and mesh\n",
        section("extract", "parameters."),
        "### Parameters of distance\n",
        section("distance", "parameters."),
        "### Parameters of surface\n",
        section("surface", "parameters."),
        "### Counts of extract and mesh\n",
        section("cells", "counts."),
        "`distance` counts `not_a_number_voxels` only, `surface` the voxels of object, pores and dust, without `boundary_voxels`. Both have\n"
        "no `percent` and `thickness`.\n",
        "## Warnings\n",
        "Some runs end well and their numbers mislead. Each warning is one line on the error stream, an entry under `warnings` in the\n"
        "report, a line on the page, and a comment on the output stream of the Slicer module. The exit status stays 0, or with\n"
        "`--fail-if-thin` is 6 where the warning says that too little was measured.\n",
        table(["code", "when"], [[f"`{row['const']}`", row["description"]] for row in warnings]),
        "## Progress\n",
        "`--progress STYLE` chooses what the error stream shows. `--quiet` leaves out notes, warnings and the table too.\n",
        table(["style", "what is shown"], [[f"`{style}`", text] for style, text in PROGRESS.items()]),
        "## Log\n",
        "`--log-file FILE` adds one line per step: time (UTC), level, process, event, values. Values with blanks are quoted as in JSON.\n"
        "Existing lines stay; a file that is not a log is refused.\n",
        "```text\n"
        '2026-11-22T00:12:31.402Z info 4711 start work="extracting medial voxels"\n'
        '2026-11-22T00:12:31.418Z info 4711 plan input=part.mha format=MetaImage size="1500 x 1500 x 668" type=uint8 pieces=21 ...\n'
        "2026-11-22T00:12:31.711Z info 4711 piece of=labels slices=0-31 seconds=0.291 recomputed_voxels=0 bytes_read=103500000 "
        "peak_memory_bytes=126222336\n```\n",
        table(["event", "level", "content"],
              [[", ".join(f"`{name}`" for name in names.split(", ")), level, text] for names, level, text in EVENTS]),
    ])  # fmt: skip


def read_public(name):
    """Summary of a class, and the comment of each group of public members that is wrapped: names, then text."""
    summary, members = "", []
    for comment, code in header_comments.COMMENT.findall(header_comments.read_public(name)):
        plain = header_comments.plain(comment)
        if re.search(rf"\\class {name}\b", comment):
            summary = " ".join(plain.split("\n\n")[0].split())
            continue
        names = []
        for declared, argument in re.findall(r"^  (?:\w+ )*(\w+)\((\w*)", code, re.MULTILINE):
            names += [form.format(argument) for form in header_comments.MACROS.get(declared, ("{1}",))] if (
                declared.startswith("itk")
            ) else [declared]
        members.append((names, " ".join(plain.split())))
    return summary, members


def make_member_tables(members):
    parameters, methods = [], []
    for names, text in members:
        setters = [name.removeprefix("Set") for name in names if re.match(r"Set[A-Z]", name)]
        getters = [name for name in dict.fromkeys(names) if re.match(r"(Get|Unset)[A-Z]", name)]
        if setters:
            parameters.append([", ".join(f"`{header_comments.to_snake(name)}`" for name in dict.fromkeys(setters)), text])
        elif getters:
            methods.append([", ".join(f"`{name}()`" for name in getters), text])
    tables = [table(["parameter", "meaning"], parameters)] if parameters else []
    return tables + ([table(["method", "meaning"], methods)] if methods else [])


# Sections of what several filters inherit.
INHERITED = {
    header_comments.SHEET: ("Properties of sheets", "Of the filters that find medial sheets."),
    header_comments.OBJECT: ("Common properties", "Of all filters."),
    header_comments.BASE: ("Common methods", "Of all filters whose output is an image."),
}


def make_python():
    """Parameters and methods of the wrapped classes, from the comments of their headers."""
    parts = [
        NOTICE,
        "# Python classes\n",
        "After this page you know every parameter and output of the filters in Python. `help(itk.MedialVoxelImageFilter)` shows the\n"
        "same text. A parameter `lower_threshold` is an argument of the function and of `New()`, and `SetLowerThreshold()` and\n"
        "`GetLowerThreshold()` of the object.\n",
    ]
    for name in header_comments.FILTERS:
        summary, members = read_public(name)
        parts.append(f"## {name}\n\n{summary} Function: `itk.{header_comments.to_snake(name)}(image, ...)`.\n")
        parts += make_member_tables(members)
        links = [f"[{INHERITED.get(parent, (parent,))[0]}]" for parent in header_comments.PARENTS[name]]
        links = [f"{link}(#{link[1:-1].lower().replace(' ', '-')})" for link in links]
        parts.append("Inherited: " + ", ".join(links) + ".\n")
    for parent, (title, owners) in INHERITED.items():
        parts.append(f"## {title}\n\n{owners}\n")
        parts += make_member_tables(read_public(parent)[1])
    return "\n".join(parts)


def make_slicer(text):
    """Parameters of the module of 3D Slicer, from its description."""
    description = xml.etree.ElementTree.fromstring(text.encode())
    parts = [
        NOTICE,
        "# Parameters in 3D Slicer\n",
        "After this page you know every parameter of *Medial Voxel Extraction*. On the command line the flag has two dashes; without a\n"
        "flag, the parameter is an argument, or a result of `--returnparameterfile`.\n",
    ]
    for group in description.iter("parameters"):
        rows = []
        for parameter in group:
            if parameter.tag in ("label", "description"):
                continue
            names = {part.tag: (part.text or "").strip() for part in parameter}
            choices = [f"`{part.text}`" for part in parameter.iter("element")]
            text = sentence(names["description"]) + (f" Choices: {', '.join(choices)}." if choices else "")
            flag = f"`{names['longflag']}`" if "longflag" in names else ""
            default = f"`{names['default']}`" if names.get("default") else ""
            rows.append([names["label"], flag, text, default])
        parts.append(f"## {group.findtext('label')}\n\n{sentence(group.findtext('description'))}\n")
        parts.append(table(["parameter", "flag", "meaning", "default"], rows))
    return "\n".join(parts)


def generate(program):
    """The catalog of the program and the description of the Slicer module."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "generate", folder], check=True)
        catalog, description = ((pathlib.Path(folder) / name).read_text(encoding="utf-8") for name in ("catalog.json", "MedialVoxelExtraction.xml"))
        return json.loads(catalog), description


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    catalog, description = generate(arguments.program)
    schema = json.loads((ROOT / "doc/report.schema.json").read_text(encoding="utf-8"))
    pages = {
        REFERENCE / "commands.md": make_commands(catalog),
        REFERENCE / "formats.md": make_formats(catalog),
        REFERENCE / "report.md": make_report(catalog, schema),
        REFERENCE / "arrays.md": array_reference.make_arrays(NOTICE, table),
        REFERENCE / "python.md": make_python(),
        REFERENCE / "slicer.md": make_slicer(description),
    }
    status = 0
    for path, text in pages.items():
        text = text.rstrip("\n") + "\n"
        old = path.read_text(encoding="utf-8") if path.exists() else ""
        if not arguments.check:
            path.write_text(text, encoding="utf-8")
        elif text != old:
            status = 1
            sys.stdout.writelines(difflib.unified_diff(old.splitlines(True), text.splitlines(True), str(path), "made", n=0))
    if status:
        print("Pages of doc/reference are out of date: run doc/make_reference.py PROGRAM")
    return status


if __name__ == "__main__":
    sys.exit(main())
