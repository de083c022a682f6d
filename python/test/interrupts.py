# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C while a call is at work in another process."""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

from support import PATIENCE, wait_until

# A shell that runs the tests in the background leaves the signal ignored.
SOURCE = """
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.path.insert(0, {tests!r})
import medialvoxel, support
values = {values}
print("begin", flush=True)
try:
    medialvoxel.{call}
except KeyboardInterrupt:
    print("interrupted", time.time(), flush=True)
print("voxels", medialvoxel.extract(support.scene(), lower=40).counts["object_voxels"])
"""


def family_of(process):
    """The number of a process, and those of what it has started."""
    family = [process]
    for parent in family:
        for path in pathlib.Path(f"/proc/{parent}/task").glob("*/children"):
            try:
                family += map(int, path.read_text().split())
            except OSError:
                pass  # the thread has ended
    return family


def processor_seconds(process):
    """For how long a process, and what it has started, have had processors."""
    ticks = 0
    for member in family_of(process):
        try:
            ticks += sum(map(int, pathlib.Path(f"/proc/{member}/stat").read_text().rpartition(")")[2].split()[11:13]))
        except OSError:
            pass  # it has ended
    return ticks / os.sysconf("SC_CLK_TCK")


class Hindrance:
    """For how long the threads of a process, and of what it has started, could have gone on, and others had the processors."""

    def __init__(self, process):
        self.process = process
        self.first = self.read()
        self.last = dict(self.first)

    def read(self):
        found = {}
        for member in family_of(self.process):
            for path in pathlib.Path(f"/proc/{member}/task").glob("*/schedstat"):
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


def interrupt(call, values):
    """Presses Ctrl-C when a call has worked for a second. Returns the seconds that it goes on for, without those in which
    others hinder it: what it takes on a machine that is free."""
    source = SOURCE.format(tests=str(pathlib.Path(__file__).parent), call=call, values=values)
    with tempfile.TemporaryFile() as stream:

        def output():
            return os.pread(stream.fileno(), 1 << 20, 0).decode()

        def has_printed(word):
            return process.poll() is not None or re.search(rf"^{word}\b.*\n", output(), re.MULTILINE)

        process = subprocess.Popen([sys.executable, "-c", source], stdout=stream, stderr=subprocess.STDOUT)
        try:
            wait_until(lambda: has_printed("begin"), "the call")
            begin = processor_seconds(process.pid)
            wait_until(lambda: process.poll() is not None or processor_seconds(process.pid) >= begin + 1, "its work")
            hindrance = Hindrance(process.pid)
            sent = time.time()
            process.send_signal(signal.SIGINT)
            wait_until(lambda: hindrance.look() or has_printed("interrupted"), "the end after Ctrl-C")
            process.wait(60 * PATIENCE)
        finally:
            process.kill()
            process.wait()
        found = re.search(r"^interrupted ([\d.]+)\nvoxels \d+\n\Z", output(), re.MULTILINE)
        if process.returncode or not found:
            raise AssertionError(f"{call}: {process.returncode}\n{output()}")
        seconds = float(found[1]) - sent - hindrance.seconds()
        print(f"Ctrl-C stops {call.split('(')[0]} after {seconds:.2f} s")
        return seconds
