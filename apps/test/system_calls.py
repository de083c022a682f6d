# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program under strace, which lets a chosen call of the system fail, or be the last one of the process."""

import os
import shutil
import subprocess
import unittest

from jobs import results
from program import PROGRAM


def _is_missing():
    if os.environ.get("MEDIALVOXEL_SANITIZED"):
        return "the sanitizers do not work under strace"
    if not shutil.which("strace"):
        return "strace is missing: scripts/install-packages strace"
    if subprocess.run(["strace", "-o", os.devnull, "true"], capture_output=True, check=False).returncode:
        return "strace may not trace a process here"
    return None


needs_strace = unittest.skipIf(_is_missing(), _is_missing() or "")


def command_with(injections, arguments, path=None, trace=os.devnull):
    """The program with injections of strace, such as "rename:error=EIO:when=2", with blanks between, in calls for a
    file. The calls are listed in the trace."""
    calls = ",".join(injection.split(":")[0] for injection in injections.split())
    command = ["strace", "-f", "-o", trace, "-e", "trace=" + calls]
    command += [text for injection in injections.split() for text in ("-e", "inject=" + injection)]
    command += ["-P", path] if path else []
    return [*command, PROGRAM, *map(str, arguments)]


def run_with(injections, arguments, folder, path=None):
    """Runs command_with()."""
    command = command_with(injections, arguments, path)
    return subprocess.run(command, capture_output=True, text=True, cwd=folder, check=False)


def kill_at_each(call, command, prepare, check, folder, always=""):
    """Has the command killed before each call of this name, in each thread: prepare(), the command, check(label).
    Each run also has the injections that are given always. Returns the number of kills."""
    kills = 0
    while True:
        prepare()
        label = f"killed at {call} {kills + 1}"
        result = run_with(f"{call}:signal=SIGKILL:when={kills + 1} {always}", command, folder)
        if result.returncode not in (-9, 137):
            # There are no more of them.
            if result.returncode:
                raise AssertionError(f"{label}: {result.stderr}")
            return kills
        check(label)
        kills += 1


class PreparedFolder:
    """The outputs of a former run, or none, to begin from again and again."""

    def __init__(self, target, store):
        self.target, self.store = target, store
        shutil.copytree(target, store, symlinks=True)

    def restore(self):
        for path in self.target.iterdir():
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        # Copied times would let a job believe that nothing has changed, which is what is wanted.
        shutil.copytree(self.store, self.target, dirs_exist_ok=True)


def compare(case, label, expected, folders=()):
    """The outputs are those that are expected, and nothing else is there but these folders."""
    found = results(case.target)
    case.assertEqual(sorted(found), sorted(expected), label)
    for name, content in expected.items():
        case.assertEqual(found[name], content, (label, name))
    names = {path.name for path in case.target.iterdir()}
    case.assertEqual(names, {name.split("/")[0] for name in expected} | set(folders), label)
