"""RobotWare version of a controller."""

from __future__ import annotations

import re

from rapidsim.values import value_class

_VERSION = re.compile(r"(\d{1,3})\.(\d{1,3})(?:\.\d+)*")


@value_class(frozen=True, slots=True, order=True)
class RobotWare:
    """A version, as far as the language depends on it."""

    major: int
    minor: int = 0

    def __str__(self) -> str:
        """Version in ABB's notation: `6.15`, `7.0`."""
        return f"{self.major}.{self.minor}"


def read_robotware(text: str) -> RobotWare | None:
    """The version in a text such as "6.15" or "7.13.0"; None if it is not a version."""
    match = _VERSION.fullmatch(text.strip())
    return None if match is None else RobotWare(int(match[1]), int(match[2]))
