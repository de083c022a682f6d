# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""The program that the wheel brings, for files of any size."""

from __future__ import annotations

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from typing import Any, NoReturn, Union

from ._options import format_value
from ._parameters import describe
from ._progress import Progress, show
from ._threads import make_environment
from ._warnings import warn

FileName = Union[str, "os.PathLike[str]"]

# Where values of all axes are: x first for the program.
_PER_AXIS = ("spacing", "raw_size")

# Options that are automatic unless they are on or off.
_SWITCHES = ("smooth", "sub_voxel")

_WRONG_VALUES = (2, 3, 4)  # of its exit status: usage, refused, corrupt input
_TOO_THIN = 5  # all is written, and there are thin places
_NOT_MEASURED = 6  # all is written, and too little was measured to know


class ThinPlacesError(RuntimeError):
    """There are places with too thin walls, and fail_if_thin was on. All outputs are written.

    report: what the function returns otherwise; report["places"]["thin"] has their number and the first of them."""

    report: dict[str, Any]

    def __init__(self, report: dict[str, Any]) -> None:
        super().__init__(f"{report['places']['thin']['number']} thin places")
        self.report = report


class NotMeasuredError(RuntimeError):
    """Too little was measured for a verdict on thin walls, and fail_if_thin was on. All outputs are written.

    report: what the function returns otherwise; report["warnings"] has the reasons."""

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
        sys.exit(subprocess.call([program, *sys.argv[1:]], env=make_environment()))
    os.execve(program, ["medialvoxel", *sys.argv[1:]], make_environment())


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
    if status == 3 and " memory" in message and any(word in message for word in (" need", " takes ")):
        raise MemoryError(message)
    if message.endswith("no such file"):
        raise FileNotFoundError(message)
    raise (ValueError if status in _WRONG_VALUES else RuntimeError)(message)


def _run(arguments: list[str], progress: Callable[[float], object] | None, stdout: int = subprocess.DEVNULL) -> tuple[int, str, str]:
    """Status, output and errors of the program. An exception here, such as that of Ctrl-C, stops it first."""
    command, environment = [find_program(), *arguments], make_environment()
    with subprocess.Popen(command, stdout=stdout, stderr=subprocess.PIPE, text=True, env=environment) as process:
        errors = ""
        assert process.stderr is not None
        try:
            for line in process.stderr:
                if line.startswith("{") and progress:
                    done = json.loads(line).get("progress")
                    done is None or progress(done)
                else:
                    errors += line
            return process.wait(), process.stdout.read() if process.stdout else "", errors
        except BaseException:
            process.terminate()
            raise


def run_on_files(command: str, files: tuple[FileName, ...], options: dict[str, Any], progress: Progress) -> dict[str, Any]:
    with tempfile.TemporaryDirectory(prefix="medialvoxel-") as folder, show(progress) as take:
        report = os.fspath(options.pop("report", None) or os.path.join(folder, "report.json"))
        style = "json" if take else "none"
        arguments = [command, *(os.fspath(file) for file in files), f"--report={report}", f"--progress={style}", *_make_arguments(options)]
        status, _, errors = _run(arguments, take)
        if status not in (0, _TOO_THIN, _NOT_MEASURED):
            _fail(status, errors)
        if options.get("dry_run"):
            return {}
        found: dict[str, Any] = json.loads(pathlib.Path(report).read_text())
    warn(found["warnings"])
    if status == _TOO_THIN:
        raise ThinPlacesError(found)
    if status == _NOT_MEASURED:
        raise NotMeasuredError(errors.strip().splitlines()[-1].removeprefix("medialvoxel: "), found)
    return found


@describe
def extract_file(input: FileName, output: FileName | None = None, *, progress: Progress = None, **options: Any) -> dict[str, Any]:
    """The medial cells of a file of any size, as `medialvoxel extract INPUT OUTPUT` writes them; other outputs are options.

    Returns
    -------
    dict[str, Any]
        The report, whose keys doc/reference/report.md lists; empty with ``dry_run=True``.
    """
    return run_on_files("extract", (input,) if output is None else (input, output), options, progress)


@describe
def mesh_file(input: FileName, output: FileName, *, progress: Progress = None, **options: Any) -> dict[str, Any]:
    """The medial surface of a file of any size, as `medialvoxel mesh INPUT OUTPUT` writes it.

    Returns
    -------
    dict[str, Any]
        The report, as of extract_file().
    """
    return run_on_files("mesh", (input, output), options, progress)


@describe
def surface_file(input: FileName, output: FileName, *, progress: Progress = None, **options: Any) -> dict[str, Any]:
    """The surface of the part in a file, with the wall thickness, as `medialvoxel surface INPUT OUTPUT` writes it.

    Returns
    -------
    dict[str, Any]
        The report, as of extract_file().
    """
    return run_on_files("surface", (input, output), options, progress)


@describe
def distance_file(input: FileName, output: FileName, *, progress: Progress = None, **options: Any) -> dict[str, Any]:
    """Vectors to the boundary of a file of any size, as `medialvoxel distance INPUT VECTORS` writes them.

    Returns
    -------
    dict[str, Any]
        The report, as of extract_file().
    """
    return run_on_files("distance", (input, output), options, progress)


@describe
def info(input: FileName, **options: Any) -> dict[str, str]:
    """What `medialvoxel info INPUT` tells of a volume: format, size, spacing and more.

    Returns
    -------
    dict[str, str]
        The lines of the program by their first word: ``info("part.mha")["size"]``. ``values=True`` adds statistics of the values.
    """
    status, output, errors = _run(["info", os.fspath(input), *_make_arguments(options)], None, subprocess.PIPE)
    if status:
        _fail(status, errors)
    return dict(re.split(r"  +", line, maxsplit=1) for line in output.splitlines())  # type: ignore[arg-type,unused-ignore]
