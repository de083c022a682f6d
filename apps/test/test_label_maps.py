# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Label maps with several objects: the result is that of runs with one label at a time, put together.

MEDIALVOXEL_LABEL_MAPS is the number of random maps; default 24.
"""

import array
import itertools
import json
import os
import random
import unittest

import volumes
from program import CORRUPT, REFUSED, USAGE, ProgramTestCase

NUMBER_OF_MAPS = int(os.environ.get("MEDIALVOXEL_LABEL_MAPS", 24))


def make_boxes(dice, size, labels):
    """Full and hollow boxes, later ones over earlier ones."""
    boxes = []
    for _ in range(dice.randint(2, 9)):
        lower = [dice.randint(-2, n - 1) for n in size]
        extent = [dice.randint(1, max(2, n)) for n in size]
        boxes.append((lower, [a + b for a, b in zip(lower, extent)], dice.choice([0, 0, 1, 2, 3]), dice.choice([0, *labels])))

    def value(index):
        found = 0
        for lower, upper, wall, label in boxes:
            depth = min(min(c - a, b - 1 - c) for c, a, b in zip(index, lower, upper))
            if depth >= 0 and (wall == 0 or depth < wall):
                found = label
        return found

    return value


def make_cells(dice, size, labels):
    """Cells of random points, with walls of background between them, of any thickness from none."""
    points = [([dice.uniform(0, n) for n in size], dice.choice(labels)) for _ in range(dice.randint(2, 12))]
    gap = dice.choice([0, 1, 2, 3, 4.5, 6])

    def value(index):
        near = sorted((sum((c - p) ** 2 for c, p in zip(index, point)) ** 0.5, label) for point, label in points)
        return 0 if near[1][0] - near[0][0] < gap else near[0][1]

    return value


def make_noise(dice, size, labels):
    share = dice.choice([0.02, 0.1, 0.5])
    return lambda index: dice.choice(labels) if dice.random() < share else 0


def make_map(dice):
    dimension = dice.choice([2, 3, 3, 3])
    size = [dice.choice([1, 7, 13, 21, 33] if dimension == 3 else [1, 20, 45]) for _ in range(dimension)]
    size[0] = max(size[0], 2)
    kind = dice.choice(["uint8", "uint16", "int16", "int32", "float32", "uint64"])
    labels = dice.sample([1, 2, 3, 5, 77, 120] if kind == "uint8" else [1, 2, 3, 5, 77, 120, 30000], dice.randint(2, 5))
    spacing = dice.choice([None, [1.0, 0.7, 2.5][:dimension]])
    volume = volumes.Volume(size, [], spacing, kind)
    value = dice.choice([make_boxes, make_cells, make_cells, make_noise])(dice, size, labels)
    volume.voxels = [value(index) for index in volume.indices()]
    if not any(volume.voxels):
        volume.voxels[0] = labels[0]
    return volume


def read_values(path, kind):
    values = array.array(volumes.TYPES[kind][0])
    values.frombytes(volumes.read_data(path))
    return values


def put_together(single):
    """Labels, objects, thickness and the number of shared cells of runs with one label each."""
    count = len(next(iter(single.values()))["labels"])
    labels, objects, thickness, shared = bytearray(count), [0] * count, [0.0] * count, 0
    for cell in range(count):
        found = [(label, run["labels"][cell]) for label, run in sorted(single.items()) if run["labels"][cell]]
        medial = [pair for pair in found if pair[1] in (2, 3)]
        added = [pair for pair in found if pair[1] == 4]
        shared += len(medial + added) > 1
        if found:
            objects[cell], labels[cell] = (medial or added or found)[0]
            thickness[cell] = single[objects[cell]]["thickness"][cell]
    return labels, objects, thickness, shared


class LabelMapTest(ProgramTestCase):
    def run_labels(self, name, *options, kind="uint8", thickness="auto"):
        """Outputs of a run for all labels."""
        self.extract(
            name, "all.mha", "--labels", "all", "--objects", "objects.mha", "--thickness-map", "walls.mha",
            "--report", "all.json", "--overwrite", *options, thickness=thickness,
        )  # fmt: skip
        return {
            "labels": volumes.read_data(self.folder / "all.mha"),
            "objects": read_values(self.folder / "objects.mha", kind),
            "thickness": volumes.read_floats(self.folder / "walls.mha"),
            "report": json.loads((self.folder / "all.json").read_text(encoding="utf-8")),
        }

    def run_label(self, name, label, *options, thickness="auto"):
        self.extract(
            name, "one.mha", "--label", label, "--thickness-map", "wall.mha", "--report", "one.json", "--overwrite",
            "--smooth", "off", *options, thickness=thickness,
        )  # fmt: skip
        return {
            "labels": volumes.read_data(self.folder / "one.mha"),
            "thickness": volumes.read_floats(self.folder / "wall.mha"),
            "report": json.loads((self.folder / "one.json").read_text(encoding="utf-8")),
        }

    def check_report(self, report, volume, single):
        self.assertEqual([row["label"] for row in report["objects"]], sorted(single))
        for row in report["objects"]:
            alone = single[row["label"]]["report"]
            self.assertEqual(row["voxels"], volume.voxels.count(row["label"]))
            self.assertEqual(row["candidate_cells"], alone["counts"]["candidate_cells"])
            self.assertEqual(row["medial_cells"], alone["counts"]["medial_cells"])
            # Objects have no place of the thinnest wall.
            thickness = {name: value for name, value in alone["thickness"].items() if name != "thinnest"}
            self.assertEqual(row["thickness"], thickness)
            self.assertEqual(row.get("added_cells"), alone.get("topology", {}).get("added_cells"))
        for name in ("candidate_cells", "medial_cells", "boundary_voxels"):
            self.assertEqual(report["counts"][name], sum(run["report"]["counts"][name] for run in single.values()))
        if "topology" in report:
            alone = [run["report"]["topology"] for run in single.values()]
            self.assertEqual(report["topology"]["added_cells"], sum(topology["added_cells"] for topology in alone))
            for kind, number in itertools.product(("object", "sheet"), ("parts", "tunnels", "cavities")):
                self.assertEqual(report["topology"][kind][number], sum(topology[kind][number] for topology in alone))

    def check_map(self, volume, dice):
        labels = sorted({int(v) for v in volume.voxels} - {0})
        name = volumes.write_meta(self.folder / "map.mha", volume, compressed=dice.random() < 0.3).name
        thickness = dice.choice(["auto", "auto", 3, 6])
        options = dice.choice([(), (), ("--max-pore-size", 0), ("--max-pore-size", 300)])
        options += dice.choice([(), ("--same-topology",)])
        run = dice.choice([(), ("--threads", 1), ("--divisions", 3), ("--memory", "64M")])
        found = self.run_labels(name, *options, *run, kind=volume.kind, thickness=thickness)
        single = {label: self.run_label(name, label, *options, thickness=thickness) for label in labels}
        wanted, objects, walls, shared = put_together(single)
        what = f"{volume.size} {volume.kind} {volume.spacing} {labels} {thickness} {options} {run}"
        self.assertEqual(found["labels"], wanted, what)
        self.assertEqual(list(found["objects"]), objects, what)
        self.assertEqual(list(found["thickness"]), list(walls), what)
        self.assertEqual(found["report"]["shared_cells"], shared, what)
        self.check_report(found["report"], volume, single)
        return found["report"]["passes"], len(labels)

    def test_random_maps(self):
        joined = 0
        for seed in range(NUMBER_OF_MAPS):
            with self.subTest(seed=seed):
                dice = random.Random(seed)
                passes, labels = self.check_map(make_map(dice), dice)
                joined += passes < labels
        self.assertGreater(joined, NUMBER_OF_MAPS // 20, "maps whose objects share a pass")

    def test_chosen_labels(self):
        volume = volumes.Volume((20, 9, 9), [])
        volume.voxels = [1 + x // 5 for x, _, _ in volume.indices()]
        volumes.write_meta(self.folder / "map.mha", volume)
        self.extract("map.mha", "out.mha", "--labels", "3,1,3", "--objects", "objects.mha", "--report", "r.json")
        report = json.loads((self.folder / "r.json").read_text(encoding="utf-8"))
        self.assertEqual(report["parameters"]["labels"], [1, 3])
        self.assertEqual([row["label"] for row in report["objects"]], [1, 3])
        self.assertEqual(set(read_values(self.folder / "objects.mha", "uint8")), {0, 1, 3})

    def info(self, name):
        """What info --labels tells of the objects, by name."""
        lines = self.run_program("info", name, "--labels").stdout.splitlines()
        return {line[:10].strip(): line[10:] for line in lines}

    def test_info(self):
        for seed in range(12):
            dice = random.Random(seed)
            volume = make_map(dice)
            for compressed in (False, True):
                volumes.write_meta(self.folder / "map.mha", volume, compressed=compressed)
                info = self.info("map.mha")
                self.extract("map.mha", "o.mha", "--labels", "all", "--report", "r.json", "--overwrite", thickness="auto")
                report = json.loads((self.folder / "r.json").read_text(encoding="utf-8"))
                labels = [row["label"] for row in report["objects"]]
                self.assertEqual(info["objects"], f"{len(labels)}, labels {labels[0]} to {labels[-1]}")
                self.assertEqual(info["passes"], f"{report['passes']} for extract --labels all")
                smallest = min(report["objects"], key=lambda row: row["voxels"])
                self.assertEqual(info["smallest"], f"{smallest['voxels']} voxels (label {smallest['label']})")
                largest = max(report["objects"], key=lambda row: row["voxels"])
                self.assertEqual(info["largest"], f"{largest['voxels']} voxels (label {largest['label']})")
                again = f"streamed, each part {report['passes'] + 1} times"
                self.assertTrue(info["labels"].startswith("unpacked once" if compressed else again), info["labels"])

    def test_info_of_other_values(self):
        volume = volumes.box_with_plate(kind="float32")
        volume.voxels[17] = 2.5
        volumes.write_meta(self.folder / "map.mha", volume)
        self.assert_fails(CORRUPT, ["map.mha", "2.5", "whole"], "info", "map.mha", "--labels")

    def test_memory_of_many_objects(self):
        """The number of objects is known after the plan, which then counts them, or the run is refused."""
        volume = volumes.Volume((90, 90, 9), [], kind="uint16")
        volume.voxels = [1 + x // 3 + 30 * (y // 3) for x, y, _ in volume.indices()]
        volumes.write_meta(self.folder / "map.mha", volume)
        run = ("map.mha", "o.mha", "--labels", "all", "--threads", 1, "--report", "r.json", "--overwrite")
        self.extract(*run)
        report = json.loads((self.folder / "r.json").read_text(encoding="utf-8"))
        self.assertEqual(len(report["objects"]), 900)
        self.assertLessEqual(report["peak_memory_bytes"], report["planned_peak_bytes"])
        self.assertGreater(report["planned_peak_bytes"], 836 * 32768)
        limit = f"{report['planned_peak_bytes'] // 1024 - 1024}K"
        parts = ["map.mha", "--memory", "fewer objects"]
        self.assert_fails(REFUSED, parts, "extract", *run, "--memory", limit, "--thickness", 3)

    def test_refusals(self):
        volumes.write_meta(self.folder / "map.mha", volumes.box_with_plate())
        run = ("extract", "map.mha", "out.mha", "--labels")
        self.assert_fails(USAGE, ["labels", "'x'", "names"], *run, "1,x")
        self.assert_fails(USAGE, ["--labels", "'0'"], *run, "0")
        self.assert_fails(USAGE, ["--labels", "'1,,2'"], *run, "1,,2")
        self.assert_fails(USAGE, ["map.mha", "label 5"], *run, "100,5")
        for options, part in (
            (("--lower", 7), "threshold"),
            (("--label", 7), "a label"),
            (("--vectors", "v.mha"), "vectors"),
            (("--distance", "d.mha"), "--label"),
        ):
            self.assert_fails(USAGE, [part], *run, "all", *options)
        self.assert_fails(USAGE, ["--objects", "--labels"], "extract", "map.mha", "out.mha", "--objects", "o.mha")
        self.assert_fails(REFUSED, ["labels of several objects"], *run, "all", "--resume")

    def test_bad_values(self):
        volume = volumes.box_with_plate(kind="float32")
        volume.voxels[17] = 2.5
        for compressed in (False, True):
            volumes.write_meta(self.folder / "map.mha", volume, compressed=compressed)
            self.assert_fails(CORRUPT, ["map.mha", "2.5", "whole"], "extract", "map.mha", "out.mha", "--labels", "all")
        empty = volumes.Volume((5, 5, 5), [0] * 125)
        volumes.write_meta(self.folder / "map.mha", empty)
        self.assert_fails(USAGE, ["map.mha", "no object"], "extract", "map.mha", "out.mha", "--labels", "all")
        many = volumes.Volume((300, 300, 1), range(90000), kind="int32")
        volumes.write_meta(self.folder / "map.mha", many)
        self.assert_fails(CORRUPT, ["map.mha", "65535"], "extract", "map.mha", "out.mha", "--labels", "all", "--max-pore-size", 0)


class GrayScanTest(ProgramTestCase):
    """A scan that is taken for a label map ends at once: its objects would take a pass each."""

    def refuse(self, volume):
        volumes.write_meta(self.folder / "in.mha", volume)
        volumes.write_nrrd(self.folder / "in.nrrd", volume, compressed=True)
        for name in ("in.mha", "in.nrrd"):
            parts = [name, "more than 128 of its values lie side by side", "gray scan", "threshold"]
            self.assert_fails(CORRUPT, parts, "info", name, "--labels", timeout=120)
            self.assert_fails(CORRUPT, parts, "extract", name, "out.mha", "--labels", "all", timeout=120)

    def test_noise(self):
        dice = random.Random(4)
        size = (40, 40, 40)
        self.refuse(volumes.Volume(size, [dice.randrange(65536) for _ in range(40**3)], kind="uint16"))

    def test_smooth_values(self):
        """Nowhere more than some dozens of values, but each beside many others somewhere."""
        dice = random.Random(5)
        values = [min(max(int(z * 6.4 + dice.gauss(0, 60)), 0), 255) for z in range(40) for _ in range(40 * 40)]
        self.refuse(volumes.Volume((40, 40, 40), values, kind="uint8"))

    def test_many_small_objects_are_a_label_map(self):
        volume = volumes.Volume((24, 24, 24), [], kind="uint16")
        volume.voxels = [1 + x // 2 + 12 * (y // 2 + 12 * (z // 2)) for x, y, z in volume.indices()]
        volumes.write_meta(self.folder / "in.mha", volume)
        self.assertRegex(self.run_program("info", "in.mha", "--labels").stdout, "objects +1728,.*\n(.*\n)*passes +[67][0-9] ")

    def test_value_that_is_no_label(self):
        volumes.write_meta(self.folder / "in.mha", volumes.Volume((3, 3, 3), [0] * 26 + [2**64 - 1], kind="uint64"))
        parts = [f"a voxel has the value {2**64 - 1};"]
        self.assert_fails(CORRUPT, parts, "extract", "in.mha", "out.mha", "--labels", "all")

    def test_labels_that_resampling_loses(self):
        volume = volumes.Volume((6, 6, 6), [0] * 36 + [5] * 36 + [0] * 144)
        volumes.write_meta(self.folder / "in.mha", volume)
        for labels, words in (("all", "all voxels are 0"), ("5", "no voxel has the label 5")):
            parts = [words, "when it is resampled to 1 x 1 x 1 voxels"]
            self.assert_fails(USAGE, parts, "extract", "in.mha", "out.mha", "--labels", labels, "--resample", "1e5")
        warnings = self.run_program("extract", "in.mha", "out.mha", "--resample", "1e5").warnings
        self.assertTrue(any("no object when it is resampled to 1 x 1 x 1" in warning for warning in warnings), warnings)


if __name__ == "__main__":
    unittest.main()
