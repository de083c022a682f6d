# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program on volumes of much empty space, and each object of it by itself to compare with."""

import json
import subprocess
import sys
import time

import sparse_volumes
import volumes
from program import PROGRAM, ProgramTestCase

UNITS = {"M": 1 << 20, "G": 1 << 30}
ALLOCATED_PER_VOLUME = 512 << 20


# A process inherits the peak of the one that starts it, so that a small interpreter does.
MEASURE = """
import os, sys
child = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ)
_, status, usage = os.wait4(child, 0)
print(usage.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status))
"""


class SparseTestCase(ProgramTestCase):
    def extract_measured(self, *arguments):
        """Seconds and largest resident memory of an extraction, as the system tells its parent."""
        start = time.monotonic()
        command = [PROGRAM, "extract", *map(str, arguments), "--thickness", "3", "--quiet"]
        measured = [sys.executable, "-c", MEASURE, *command]
        result = subprocess.run(measured, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        return time.monotonic() - start, int(result.stdout) * 1024

    def extract_objects(self, objects, size):
        """Labels of each object in a volume of its own, and the sums of their counts."""
        labels, sums = [], {}
        for thing in objects:
            volumes.write_meta(self.folder / "crop.mha", sparse_volumes.crop(thing, size))
            self.extract("crop.mha", "crop-labels.mha", "--report", "crop.json", "--overwrite")
            labels.append(volumes.read_data(self.folder / "crop-labels.mha"))
            for name, count in json.loads((self.folder / "crop.json").read_text())["counts"].items():
                sums[name] = sums.get(name, 0) + count
        return labels, sums

    def check_labels(self, path, size, objects, expected):
        """The labels around each object are those of the object alone, and all others are zero."""
        for number, (thing, labels) in enumerate(zip(objects, expected)):
            self.assertEqual(sparse_volumes.read_box(path, size, *thing.box(size)), labels, number)
        self.assertEqual(
            sparse_volumes.count_set_voxels(path, size), sum(len(labels) - labels.count(0) for labels in expected)
        )

    def check_size(self, size, memory):
        """Extracts from a headerless volume with holes; returns the seconds that the program took."""
        objects = sparse_volumes.scattered_objects(size)
        source = sparse_volumes.write_sparse(self.folder / "in.raw", size, objects)
        if sparse_volumes.allocated_bytes(source) > ALLOCATED_PER_VOLUME:
            self.skipTest("files have no holes here")
        shape = ["--raw-size", ",".join(map(str, size)), "--raw-type", "uint8"]
        outputs = ["labels.mha", "--sparse", "--report", "r.json"]
        seconds, peak = self.extract_measured("in.raw", *outputs, *shape, "--memory", memory)
        report = json.loads((self.folder / "r.json").read_text())
        print(f"{size}: {seconds:.1f} s, peak {peak / UNITS['M']:.0f} MiB of {memory}", flush=True)

        self.assertLessEqual(peak, int(memory[:-1]) * UNITS[memory[-1]])
        self.assertLessEqual(sparse_volumes.allocated_bytes(self.folder / "labels.mha"), ALLOCATED_PER_VOLUME)
        expected, counts = self.extract_objects(objects, size)
        self.assertEqual(report["counts"], counts)
        self.check_labels(self.folder / "labels.mha", size, objects, expected)
        return seconds
