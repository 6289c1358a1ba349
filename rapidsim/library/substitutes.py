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
from rapidsim.library.signals import set_ao, set_do, set_go

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


def _set_digital(controller: Controller, given: Mapping[str, Any]) -> None:
    set_do(controller, given["signal"], given["value"])


def _set_analog(controller: Controller, given: Mapping[str, Any]) -> None:
    set_ao(controller, given["signal"], given["value"])


def _set_group(controller: Controller, given: Mapping[str, Any]) -> None:
    value = given.get("value")
    set_go(controller, given["signal"], given["dvalue"] if value is None else value)


def _find_end(controller: Controller, given: Mapping[str, Any]) -> None:
    del controller
    given["searchpoint"].value = given["topoint"]


def _options(given: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a move that these instructions may have too."""
    return {name: given[name] for name in ("conc", "v", "t", "wobj") if given.get(name)}


def _in_turn(*steps: Substitute) -> Substitute:
    def substitute(controller: Controller, given: Mapping[str, Any]) -> None:
        for step in steps:
            step(controller, given)

    return substitute


_MOVES: Mapping[str, Substitute] = {"MoveJ": _joint, "MoveL": _line, "MoveC": _circle}
_OUTPUTS: Mapping[str, Substitute] = {
    "SetDO": _set_digital,
    "SetAO": _set_analog,
    "SetGO": _set_group,
}

SUBSTITUTES: Mapping[str, Substitute] = MappingProxyType(
    {
        **_MOVES,
        **{
            f"{move} and {output}": _in_turn(make, write)
            for move, make in _MOVES.items()
            for output, write in _OUTPUTS.items()
        },
        **{
            f"{move} that finds its end point": _in_turn(make, _find_end)
            for move, make in _MOVES.items()
        },
    }
)
"""By what stands after `=>` in `declared.txt`."""
