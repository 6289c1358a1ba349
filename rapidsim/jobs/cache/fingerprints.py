"""Fingerprints of the inputs of a result: equal ones mean equal results.

A fingerprint covers a value to its last digit. Values that cannot be hashed raise
`NoFingerprintError`; callers then skip the cache.
"""

from __future__ import annotations

import dataclasses
import os
import sys
import sysconfig
from collections.abc import Iterator, Mapping
from datetime import date, time
from enum import Enum
from functools import cache
from hashlib import blake2b
from pathlib import Path, PurePath
from typing import Protocol

from rapidsim.shipped import shipped

_SIZE = 20
"""Size of a digest [bytes]."""
_SHIPPED = ("grammars", "robots")
_METADATA = (".dist-info", ".egg-info")


class NoFingerprintError(Exception):
    """A value without a fingerprint, such as a function."""


class Stamps(Protocol):
    """Store of fingerprints of files' contents, by the fingerprint of names, sizes and times."""

    def text(self, key: str) -> str | None:
        """Return the text stored under a key; None if there is no such text."""
        ...

    def keep_text(self, key: str, text: str) -> None:
        """Store a text under a key."""
        ...


def fingerprint(*values: object) -> str:
    """Return the fingerprint of values.

    Raises:
        NoFingerprintError: If a value has no fingerprint.
    """
    digest = blake2b(digest_size=_SIZE)
    for value in values:
        for part in _parts(value):
            digest.update(len(part).to_bytes(8, "big"))
            digest.update(part)
    return digest.hexdigest()


def _parts(value: object) -> Iterator[bytes]:
    """Yield the value as bytes with its types and lengths, so that distinct values differ."""
    kind = type(value)
    yield f"{kind.__module__}.{kind.__qualname__}".encode()
    match value:
        case Enum():
            yield value.name.encode()
        case str():
            yield value.encode("utf-8", "surrogatepass")
        case None | bool() | int() | float() | bytes() | date() | time():
            yield repr(value).encode()
        case PurePath():
            yield str(value).encode("utf-8", "surrogatepass")
        case tuple() | list():
            yield str(len(value)).encode()
            for one in value:
                yield from _parts(one)
        case Mapping():
            yield str(len(value)).encode()
            for key, one in value.items():
                yield from _parts(key)
                yield from _parts(one)
        case frozenset() | set():
            yield from sorted(fingerprint(one).encode() for one in value)
        case _ if dataclasses.is_dataclass(value):
            for field in dataclasses.fields(value):
                yield from _parts(getattr(value, field.name))
        case _ if kind.__module__ == "numpy" and hasattr(value, "__array_interface__"):
            form = value.__array_interface__
            if "O" in form["typestr"]:
                raise NoFingerprintError(kind.__qualname__)
            yield f"{form['typestr']}{form['shape']}".encode()
            yield bytes(memoryview(value))  # type: ignore[arg-type]
        case _:
            raise NoFingerprintError(kind.__qualname__)


@cache
def of_installation(stamps: Stamps | None = None) -> str:
    """Return the fingerprint of rapidsim with its shipped files, Python, and installed packages.

    Args:
        stamps: Fingerprints of known file contents, which are not read again.
    """
    files = [entry for folder in _folders() for entry in _files(os.fspath(folder))]
    stamp = fingerprint("\n".join(map(_stamp, files)))
    content = None if stamps is None else stamps.text(stamp)
    if content is None:
        content = fingerprint([(entry.name, Path(entry.path).read_bytes()) for entry in files])
        if stamps is not None:
            stamps.keep_text(stamp, content)
    return fingerprint(content, sys.version, sysconfig.get_platform(), _packages())


@cache
def of_folder(folder: Path) -> str:
    """Return the fingerprint of the names and contents of all files below a folder."""
    files = _files(os.fspath(folder))
    return fingerprint([(entry.name, Path(entry.path).read_bytes()) for entry in files])


def _folders() -> tuple[Path, ...]:
    return (Path(__file__).parents[1], *map(shipped, _SHIPPED))


def _files(folder: str) -> Iterator[os.DirEntry[str]]:
    """Yield all files below a folder except compiled ones, in a fixed order."""
    with os.scandir(folder) as entries:
        for entry in sorted(entries, key=lambda entry: entry.name):
            if entry.is_dir():
                if entry.name != "__pycache__":
                    yield from _files(entry.path)
            else:
                yield entry


def _stamp(file: os.DirEntry[str]) -> str:
    status = file.stat()
    return f"{file.path} {status.st_size} {status.st_mtime_ns}"


def _packages() -> list[str]:
    """Return names and versions of the packages that Python finds."""
    places = [place for place in map(Path, dict.fromkeys(sys.path)) if place.is_dir()]
    return sorted(one.name for place in places for one in place.iterdir() if _is_metadata(one))


def _is_metadata(entry: Path) -> bool:
    return entry.suffix in _METADATA
