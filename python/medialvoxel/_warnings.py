# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Warnings of runs, with the codes of the report."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable


class MedialVoxelWarning(UserWarning):
    """A result that may mislead.

    code: for scripts; doc/reference/report.md lists them."""

    code: str

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


def warn(found: Iterable[dict[str, str]]) -> None:
    """Warns, at the line that calls this package, of rows of a report."""
    level, frame = 1, sys._getframe()
    while frame.f_back and frame.f_globals.get("__name__", "").split(".")[0] == __package__:
        level, frame = level + 1, frame.f_back
    for row in found:
        warnings.warn(MedialVoxelWarning(row["code"], row["message"]), stacklevel=level)
