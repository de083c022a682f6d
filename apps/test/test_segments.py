# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Names and colors of the objects of a label map, as 3D Slicer writes and reads them."""

import collections
import html.parser
import json
import pathlib
import subprocess
import unittest

import volumes
from interpreters import python_with
from program import CORRUPT, FAILURE, USAGE, ProgramTestCase

WRITE_SEGMENTATIONS = pathlib.Path(__file__).with_name("write_segmentations.py")

# As 3D Slicer exports them with a label map.
BLANK_TABLE = """# Color table file /tmp/labels.ctbl
# 4 values
0 background 0 0 0 0
3 left_rib 51 102 255 255
7 'right' 255 0 127.5 255
9 _ 1 2 3
"""
COMMA_TABLE = (
    "\ufeff"
    "LabelValue,Name,Color_R,Color_G,Color_B,Color_A,Type_CodeMeaning\r\n"
    '0,"background",0,0,0,0,\r\n'
    '3,"left rib",51,102,255,255,"Rib, left"\r\n'
    '7,"right, ""big""",255,0,127,255,\r\n'
)


def set_keys(content, **changes):
    """A NRRD file with these keys, or without those that are None."""
    header, voxels = content.split(b"\n\n", 1)
    lines = [line for line in header.split(b"\n") if line.split(b":=")[0].decode() not in changes]
    lines += [f"{key}:=".encode() + value for key, value in changes.items() if value is not None]
    return b"\n".join(lines) + b"\n\n" + voxels


class PageParser(html.parser.HTMLParser):
    """All elements, and the cells of tables by row."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.rows, self.styles = collections.Counter(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags[tag] += 1
        self.styles += [value for name, value in attrs if name == "style"]
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th") and self.rows:
            self.rows[-1].append("")

    def handle_data(self, data):
        if self.rows and self.rows[-1]:
            self.rows[-1][-1] += data


class SegmentsTestCase(ProgramTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.Volume((18, 12, 9), [], (0.5, 1, 0.75))
        self.volume.voxels = [0 if min(x, y, z) < 1 else 3 if x < 6 else 7 for x, y, z in self.volume.indices()]
        volumes.write_meta(self.folder / "map.mha", self.volume)

    def run_labels(self, name, *options, labels="all"):
        """The report."""
        result = self.extract(name, "out.mha", "--labels", labels, "--report", "r.json", "--overwrite", *options)
        self.warnings = result.warnings
        self.shown = result.stdout
        return json.loads((self.folder / "r.json").read_text(encoding="utf-8"))

    def names_and_colors(self, report):
        return {row["label"]: (row["name"], row["color"]) for row in report["objects"]}

    def write_nrrd(self, name="map.seg.nrrd", **keys):
        """The map as a segmentation with these keys."""
        header = b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 18 12 9\nencoding: raw\nspace: LPS\n"
        header += b"space directions: (0.5,0,0) (0,1,0) (0,0,0.75)\nspace origin: (0,0,0)\n\n"
        (self.folder / name).write_bytes(set_keys(header + bytes(self.volume.voxels), **keys))


class SlicerioTest(SegmentsTestCase):
    """Against slicerio, which knows the files of 3D Slicer."""

    def setUp(self):
        super().setUp()
        self.python = python_with("slicerio")
        if not self.python:
            self.skipTest("slicerio is not installed: run scripts/volume-writers")
        subprocess.run([self.python, "-B", WRITE_SEGMENTATIONS, "write", self.folder], check=True)

    def read(self, name):
        command = [self.python, "-B", WRITE_SEGMENTATIONS, "read", self.folder / name]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)

    def test_names_and_colors_go_through(self):
        before = self.read("one.seg.nrrd")
        for output, options in (("o.seg.nrrd", ()), ("packed.seg.nrrd", ("--compress",)), ("o.nhdr", ())):
            with self.subTest(output):
                report = self.run_labels("one.seg.nrrd", "--objects", output, *options)
                self.assertFalse([warning for warning in self.warnings if "segment" in warning])
                wanted = {segment["labelValue"]: (segment["name"], segment["color"]) for segment in before["segments"]}
                self.assertEqual(self.names_and_colors(report), wanted)
                after = self.read(output)
                self.assertEqual(after["representation"], "Binary labelmap")
                self.assertEqual(after["representations"], ["Binary labelmap"])
                self.assertEqual(after["offset"], [0, 0, 0])
                for key in ("id", "name", "color", "labelValue", "layer", "terminology"):
                    self.assertEqual(
                        [segment.get(key) for segment in after["segments"]],
                        [segment.get(key) for segment in before["segments"]],
                        key,
                    )
                for segment in after["segments"]:
                    self.assertEqual(segment["extent"], [0, 23, 0, 19, 0, 17])
                self.assertEqual(set(after["masks"]), {"left rib", 'right <b>"rib"</b> & more'})
                self.assertTrue(all(count > 50 for count in after["masks"].values()), after["masks"])
                # Cells lie between voxels.
                self.assertEqual([row[3] for row in after["matrix"][:3]], [10.25, -19.75, 30.375])

    def test_a_part_of_the_segments(self):
        for labels in ("7", 'right <b>"rib"</b> & more'):
            report = self.run_labels("one.seg.nrrd", "--objects", "o.seg.nrrd", labels=labels)
            self.assertEqual(report["parameters"]["labels"], [7])
            self.assertEqual([segment["labelValue"] for segment in self.read("o.seg.nrrd")["segments"]], [7])

    def test_color_table_for_a_plain_map(self):
        (self.folder / "map.ctbl").write_text(BLANK_TABLE, encoding="utf-8")
        self.run_labels("map.mha", "--segments", "map.ctbl", "--objects", "o.seg.nrrd")
        segments = self.read("o.seg.nrrd")["segments"]
        self.assertEqual([segment["labelValue"] for segment in segments], [3, 7, 9])
        self.assertEqual([segment["name"] for segment in segments], ["left rib", "right", "Segment_9"])
        self.assertEqual(segments[0]["color"], [0.2, 0.4, 1])

    def test_a_map_without_names_has_no_segments(self):
        self.run_labels("map.mha", "--objects", "o.seg.nrrd")
        self.assertNotIn(b":=", (self.folder / "o.seg.nrrd").read_bytes().split(b"\n\n")[0])

    def test_layers_are_refused(self):
        parts = ["layers.seg.nrrd", "2 layers", "overlap", "export a label map"]
        self.assert_fails(CORRUPT, parts, "info", "layers.seg.nrrd")
        self.assert_fails(CORRUPT, parts, "extract", "layers.seg.nrrd", "out.mha", "--labels", "all")
        parts = ["layers.seg.nrrd", "Segment2_Layer is '1'", "one layer"]
        run = ("extract", "map.mha", "out.mha", "--labels", "all", "--segments")
        self.assert_fails(CORRUPT, parts, *run, "layers.seg.nrrd")


class KeysTest(SegmentsTestCase):
    def test_keys(self):
        """Also what Slicer reads without a key, as its source says."""
        one = {"Segment0_ID": b"a"}
        cases = [
            ({}, {3: (None, None), 7: (None, None)}, 0),
            ({"Segment0_LabelValue": b"3"}, {3: (None, None), 7: (None, None)}, 0),
            (one, {3: (None, None), 7: (None, None)}, 1),
            ({**one, "Segment0_LabelValue": b"3"}, {3: ("a", None), 7: (None, None)}, 1),
            (
                {**one, "Segment0_LabelValue": b"3", "Segment1_ID": b"b", "Segment1_LabelValue": b"7", "Segment1_Name": b"N"},
                {3: ("a", None), 7: ("N", None)},
                0,
            ),
            # Slicer counts up to the first one that is missing.
            (
                {**one, "Segment0_LabelValue": b"3", "Segment2_ID": b"b", "Segment2_LabelValue": b"7"},
                {3: ("a", None), 7: (None, None)},
                1,
            ),
            ({**one, "Segment0_LabelValue": b"7", "Segment0_Color": b"0 0.5 1"}, {3: (None, None), 7: ("a", [0, 0.5, 1])}, 1),
        ]
        for keys, wanted, warnings in cases:
            with self.subTest(keys):
                self.write_nrrd(**keys)
                report = self.run_labels("map.seg.nrrd")
                self.assertEqual(self.names_and_colors(report), wanted)
                self.assertEqual(len(self.warnings), warnings, self.warnings)

    def test_warning_for_labels_without_a_segment(self):
        self.write_nrrd(Segment0_ID=b"a", Segment0_LabelValue=b"3")
        report = self.run_labels("map.seg.nrrd")
        (warning,) = report["warnings"]
        self.assertEqual((warning["code"], warning["values"]), ("labels_without_segment", {"labels": 1}))
        self.assertIn("as is 7", warning["message"])
        # A label that is asked for becomes a segment.
        self.run_labels("map.seg.nrrd", "--objects", "o.seg.nrrd", labels="7,3")
        self.assertEqual(self.warnings, [])
        self.assertIn(b"Segment1_Name:=Segment_7\n", (self.folder / "o.seg.nrrd").read_bytes())

    def test_bad_keys(self):
        good = {"Segment0_ID": b"a", "Segment0_LabelValue": b"3", "Segment1_ID": b"b", "Segment1_LabelValue": b"7"}
        cases = [
            ({"Segment1_LabelValue": b"3"}, ["Segment1_LabelValue is '3'", "another segment"]),
            ({"Segment1_LabelValue": b"0"}, ["Segment1_LabelValue is '0'", "other than 0"]),
            ({"Segment1_LabelValue": b"2147483648"}, ["Segment1_LabelValue is '2147483648'", "2^31"]),
            ({"Segment1_LabelValue": b"1.5"}, ["Segment1_LabelValue is '1.5'"]),
            ({"Segment1_LabelValue": b""}, ["Segment1_LabelValue is ''"]),
            ({"Segment0_Color": b"1 0"}, ["Segment0_Color has 2 values"]),
            ({"Segment0_Color": b"1 0 red"}, ["Segment0_Color", "'red'"]),
            ({"Segment0_Color": b"1 0 nan"}, ["Segment0_Color", "'nan'"]),
            ({"Segment0_Color": b"255 0 0"}, ["Segment0_Color is '255 0 0'", "from 0 to 1"]),
            ({"Segment0_Layer": b"1"}, ["Segment0_Layer is '1'", "one layer"]),
            ({"Segment0_Layer": b"x"}, ["Segment0_Layer is 'x'"]),
            ({"Segment0_Name": b"n" * 1025}, ["Segment0_Name has 1025 bytes", "1024"]),
            ({"Segment0_Tags": b"n" * 65537}, ["Segment0_Tags has 65537 bytes"]),
        ]
        for keys, parts in cases:
            with self.subTest(keys):
                self.write_nrrd(**{**good, **keys})
                self.assert_fails(CORRUPT, ["map.seg.nrrd: ", *parts], "extract", "map.seg.nrrd", "o.mha", "--labels", "all")
                # They do not matter for a run on other things.
                self.extract("map.seg.nrrd", "one.mha", "--label", 3, "--overwrite")
                (self.folder / "one.mha").unlink()

    def test_many_segments(self):
        def write(number):
            keys = {}
            for i in range(number):
                keys[f"Segment{i}_ID"] = keys[f"Segment{i}_LabelValue"] = str(i + 1).encode()
            header = b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 18 12 9\nencoding: raw\n"
            lines = b"".join(f"{key}:=".encode() + value + b"\n" for key, value in keys.items())
            (self.folder / "many.nrrd").write_bytes(header + lines + b"\n" + bytes(self.volume.voxels))

        write(8192)
        report = self.run_labels("many.nrrd", "--objects", "o.seg.nrrd")
        self.assertEqual(self.names_and_colors(report), {3: ("3", None), 7: ("7", None)})
        self.run_labels("o.seg.nrrd")
        write(8193)
        self.assert_fails(CORRUPT, ["many.nrrd", "8192 segments"], "extract", "many.nrrd", "o.mha", "--labels", "all")
        table = "".join(f"{i} a 0 0 0\n" for i in range(1, 65536))
        (self.folder / "many.ctbl").write_text(table, encoding="utf-8")
        run = ("map.mha", "--segments", "many.ctbl")
        self.run_labels(*run, "--objects", "o.mha")
        self.run_labels(*run, "--objects", "o.nrrd", labels="3")
        parts = ["p.nrrd", "65535 segments", "8192"]
        self.assert_fails(USAGE, parts, "extract", run[0], "o2.mha", *run[1:], "--labels", "all", "--objects", "p.nrrd")

    def test_hostile_names(self):
        names = {
            3: b"<script>alert(1)</script>&\"'</td></table>",
            7: b"tab\tbell\x07esc\x1b[31m c1\xc2\x9b31m line\\nend back\\\\slash nonutf\xff umlaut\xc3\xa9",
        }
        keys = {}
        for i, (label, name) in enumerate(names.items()):
            keys |= {f"Segment{i}_ID": b"same", f"Segment{i}_LabelValue": str(label).encode(), f"Segment{i}_Name": name}
        keys["Segment0_Color"] = b"0 0.5 1"
        self.write_nrrd(**keys)
        self.extract("map.seg.nrrd", "plain.mha", "--label", 3, "--html", "plain.html")
        report = self.run_labels("map.seg.nrrd", "--objects", "o.seg.nrrd", "--html", "page.html")
        self.assertEqual(report["objects"][0]["name"], names[3].decode())
        cleaned = "tab?bell?esc?[31m c1?31m line?end back\\slash nonutf\ufffd umlaut\u00e9"
        self.assertEqual(report["objects"][1]["name"], cleaned)
        page = (self.folder / "page.html").read_bytes()
        for control in (b"\x07", b"\x1b", b"\xc2\x9b"):
            self.assertNotIn(control, page)
            self.assertNotIn(control.decode(), self.shown)
        parsed = PageParser(page.decode(errors="replace"))
        plain = PageParser((self.folder / "plain.html").read_text(encoding="utf-8"))
        self.assertEqual(set(parsed.tags) - set(plain.tags), set(), "an element more")
        self.assertEqual(parsed.tags["table"], plain.tags["table"] + 1)
        rows = [row for row in parsed.rows if row[:1] in (["3"], ["7"])]
        self.assertEqual([row[1] for row in rows], [names[3].decode(), cleaned])
        self.assertEqual(parsed.styles, ["background:rgb(0,128,255)"])
        # What is written reads back the same, with IDs that are each there once.
        again = self.run_labels("o.seg.nrrd")
        self.assertEqual([row["name"] for row in again["objects"]], [row["name"] for row in report["objects"]])
        text = (self.folder / "o.seg.nrrd").read_bytes()
        self.assertIn(b"Segment0_ID:=same\n", text)
        self.assertIn(b"Segment1_ID:=same_\n", text)

    def test_names_on_the_screen_and_on_the_page(self):
        volume = volumes.Volume((150, 3, 3), [], kind="uint8")
        volume.voxels = [x // 4 + 1 if x % 4 < 3 else 0 for x, _, _ in volume.indices()]
        volumes.write_meta(self.folder / "map.mha", volume)
        (self.folder / "n.ctbl").write_text("2 second_one 255 0 0 255\n", encoding="utf-8")
        self.run_labels("map.mha", "--segments", "n.ctbl")
        self.assertIn("label 2 ", self.shown)
        self.assertIn(" second one: 27 voxels, ", self.shown)
        self.assertRegex(self.shown, r"(?m)^  label 20 .*\n  others +18, --report has all$")


class TablesTest(SegmentsTestCase):
    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8", newline="")

    def test_tables(self):
        self.write("labels.ctbl", BLANK_TABLE)
        self.write("labels.txt", BLANK_TABLE.replace("\n", "\r\n").replace(" ", "\t"))
        self.write("labels.csv", COMMA_TABLE)
        self.write("labels.tsv", COMMA_TABLE.replace(",", "\t").replace("Rib\t", "Rib,").replace("right\t", "right,"))
        self.write("Small.CSV", "Name,LabelValue\nleft rib,3\n")
        self.write_nrrd("names.nrrd", Segment0_ID=b"3", Segment0_LabelValue=b"3", Segment0_Name=b"left rib")
        for name, other in (
            ("labels.ctbl", ("right", [1, 0, 0.5])),
            ("labels.txt", ("right", [1, 0, 0.5])),
            ("labels.csv", ('right, "big"', [1, 0, 127 / 255])),
            ("labels.tsv", ('right, "big"', [1, 0, 127 / 255])),
            ("Small.CSV", (None, None)),
            ("names.nrrd", (None, None)),
        ):
            with self.subTest(name):
                known = self.names_and_colors(self.run_labels("map.mha", "--segments", name))
                self.assertEqual(known[3][0], "left rib")
                self.assertEqual(known[3][1], [0.2, 0.4, 1] if other[1] else None)
                self.assertEqual(known[7], other)

    def test_a_table_goes_before_the_names_of_the_input(self):
        self.write_nrrd(Segment0_ID=b"a", Segment0_LabelValue=b"3", Segment1_ID=b"b", Segment1_LabelValue=b"7")
        self.write("n.csv", "LabelValue,Name\n3,other\n")
        known = self.names_and_colors(self.run_labels("map.seg.nrrd", "--segments", "n.csv"))
        self.assertEqual(known, {3: ("other", None), 7: (None, None)})

    def test_names_as_labels(self):
        self.write("n.csv", "LabelValue,Name\n3,left\n7,right\n8,twin\n9,twin\n")
        for labels, values in (("left", [3]), ("right,left", [3, 7]), ("left,3,7", [3, 7])):
            report = self.run_labels("map.mha", "--segments", "n.csv", labels=labels)
            self.assertEqual(report["parameters"]["labels"], values)
            self.assertEqual([row["label"] for row in report["objects"]], values)
        run = ("extract", "map.mha", "o.mha", "--labels")
        self.assert_fails(USAGE, ["'twin'", "8 and 9"], *run, "twin", "--segments", "n.csv")
        self.assert_fails(USAGE, ["'up'", "no name"], *run, "left,up", "--segments", "n.csv")
        self.assert_fails(USAGE, ["'up'", "--segments"], *run, "up", "--dry-run")
        self.assert_fails(USAGE, ["map.mha", "label 8"], *run, "8", "--segments", "n.csv")

    def test_bad_tables(self):
        start = "LabelValue,Name,Color_R,Color_G,Color_B\n"
        cases = [
            ("a.ctbl", "3 a 1 2\n", ["line 1", "4 words"]),
            ("a.ctbl", "# x\n3 a b 1 2 3 255\n", ["line 2", "7 words"]),
            ("a.ctbl", "3 a 256 0 0 255\n", ["line 1", "red is '256'", "0 to 255"]),
            ("a.ctbl", "3 a 0 -1 0 255\n", ["green is '-1'"]),
            ("a.ctbl", "3 a 0 0 blue 255\n", ["blue is 'blue'"]),
            ("a.ctbl", "3 a 0 0 nan 255\n", ["blue is 'nan'"]),
            ("a.ctbl", "x a 0 0 0 255\n", ["line 1: label is 'x'"]),
            ("a.ctbl", "3 a 0 0 0 255\n3 b 0 0 0 255\n", ["line 2", "label 3", "twice"]),
            ("a.ctbl", "# Color procedural file x\n1 0 0 0\n", ["line 1", "color function"]),
            ("a.ctbl", f"3 {'n' * 1025} 0 0 0\n", ["line 1: name has 1025 bytes"]),
            ("a.ctbl", "3 a\0 0 0 0\n", ["line 1", "not text"]),
            ("a.ctbl", f"3 {'n' * 70000} 0 0 0\n", ["line 1", "65536 bytes"]),
            ("a.ctbl", "".join(f"{i} a 0 0 0\n" for i in range(1, 65537)), ["65535 rows"]),
            ("a.csv", "", ["a.csv", "LabelValue"]),
            ("a.csv", "Label,Name\n3,a\n", ["line 1", "LabelValue"]),
            ("a.csv", start + '3,"a,1,2,3\n', ["line 2", "quotation mark"]),
            ("a.csv", start + "3,a,1,2\n", ["line 2", "Color_B is ''"]),
            ("a.csv", start + "3,a,1,2,300\n", ["line 2", "Color_B is '300'"]),
            ("a.csv", start + ",a,1,2,3\n", ["line 2", "label is ''"]),
            ("a.csv", start + "4294967299,a,1,2,3\n", ["line 2", "label is '4294967299'"]),
        ]
        for name, text, parts in cases:
            with self.subTest(text[:60]):
                self.write(name, text)
                run = ("extract", "map.mha", "o.mha", "--labels", "all", "--segments", name)
                self.assert_fails(CORRUPT, [f"{name}: ", *parts], *run)

    def test_refusals(self):
        run = ("extract", "map.mha", "o.mha")
        self.write("n.json", "{}")
        self.write("n.csv", "LabelValue,Name\n3,left\n")
        self.assert_fails(USAGE, ["--segments", "--labels"], *run, "--segments", "n.csv")
        self.assert_fails(USAGE, ["n.json", "unknown format", ".ctbl"], *run, "--labels", "all", "--segments", "n.json")
        self.assert_fails(FAILURE, ["no.csv", "no such file"], *run, "--labels", "all", "--segments", "no.csv")
        (self.folder / "folder.csv").mkdir()
        self.assert_fails(FAILURE, ["folder.csv"], *run, "--labels", "all", "--segments", "folder.csv")
        self.write_nrrd(Segment0_ID=b"a", Segment0_LabelValue=b"3")
        options = ("--labels", "all", "--segments", "map.seg.nrrd", "--objects", "map.seg.nrrd", "--overwrite")
        self.assert_fails(USAGE, ["map.seg.nrrd", "objects", "would replace the input"], *run, *options)


if __name__ == "__main__":
    unittest.main()
