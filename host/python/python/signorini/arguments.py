"""Arguments as callers give them: in the shape that the native part reads, or refused in plain words."""

from __future__ import annotations

import numbers
import os
from pathlib import Path
from typing import Any, Optional


def text(name: str, value: Any, expected: str = "a text") -> Optional[str]:
    """A text, where there is one."""
    if value is None:
        return None
    if not isinstance(value, str):
        raise TypeError(f"{name} is {value!r}, expected {expected}")
    why = unwritable(value)
    if why:
        raise ValueError(f"{name} is {value!r}: {why}")
    return value


def unwritable(value: str) -> Optional[str]:
    """Why no file in UTF-8 can hold a text: half of a character that UTF-16 writes in two."""
    try:
        value.encode("utf-8")
    except UnicodeEncodeError as error:
        return f"{value[error.start]!a} is no character"
    return None


def path(name: str, value: Any) -> str:
    """A path, as the system writes it."""
    try:
        found = os.fspath(value)
    except TypeError:
        found = None
    if not isinstance(found, str):
        raise TypeError(f"{name} is {value!r}, expected a path: a text or a pathlib.Path")
    try:
        os.fsencode(found)
    except UnicodeEncodeError as error:
        raise ValueError(f"{name} is {found!r}: {found[error.start]!a} is no character") from None
    return found


def number(name: str, value: Any) -> Optional[float]:
    """A number, where there is one."""
    if value is None:
        return None
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {value!r}, expected a number") from None


def count(name: str, value: Any, least: int = 0, bits: int = 32) -> Optional[int]:
    """A whole number, where there is one."""
    if value is None:
        return None
    is_whole = isinstance(value, numbers.Integral) and least <= value < 2**bits
    if not is_whole:
        raise ValueError(f"{name} is {value!r}, expected a count" + (f" of {least} or more" if least else ""))
    return int(value)


def flag(name: str, value: Any) -> Optional[bool]:
    """True or False, where there is one."""
    if value is None or isinstance(value, bool):
        return value
    raise TypeError(f"{name} is {value!r}, expected True or False")


def write(place: str, text: str) -> None:
    """Writes a file, whole or not at all."""
    fresh = Path(f"{place}.{os.getpid()}")
    try:
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(place)
    except OSError as error:
        fresh.unlink(missing_ok=True)
        # Nobody has named the file that is written first.
        raise OSError(error.errno, error.strerror, place) from None
