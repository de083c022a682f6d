# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Processes that are stopped by a signal: when they are at work, and how soon they end."""

import os
import pathlib
import signal
import time

from program import wait_until

TICKS = os.sysconf("SC_CLK_TCK")

# A shell that runs the tests in the background leaves the signal ignored, for them and what they start.
signal.signal(signal.SIGINT, signal.default_int_handler)


def stat_of(process):
    """What the system tells of a process, from its state on; its number, or that of a thread."""
    return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()


def state_of(process):
    """One letter: R runs, S sleeps, T is halted, Z has ended."""
    return stat_of(process)[0]


def processor_seconds(process):
    user, system = stat_of(process)[11:13]
    return (int(user) + int(system)) / TICKS


def wait_for_work(process, seconds):
    """Waits until a process has had processors for so long, however busy the machine is, or has ended. Returns whether
    it is at work."""
    wait_until(
        lambda: process.poll() is not None or processor_seconds(process.pid) >= seconds, f"{seconds} s of work"
    )
    return process.poll() is None


class Hindrance:
    """For how long the threads of a process could have gone on, and others had the processors."""

    def __init__(self, process):
        self.folder = pathlib.Path(f"/proc/{process}/task")
        self.first = self.read()
        self.last = dict(self.first)

    def read(self):
        found = {}
        for path in self.folder.glob("*/schedstat"):
            try:
                found[path.parent.name] = int(path.read_text().split()[1]) / 1e9
            except (OSError, IndexError):
                pass  # the thread has ended
        return found

    def look(self):
        self.last.update(self.read())

    def seconds(self):
        """Of the thread that was hindered most."""
        return max((last - self.first.get(thread, 0) for thread, last in self.last.items()), default=0)


def stop(process, number):
    """Sends a signal and waits for the end. Returns the seconds that this took, without those in which others hindered
    the process: what it takes on a machine that is free."""
    hindrance = Hindrance(process.pid)
    sent = time.monotonic()
    process.send_signal(number)

    def has_ended():
        hindrance.look()
        return process.poll() is not None

    wait_until(has_ended, f"the end after {signal.Signals(number).name}")
    return time.monotonic() - sent - hindrance.seconds()
