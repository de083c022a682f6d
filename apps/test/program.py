# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program that the environment variable MEDIALVOXEL_PROGRAM names."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from processes import open_files_of, wait_until

PROGRAM = os.environ["MEDIALVOXEL_PROGRAM"]
READS_TIFF = os.environ.get("MEDIALVOXEL_READS_TIFF", "1") == "1"

needs_tiff = unittest.skipUnless(READS_TIFF, "the program was built without libtiff")

# What a run says that succeeds.
NOTE_OF_UNPACKING = r"\A(medialvoxel: .* is compressed and was unpacked once: .* in .*\n)?\Z"

# What a run says as well when it takes more than half a minute.
PROGRESS = re.compile(r"^medialvoxel: \d+ % after .* left\n", re.MULTILINE)

# What it must know who uses the results.
WARNING = re.compile(r"^medialvoxel: warning: (.*)\n", re.MULTILINE)

DONE, FAILURE, USAGE, REFUSED, CORRUPT = range(5)


def unprivileged():
    """Options that run the program as a user whom permissions bind; skips the test where that is not possible."""
    options = {} if os.geteuid() else {"user": 65534, "group": 65534, "extra_groups": []}
    try:
        subprocess.run([PROGRAM, "--version"], check=True, capture_output=True, cwd="/", **options)
    except (OSError, subprocess.CalledProcessError):
        raise unittest.SkipTest("the program cannot be run by an unprivileged user from here") from None
    return options


def has_begun(process, folder):
    """Whether a process writes outputs in a folder: files without a name, or with a temporary one."""
    if any(folder.glob("*.partial")):
        return True
    return any(name.startswith(f"{folder.resolve()}/#") for name in open_files_of(process.pid))


def wait_for_begin(process, folder):
    """Waits until a process writes outputs, or has ended. Returns whether it writes them."""

    def begins_or_ends():
        return "ends" if process.poll() is not None else has_begun(process, folder) and "begins"

    return wait_until(begins_or_ends, "the first output") == "begins"


class ProgramTestCase(unittest.TestCase):
    """Each test has a folder of its own, self.folder."""

    PLACE = None  # folder for them; None: that of all temporary files
    PROGRAM = PROGRAM

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="medialvoxel-test-", dir=self.PLACE)
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_program(self, *arguments, status=DONE, **options):
        """Runs the program, checks its exit status and returns what it printed; only unpacking makes it say something
        beside its warnings, which are returned as a list."""
        result = subprocess.run(
            [self.PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, check=False, **options
        )
        self.assertEqual(result.returncode, status, f"{arguments}\n{result.stdout}{result.stderr}")
        result.warnings = WARNING.findall(result.stderr)
        result.stderr = WARNING.sub("", PROGRESS.sub("", result.stderr))
        if status == DONE:
            self.assertRegex(result.stderr, NOTE_OF_UNPACKING)
        else:
            self.assertEqual(result.stdout, "", arguments)
            self.assertTrue(result.stderr.startswith("medialvoxel: "), result.stderr)
        return result

    def extract(self, source, target, *arguments, status=DONE, thickness=3, **options):
        return self.run_program(
            "extract", source, target, "--thickness", thickness, *arguments, status=status, **options
        )

    def find_least_memory(self, *arguments, folder=None):
        """The bytes with which a run can just be planned, to 64 KiB."""
        refused, accepted = 0, 1 << 32
        while accepted - refused > 1 << 16:
            bytes_ = (refused + accepted) // 2
            command = [PROGRAM, *map(str, arguments), "--memory", str(bytes_), "--dry-run", "--overwrite"]
            plan = subprocess.run(command, capture_output=True, cwd=folder or self.folder, check=False)
            self.assertIn(plan.returncode, (DONE, REFUSED), plan.stderr)
            refused, accepted = (refused, bytes_) if plan.returncode == DONE else (bytes_, accepted)
        return accepted

    def mount_small_disk(self, folder, size):
        """Skips the test where that is not permitted."""
        folder.mkdir(exist_ok=True)
        command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)]
        try:
            mounted = subprocess.run(command, capture_output=True, check=False).returncode == 0
        except OSError:
            mounted = False
        if not mounted:
            self.skipTest("mounting a small disk is not permitted here")
        self.addCleanup(subprocess.run, ["umount", str(folder)], check=True)

    def snapshot(self):
        """Names and contents of all files."""
        return {path.name: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}

    def assert_fails(self, status, parts, *arguments, **options):
        """The program fails with this status, its message has all the parts, and no file has changed."""
        before = self.snapshot()
        message = self.run_program(*arguments, status=status, **options).stderr
        for part in parts:
            self.assertIn(str(part), message)
        self.assertEqual(message.count("\n"), 1, message)
        self.assertEqual(self.snapshot(), before, "files changed")
