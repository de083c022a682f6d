# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Cells that give the sheet the topology of the object: the same for any run, and counted from known shapes."""

import json
import math
import random
import shutil
import unittest

import jobs
import volumes
from program import FAILURE, REFUSED, USAGE, ProgramTestCase

OPTION = "--same-topology"


def shape(is_inside, size=(30, 28, 26)):
    volume = volumes.Volume(size, [])
    volume.voxels = [100 if is_inside(*(p - (n - 1) / 2 for p, n in zip(index, size))) else 0 for index in volume.indices()]
    return volume


def noisy_parts(size=(37, 33, 41), seed=5):
    """A thick ball, tilted plates that cross, a rod, and a share of flipped voxels beside the object's border."""
    draw = random.Random(seed)
    volume = shape(
        lambda x, y, z: math.dist((x, y, z), (-8, -6, 9)) < 9
        or abs(0.3 * x + 0.2 * y + 0.93 * z + 4) < 1.7
        or abs(0.8 * x - 0.6 * y) < 2.2 and z < 2
        or math.hypot(x - 10, y - 8) < 3,
        size,
    )
    volume.voxels = [100 - value if draw.random() < 0.02 else value for value in volume.voxels]
    volume.spacing = (0.7, 0.7, 0.7)
    return volume


# Parts, tunnels and cavities.
SHAPES = {
    "ball": (shape(lambda x, y, z: math.hypot(x, y, z) < 9), (1, 0, 0)),
    "shell": (shape(lambda x, y, z: 6 < math.hypot(x, y, z) < 10), (1, 0, 1)),
    "ring": (shape(lambda x, y, z: math.hypot(math.hypot(x, y) - 9, z) < 3.5), (1, 1, 0)),
    "tube that a plane closes": (
        shape(lambda x, y, z: 5 < math.hypot(x, y) < 9 and abs(z) < 9 or math.hypot(x, y) < 9 and abs(z) < 2),
        (1, 0, 0),
    ),
    "two rods": (shape(lambda x, y, z: math.hypot(abs(x) - 7, y) < 2.5 and abs(z) < 10), (2, 0, 0)),
    "plate with holes": (
        shape(lambda x, y, z: abs(z) < 2 and max(abs(x), abs(y)) < 11 and math.hypot(abs(x) - 5, y) > 3),
        (1, 2, 0),
    ),
    "nothing": (shape(lambda x, y, z: False), (0, 0, 0)),
}


class SameTopologyTest(ProgramTestCase):
    def labels(self, *arguments, output="out.mha"):
        self.run_program("extract", "in.mha", output, *arguments, "--report", "r.json", "--overwrite", "--quiet")
        self.report = json.loads((self.folder / "r.json").read_text())
        return volumes.read_data(self.folder / output) if output.endswith((".mha", ".nrrd")) else b""

    def check(self, labels, *arguments):
        """Labels 2 and 3 stay, label 4 is counted, and both sets have the same numbers. Returns these."""
        without = self.labels(*arguments)
        self.assertNotIn("topology", self.report)
        self.assertFalse(self.report["parameters"]["same_topology"])
        self.assertEqual(without, bytes(1 if label == 4 else label for label in labels))
        self.labels(*arguments, OPTION)
        topology = self.report["topology"]
        self.assertTrue(self.report["parameters"]["same_topology"])
        self.assertEqual(topology["added_cells"], labels.count(4))
        self.assertEqual(topology["sheet"], topology["object"])
        return tuple(topology["object"].values())

    def test_known_shapes(self):
        for name, (volume, expected) in SHAPES.items():
            volumes.write_meta(self.folder / "in.mha", volume)
            for options in ((), ("--thickness", 3), ("--thickness", 7, "--max-pore-size", 4)):
                self.assertEqual(self.check(self.labels(*options, OPTION), *options), expected, (name, options))

    def test_runs_give_the_same_bytes(self):
        volumes.write_meta(self.folder / "in.mha", noisy_parts())
        added = 0
        for options in (
            ("--lower", 50),
            ("--lower", 50, "--thickness", 2.1),
            ("--lower", 50, "--thickness", 2.1, "--max-pore-size", 6),
            ("--lower", 50, "--smooth", "on", "--thickness-map", "t.mha"),
        ):
            expected = self.labels(*options, OPTION)
            self.check(expected, *options)
            added += expected.count(4)
            numbers = self.report["topology"]
            for run in (
                ("--divisions", 7),
                ("--divisions", 41, "--threads", 1),
                ("--threads", 3, "--memory", "64M"),
                ("--sparse",),
                ("--scratch", "."),
                ("--preview", "p.png", "--html", "p.html", "--mesh", "m.ply"),
            ):
                self.assertEqual(self.labels(*options, *run, OPTION), expected, (options, run))
                self.assertEqual(self.report["topology"], numbers, (options, run))
        self.assertGreater(added, 100)

    def test_storages(self):
        """Packed labels come back as an input with the same cells."""
        volumes.write_meta(self.folder / "in.mha", noisy_parts())
        expected = self.labels("--lower", 50, OPTION)
        for output, options in (
            ("o.nrrd", ()), ("o.mha", ("--compress",)), ("o.nii.gz", ()), ("o.zarr", ()), ("o.nhdr", ()),
        ):  # fmt: skip
            self.labels("--lower", 50, OPTION, *options, output=output)
            self.run_program("extract", output, "v.mha", "--label", 4, "--thickness", 3, "--report", "d.json", "--overwrite", "--quiet")
            self.assertEqual(json.loads((self.folder / "d.json").read_text())["counts"]["object_voxels"], expected.count(4))
        left = {path.name for path in self.folder.iterdir()} - {"in.mha", "out.mha", "r.json", "v.mha", "d.json", "o.raw"}
        self.assertEqual(left, {"o.nrrd", "o.mha", "o.nii.gz", "o.zarr", "o.nhdr"})

    def test_flat_volumes(self):
        """In an image of two axes, a ring keeps its hole."""
        for size in ((31, 29), (31, 29, 1)):
            ring = volumes.Volume(size, [])
            ring.voxels = [100 if 6 < math.hypot(index[0] - 15, index[1] - 14) < 11 else 0 for index in ring.indices()]
            volumes.write_meta(self.folder / "in.mha", ring)
            self.assertEqual(self.check(self.labels(OPTION)), (1, 1, 0), size)

    def test_no_background(self):
        """Nothing has a distance, so that no cell can be chosen."""
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((9, 8, 7), [1] * 504))
        self.assertEqual(set(self.labels(OPTION)), {0, 1})
        self.assertEqual(self.report["topology"]["added_cells"], 0)
        self.assertEqual(self.report["topology"]["object"], {"parts": 1, "tunnels": 0, "cavities": 0})
        self.assertEqual(self.report["topology"]["sheet"], {"parts": 0, "tunnels": 0, "cavities": 0})

    def test_terminal_has_a_line(self):
        volumes.write_meta(self.folder / "in.mha", SHAPES["ring"][0])
        printed = self.run_program("extract", "in.mha", "out.mha", OPTION).stdout
        self.assertRegex(printed, r"topology +\d+ cells added; parts 1, tunnels 1, cavities 0\n")
        self.assertNotIn("topology", self.run_program("extract", "in.mha", "out.mha", "--overwrite").stdout)

    def test_errors(self):
        volumes.write_meta(self.folder / "in.mha", SHAPES["ball"][0])
        extract = ("extract", "in.mha", "o.mha", OPTION)
        self.assert_fails(USAGE, [OPTION, "OUTPUT"], "extract", "in.mha", OPTION, "--report", "r.json")

    def test_planned_memory(self):
        """The end of the run is in the plan: walls of 16 voxels keep within it, and less is refused before the run."""
        slices = (bytes([100 if 2 <= z % 20 < 18 else 0]) * 160000 for z in range(80))
        (self.folder / "in.raw").write_bytes(b"".join(slices))
        raw = ("--raw-size", "400,400,80", "--raw-type", "uint8", "--lower", 50, "--thickness", 3, "--threads", 1)
        extract = ("extract", "in.raw", "o.mha", *raw)
        least = self.find_least_memory(*extract, OPTION)
        self.assertGreater(least, self.find_least_memory(*extract) + (1 << 20))
        self.run_program(*extract, OPTION, "--memory", least, "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertLessEqual(report["peak_memory_bytes"], report["planned_peak_bytes"])
        self.assertLessEqual(report["planned_peak_bytes"], least)
        (self.folder / "o.mha").unlink()
        self.assert_fails(REFUSED, ["needs at least"], *extract, OPTION, "--memory", least - (1 << 17))
        self.assertFalse((self.folder / "o.mha").exists())

    def test_lack_of_memory(self):
        """A thick part holds more slices than a wall, which the plan cannot know."""
        (self.folder / "in.raw").write_bytes((bytes(1) + bytes([100]) * 239) * (240 * 200))
        raw = ("--raw-size", "240,240,200", "--raw-type", "uint8", "--lower", 50, "--thickness", 3, "--threads", 1)
        extract = ("extract", "in.raw", "o.mha", OPTION, *raw)
        least = self.find_least_memory(*extract)
        self.assert_fails(REFUSED, ["topology of the object", "--memory"], *extract, "--memory", least + (8 << 20))


def put_in_map(parts, size=(44, 40, 38)):
    """Shapes of SHAPES at offsets, with labels; later ones lie over earlier ones."""
    scene = volumes.Volume(size, [0] * math.prod(size))
    for label, name, offset in parts:
        volume = SHAPES[name][0]
        for (x, y, z), value in zip(volume.indices(), volume.voxels):
            if value:
                scene.voxels[x + offset[0] + size[0] * (y + offset[1] + size[1] * (z + offset[2]))] = label
    return scene


class LabelMapTopologyTest(ProgramTestCase):
    """Each object of a label map keeps its own topology. test_label_maps compares random maps with runs for one label."""

    def extract_objects(self, *options):
        self.run_program(
            "extract", "in.mha", "out.mha", "--labels", "all", "--objects", "objects.mha", "--report", "r.json", "--overwrite",
            "--quiet", OPTION, *options,
        )  # fmt: skip
        self.report = json.loads((self.folder / "r.json").read_text())
        return volumes.read_data(self.folder / "out.mha"), volumes.read_data(self.folder / "objects.mha")

    def test_objects_that_touch_and_lie_within_others(self):
        """A ball in a shell, a ring around a rod: numbers of the objects alone are added."""
        scene = put_in_map([(3, "shell", (0, 0, 0)), (9, "ring", (13, 8, 12)), (5, "two rods", (6, 5, 2))])
        for i, index in enumerate(scene.indices()):
            scene.voxels[i] = 120 if math.dist(index, (14.5, 13.5, 12.5)) < 5 else scene.voxels[i]
        volumes.write_meta(self.folder / "in.mha", scene)
        for options in (("--thickness", 3), ("--thickness", "auto", "--max-pore-size", 5)):
            found = self.extract_objects(*options)
            sums, added = dict.fromkeys(("parts", "tunnels", "cavities"), 0), {}
            for label in (3, 5, 9, 120):
                self.run_program(
                    "extract", "in.mha", "one.mha", "--label", label, "--report", "one.json", "--smooth", "off", "--overwrite",
                    "--quiet", OPTION, *options,
                )  # fmt: skip
                alone = json.loads((self.folder / "one.json").read_text())["topology"]
                self.assertEqual(alone["object"], alone["sheet"])
                sums = {name: value + alone["object"][name] for name, value in sums.items()}
                added[label] = alone["added_cells"]
            self.assertEqual(self.report["topology"]["object"], sums)
            self.assertEqual(self.report["topology"]["sheet"], sums)
            self.assertEqual({row["label"]: row["added_cells"] for row in self.report["objects"]}, added)
            self.assertGreater(sum(added.values()), 20)
            expected = self.report
            for run in (("--divisions", 5), ("--divisions", 38, "--threads", 1), ("--threads", 3, "--memory", "64M"), ("--scratch", "."), ("--sparse",)):
                self.assertEqual(self.extract_objects(*options, *run), found, run)
                for name in ("topology", "objects", "shared_cells"):
                    self.assertEqual(self.report[name], expected[name], (name, run))
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"in.mha", "out.mha", "objects.mha", "r.json", "one.mha", "one.json"})

    def test_cells_of_two_sheets(self):
        """A cell between plates of one voxel that is medial for both, or added for one, counts as shared, once."""
        scene = volumes.Volume((20, 16, 12), [])
        scene.voxels = [{5: 2, 6: 7}.get(z, 0) if 2 <= x < 18 and 2 <= y < 14 else 0 for x, y, z in scene.indices()]
        volumes.write_meta(self.folder / "in.mha", scene)
        labels, objects = self.extract_objects("--thickness", 3)
        shared = self.report["shared_cells"]
        self.assertEqual(self.report["topology"]["sheet"], {"parts": 2, "tunnels": 0, "cavities": 0})
        self.assertEqual(sum(row["medial_cells"] + row["added_cells"] for row in self.report["objects"]), shared + sum(label > 1 for label in labels))

    def test_storages(self):
        """Packed labels and objects have the same cells."""
        volumes.write_meta(self.folder / "in.mha", put_in_map([(3, "ring", (0, 0, 0)), (5, "ball", (9, 6, 8))]))
        labels, objects = self.extract_objects()
        self.assertIn(4, labels)
        for extension in ("nrrd", "seg.nrrd", "nii.gz", "zarr"):
            names = f"o.{extension.replace('seg.', '')}", f"b.{extension}"
            run = ("--labels", "all", OPTION, "--objects", names[1], "--report", "r.json", "--overwrite", "--quiet")
            self.run_program("extract", "in.mha", names[0], *run)
            self.assertEqual(json.loads((self.folder / "r.json").read_text())["topology"], self.report["topology"])
            counted = []
            for name, value in ((names[0], 4), (names[1], 5)):
                self.run_program("extract", name, "v.mha", "--label", value, "--thickness", 3, "--report", "d.json", "--overwrite", "--quiet")
                counted.append(json.loads((self.folder / "d.json").read_text())["counts"]["object_voxels"])
            self.assertEqual(counted, [labels.count(4), objects.count(5)], extension)

    def test_flat_map(self):
        """In an image of two axes, two rings keep their holes."""
        for size in ((40, 29), (40, 29, 1)):
            scene = volumes.Volume(size, [])
            scene.voxels = [
                1 if 6 < math.hypot(x - 13, y - 14) < 11 else 2 if 4 < math.hypot(x - 30, y - 14) < 8 else 0
                for x, y, *_ in scene.indices()
            ]
            volumes.write_meta(self.folder / "in.mha", scene)
            found = self.extract_objects()
            self.assertEqual(self.report["topology"]["sheet"], {"parts": 2, "tunnels": 2, "cavities": 0})
            self.assertEqual(self.extract_objects("--divisions", 4), found)

    def test_errors(self):
        volumes.write_meta(self.folder / "in.mha", SHAPES["ball"][0])
        run = ("in.mha", "out.mha", "--labels", "all", OPTION)
        self.assert_fails(REFUSED, ["labels of several objects"], "plan", *run[:2], "job", *run[2:])
        self.assert_fails(REFUSED, ["scratch folder"], "extract", *run, "--scratch", "none")


class SameTopologyJobTest(jobs.JobTestCase):
    """Clusters fill a volume of cells, which the end of the job reads and removes."""

    OPTIONS = ("--lower", 50, "--preview", "p.png", "--places", "c.csv", "--thin-below", 2, "--report", "r.json", OPTION)

    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", noisy_parts())

    def test_clusters_of_several_processes(self):
        for output in ("out.mha", "out.nhdr", "out.zarr"):
            expected = self.expect("extract", "../in.mha", output, *self.OPTIONS)
            self.assertGreater(expected["r.json"]["topology"]["added_cells"], 0)
            self.in_target("plan", "../in.mha", output, "job", *self.OPTIONS, "--divisions", 3)
            for cluster in (2, 0, 1):
                self.in_target("work", "job", "--clusters", cluster, "--threads", 1 + cluster, "--scratch", "..")
            self.in_target("finalize", "job")
            self.assertEqual(jobs.results(self.target), expected, output)
            self.clear_target()
            self.in_target("extract", "../in.mha", output, *self.OPTIONS, "--resume")
            self.assertEqual(jobs.results(self.target), expected, output)
            self.clear_target()
            shutil.rmtree(self.folder / "expected")

    def test_damaged_cells(self):
        """The end finds them before it uses them, and names the cluster that is to be done again."""
        expected = self.expect("extract", "../in.mha", "out.mha", *self.OPTIONS)
        self.in_target("plan", "../in.mha", "out.mha", "job", *self.OPTIONS, "--divisions", 3)
        self.in_target("work", "job")
        (cells,) = self.target.glob("out.mha.cells.mha.*.partial")
        content = bytearray(cells.read_bytes())
        content[-1] ^= 1
        cells.write_bytes(content)
        self.assertIn("checksums that they were written with: 2;", self.in_target("finalize", "job", status=FAILURE).stderr)
        self.in_target("work", "job", "--clusters", 2)
        self.in_target("finalize", "job")
        self.assertEqual(jobs.results(self.target), expected)

    def test_plan_that_is_given_up(self):
        """Its volume of cells goes when the folder is planned anew."""
        self.in_target("plan", "../in.mha", "out.mha", "job", *self.OPTIONS)
        (self.job / "manifest.json").rename(self.job / "planned.json")
        self.in_target("plan", "../in.mha", "out.mha", "job", *self.OPTIONS)
        self.assertEqual(len(list(self.target.glob("out.mha.cells.mha.*.partial"))), 1)


if __name__ == "__main__":
    unittest.main()
