# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Jobs of hosts that share a folder over a network: one is killed, one is cut off, the disk of the server gets full."""

import shutil
import signal
import unittest

import jobs
import network_hosts
from network_jobs import CLUSTERS, OPTIONS, NetworkTestCase
from processes import wait_until
from program import DONE, FAILURE


class GlusterTest(NetworkTestCase):
    """A file system with locks that all hosts see."""

    def test_one_host_killed_and_one_cut_off(self):
        self.network.share_by_gluster(self.shared)
        alpha, beta, gamma = self.clients
        self.plan_on(alpha)
        workers = [self.start_on(host, "work", "job") for host in (alpha, beta)]
        rivals = [self.start_on(host, "work", "job", "--clusters", 13) for host in (alpha, gamma)]
        self.wait_for_markers(CLUSTERS // 5)
        network_hosts.send(workers[0], signal.SIGKILL)
        self.wait_for_markers(CLUSTERS // 5 + 2)
        beta.cut_off()
        self.on(gamma, "status", "job", messages=[f"clusters  {CLUSTERS}\n", "\nmissing   "])
        self.on(gamma, "finalize", "job", status=FAILURE, messages=["clusters are not done", "--clusters"])
        self.assert_nothing_published()
        # Waits for the lock of the one that is gone.
        print(self.on(gamma, "work", "job"), flush=True)
        # Whatever it was at: it cannot lock, read or write, or finds later that the job has ended.
        self.assert_ends(workers[1], FAILURE, "medialvoxel: ")
        rivals = sorted(self.assert_ends(rival, DONE) for rival in rivals)
        counts = ["clusters done     0\nclusters skipped  1\n", "clusters done     1\nclusters skipped  0\n"]
        self.assertIn(rivals, [counts, [counts[0], counts[0]]])
        beta.join_again()
        wait_until(lambda: beta.run("ls", self.job, check=False).returncode == 0, "the return of the host")
        self.on(beta, "work", "job", messages=[f"clusters skipped  {CLUSTERS}\n"])
        self.on(gamma, "finalize", "job")
        self.assert_same_bytes_on_all()


class SftpTest(NetworkTestCase):
    """A file system without locks between hosts, which reserves no space and tells of errors late."""

    def test_no_space_is_written_to_see_whether_it_is_there(self):
        self.network.share_by_sftp(self.shared)
        self.plan_on(self.clients[0])
        (labels,) = self.target.glob("out.mha.*.partial")
        self.assertLess(labels.stat().st_blocks * 512, labels.stat().st_size // 8)

    def test_disk_of_the_server_gets_full(self):
        """Which is told when a file is closed, and not by the calls that write."""
        self.network.server.run("mount", "-t", "tmpfs", "-o", "size=5m", "tmpfs", self.shared)
        disk = self.network.server.see(self.shared)
        self.fill(disk)
        self.network.share_by_sftp(self.shared, "-o", "dcache_timeout=1")
        filler = disk / "filler"
        filler.write_bytes(bytes(shutil.disk_usage(disk).free - (1 << 18)))
        alpha, beta, _ = self.clients
        outputs = ["../in.raw", "out.zarr", *OPTIONS, "--distance", "d.zarr"]
        # A job also writes what it knows of its clusters, which may be what finds no room.
        for command, failed in ((["extract", *outputs], "cannot write "), (["extract", *outputs, "--resume"], "cannot ")):
            self.on(alpha, *command, status=FAILURE, messages=[failed, ".zarr"])
            names = {path.name for path in (disk / "target").iterdir()}
            self.assertFalse(names & {"out.zarr", "d.zarr"}, names)
        filler.unlink()
        self.on(beta, *command)
        self.target, expected = disk / "target", self.expect("extract", *outputs)
        self.assertEqual(jobs.results(self.target), expected)


if __name__ == "__main__":
    unittest.main()
