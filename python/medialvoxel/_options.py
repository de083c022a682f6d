# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0
"""Values of keywords as options of the program."""

from collections.abc import Iterable
from typing import Any

import numpy as np


def format_value(value: Any) -> str:
    """The text that the program reads as exactly this value."""
    if isinstance(value, str):
        return value
    if value is None:  # among others: the default
        return ""
    if isinstance(value, (bool, np.bool_)):
        return "on" if value else "off"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return format_value(value[()])
    if isinstance(value, Iterable):
        return ",".join(format_value(part) for part in value)
    return str(value)


def read_flag(name: str, value: Any) -> bool:
    """Whether a keyword switches something on: a bool, None for off, or a word that the program takes for a flag."""
    words = {"true": True, "on": True, "yes": True, "1": True, "false": False, "off": False, "no": False, "0": False}
    if value is None or isinstance(value, (bool, np.bool_)):
        return bool(value)
    text = str(value).lower() if isinstance(value, (str, int, np.integer)) else ""
    if text not in words:
        raise ValueError(f"{name} is {value!r}; it must be True or False, or one of {', '.join(words)}")
    return words[text]


def make_options(values: dict[str, Any]) -> list[str]:
    """Arguments of the program for keywords. None: the option is left to its default."""
    arguments: list[str] = []
    for name, value in values.items():
        if value is None:
            continue
        option, text = f"--{name.replace('_', '-')}", format_value(value)
        if not text:
            raise ValueError(f"{option}: its value is empty")
        # In one word, so that a value may begin with a minus sign.
        arguments.append(f"{option}={text}")
    return arguments


def make_flags(values: dict[str, Any]) -> list[str]:
    """Arguments of the program for keywords that switch something on."""
    return [f"--{name.replace('_', '-')}" for name, value in values.items() if read_flag(name, value)]
