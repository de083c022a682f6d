# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""What the system tells of other processes, and how tests wait for them."""

import os
import pathlib
import re
import time

TICKS = os.sysconf("SC_CLK_TCK")

# How many times longer than usual a test may wait for what must not take long.
PATIENCE = float(os.environ.get("MEDIALVOXEL_PATIENCE", 1))


def wait_until(condition, what, seconds=60, interval=0.001):
    """Asks again and again until a condition holds. Returns what it says."""
    deadline = time.monotonic() + seconds * PATIENCE
    while not (found := condition()):
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {seconds * PATIENCE:g} s for {what}")
        time.sleep(interval)
    return found


def stat_of(process):
    """What the system tells of a process, from its state on; its number, or that of a thread."""
    return pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()


def state_of(process):
    """One letter: R runs, S sleeps, T is halted, Z has ended."""
    return stat_of(process)[0]


def open_files_of(process):
    """The names of its open files, each with how far it was read; none when it has ended."""
    place = pathlib.Path(f"/proc/{process}")
    try:
        numbers = os.listdir(place / "fd")
    except OSError:
        return {}
    found = {}
    for number in numbers:
        try:
            position = re.match(r"pos:\s*(\d+)", (place / "fdinfo" / number).read_text())
            found[os.readlink(place / "fd" / number)] = int(position[1])
        except OSError:
            pass  # it was closed meanwhile
    return found


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
            ticks += sum(map(int, stat_of(member)[11:13]))
        except OSError:
            pass  # it has ended
    return ticks / TICKS


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
