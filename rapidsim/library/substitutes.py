r"""What is done instead of moves that are not simulated with all they do.

Arguments are found by their folded RAPID names, which these instructions share: `ToPoint`, `Speed`,
`Zone`, `Tool`, `WObj`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from rapidsim.language.controller import Controller
from rapidsim.language.data import FINE
from rapidsim.library.motion import move_c, move_j, move_l

Substitute = Callable[[Controller, Mapping[str, Any]], None]


def _joint(controller: Controller, given: Mapping[str, Any]) -> None:
    zone = given.get("zone") or FINE
    tool, point, speed = given["tool"], given["topoint"], given["speed"]
    move_j(controller, point, speed, zone, tool, **_options(given))


def _line(controller: Controller, given: Mapping[str, Any]) -> None:
    zone = given.get("zone") or FINE
    tool, point, speed = given["tool"], given["topoint"], given["speed"]
    move_l(controller, point, speed, zone, tool, **_options(given))


def _circle(controller: Controller, given: Mapping[str, Any]) -> None:
    zone = given.get("zone") or FINE
    tool, point, speed = given["tool"], given["topoint"], given["speed"]
    move_c(controller, given["cirpoint"], point, speed, zone, tool, **_options(given))


def _options(given: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a move that these instructions may have too."""
    return {name: given[name] for name in ("conc", "v", "t", "wobj") if given.get(name)}


SUBSTITUTES: Mapping[str, Substitute] = MappingProxyType(
    {"MoveJ": _joint, "MoveL": _line, "MoveC": _circle}
)
"""By what stands after `=>` in `declared.txt`."""
