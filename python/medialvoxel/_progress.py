# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""How far a run is: a function, a bar of tqdm, or nothing."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import Union

Progress = Union[Callable[[float], object], bool, None]


@contextlib.contextmanager
def show(progress: Progress) -> Iterator[Callable[[float], object] | None]:
    """What takes the share that is done while the block runs."""
    if progress is not True:
        yield progress or None
        return
    from tqdm.auto import tqdm  # type: ignore[import-untyped,unused-ignore]

    with tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}") as bar:
        yield lambda done: bar.update(done - bar.n)
