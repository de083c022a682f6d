# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Interpreters of Python, of which some may have what others read our files with."""

import functools
import os
import pathlib
import subprocess
import sys

CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "medialvoxel"
PYTHONS = [
    str(CACHE / "zarr-readers/bin/python"),
    str(CACHE / "mesh-readers/bin/python"),
    str(CACHE / "keyword-readers/bin/python"),
    str(CACHE / "volume-writers/bin/python"),
    sys.executable,
    "/usr/bin/python3",
]


@functools.lru_cache(maxsize=None)
def python_with(module):
    """The first one that has the module, or None."""
    for python in PYTHONS:
        if pathlib.Path(python).exists():
            if subprocess.run([python, "-c", f"import {module}"], capture_output=True, check=False).returncode == 0:
                return python
    return None
