r"""Substitutes of moves that are not simulated completely.

Arguments are found by their folded RAPID names, which these instructions share: `ToPoint`, `Speed`,
`Zone`, `Tool`, `WObj`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from rapidsim.language.controller import Controller
from rapidsim.language.data import FINE
from rapidsim.language.moves import Interpolation
from rapidsim.library.motion import move

Substitute = Callable[[Controller, Mapping[str, Any]], None]


def _substitute(name: str, interpolation: Interpolation) -> Substitute:
    body = move(name, interpolation)

    def substitute(controller: Controller, arguments: Mapping[str, Any]) -> None:
        zone = arguments.get("zone") or FINE
        point, speed, tool = arguments["topoint"], arguments["speed"], arguments["tool"]
        body(controller, point, speed, zone, tool, **_options(arguments))

    return substitute


def _options(arguments: Mapping[str, Any]) -> dict[str, Any]:
    """Options of a move that these instructions may have too, and its circle point."""
    options = {name: arguments[name] for name in ("conc", "v", "t", "wobj") if arguments.get(name)}
    return options | ({"cir_point": arguments["cirpoint"]} if "cirpoint" in arguments else {})


SUBSTITUTES: Mapping[str, Substitute] = MappingProxyType(
    {
        "MoveJ": _substitute("MoveJ", Interpolation.JOINT),
        "MoveL": _substitute("MoveL", Interpolation.LINE),
        "MoveC": _substitute("MoveC", Interpolation.CIRCLE),
    }
)
"""Substitute by the name after `=>` in `declared.txt`."""
