# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Jobs on a Dask cluster: dask_jobs.py, in whichever Python has Dask."""

import pathlib
import subprocess
import sys
import unittest

FOLDER = pathlib.Path(__file__).parent


def python_with_dask():
    """This Python or that of the system, or None."""
    for python in (sys.executable, "/usr/bin/python3"):
        if pathlib.Path(python).exists():
            if subprocess.run([python, "-c", "import distributed"], capture_output=True, check=False).returncode == 0:
                return python
    return None


class DaskTest(unittest.TestCase):
    def test_jobs(self):
        python = python_with_dask()
        if python is None:
            self.skipTest("Dask is not installed: scripts/install-packages schedulers, Debian package python3-distributed")
        command = [python, "-B", "-m", "unittest", "--verbose", "dask_jobs"]
        result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=FOLDER)
        print(f"{python}\n{result.stdout}{result.stderr}", flush=True)
        self.assertEqual(result.returncode, 0)


if __name__ == "__main__":
    unittest.main()
