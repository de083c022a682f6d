# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What tests share whose jobs are done by hosts of a network."""

import random
import shutil
import unittest

import jobs
import network_hosts
from jobs import JobTestCase
from processes import PATIENCE, wait_until
from program import DONE, PROGRAM

SIZE = (48, 48, 640)
CLUSTERS = 20
OPTIONS = ["--raw-size", "48,48,640", "--raw-type", "uint8", "--upper", 0, "--thickness", 3, "--threads", 1]
OUTPUTS = ["--report", "r.json", "--preview", "p.png", "--distance", "d.zarr", "--thickness-map", "t.mhd"]


@unittest.skipIf(network_hosts.why_not(), network_hosts.why_not())
class NetworkTestCase(JobTestCase):
    """Hosts see the folder of the outputs, and the input beside it, as the server has them."""

    def setUp(self):
        super().setUp()
        noise = random.Random(11)
        with open(self.folder / "in.raw", "wb") as file:
            file.truncate(SIZE[0] * SIZE[1] * SIZE[2])
            for _ in range(100):
                file.seek(noise.randrange(SIZE[0] * SIZE[1] * SIZE[2]))
                file.write(b"\1")
        self.network = network_hosts.Network("alpha", "beta", "gamma")
        self.addCleanup(self.network.stop)
        self.clients = self.network.clients
        self.shared = self.folder / "shared"
        self.target = self.shared / "target"
        self.job = self.target / "job"
        self.fill(self.shared)

    def fill(self, shared):
        """Puts into the folder of the server what the hosts are to see."""
        (shared / "target").mkdir(parents=True)
        shutil.copy(self.folder / "in.raw", shared / "in.raw")

    def start_on(self, host, *arguments):
        return host.start(PROGRAM, *arguments, cwd=self.target)

    def assert_ends(self, process, status, *messages):
        out, error = process.communicate(timeout=100 * PATIENCE)
        self.assertEqual(process.returncode, status, out + error)
        for message in messages:
            self.assertIn(message, out + error)
        return out

    def on(self, host, *arguments, status=DONE, messages=()):
        return self.assert_ends(self.start_on(host, *arguments), status, *messages)

    def plan_on(self, host, *options):
        self.on(host, "plan", "../in.raw", "out.mha", "job", *OPTIONS, *OUTPUTS, "--divisions", CLUSTERS, *options)

    def wait_for_markers(self, number):
        markers = self.job / "clusters"
        wait_until(lambda: len(list(markers.glob("*.json"))) >= number, f"{number} clusters")

    def assert_same_bytes_on_all(self):
        """As one run on the disk of this machine makes, and nothing else."""
        expected = self.expect("extract", "../in.raw", "out.mha", *OPTIONS, *OUTPUTS)
        for host in self.clients:
            found = jobs.results(host.see(self.target))
            self.assertEqual(sorted(found), sorted(expected), host.name)
            self.assertFalse([name for name in found if found[name] != expected[name]], host.name)
        self.assertFalse([path.name for path in self.target.rglob("*.partial*") if self.job not in path.parents])
