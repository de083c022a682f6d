# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The program that the wheel brings, for files of any size."""

from __future__ import annotations

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from typing import Any, NoReturn

from ._options import format_value
from ._warnings import warn

# Where values of all axes are: x first for the program.
_PER_AXIS = ("spacing", "raw_size", "raw_spacing")

# Options that are automatic unless they are on or off.
_SWITCHES = ("smooth", "sub_voxel")

_WRONG_VALUES = (2, 3, 4)  # of its exit status: usage, refused, corrupt input
_TOO_THIN = 5  # all is written, and there are thin places
_NOT_MEASURED = 6  # all is written, and too little was measured to know


class ThinPlacesError(RuntimeError):
    """There are places with too thin walls, and fail_if_thin was on. All outputs are written.

    report: what extract_file() returns otherwise; report["places"]["thin"] has their number and the first of them."""

    report: dict[str, Any]

    def __init__(self, report: dict[str, Any]) -> None:
        super().__init__(f"{report['places']['thin']['number']} thin places")
        self.report = report


class NotMeasuredError(RuntimeError):
    """Too little was measured for a verdict on thin walls, and fail_if_thin was on. All outputs are written.

    report: what extract_file() returns otherwise; report["warnings"] has the reasons."""

    report: dict[str, Any]

    def __init__(self, message: str, report: dict[str, Any]) -> None:
        super().__init__(message)
        self.report = report


def find_program() -> str:
    """The program of the environment variable MEDIALVOXEL_PROGRAM, of this package, or of the search path."""
    name = "medialvoxel.exe" if os.name == "nt" else "medialvoxel"
    own = pathlib.Path(__file__).parent / "bin" / name
    program = os.environ.get("MEDIALVOXEL_PROGRAM") or (os.fspath(own) if own.exists() else shutil.which(name))
    if not program:
        raise FileNotFoundError("the program medialvoxel is neither in this package nor in the search path")
    return program


def main() -> NoReturn:
    """Becomes the program, with the arguments of this process."""
    program = find_program()
    if os.name == "nt":
        sys.exit(subprocess.call([program, *sys.argv[1:]]))
    os.execv(program, ["medialvoxel", *sys.argv[1:]])


def _make_arguments(options: dict[str, Any]) -> list[str]:
    arguments: list[str] = []
    for name, value in options.items():
        option = f"--{name.replace('_', '-')}"
        if name in _SWITCHES and isinstance(value, bool):
            arguments.append(f"{option}={'on' if value else 'off'}")
            continue
        if value is None or value is False:
            continue
        if value is True:
            arguments.append(option)
            continue
        if name in _PER_AXIS and not isinstance(value, str):
            value = tuple(value)[::-1]
        arguments.append(f"{option}={format_value(os.fspath(value) if isinstance(value, os.PathLike) else value)}")
    return arguments


def _fail(status: int, text: str) -> NoReturn:
    lines = [line for line in text.splitlines() if line.startswith("medialvoxel: ")]
    message = lines[-1].removeprefix("medialvoxel: ") if lines else text.strip() or f"exit status {status}"
    if status == 3 and " memory" in message and "needs" in message:
        raise MemoryError(message)
    if message.endswith("no such file"):
        raise FileNotFoundError(message)
    raise (ValueError if status in _WRONG_VALUES else RuntimeError)(message)


def extract_file(input: str | os.PathLike[str], output: str | os.PathLike[str], **options: Any) -> dict[str, Any]:
    """Extracts the medial cells of a file of any size into a file, as `medialvoxel extract INPUT OUTPUT` does.

    options: those of the program, with underscores: thickness_map="map.mha", lower=72, memory="2G", overwrite=True.
        True switches an option on; None and False leave it to its default. smooth=False and sub_voxel=False switch off.
        Values of all axes are (z, y, x) as numbers, and as the program takes them as a text: spacing=(2, 1, 1) is
        spacing="1,1,2". Two limits of places are a tuple: thin_below=(2, 2.5).

    Returns the report, whose keys doc/reference/report.md lists. Raises ValueError for what the program refuses,
    FileNotFoundError, MemoryError for a limit of memory that is too small, ThinPlacesError with fail_if_thin=True when
    there are thin places, NotMeasuredError when too little was measured to know, RuntimeError for other failures. Warns of
    each of the report's warnings by MedialVoxelWarning.
    Ctrl-C stops the program."""
    with tempfile.TemporaryDirectory(prefix="medialvoxel-") as folder:
        wanted = options.pop("report", None)
        report = os.fspath(wanted) if wanted else os.path.join(folder, "report.json")
        command = [find_program(), "extract", os.fspath(input), os.fspath(output), f"--report={report}", "--progress=none"]
        process = subprocess.Popen(
            command + _make_arguments(options), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        try:
            _, errors = process.communicate()
        except BaseException:
            process.terminate()
            process.wait()
            raise
        if process.returncode not in (0, _TOO_THIN, _NOT_MEASURED):
            _fail(process.returncode, errors)
        if options.get("dry_run"):
            return {}
        found: dict[str, Any] = json.loads(pathlib.Path(report).read_text())
        warn(found["warnings"])
        if process.returncode == _TOO_THIN:
            raise ThinPlacesError(found)
        if process.returncode == _NOT_MEASURED:
            raise NotMeasuredError(errors.strip().splitlines()[-1].removeprefix("medialvoxel: "), found)
        return found
