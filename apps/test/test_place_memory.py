# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Lists of places stay in the memory that is planned, or the run is refused and leaves all files as they were."""

import json
import re

import jobs
import volumes
from program import REFUSED, ProgramTestCase

MEGABYTE = 1 << 20


def flat_wall(size=(640, 640, 40), wall=(18, 21)):
    """One wall of three voxels in the plane of the slices, so that one slice has nearly all of its cells."""
    area = size[0] * size[1]
    volume = volumes.Volume(size, [])
    volume.voxels = bytes(area * wall[0]) + b"\1" * (area * (wall[1] - wall[0])) + bytes(area * (size[2] - wall[1]))
    return volume


def islands(size=(320, 320, 160), period=8, island=(6, 6, 3)):
    """A small wall in each cube of the period, but none at the last slice."""
    row = (b"\1" * island[0] + bytes(period - island[0])) * (size[0] // period)
    piece = (row * island[1] + bytes(size[0]) * (period - island[1])) * (size[1] // period)
    layers = (bytes(len(piece)) * (period - island[2]) + piece * island[2]) * (size[2] // period)
    volume = volumes.Volume(size, [])
    volume.voxels = layers[len(piece) :] + bytes(len(piece))
    return volume


class PlaceMemoryTest(ProgramTestCase):
    def needed(self, *arguments):
        """The least limit that the program names, in MiB."""
        result = self.run_program("extract", *arguments, "--memory", "1M", status=REFUSED)
        return float(re.search(r"at least ([0-9.]+) MiB", result.stderr)[1])

    def test_the_lists_are_planned_for(self):
        volumes.write_meta(self.folder / "in.mha", islands())
        plain = self.needed("in.mha", "l.mha", "--threads", 1)
        one = self.needed("in.mha", "l.mha", "--threads", 1, "--thin-below", 4)
        both = self.needed("in.mha", "l.mha", "--threads", 1, "--thin-below", 4, "--thick-above", 8)
        self.assertGreater(one, plain + 4)
        self.assertGreater(both, one + 4)
        volumes.write_meta(self.folder / "small.mha", islands((24, 24, 24)))
        self.assertLess(self.needed("small.mha", "l.mha", "--thin-below", 4), self.needed("small.mha", "l.mha") + 2)

    def test_more_places_than_are_listed(self):
        volumes.write_meta(self.folder / "in.mha", islands())
        options = ["--thin-below", "4,,0", "--thick-above", "0.5,,0", "--overwrite"]
        options += ["--places", "p.csv", "--threads", 1, "--report", "r.json"]
        tables = []
        for memory in ("1G", f"{int(self.needed('in.mha', 'l.mha', *options)) + 12}M"):
            self.extract("in.mha", "l.mha", *options, "--memory", memory)
            report = json.loads((self.folder / "r.json").read_text())
            self.assertEqual(report["places"]["thin"]["number"], 40 * 40 * 20)
            self.assertLessEqual(report["peak_memory_bytes"], report["memory_limit_bytes"], memory)
            tables.append((self.folder / "p.csv").read_bytes())
        self.assertEqual(tables[0].count(b"\nthin,"), 10000)
        self.assertEqual(tables[0].count(b"\nthick,"), 10000)
        self.assertEqual(tables[1], tables[0])

    def test_too_many_cells_leave_all_files_as_they_were(self):
        volumes.write_meta(self.folder / "in.mha", flat_wall())
        options = ["--thin-below", 4, "--places", "p.csv", "--threads", 1, "--overwrite"]
        self.extract("in.mha", "l.mha", *options, "--memory", "1G")
        self.assertIn(b"thin,1,", (self.folder / "p.csv").read_bytes())
        memory = f"{int(self.needed('in.mha', 'l.mha', *options)) + 1}M"
        parts = ["slice 19 needs more", "thin or thick places", "--memory", "--thin-below"]
        command = ["in.mha", "l.mha", "--thickness", 3, *options, "--memory", memory]
        self.assert_fails(REFUSED, parts, "extract", *command)
        options[options.index("--thin-below") + 1] = 1
        self.extract("in.mha", "l.mha", *options, "--memory", memory)


class PlaceMemoryOfJobsTest(jobs.JobTestCase):
    def test_a_cluster_with_too_many_cells_does_not_keep_others_from_being_done(self):
        volumes.write_meta(self.folder / "in.mha", flat_wall())
        options = ["--thickness", 3, "--thin-below", 4, "--places", "p.csv", "--threads", 1]
        expected = self.expect("extract", "../in.mha", "out.mha", *options)
        plan = ["plan", "../in.mha", "out.mha", "job", *options, "--divisions", 4]
        error = self.in_target(*plan, "--memory", "1M", status=REFUSED).stderr
        memory = f"{int(float(re.search(r'at least ([0-9.]+) MiB', error)[1])) + 1}M"
        self.in_target(*plan)
        error = self.in_target("work", "job", "--memory", memory, "--threads", 1, status=REFUSED).stderr
        self.assertIn("slice 19 needs more", error)
        self.assertEqual(self.status()["done"], {"number": 3, "clusters": "0,2-3"})
        self.assert_nothing_published()
        self.in_target("work", "job", "--memory", "1G")
        self.in_target("finalize", "job")
        self.assertEqual(jobs.results(self.target), expected)

    def test_what_is_planned_can_be_done(self):
        volumes.write_meta(self.folder / "in.mha", islands())
        options = ["--thickness", 3, "--thin-below", "4,,0", "--places", "p.csv", "--threads", 1]
        plan = ["plan", "../in.mha", "out.mha", "job", *options]
        error = self.in_target(*plan, "--memory", "1M", status=REFUSED).stderr
        memory = f"{int(float(re.search(r'at least ([0-9.]+) MiB', error)[1])) + 12}M"
        self.in_target(*plan, "--memory", memory)
        self.in_target("work", "job", "--memory", memory, "--threads", 1)
        self.in_target("finalize", "job")
        self.assertEqual((self.target / "p.csv").read_bytes().count(b"\nthin,"), 10000)
