# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Processes that are stopped by a signal: when they are at work, and how soon they end."""

import signal
import time

from processes import Hindrance, processor_seconds, wait_until

# A shell that runs the tests in the background leaves the signal ignored, for them and what they start.
signal.signal(signal.SIGINT, signal.default_int_handler)


def wait_for_work(process, seconds):
    """Waits until a process has had processors for so long, however busy the machine is, or has ended. Returns whether
    it is at work."""
    wait_until(
        lambda: process.poll() is not None or processor_seconds(process.pid) >= seconds, f"{seconds} s of work"
    )
    return process.poll() is None


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
