# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""3D Slicer cancels a module by killing it: whenever that happens, a file under its final name is complete."""

import random
import re
import subprocess
import time
import unittest

import volumes
from program import has_begun, wait_for_begin
from slicer_module import MODULE, ModuleTestCase

KILLS = 20
SIZE = (96, 96, 64)


class KillTest(ModuleTestCase):
    def setUp(self):
        super().setUp()
        volumes.write_meta(self.folder / "in.mha", volumes.box_with_plate(size=SIZE))
        seed = random.randrange(1 << 32)
        self.random = random.Random(seed)
        print(f"seed {seed}")

    def start(self, *arguments):
        command = [MODULE, *arguments, "--objectSelection", "Label", "--labelValue", "100"]
        return subprocess.Popen([*command, "--thickness", "4"], cwd=self.folder, stdout=subprocess.DEVNULL)

    def read_outputs(self, names):
        """Contents of the outputs that there are; of a header also those of its data file, without their random name."""
        contents = {}
        for name in names:
            path = self.folder / name
            if path.exists():
                contents[name] = path.read_bytes()
                if path.suffix == ".mhd":
                    data = re.search(rb"ElementDataFile = (.*)\n", contents[name])[1]
                    contents[name] = contents[name].replace(data, b"DATA") + (self.folder / data.decode()).read_bytes()
        return contents

    def remove_outputs(self):
        for path in self.folder.iterdir():
            if path.name != "in.mha":
                path.unlink()

    def assert_complete_or_absent(self, names, *arguments):
        """Kills at moments spread over the whole run; the first name stands for all and appears last."""
        seconds = []
        for _ in range(3):
            self.remove_outputs()
            start = time.monotonic()
            self.assertEqual(self.start(*arguments).wait(), 0)
            seconds.append(time.monotonic() - start)
        complete = self.read_outputs(names)
        self.assertEqual(list(complete), names)
        unfinished = 0
        for kill in range(KILLS):
            self.remove_outputs()
            process = self.start(*arguments)
            # Moments all over the run; the first one is sure to be in the work.
            if kill:
                time.sleep(sorted(seconds)[1] * (kill + self.random.random()) / KILLS)
            else:
                wait_for_begin(process, self.folder)
            has_worked = has_begun(process, self.folder)
            process.kill()
            process.wait()
            found = self.read_outputs(names)
            for name, content in found.items():
                self.assertEqual(content, complete[name], f"{name} of kill {kill} is not complete")
            if names[0] in found:
                self.assertEqual(list(found), names, f"{names[0]} appeared before the others")
            unfinished += has_worked and names[0] not in found
            self.assert_no_leftovers(kill, names, arguments)
        self.assertGreater(unfinished, 0, "no kill hit the work")

    def assert_no_leftovers(self, kill, names, arguments):
        """A data file keeps a second name until its header has its own; the next run removes what is left of it."""
        if names[0].endswith(".mhd") and list(self.folder.glob("*.partial")):
            self.assertEqual(self.start(*arguments).wait(), 0)
        self.assertEqual(list(self.folder.glob("*.partial")), [], f"kill {kill} left a file")

    def test_one_file(self):
        self.assert_complete_or_absent(["out.mha"], "in.mha", "out.mha")

    def test_header_and_data(self):
        self.assert_complete_or_absent(["out.mhd"], "in.mha", "out.mhd")

    def test_two_outputs(self):
        self.assert_complete_or_absent(["out.mha", "d.mha"], "in.mha", "out.mha", "--distanceVolume", "d.mha")

    def test_existing_output_survives(self):
        process = self.start("in.mha", "out.mha")
        self.assertEqual(process.wait(), 0)
        complete = (self.folder / "out.mha").read_bytes()
        (self.folder / "out.mha").write_bytes(b"of an earlier run")
        process = self.start("in.mha", "out.mha")
        wait_for_begin(process, self.folder)
        process.kill()
        process.wait()
        self.assertIn((self.folder / "out.mha").read_bytes(), (b"of an earlier run", complete))


if __name__ == "__main__":
    unittest.main()
