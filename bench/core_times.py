# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs a program on paper with a core for each of its threads (bench/tiles/VirtualCores.cxx), and says what the cores wait for."""

import bisect
import collections
import json
import os
import subprocess
import tempfile

OTHER = "start and end of the program"


def run(library, command, threads):
    """Seconds of a run with so many threads, and of its cores, by the names of what they did."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        environment = {**os.environ, "LD_PRELOAD": str(library), "MEDIALVOXEL_CORES": file.name}
        subprocess.run([*command, "--threads", str(threads)], env=environment, check=True, stdout=subprocess.DEVNULL)
        return json.load(file)


def count_busy(intervals_of_threads):
    """Times, and how many threads run from each of them on to the next one."""
    changes = collections.Counter()
    for intervals in intervals_of_threads:
        for begin, end in intervals:
            changes[begin] += 1
            changes[end] -= 1
    times, busy = [], []
    for time in sorted(changes):
        times.append(time)
        busy.append((busy[-1] if busy else 0) + changes[time])
    return times, busy


class Integral:
    """Of a function of the number of busy threads, from the first time on."""

    def __init__(self, times, busy, function):
        self.times = times
        self.values = [function(number) for number in busy]
        self.sums = [0.0]
        for i in range(1, len(times)):
            self.sums.append(self.sums[-1] + (times[i] - times[i - 1]) * self.values[i - 1])

    def until(self, time):
        i = bisect.bisect_right(self.times, time) - 1
        return self.sums[i] + (time - self.times[i]) * self.values[i]

    def between(self, begin, end):
        return self.until(end) - self.until(begin)


class Names:
    """Functions of addresses, by addr2line."""

    def __init__(self, samples):
        addresses = collections.defaultdict(dict)
        for sample in samples:
            for address in sample[2:]:
                file, offset = address.rsplit(" ", 1)
                addresses[file][offset] = address
        self.functions = {}
        for file, offsets in addresses.items():
            if os.path.isfile(file):
                command = ["addr2line", "-f", "-C", "-e", file]
                text = subprocess.run(command, input="\n".join(offsets), capture_output=True, text=True, check=True).stdout
                self.functions.update(zip(offsets.values(), text.splitlines()[::2]))

    def functions_of(self, sample):
        """From the innermost to the outermost."""
        return [self.functions.get(address, "") for address in sample[2:]]


def share_out(samples, intervals_of_threads, integral):
    """Gives each sample what its thread adds to the integral since the sample before, in seconds."""
    by_thread = collections.defaultdict(list)
    for sample in samples:
        by_thread[sample[0]].append(sample)
    for thread, intervals in enumerate(intervals_of_threads):
        own = sorted(by_thread[thread], key=lambda sample: sample[1])
        times = [sample[1] for sample in own]
        shares = [0.0] * (len(own) + 1)
        for begin, end in intervals:
            first, last = bisect.bisect_left(times, begin), bisect.bisect_left(times, end)
            bounds = [begin, *times[first:last], end]
            for i in range(len(bounds) - 1):
                shares[min(first + i, len(own) - 1)] += integral.between(bounds[i], bounds[i + 1]) / 1e9
        if own:
            shares[len(own) - 1] += shares.pop()
        yield from zip(own or [None], shares)


def name_of(functions, names):
    """The first name whose function is among those of a sample."""
    return next((name for part, name in names if any(part in function for function in functions)), OTHER)


def summarize(record, cores, names):
    """Seconds of a run, of its work, and by name: with one busy core, and what cores without work add to its seconds, which
    are the work over the cores and these."""
    threads, samples = record["threads"], record["samples"]
    times, busy = count_busy(threads)
    functions = Names(samples)
    work = sum(end - begin for intervals in threads for begin, end in intervals) / 1e9
    result = {"seconds": (times[-1] - times[0]) / 1e9, "work_cpu_seconds": work}
    for key, function in (
        ("serial_seconds", lambda number: float(number == 1)),
        ("idle_seconds", lambda number: 1 / number - 1 / cores if number > 0 else 0.0),
    ):
        sums = collections.Counter()
        for sample, seconds in share_out(samples, threads, Integral(times, busy, function)):
            sums[name_of(functions.functions_of(sample), names) if sample else OTHER] += seconds
        result[key] = dict(sums)
    return result
