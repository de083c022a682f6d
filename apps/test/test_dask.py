# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Jobs on a Dask cluster: dask_jobs.py, in whichever Python has Dask."""

import pathlib
import subprocess
import unittest

from interpreters import python_with

FOLDER = pathlib.Path(__file__).parent


class DaskTest(unittest.TestCase):
    def test_jobs(self):
        python = python_with("distributed")
        if python is None:
            self.skipTest("Dask is not installed: scripts/install-packages schedulers, Debian package python3-distributed")
        command = [python, "-B", "-m", "unittest", "--verbose", "dask_jobs"]
        result = subprocess.run(command, capture_output=True, text=True, check=False, cwd=FOLDER)
        print(f"{python}\n{result.stdout}{result.stderr}", flush=True)
        self.assertEqual(result.returncode, 0)


if __name__ == "__main__":
    unittest.main()
