# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The description of the module for 3D Slicer: served as Slicer wants it, valid, and without known traps."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree

from slicer_lint import ANY, ATTRIBUTES, lint
from slicer_module import ENUMERATIONS, FILES, MODULE, XML_FILE, Description

SCHEMA = pathlib.Path(os.environ["MEDIALVOXEL_SOURCE"]) / "apps/MedialVoxelExtraction/SlicerModule.rng"
CONTENT = XML_FILE.read_bytes()

# What is replaced, by what, and what the lint says of it; the schema must refuse all of these.
TRAPS = {
    "dash in a flag": ("<longflag>numberOfThreads<", "<longflag>number-of-threads<", "other characters"),
    "dash in a name": ("<name>numberOfThreads<", "<name>number-of-threads<", "other characters"),
    "leading dashes": ("<longflag>memory<", "<longflag>--memory<", "other characters"),
    "long flag": ("<longflag>memory<", "<flag>mm</flag><longflag>memory<", "not one letter"),
    "flag and index": ("<index>0</index>", "<index>0</index><longflag>in</longflag>", "index and flag"),
    "true boolean": ("<default>false<", "<default>true<", "not false by default"),
    "no label": ("<label>Thickness</label>", "", "no label"),
    "no description": ("<description><![CDATA[Parameters, counts, seconds and memory as JSON]]></description>", "", "no description"),
    "no flag": ("<longflag>thickness</longflag>", "", "neither flag nor index"),
    "no channel": ("<channel>input</channel>\n      <index>", "<index>", "no channel"),
    "no number": ("<default>3<", "<default>three<", "no number"),
    "no step": ("<step>1</step>", "", "constraints without"),
    "unknown attribute": ("<double>", '<double unit="mm">', "unknown attribute"),
    "unknown image": ('type="label"', 'type="mask"', "unknown type 'mask' of image"),
    "unknown kind": ("boolean>", "bool>", "unknown kind"),
    "other root": ("executable>", "module>", "root"),
}
# What no schema of this kind can see.
RELATIONS = {
    "flag twice": ("<longflag>memory<", "<longflag>resample<", "longflag resample twice"),
    "index twice": ("<index>1<", "<index>0<", "index 0 twice"),
    "name twice": ("<name>memory<", "<name>resample<", "name resample twice"),
    "default not an element": ("<default>NonZero<", "<default>Nonzero<", "not one of its elements"),
    "element twice": ("<element>background<", "<element>object<", "an element twice"),
    "minimum above maximum": ("<maximum>128<", "<maximum>-1<", "minimum above maximum"),
    "default outside": ("<minimum>0<", "<minimum>1<", "outside the constraints"),
    "reference to nothing": ('reference="inputVolume"', 'reference="input"', "reference to no image"),
    "flag of every module": ("<longflag>memory<", "<longflag>echo<", "every module has"),
    "first extension": ('fileExtensions=".mha,.mhd', 'fileExtensions=".nii,.mhd', "not the first extension"),
    "name of a segmentation": ('fileExtensions=".nrrd,', 'fileExtensions=".mha,', "writes segmentations as NRRD"),
    "blank before": ("<?xml version", "\n<?xml version", None),
}


# What Slicer's parser was seen to refuse with an error, whatever a table here says.
REFUSED_BY_SLICER = [
    *((kind, "unit", "mm") for kind in (*sorted(FILES - {"directory"}), "point", "region")),
    *(("geometry", "coordinateSystem", value) for value in ("lps", "ras", "ijk")),
    *(("geometry", "hidden", "true"), ("geometry", "type", "scalar"), ("geometry", "aggregate", "maybe")),
    *(("file", "type", "any"), ("file", "hidden", "true"), ("file", "reference", "inputVolume")),
    *(("image", "type", "mask"), ("image", "coordinateSystem", "lps"), ("image", "aggregate", "true")),
    *(("transform", "type", "affine"), ("transform", "hidden", "true"), ("pointfile", "type", "closedcurve")),
    *(("pointfile", "hidden", "true"), ("pointfile", "reference", "inputVolume"), ("point", "hidden", "true")),
    *(("table", "type", "any"), ("table", "coordinateSystem", "lps"), ("measurement", "aggregate", "true")),
    *(("region", "coordinateSystem", "xyz"), ("region", "type", "any"), ("boolean", "hidden", "maybe")),
    *(("integer", "hidden", "maybe"), ("string-enumeration", "hidden", "maybe")),
]


def with_attributes(kind, attributes):
    """The description with one parameter more, or with another group, that has these attributes."""
    text = "".join(f' {name}="{value}"' for name, value in attributes.items())
    if kind == "parameters":
        return CONTENT.replace(b"<parameters>", f"<parameters{text}>".encode(), 1)
    if kind == "image" and "fileExtensions" not in attributes:
        text += ' fileExtensions=".mha"'
    label, description = "<label>More</label>", "<description>More</description>"
    if kind in FILES:
        end = f"{label}<channel>input</channel>{description}"
    else:
        end = f"{label}{description}<default>{'false' if kind == 'boolean' else 1}</default>"
    end += "<element>1</element>" if kind in ENUMERATIONS else ""
    element = f"<{kind}{text}><name>more</name><longflag>more</longflag>{end}</{kind}>"
    group = f"<parameters>{label}{description}{element}</parameters></executable>"
    return CONTENT.replace(b"</executable>", group.encode())


def attributes_to_try():
    """Each kind of element with each attribute that any has, and one that none has: kind, attribute, value, known."""
    values = {name: {"true", "more"} for row in ATTRIBUTES.values() for name in row} | {"unit": {"mm"}}
    for row in ATTRIBUTES.values():
        for name, known in row.items():
            values[name] |= set(known or ())
    values["fileExtensions"] = {".mha"}
    values["reference"] = {"inputVolume"}
    for kind, row in ATTRIBUTES.items():
        for name, choices in values.items():
            for value in sorted(choices):
                yield kind, name, value, name in row and (row[name] is ANY or value in row[name])


def changed(rule):
    before, after, _ = rule
    return CONTENT.replace(before.encode(), after.encode())


class DescriptionTest(unittest.TestCase):
    def run_for_xml(self, **options):
        return subprocess.run([MODULE, "--xml"], capture_output=True, check=True, timeout=60, **options)

    def test_xml_equals_the_file_beside_the_program(self):
        result = self.run_for_xml(env={"ITK_AUTOLOAD_PATH": ""})
        self.assertEqual(result.stdout, CONTENT)
        self.assertEqual(result.stderr, b"")

    def test_xml_comes_at_once(self):
        def seconds():
            start = time.monotonic()
            self.run_for_xml()
            return time.monotonic() - start

        self.assertLess(min(seconds() for _ in range(3)), 1)

    def test_version_is_that_of_the_program(self):
        out = subprocess.run([MODULE, "--version"], capture_output=True, check=True, text=True).stdout
        self.assertEqual(out, f"MedialVoxelExtraction {Description().root.findtext('version')}\n")

    def test_lint(self):
        self.assertEqual(lint(CONTENT), [])

    def test_lint_finds_traps(self):
        for name, rule in (TRAPS | RELATIONS).items():
            with self.subTest(name):
                content = changed(rule)
                self.assertTrue(content != CONTENT, "nothing to replace")
                if rule[2] is None:
                    self.assertRaises(xml.etree.ElementTree.ParseError, lint, content)
                else:
                    self.assertTrue(any(rule[2] in error for error in lint(content)), lint(content))

    def test_lint_knows_the_attributes_of_each_element(self):
        for kind, name, value, known in attributes_to_try():
            errors = lint(with_attributes(kind, {name: value}))
            self.assertEqual(errors == [], known, (kind, name, value, errors))

    def test_lint_refuses_what_slicer_refuses(self):
        for kind, name, value in REFUSED_BY_SLICER:
            self.assertNotEqual(lint(with_attributes(kind, {name: value})), [], (kind, name, value))

    def test_geometry_of_this_module_once_had_an_attribute_too_many(self):
        content = CONTENT.replace(b"<geometry ", b'<geometry coordinateSystem="lps" ')
        self.assertEqual(lint(content), ["meshModel: geometry has the unknown attribute coordinateSystem"])

    def validate(self, content):
        """Whether the content conforms to the schema, and what xmllint says; skips without it."""
        if not shutil.which("xmllint"):
            self.skipTest("xmllint is not installed (package libxml2-utils)")
        with tempfile.NamedTemporaryFile(suffix=".xml") as file:
            file.write(content)
            file.flush()
            result = subprocess.run(
                ["xmllint", "--noout", "--nonet", "--relaxng", SCHEMA, file.name],
                capture_output=True,
                check=False,
                text=True,
            )
        self.assertIn(result.returncode, (0, 1, 3), result.stderr)
        return result.returncode == 0, result.stderr

    def test_schema(self):
        valid, message = self.validate(CONTENT)
        self.assertTrue(valid, message)

    def test_schema_refuses_traps(self):
        for name, rule in TRAPS.items():
            with self.subTest(name):
                self.assertFalse(self.validate(changed(rule))[0])

    def test_schema_agrees_with_the_lint_on_attributes(self):
        for kind, name, value, known in attributes_to_try():
            content = with_attributes(kind, {name: value})
            self.assertEqual(self.validate(content)[0], known, (kind, name, value))

    def test_schema_refuses_what_slicer_refuses(self):
        for kind, name, value in REFUSED_BY_SLICER:
            self.assertFalse(self.validate(with_attributes(kind, {name: value}))[0], (kind, name, value))

    def test_ctk_cli_reads_it(self):
        try:
            import ctk_cli  # pylint: disable=import-outside-toplevel
        except ImportError:
            self.skipTest("the Python package ctk-cli is not installed")
        module = ctk_cli.CLIModule(str(MODULE))
        description = Description()
        self.assertEqual(module.title, description.root.findtext("title"))
        arguments, options, outputs = module.classifyParameters()
        self.assertEqual([item.name for item in arguments], ["inputVolume", "outputVolume"])
        self.assertEqual({item.longflag.lstrip("-") for item in options}, set(description.flagged))
        self.assertEqual([item.name for item in outputs], description.results)


class InstallTest(unittest.TestCase):
    def test_installed_module_runs_beside_its_description(self):
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run(
                [os.environ["MEDIALVOXEL_CMAKE"], "--install", os.environ["MEDIALVOXEL_BUILD"], "--prefix", prefix],
                capture_output=True,
                check=True,
            )
            installed = pathlib.Path(prefix)
            module, = installed.glob("**/MedialVoxel/cli-modules/MedialVoxelExtraction")
            self.assertEqual(module.with_suffix(".xml").read_bytes(), CONTENT)
            result = subprocess.run([module, "--xml"], capture_output=True, check=True, env={})
            self.assertEqual(result.stdout, CONTENT)
            self.assertEqual(sorted(path.name for path in module.parent.iterdir()), sorted([module.name, XML_FILE.name]))
            table, = installed.glob("share/MedialVoxel/MedialVoxel.ctbl")
            rows = [line.split() for line in table.read_text().splitlines() if not line.startswith("#")]
            self.assertEqual([row[0] for row in rows], ["0", "1", "2", "3", "4"])
            for row in rows:
                self.assertEqual(len(row), 6)
                self.assertTrue(all(0 <= int(value) <= 255 for value in row[2:]), row)


if __name__ == "__main__":
    unittest.main()
