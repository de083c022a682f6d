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

import support  # noqa: F401, which makes the next one importable
from processes import PATIENCE, Hindrance, processor_seconds, wait_until

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
