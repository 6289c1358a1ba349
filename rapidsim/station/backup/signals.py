"""Signals of a controller backup: `SYSPAR/EIO.cfg`.

Types, widths, default values and limits of signals, and the cross connections between them. A run
does not need to know which bus and device carries a signal.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from rapidsim.controller.cell.conditions import Condition, Term
from rapidsim.controller.cell.description import (
    FIRST_ROBOT,
    GROUP_WIDTH,
    CellIo,
    CrossConnection,
    SignalDeclaration,
    SignalKind,
    Status,
    SystemAction,
    mapped_bits,
)
from rapidsim.station.backup.cfg_file import SWITCHED_ON, Configuration, Instance
from rapidsim.station.signals import follows_itself

_MOST_ACTORS = 5
_OF_UNITS = (Status.UNIT_ACTIVE, Status.UNIT_NOT_MOVING)
_OTHER_SPELLINGS = {
    "motoron": SystemAction.MOTORS_ON,
    "motoroff": SystemAction.MOTORS_OFF,
    "motoronstart": SystemAction.MOTORS_ON_AND_START,
    "stopinst": SystemAction.STOP_AT_INSTRUCTION_END,
    "ppmain": SystemAction.POINTER_TO_MAIN,
}
"""Actions of system inputs in other versions, in lower case; all spellings are from memory."""
_ROBOT = re.compile(r"ROB_\d+", re.IGNORECASE)
"""Units whose states system outputs show."""


class _Shown(NamedTuple):
    """Status shown by a system output, with its task and unit."""

    status: Status
    task: str | None
    unit: str


def backup_io(types: Configuration) -> tuple[CellIo, tuple[str, ...]]:
    """Return the signals of an I/O configuration and their connections.

    Returns:
        Signals and cross connections, and a remark for each skipped connection.
    """
    signals = (_signal(one) for one in types.get("EIO_SIGNAL", ()))
    shown, others = _system_outputs(types.get("SYSSIG_OUT", ()))
    actions, unknown = _system_inputs(types.get("SYSSIG_IN", ()))
    declared = (one and _acting(_showing(one, shown), actions) for one in signals)
    crosses, remarks = _crosses(types.get("EIO_CROSS", ()))
    io = CellIo(tuple(one for one in declared if one is not None), crosses)
    return io, (*remarks, *others, *unknown)


def _system_inputs(
    instances: Iterable[Instance],
) -> tuple[Mapping[str, tuple[SystemAction, str]], tuple[str, ...]]:
    """Return the action and the cycle mode of each system input, by folded name, with remarks."""
    known = {action.lower(): action for action in SystemAction} | _OTHER_SPELLINGS
    actions: dict[str, tuple[SystemAction, str]] = {}
    others: dict[str, list[str]] = {}
    for instance in instances:
        name, word = _signal_of(instance), instance.get("action", "")
        if (action := known.get(word.lower())) is not None:
            actions.setdefault(name.lower(), (action, instance.get("arg1", "")))
        else:
            others.setdefault(word, []).append(f"`{name}`")
    return actions, tuple(
        f"EIO.cfg: {word} is not simulated: {', '.join(names)} "
        + ("slows nothing down" if word.lower() == "limitspeed" else "has no effect")
        for word, names in others.items()
    )


def _acting(
    signal: SignalDeclaration, actions: Mapping[str, tuple[SystemAction, str]]
) -> SignalDeclaration:
    if signal.kind is not SignalKind.DI or signal.name.lower() not in actions:
        return signal
    action, cycle = actions[signal.name.lower()]
    return replace(signal, action=action, cycle=cycle)


def _system_outputs(
    instances: Iterable[Instance],
) -> tuple[Mapping[str, _Shown], tuple[str, ...]]:
    """Return the status shown by each output, by folded name, with remarks on unsupported ones."""
    known = {status.lower(): status for status in Status}
    shown: dict[str, _Shown] = {}
    others: dict[str, list[str]] = {}
    for instance in instances:
        name, word = _signal_of(instance), instance.get("status", "")
        status, unit = known.get(word.lower()), _unit(instance)
        if status is not None and (status not in _OF_UNITS or _ROBOT.fullmatch(unit)):
            shown.setdefault(name.lower(), _Shown(status, instance.get("arg2"), unit))
        else:
            others.setdefault(word, []).append(f"`{name}`")
    return shown, tuple(
        f"EIO.cfg: {word} is not simulated: {', '.join(names)} keeps its value"
        for word, names in others.items()
    )


def _signal_of(instance: Instance) -> str:
    """Return the signal of a system input or output; RobotWare 7 names it by the instance."""
    return instance.get("signal") or instance.get("name", "")


def _unit(instance: Instance) -> str:
    """Return the unit of a system output; which argument names it differs between statuses."""
    arguments = (instance.get(f"arg{number}") for number in (1, 3, 4, 2))
    return next((one for one in arguments if one), FIRST_ROBOT)


def _showing(signal: SignalDeclaration, visible: Mapping[str, _Shown]) -> SignalDeclaration:
    if signal.name.lower() not in visible:
        return signal
    status, task, unit = visible[signal.name.lower()]
    return replace(signal, value=status.at_start, status=status, task=task, unit=unit)


def _signal(instance: Instance) -> SignalDeclaration | None:
    """Return one signal; None if it has no name, or a type that RAPID does not know."""
    name = instance.get("name", "")
    word = instance.get("signaltype", "").lower()
    if not name or word not in [one.value for one in SignalKind]:
        return None
    kind = SignalKind(word)
    start = _number(instance.get("default")) or 0.0
    if kind in (SignalKind.AI, SignalKind.AO):
        lowest, highest = _number(instance.get("minlog")), _number(instance.get("maxlog"))
        if lowest is not None and highest is not None and lowest >= highest:
            # Both are 0 if the signal is used without limits.
            lowest = highest = None
        return SignalDeclaration(name, kind, start, lowest, highest)
    width = 1
    if kind in (SignalKind.GI, SignalKind.GO):
        bits = instance.get("devicemap") or instance.get("unitmap")
        size = len(mapped_bits(bits)) if bits else _number(instance.get("size"))
        width = int(size) if size and 1 <= size <= GROUP_WIDTH else GROUP_WIDTH
    return SignalDeclaration(name, kind, start, 0.0, 2.0**width - 1.0)


def _crosses(
    instances: Iterable[Instance],
) -> tuple[tuple[CrossConnection, ...], tuple[str, ...]]:
    crosses: list[CrossConnection] = []
    for instance in instances:
        result = instance.get("res", "")
        actors = [n for n in range(1, _MOST_ACTORS + 1) if instance.get(f"act{n}")]
        if not result or not actors:
            continue
        joints = tuple(_joint(instance, n) for n in actors[:-1])
        terms = tuple(_term(instance, n) for n in actors)
        words = [("not " if one.negated else "") + one.signal for one in terms]
        rest = zip(joints, words[1:], strict=True)
        text = " ".join((words[0], *(f"{joint} {word}" for joint, word in rest)))
        crosses.append(CrossConnection(result, Condition(text, terms, joints)))
    return _without_rings(crosses)


def _joint(instance: Instance, number: int) -> str:
    return "or" if instance.get(f"oper{number}", "").lower() == "or" else "and"


def _term(instance: Instance, number: int) -> Term:
    negated = instance.get(f"act{number}_invert", "").lower() == SWITCHED_ON
    return Term(instance[f"act{number}"], "<>", 0.0, negated=negated)


def _without_rings(
    crosses: Sequence[CrossConnection],
) -> tuple[tuple[CrossConnection, ...], tuple[str, ...]]:
    kept = tuple(one for one in crosses if not follows_itself(one, crosses))
    left_out = dict.fromkeys(one.result for one in crosses if one not in kept)
    return kept, tuple(f"EIO.cfg: `{name}` depends on itself: skipped" for name in left_out)


def _number(text: str | None) -> float | None:
    try:
        return None if text is None else float(text)
    except ValueError:
        return None
