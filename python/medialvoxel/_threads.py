# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The number of threads by default: that of the processors which this process may use."""

import math
import os
import pathlib

# Read by the program.
_VARIABLE = "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS"


def count_processors(quota: pathlib.Path = pathlib.Path("/sys/fs/cgroup/cpu.max")) -> int:
    """Those that the affinity and the quota of the container leave; 1 or more."""
    number = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    try:
        time, period = quota.read_text().split()
        number = min(number, math.ceil(int(time) / int(period)))
    except (OSError, ValueError):  # no control groups of version 2, or no limit: "max"
        pass
    return max(number, 1)


def make_environment() -> dict[str, str]:
    """That of the program; who sets the variable knows better."""
    return {_VARIABLE: str(count_processors()), **os.environ}
