# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What would mislead is said: one line on the error stream, an entry of the report, a paragraph of the page."""

import json
import subprocess
import unittest

import volumes
from jobs import JobTestCase, results
from program import PROGRAM, USAGE, ProgramTestCase


def solid(size, is_object, spacing=None, kind="uint8"):
    volume = volumes.Volume(size, [], spacing, kind)
    volume.voxels = [int(is_object(*index)) for index in volume.indices()]
    return volume


def plate(thickness, width=40, **options):
    """From face to face of the volume."""
    return solid((width, width, thickness + 8), lambda x, y, z: 4 <= z < 4 + thickness, **options)


def rod(diameter, length=40):
    size = diameter + 8
    middle = (size - 1) / 2
    return solid((size, size, length), lambda x, y, z: (x - middle) ** 2 + (y - middle) ** 2 <= diameter**2 / 4 and 4 <= z < length - 4)


def square_rod(side, length=40):
    return solid((side + 8, side + 8, length), lambda x, y, z: 4 <= x < 4 + side and 4 <= y < 4 + side and 4 <= z < length - 4)


def ball(diameter):
    size = diameter + 8
    middle = (size - 1) / 2
    return solid((size, size, size), lambda *index: sum((i - middle) ** 2 for i in index) <= diameter**2 / 4)


class WarningTest(ProgramTestCase):
    def warnings(self, volume, *arguments, thickness="auto"):
        """The warnings of the report by their codes; the error stream and the page must tell the same."""
        volumes.write_meta(self.folder / "in.mha", volume)
        outputs = ("--report", "r.json", "--html", "r.html", "--overwrite")
        result = self.extract("in.mha", "out.mha", *outputs, *arguments, thickness=thickness)
        self.report = json.loads((self.folder / "r.json").read_text())
        found = {warning["code"]: warning for warning in self.report["warnings"]}
        self.assertEqual(len(found), len(self.report["warnings"]))
        self.assertEqual([warning["message"] for warning in self.report["warnings"]], result.warnings)
        page = (self.folder / "r.html").read_text()
        self.assertEqual(page.count('class="warning"'), len(found))
        for warning in found.values():
            self.assertIn(f"Warning: {warning['message']}.", page)
            self.assertNotRegex(warning["message"], r"[\n<>&.]$|[<>&]")
        return found

    def assert_no_thickness(self):
        thickness = self.report["thickness"]
        self.assertEqual((thickness["cells"], thickness["area"]), (0, 0))
        lengths = [thickness[name] for name in ("mean", "standard_deviation", "minimum", "maximum")]
        lengths += thickness["percentiles"].values()
        self.assertEqual(set(lengths), {None})

    def test_walls_need_no_warning(self):
        for name, volume in {
            "plates": [plate(thickness) for thickness in (1, 2, 4, 8, 16)],
            "box": [solid((40, 40, 40), lambda *i: all(4 <= c < 36 for c in i) and not all(8 <= c < 32 for c in i))],
            "tilted": [solid((40, 40, 40), lambda x, y, z: abs(x + 2 * y + 2 * z - 100) <= 9)],
            "with rims": [solid((40, 40, 20), lambda x, y, z: 8 <= x < 32 and 8 <= y < 32 and 8 <= z < 12)],
            "one slice": [solid((40, 40, 1), lambda x, y, z: 8 <= y < 12)],
            "two dimensions": [solid((40, 40), lambda x, y: 8 <= y < 12)],
            "unequal": [plate(4, spacing=(0.5, 0.5, 0.25)), plate(4, spacing=(0.25, 0.5, 0.5))],
        }.items():
            for one in volume:
                self.assertEqual(self.warnings(one), {}, name)

    def test_nothing_is_told_when_quiet(self):
        volumes.write_meta(self.folder / "in.mha", plate(4))
        command = [PROGRAM, "extract", "in.mha", "out.mha", "--lower", "9", "--overwrite"]
        for more, told in (([], True), (["--quiet"], False), (["--progress", "json"], True)):
            run = subprocess.run([*command, *more], capture_output=True, check=True, text=True, cwd=self.folder)
            self.assertEqual("no value is at least 9" in run.stderr, told, more)
        (entry,) = [json.loads(line) for line in run.stderr.splitlines() if "warning" in line]
        self.assertEqual(entry["warning"], "no_object")

    def test_the_log_has_them(self):
        volumes.write_meta(self.folder / "in.mha", plate(4))
        self.extract("in.mha", "out.mha", "--lower", 9, "--log-file", "run.log", "--quiet")
        self.assertRegex((self.folder / "run.log").read_text(), r"(?m)^\S+ warning \d+ warning code=no_object message=.*$")

    def test_no_object(self):
        for arguments, part in (
            (["--lower", 2], "no value is at least 2"),
            (["--upper", -1.5], "no value is at most -1.5"),
            (["--lower", 5, "--upper", 7], "no value is from 5 to 7"),
        ):
            found = self.warnings(plate(4), *arguments)
            self.assertEqual(list(found), ["no_object"])
            self.assertIn(part, found["no_object"]["message"])
            self.assert_no_thickness()
            result = self.run_program("distance", "in.mha", "v.mha", *arguments, "--overwrite", "--report", "d.json")
            self.assertEqual(result.warnings, [found["no_object"]["message"]])
            report = json.loads((self.folder / "d.json").read_text())
            self.assertEqual([warning["code"] for warning in report["warnings"]], ["no_object"])
        self.assertIn("other than 0", self.warnings(solid((9, 9, 9), lambda *_: False))["no_object"]["message"])

    def test_all_object_is_dust(self):
        grain = solid((20, 20, 20), lambda *index: all(8 <= i < 11 for i in index))
        found = self.warnings(grain)
        self.assertEqual(found["no_object"]["values"], {"removed_voxels": 27})
        self.assertNotIn("no_object", self.warnings(grain, "--max-pore-size", 0))

    def test_no_background(self):
        found = self.warnings(plate(4), "--lower", 0)
        self.assertEqual(list(found), ["no_background"])
        self.assertIn("all values are at least 0", found["no_background"]["message"])
        self.assertNotIn("needs a lower threshold", found["no_background"]["message"])
        self.assert_no_thickness()
        self.assertIn("needs a lower threshold", self.warnings(volumes.Volume((6, 6, 6), [7] * 216))["no_background"]["message"])
        found = self.warnings(plate(4), "--lower", 0)
        result = self.run_program("distance", "in.mha", "v.mha", "--lower", 0)
        self.assertEqual(result.warnings, [found["no_background"]["message"]])
        pore = solid((20, 20, 20), lambda *index: index != (9, 9, 9))
        self.assertEqual(self.warnings(pore, "--smooth", "off")["no_background"]["values"], {"filled_voxels": 1})
        self.assertNotIn("no_background", self.warnings(pore, "--smooth", "off", "--max-pore-size", 0))

    def test_noise_without_a_threshold_is_object(self):
        # 34 gray values of a background and of a wall; masks, and most label maps, have few values.
        noise = [3 + (i * 7919) % 17 for i in range(24**3)]
        scan = [value + 120 if 8 <= i // 24**2 < 14 else value for i, value in enumerate(noise)]
        found = self.warnings(volumes.Volume((24, 24, 24), scan))
        self.assertEqual(list(found)[0], "faint_object")
        self.assertEqual(found["faint_object"]["values"]["object_percent"], 100)
        self.assertEqual(found["faint_object"]["values"]["faint_percent"], 75)
        self.assertIn("needs --lower", found["faint_object"]["message"])
        for others in (["--lower", 100], ["--upper", 100], ["--lower", "otsu"]):
            self.assertNotIn("faint_object", self.warnings(volumes.Volume((24, 24, 24), scan), *others))
        layers = volumes.Volume((24, 24, 24), [1 + i % 24 for i in range(24**3)])
        self.assertIn("faint_object", self.warnings(layers))
        for others in (["--label", 5], ["--labels", "all"]):
            self.assertNotIn("faint_object", self.warnings(layers, *others))
        # A gray object that was cut out of its scan; of float, no bin of values begins at 0.
        cut_out = [value if value > 100 else 0 for value in scan]
        self.assertNotIn("faint_object", self.warnings(volumes.Volume((24, 24, 24), cut_out)))
        shares = volumes.Volume((24, 24, 24), [value / 150 or -0.1 * (i == 0) for i, value in enumerate(cut_out)], None, "float32")
        self.assertNotIn("faint_object", self.warnings(shares))
        for values in ([value > 100 for value in scan], [value % 16 for value in noise], [7] * 24**3):
            self.assertNotIn("faint_object", self.warnings(volumes.Volume((24, 24, 24), [int(value) for value in values])))

    def test_rods_and_balls_have_no_sheet(self):
        for volume in (square_rod(2), square_rod(16), rod(3), rod(16), ball(8), ball(16)):
            self.assertEqual(list(self.warnings(volume)), ["no_medial_cells"])
            self.assert_no_thickness()
        for volume in (rod(4), rod(6), rod(8), ball(32)):
            found = self.warnings(volume)
            self.assertIn("few_sheets", found)
            self.assertLessEqual(set(found), {"few_sheets", "beyond_max_thickness"})
            percent = found["few_sheets"]["values"]["explained_percent"]
            self.assertTrue(0 <= percent < 20, percent)
            self.assertIn(f"only {percent:.{1 if 0 < percent < 1 else 0}f} %", found["few_sheets"]["message"])
        small = solid((40, 40, 12), lambda x, y, z: 8 <= x < 32 and 8 <= y < 32 and 4 <= z < 8)
        self.assertIn("of at least the given thickness", self.warnings(small, thickness=60)["no_medial_cells"]["message"])

    def test_the_share_is_one_of_the_volume(self):
        """The volume does not depend on the units and the spacing; a rod beside a plate takes its part of it."""
        size = (40, 40, 60)
        both = solid(size, lambda x, y, z: 4 <= z < 8 or (16 <= x < 24 and 16 <= y < 24 and 12 <= z < 56))
        wide = solid(size, lambda x, y, z: 4 <= z < 8 or (16 <= x < 32 and 16 <= y < 32 and 12 <= z < 56))
        self.assertEqual(self.warnings(both), {})
        shares = set()
        for volume, arguments in ((wide, []), (wide, ["--divisions", 7, "--threads", 3])):
            (warning,) = self.warnings(volume, *arguments).values()
            shares.add((warning["code"], warning["values"]["explained_percent"]))
        self.assertEqual(len(shares), 1, shares)
        share = 100 * 39 * 39 * 4 / (40 * 40 * 4 + 16 * 16 * 44)
        self.assertAlmostEqual(next(iter(shares))[1], share, delta=1)
        wide.spacing = (0.5, 0.5, 0.5)
        self.assertAlmostEqual(self.warnings(wide)["few_sheets"]["values"]["explained_percent"], share, delta=1)

    def test_walls_beyond_the_maximum_thickness(self):
        for spacing in (1, 0.25):
            volume = solid((48, 48, 60), lambda x, y, z: 8 <= z < 52 and 4 <= x < 44, spacing=[spacing] * 3)
            reports = []
            for arguments in ([], ["--divisions", 5, "--threads", 3]):
                found = self.warnings(volume, *arguments)
                reports.append(found)
                values = found["beyond_max_thickness"]["values"]
                self.assertEqual(values["max_thickness"], 16 * spacing)
                self.assertGreater(values["area_percent"], 90)
                self.assertTrue(36 * spacing <= values["suggested_max_thickness"] <= 44 * spacing)
            self.assertEqual(*reports)
            found = self.warnings(volume, "--max-thickness", values["suggested_max_thickness"])
            self.assertNotIn("beyond_max_thickness", found)
        found = self.warnings(plate(20, width=30), "--max-thickness", "8vx")
        self.assertEqual(found["beyond_max_thickness"]["values"]["suggested_max_thickness"], 20)
        self.assertIn("thickness of 20 reaches", found["beyond_max_thickness"]["message"])
        self.assertEqual(self.warnings(plate(20, width=30), thickness=8), {}, "a fixed thickness has no maximum")

    def test_unusual_lengths(self):
        for name in ("thickness", "min-thickness", "max-thickness"):
            code = "unusual_" + name.replace("-", "_")
            for spacing, length, expected in (
                (0.0195, 3, "3 units of the spacing is 153.8 voxels"),
                (0.0195, "154vx", "3.003 units of the spacing is 154 voxels"),
                (100, 3, "3 units of the spacing is 0.03 voxels"),
                (0.0195, 0.06, None),
                (100, "3vx", None),
                (1, 60, None),
            ):
                words = name.replace("min-", "minimum ").replace("max-", "maximum ")
                limit = {"min-thickness": "max-thickness", "max-thickness": "min-thickness"}.get(name)
                other = [f"--{limit}", length] if limit else []
                volumes.write_meta(self.folder / "in.mha", plate(4, 12, spacing=(spacing, spacing, 2 * spacing)))
                command = ["extract", "in.mha", "out.mha", f"--{name}", length, *other, "--dry-run"]
                found = [line for line in self.run_program(*command).warnings if f"the {words} of" in line]
                self.assertEqual(len(found), 0 if expected is None else 1, (found, code))
                if expected:
                    self.assertIn(expected, found[0])
        volumes.write_meta(self.folder / "in.mha", plate(4, 12, spacing=(2, 2, 2)))
        for distance, number in ((1.5, 1), (2, 0), (1000, 0)):
            result = self.run_program("distance", "in.mha", "v.mha", "--max-distance", distance, "--overwrite")
            self.assertEqual(len(result.warnings), number)

    def test_unused_scratch(self):
        for compressed, arguments, number in ((False, [], 1), (True, [], 0), (False, ["--mesh", "m.vtp"], 0)):
            volumes.write_meta(self.folder / "in.mha", plate(4), compressed=compressed)
            command = ["extract", "in.mha", "out.mha", "--scratch", self.folder, "--overwrite", *arguments]
            self.assertEqual(len(self.run_program(*command).warnings), number, arguments)


class WarningOfJobsTest(JobTestCase):
    def test_each_is_told_once_and_the_report_has_all(self):
        volumes.write_meta(self.folder / "in.mha", rod(6, 60))
        arguments = ["../in.mha", "out.mha", "--min-thickness", 0.25, "--report", "r.json"]
        expected = self.expect("extract", *arguments)
        codes = [warning["code"] for warning in expected["r.json"]["warnings"]]
        self.assertEqual(codes, ["unusual_min_thickness", "few_sheets"])
        told = [self.in_target("plan", *arguments[:2], "job", *arguments[2:], "--divisions", 4).stderr]
        told += [self.in_target("work", "job").stderr, self.in_target("finalize", "job").stderr]
        self.assertEqual([text.count("warning: ") for text in told], [1, 0, 1], told)
        self.assertEqual(results(self.target)["r.json"]["warnings"], expected["r.json"]["warnings"])
        self.clear_target()
        told = self.in_target("extract", *arguments, "--resume").stderr
        self.assertEqual(told.count("warning: "), 2, told)


class ExactThresholdTest(JobTestCase):
    """Whole numbers of 64 bits, most of which are no doubles."""

    def test_limits(self):
        for kind, values in {
            "uint64": [0, 2**53, 2**53 + 1, 2**53 + 2, 2**63 - 1, 2**63, 2**64 - 2, 2**64 - 1],
            "int64": [0, -(2**53) - 2, -(2**53) - 1, 2**53 + 1, 2**53 + 2, 2**63 - 2, 2**63 - 1, -(2**63)],
        }.items():
            volume = volumes.Volume((8, 8, 8), values * 64, kind=kind)
            volumes.write_meta(self.folder / "in.mha", volume)
            volumes.write_meta(self.folder / "packed.mha", volume, compressed=True)
            for limit in values[1:]:
                for option, fulfills in (("--lower", limit.__le__), ("--upper", limit.__ge__)):
                    expected = sum(map(fulfills, volume.voxels))
                    for source in ("in.mha", "packed.mha"):
                        command = ["extract", f"../{source}", "out.mha", "--thickness", 1, "--report", "r.json"]
                        self.in_target(*command, f"{option}={limit}", "--overwrite")
                        report = json.loads((self.target / "r.json").read_text())
                        self.assertEqual(report["counts"]["object_voxels"], expected, (source, option, limit))
                        self.assertEqual(report["parameters"][option[2:]], limit)

    def test_limits_of_jobs(self):
        values = [2**53, 2**53 + 1, 2**64 - 2, 2**64 - 1]
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((8, 8, 8), values * 128, kind="uint64"))
        command = ["extract", "../in.mha", "out.mha", "--thickness", 1, "--report", "r.json", "--resume"]
        self.in_target(*command, "--lower", 2**53 + 1, "--upper", 2**64 - 2)
        report = json.loads((self.target / "r.json").read_text())
        self.assertEqual(report["counts"]["object_voxels"], 256)
        self.assertEqual((report["parameters"]["lower"], report["parameters"]["upper"]), (2**53 + 1, 2**64 - 2))

    def test_limits_that_no_number_of_the_file_can_be(self):
        volumes.write_meta(self.folder / "in.mha", plate(4))
        for limit in (f"{2**53 + 1}.5", "1e", "0x10"):
            self.assert_fails(USAGE, ["--lower", limit], "extract", "in.mha", "out.mha", "--lower", limit)
        reversed_limits = ("--lower", 2**53 + 1, "--upper", 2**53)
        self.assert_fails(USAGE, [2**53 + 1, "greater"], "extract", "in.mha", "out.mha", *reversed_limits)


if __name__ == "__main__":
    unittest.main()
