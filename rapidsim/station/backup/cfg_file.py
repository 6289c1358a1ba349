"""A controller's configuration file, `SYSPAR/*.cfg`: types and their instances.

A type is a line such as `EIO_SIGNAL:`, an instance a line of attributes: `-Name "doGrip"
-Default 1`. A backslash at the end of a line continues it on the next. An attribute without a value
is a switch.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from rapidsim.files import input_bytes, require_inside
from rapidsim.language.equipment import Attributes

Instance: TypeAlias = Mapping[str, str]
"""Values by attribute, in any case; that of a switch is "true"."""

Configuration: TypeAlias = Mapping[str, Sequence[Instance]]
"""Instances of each type, by its name in upper case."""

SWITCHED_ON = "true"

_CONTINUED = re.compile(r"\\\s*\n\s*")
_UNQUOTED = re.compile(r'["\r\n]')
"""Characters that no value can have."""
_TYPE = re.compile(r"([A-Z]\w*):", re.IGNORECASE)
_ATTRIBUTE = re.compile(r'-([A-Za-z]\w*)(?:\s+(?:"([^"]*)"|(?!-[A-Za-z])(\S+)))?')


def read_configuration(text: str) -> Configuration:
    """Return the instances of each type, by its upper-case name; other lines are skipped."""
    found: dict[str, list[Instance]] = {}
    instances: list[Instance] = []
    for line in _CONTINUED.sub(" ", text.replace("\r", "")).splitlines():
        line = line.strip()
        if header := _TYPE.fullmatch(line):
            instances = found.setdefault(header[1].upper(), [])
        elif line.startswith("-"):
            instances.append(_instance(line))
    return found


def configuration_text(domain: str, types: Configuration) -> str:
    """Return the text of a file with the instances of each type of a domain."""
    parts = [f"{domain}:CFG_1.0:6:1::\n"]
    for of, instances in types.items():
        parts.append(f"#\n{of}:\n")
        for instance in instances:
            attributes = (
                f"-{name}" if value == SWITCHED_ON else f'-{name} "{_UNQUOTED.sub(" ", value)}"'
                for name, value in instance.items()
            )
            parts.append(f"\n      {' '.join(attributes)}\n")
    return "".join(parts)


def _instance(line: str) -> Instance:
    values: dict[str, str] = {}
    for match in _ATTRIBUTE.finditer(line):
        name, quoted, bare = match.groups()
        values[name] = next((v for v in (quoted, bare) if v is not None), SWITCHED_ON)
    return Attributes(values)


def text_in(root: Path, *names: str) -> str:
    """Return the text of a file below a folder, its name in any case; empty if it does not exist.

    An add-in puts its name before that of a configuration file: `StateMachine_eio.cfg`.

    Raises:
        InputError: If the path leads out of the folder, or is not a regular file.
    """
    folder = root
    for name in names:
        try:
            entries = sorted(root.iterdir())
        except OSError:
            return ""
        known = {one.name.lower(): one for one in reversed(entries)}
        with_add_in = (one for one in entries if one.name.lower().endswith(f"_{name.lower()}"))
        root = known.get(name.lower()) or next(with_add_in, root / name)
    if not root.exists():
        return ""
    require_inside([root], [folder])
    return input_bytes(root).decode("latin-1")
