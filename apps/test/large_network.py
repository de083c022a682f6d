# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Hosts of a network that wait, stop for long, or resume the same extraction."""

import os
import shutil
import signal
import sys
import time
import unittest

import network_hosts
from network_jobs import CLUSTERS, OPTIONS, OUTPUTS, NetworkTestCase
from processes import open_files_of, state_of, wait_until
from program import DONE, FAILURE

# Locks a byte of a file until it is killed.
HOLD_LOCK = """
import fcntl, signal, sys
with open(sys.argv[1], "r+b") as file:
    fcntl.lockf(file, fcntl.LOCK_EX, 1, int(sys.argv[2]))
    print("locked", flush=True)
    signal.pause()
"""


class GlusterTest(NetworkTestCase):
    """A file system with locks that all hosts see."""

    def setUp(self):
        super().setUp()
        self.network.share_by_gluster(self.shared)

    def test_one_that_waits_is_cut_off(self):
        """Who cannot be told whether another has a cluster does not take it."""
        alpha, beta, gamma = self.clients
        self.plan_on(gamma)
        holder = alpha.start(sys.executable, "-c", HOLD_LOCK, self.job / "locks", 3)
        self.assertEqual(holder.stdout.readline(), "locked\n")
        self.assertIn("\nrunning   1: 3\n", self.on(gamma, "status", "job"))
        log = self.folder / "beta.log"
        worker = self.start_on(beta, "work", "job", "--clusters", 3, "--log-file", log)
        wait_until(lambda: log.exists() and " plan " in log.read_text(), "the start")
        wait_until(lambda: self.waits_for_a_lock(network_hosts.child_of(worker.pid)), "the one that waits")
        time.sleep(1)
        beta.cut_off()
        self.assert_ends(worker, FAILURE, "cannot lock")

    @staticmethod
    def waits_for_a_lock(program):
        """Whether it sleeps, with the file of locks and its outputs open, of which it opens the thickness map last."""
        files = {os.path.basename(name) for name in open_files_of(program)}
        has_all = "locks" in files and any(name.startswith("t.") and name.endswith(".partial") for name in files)
        return has_all and state_of(program) == "S"

    def test_resumed_on_two_hosts_at_once(self):
        alpha, beta, gamma = self.clients
        command = ["extract", "../in.raw", "out.mha", *OPTIONS, *OUTPUTS, "--resume"]
        processes = [self.start_on(host, *command) for host in (alpha, beta)]
        messages = [process.communicate(timeout=100)[1] for process in processes]
        statuses = sorted(process.returncode for process in processes)
        print(statuses, messages, flush=True)
        self.assertEqual(statuses[0], DONE)
        self.assert_same_bytes_on_all()


class SftpTest(NetworkTestCase):
    """A file system without locks between hosts, with times in whole seconds."""

    def stop_before_distances(self, program, log):
        """Stops it in a cluster that has labels and no chunk of distances yet; one that was too fast goes on."""

        def labeled():
            return log.read_text().count(" piece of=labels ")

        for _ in range(CLUSTERS - 1):
            before = labeled()
            wait_until(lambda before=before: labeled() > before, "the next cluster")
            os.kill(program, signal.SIGSTOP)
            wait_until(lambda: state_of(program) == "T", "the halt")
            if labeled() > len(list(self.target.glob("d.zarr.*.partial/0/*/0/0"))):
                return
            os.kill(program, signal.SIGCONT)
        self.fail("no cluster was stopped between its labels and its distances")

    def test_late_writer_changes_nothing(self):
        self.network.share_by_sftp(self.shared)
        alpha, beta, gamma = self.clients
        # By the server itself, which knows the time of the input to the nanosecond.
        self.in_target("plan", "../in.raw", "out.mha", "job", *OPTIONS, *OUTPUTS, "--divisions", CLUSTERS)
        log = self.folder / "late.log"
        late = self.start_on(beta, "work", "job", "--log-file", log)
        wait_until(lambda: log.exists() and " plan " in log.read_text(), "the start")
        late_program = network_hosts.child_of(late.pid)
        self.stop_before_distances(late_program, log)
        self.on(alpha, "work", "job")
        self.on(gamma, "finalize", "job")
        self.assert_same_bytes_on_all()
        shutil.rmtree(self.folder / "expected")
        os.kill(late.pid, signal.SIGCONT)
        self.assert_ends(late, FAILURE, "d.zarr.", "No such file or directory")
        self.assert_same_bytes_on_all()


if __name__ == "__main__":
    unittest.main()
