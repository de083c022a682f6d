# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs of the module for 3D Slicer: the files of the terminal's program, tags of progress, results in a file."""

import array
import json
import re
import subprocess
import unittest

import volumes
from program import PROGRAM, USAGE
from slicer_module import MODULE, Description, ModuleTestCase

# Arguments of the module, and of the program.
PAIRS = [
    ([], []),
    (["--objectSelection", "AboveLower", "--lowerThreshold", "72.5"], ["--lower", "72.5"]),
    (["--objectSelection", "BelowUpper", "--upperThreshold=50", "--thickness", "2"], ["--upper", "50"]),
    (["--objectSelection", "Between", "--lowerThreshold", "8", "--upperThreshold", "100"], ["--lower", "8", "--upper", "100"]),
    (["--objectSelection=Label", "--labelValue", "100"], ["--label", "100"]),
    (["--objectSelection=Label", "--labelValue=100", "--thickness", "3vx"], ["--label", "100"]),
    (["--thickness", "2.5VX"], []),
    (["--thicknessMode", "Automatic"], []),
    (["--thicknessMode=Fixed", "--thickness", "3"], []),
    (["--objectSelection", "AboveLower", "--lowerThreshold", "72.5", "--subVoxel", "On"], ["--lower", "72.5", "--sub-voxel"]),
    (["--maxPoreSize", "0"], ["--max-pore-size", "0"]),
    (["--resample", "--objectSelection=AboveLower", "--lowerThreshold=72"], ["--resample", "auto", "--lower", "72"]),
    (["--maxPoreSize=-1", "--thickness", "2"], []),
    (["--maxPoreSize=200", "--thickness", "2"], ["--max-pore-size", "200"]),
    (["--numberOfThreads", "1", "--memory", "300M"], ["--threads", "1", "--memory", "300M"]),
]  # fmt: skip
LABEL_100 = ("--objectSelection", "Label", "--labelValue", "100")
OUTPUTS = {
    "vectorVolume": "vectors",
    "distanceVolume": "distance",
    "thicknessMap": "thickness-map",
    "meshModel": "mesh",
    "reportFile": "report",
    "previewFile": "preview",
    "vectorBoundary": "vector-boundary",
}


class RunTest(ModuleTestCase):
    def setUp(self):
        super().setUp()
        self.volume = volumes.box_with_plate(spacing=(0.5, 1, 0.75))
        volumes.write_meta(self.folder / "in.mha", self.volume)

    def extract_both(self, module_arguments, program_arguments, extension=".mha"):
        """The labels of module and program."""
        thickness = "auto"
        if "--thickness" in module_arguments:
            thickness = module_arguments[module_arguments.index("--thickness") + 1]
        self.run_module(*module_arguments, "in.mha", f"module{extension}")
        self.extract("in.mha", f"program{extension}", "--overwrite", *program_arguments, thickness=thickness)
        return [(self.folder / f"{name}{extension}").read_bytes() for name in ("module", "program")]

    def test_labels_equal_those_of_the_program(self):
        seen = set()
        for module_arguments, program_arguments in PAIRS:
            labels, expected = self.extract_both(module_arguments, program_arguments)
            self.assertEqual(labels, expected, module_arguments)
            seen.add(labels)
        self.assertGreaterEqual(len(seen), 4, "the arguments make no difference")

    def test_all_formats_equal_those_of_the_program(self):
        for extension in (".mha", ".nrrd"):
            labels, expected = self.extract_both([], [], extension)
            self.assertEqual(labels, expected)

    def test_objects_of_a_label_map_equal_those_of_the_program(self):
        table = "# Color table file\n8 the_box 255 0 0 255\n100 the_plate 0 0 255 255\n"
        (self.folder / "names.ctbl").write_text(table, encoding="utf-8")
        for labels, names in ((["--labels=the plate"], True), ([], True), (["--labels", "100"], False)):
            with self.subTest(labels):
                table = ["--colorTable", "names.ctbl"] if names else []
                module = ["--objectSelection", "Labels", *labels, "--returnparameterfile", "r.txt", *table]
                self.run_module(*module, "--objectsVolume", "m.seg.nrrd", "in.mha", "m.mha")
                names = ["--segments", "names.ctbl"] if names else []
                program = labels[-1].split("=")[-1] if labels else "all"
                program = ["--labels", program, *names, "--objects", "p.seg.nrrd", "--overwrite"]
                self.extract("in.mha", "p.mha", *program, thickness="auto")
                for one, other in (("m.seg.nrrd", "p.seg.nrrd"), ("m.mha", "p.mha")):
                    self.assertEqual((self.folder / one).read_bytes(), (self.folder / other).read_bytes())
                self.assertEqual(b"Segment0_Name:=the" in (self.folder / "m.seg.nrrd").read_bytes(), bool(names))
                self.assertIn("medialCells = ", (self.folder / "r.txt").read_text(encoding="utf-8"))
        # As Slicer gives all parameters, these have no effect with another selection.
        self.run_module("--objectSelection", "NonZero", "--labels", "all", "--colorTable", "none.ctbl", "in.mha", "m.mha")
        self.assert_module_fails(USAGE, ["--labels requires --objectSelection"], "--labels", "8", "in.mha", "new.mha")
        parts = ["o.seg.nrrd", "several labels"]
        self.assert_module_fails(USAGE, parts, "--objectsVolume", "o.seg.nrrd", "in.mha", "new.mha")

    def test_further_outputs_equal_those_of_the_program(self):
        def run(name, flag_of, runner):
            files = {"vectorVolume": "v.mha", "distanceVolume": "d.mha", "thicknessMap": "t.mha", "meshModel": "s.vtp"}
            files |= {"reportFile": "r.json", "previewFile": "p.png"}
            values = {flag: name + file for flag, file in files.items()} | {"vectorBoundary": "background"}
            runner(*(part for flag, value in values.items() for part in (f"--{flag_of(flag)}", value)))
            return {flag: (self.folder / values[flag]).read_bytes() for flag in files}

        module = run("m", lambda flag: flag, lambda *arguments: self.run_module(*arguments, "in.mha", "m.mha"))
        program = run("p", OUTPUTS.get, lambda *arguments: self.extract("in.mha", "p.mha", *arguments, thickness="auto"))
        reports = [json.loads(outputs.pop("reportFile")) for outputs in (module, program)]
        self.assertEqual(module, program)
        for key in ("version", "input", "parameters", "size", "counts", "percent", "threads", "divisions"):
            self.assertEqual(reports[0][key], reports[1][key], key)

    def test_the_model_has_points_in_the_coordinates_of_the_files(self):
        """Of ITK (LPS), as Slicer takes models to be that say nothing else; the description cannot say it."""
        volumes.write_meta(self.folder / "in.mha", self.volume, Offset="10 200 3000")
        self.run_module("--meshModel", "model.ply", *LABEL_100, "in.mha", "out.mha")
        header, data = (self.folder / "model.ply").read_bytes().split(b"end_header\n", 1)
        number = int(re.search(rb"element vertex (\d+)", header)[1])
        points = list(zip(*[iter(array.array("f", data[: 16 * number]))] * 4))
        self.assertGreater(number, 20)
        for axis, origin in enumerate((10, 200, 3000)):
            self.assertTrue(all(origin < point[axis] < origin + 100 for point in points), axis)
        (element,) = Description().root.iter("geometry")
        self.assertNotIn("coordinateSystem", element.attrib)
        self.assertTrue(element.get("fileExtensions").startswith(".vtp"))

    def test_branches_of_the_model(self):
        arguments = ("--thicknessMode", "Fixed", "--thickness", "1", *LABEL_100, "in.mha", "out.mha")
        self.run_module("--meshModel", "all.vtp", *arguments)
        self.run_module("--meshModel", "cut.vtp", "--minBranchLength", "2", *arguments)
        selection = ("--label", 100, "--thickness", 1)
        self.run_program("mesh", "in.mha", "program.vtp", *selection, "--min-branch-length", 2)
        cut = (self.folder / "cut.vtp").read_bytes()
        self.assertEqual(cut, (self.folder / "program.vtp").read_bytes())
        self.assertNotEqual(cut, (self.folder / "all.vtp").read_bytes())
        self.assert_module_fails(USAGE, ["'-1' is not a finite number"], "--minBranchLength=-1", *arguments)

    def test_elements_of_the_model(self):
        sizes = {
            ("--elementSizeMode", "Automatic", "--extendRims"): ("--element-size", "auto", "--extend-rims"),
            ("--elementSize", "5"): ("--element-size", 5),
            ("--elementSizeMode", "Voxel", "--elementSize", "5"): (),
        }
        models = set()
        for module, program in sizes.items():
            with self.subTest(module):
                self.run_module("--meshModel", "m.vtp", *module, *LABEL_100, "in.mha", "out.mha")
                self.run_program("mesh", "in.mha", "p.vtp", "--label", 100, *program, "--overwrite")
                models.add((self.folder / "m.vtp").read_bytes())
                self.assertIn((self.folder / "p.vtp").read_bytes(), models)
        self.assertEqual(len(models), len(sizes))
        arguments = ("--meshModel", "m.vtp", *LABEL_100, "in.mha", "out.mha")
        self.assert_module_fails(USAGE, ["element size"], "--extendRims", *arguments)
        self.assert_module_fails(USAGE, ["element size", "0.01"], "--elementSize", "0.01", *arguments)

    def test_progress(self):
        for arguments in ([], ["--distanceVolume", "d.mha"]):
            out = self.run_module(*arguments, *LABEL_100, "in.mha", "out.mha").stdout
            lines = out.splitlines()
            self.assertLessEqual(len(lines), 200)
            self.assertRegex(
                lines[0],
                r"^<filter-start><filter-name>\w+</filter-name><filter-comment>[\w ]+</filter-comment></filter-start>$",
            )
            self.assertRegex(
                lines[-1],
                r"^<filter-end><filter-name>\w+</filter-name><filter-time>[\d.e-]+</filter-time></filter-end>$",
            )
            fractions = [re.fullmatch(r"<filter-progress>([\d.e-]+)</filter-progress>", line)[1] for line in lines[1:-1]]
            fractions = [float(fraction) for fraction in fractions]
            self.assertEqual(fractions, sorted(fractions))
            self.assertTrue(0 <= fractions[0] < fractions[-1] == 1)

    def test_warnings_are_comments_and_lines_of_the_output_stream(self):
        arguments = ("--objectSelection", "AboveLower", "--lowerThreshold", "200", "in.mha", "out.mha")
        lines = self.run_module(*arguments).stdout.splitlines()
        text = "the volume has no object: no value is at least 200"
        self.assertIn(f"medialvoxel: warning: {text}", lines)
        self.assertIn(f"<filter-comment>Warning: {text}</filter-comment>", lines)
        self.assertTrue(lines[-1].startswith("<filter-end>"))

    def test_compressed_input_is_told_on_the_output_stream(self):
        """3D Slicer takes all of the error stream for errors."""
        volumes.write_meta(self.folder / "packed.mha", self.volume, compressed=True)
        result = self.run_module("packed.mha", "packed-out.mha")
        self.assertIn("compressed", result.stdout)
        self.run_module("in.mha", "out.mha")
        self.assertEqual((self.folder / "packed-out.mha").read_bytes(), (self.folder / "out.mha").read_bytes())

    def test_progress_of_the_program_is_told_on_the_output_stream(self):
        volumes.write_meta(self.folder / "packed.mha", self.volume, compressed=True)
        command = [PROGRAM, "extract", "packed.mha", "out.mha", "--thickness", "3", "--progress", "slicer"]
        result = subprocess.run(command, cwd=self.folder, capture_output=True, check=True, text=True)
        self.assertEqual(result.stderr, "")
        self.assertIn("unpacked", result.stdout)

    def test_return_parameters_equal_the_report(self):
        selection = ["--objectSelection", "Label", "--labelValue", "100"]
        files = ["--returnparameterfile", "values.txt", "--reportFile", "r.json"]
        self.run_module(*selection, *files, "in.mha", "out.mha")
        values = dict(line.split(" = ") for line in (self.folder / "values.txt").read_text().splitlines())
        report = json.loads((self.folder / "r.json").read_text())
        counts = report["counts"]
        for name, key in {
            "objectVoxels": "object_voxels",
            "candidateCells": "candidate_cells",
            "trivialCells": "trivial",
            "boundCells": "bound",
            "geodesicMedialCells": "geodesic_medial",
            "geodesicNonMedialCells": "geodesic_non_medial",
            "medialCells": "medial_cells",
        }.items():
            self.assertEqual(int(values[name]), counts[key], name)
        self.assertEqual(counts["object_voxels"], self.volume.voxels.count(100))
        self.assertGreater(counts["medial_cells"], 0)
        for kind in ("pseudo", "correct"):
            self.assertEqual(float(values[f"{kind}Percent"]), report["percent"][kind])
        for kind in ("distance", "classification", "total"):
            self.assertEqual(float(values[f"{kind}Seconds"]), report["seconds"][kind])

    def test_return_parameters_of_nothing(self):
        arguments = ["--objectSelection", "AboveLower", "--lowerThreshold", "200", "--returnparameterfile", "values.txt"]
        self.run_module(*arguments, "in.mha", "out.mha")
        values = (self.folder / "values.txt").read_text()
        self.assertIn("medialCells = 0\n", values)
        self.assertIn("pseudoPercent = nan\n", values)

    def test_echo(self):
        out = self.run_module("--echo", "--thickness", "2.50", "in.mha", "out.mha").stdout
        self.assertIn("thickness: 2.50\n", out)
        self.assertIn("<filter-end>", out)

    def test_closed_output_is_a_failure(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run(
                [MODULE, "--xml"], stdout=full, stderr=subprocess.PIPE, check=False, cwd=self.folder, text=True
            )
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output", result.stderr)


if __name__ == "__main__":
    unittest.main()
