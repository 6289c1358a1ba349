"""The signals of a controller backup: `SYSPAR/EIO.cfg`.

Types, widths, default values and limits of signals, and the cross connections between them. A run
does not need to know which bus and device carries a signal.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from rapidsim.controller.cell.conditions import Condition, Term
from rapidsim.controller.cell.description import (
    GROUP_WIDTH,
    CellIo,
    CrossConnection,
    SignalDeclaration,
    SignalKind,
    Status,
    mapped_bits,
)
from rapidsim.station.backup.cfg_file import SWITCHED_ON, Configuration, Instance
from rapidsim.station.signals import follows_itself

_MOST_ACTORS = 5


def backup_io(types: Configuration) -> tuple[CellIo, tuple[str, ...]]:
    """The signals of an I/O configuration and how they are wired.

    Returns:
        Signals and cross connections, and a remark for each connection left out.
    """
    signals = (_signal(one) for one in types.get("EIO_SIGNAL", ()))
    shown, others = _system_outputs(types.get("SYSSIG_OUT", ()))
    declared = (one and _showing(one, shown) for one in signals)
    crosses, remarks = _crosses(types.get("EIO_CROSS", ()))
    io = CellIo(tuple(one for one in declared if one is not None), crosses)
    return io, (*remarks, *others)


def _system_outputs(
    instances: Iterable[Instance],
) -> tuple[Mapping[str, tuple[Status, str | None]], tuple[str, ...]]:
    """What signals show, by folded name, with the task; and a remark for what no run shows."""
    known = {status.lower(): status for status in Status}
    shown: dict[str, tuple[Status, str | None]] = {}
    others: dict[str, list[str]] = {}
    for instance in instances:
        name, word = instance.get("signal", ""), instance.get("status", "")
        if word.lower() in known:
            shown.setdefault(name.lower(), (known[word.lower()], instance.get("arg2")))
        else:
            others.setdefault(word, []).append(f"`{name}`")
    return shown, tuple(
        f"EIO.cfg: {word} is not simulated: {', '.join(names)} keeps its value"
        for word, names in others.items()
    )


def _showing(
    signal: SignalDeclaration, shown: Mapping[str, tuple[Status, str | None]]
) -> SignalDeclaration:
    if signal.name.lower() not in shown:
        return signal
    status, task = shown[signal.name.lower()]
    return replace(signal, value=status.at_start, status=status, task=task)


def _signal(instance: Instance) -> SignalDeclaration | None:
    """One signal; None where it has no name, or a type that RAPID does not know."""
    name = instance.get("name", "")
    word = instance.get("signaltype", "").lower()
    if not name or word not in [one.value for one in SignalKind]:
        return None
    kind = SignalKind(word)
    start = _number(instance.get("default")) or 0.0
    if kind in (SignalKind.AI, SignalKind.AO):
        lowest, highest = _number(instance.get("minlog")), _number(instance.get("maxlog"))
        if lowest is not None and highest is not None and lowest >= highest:
            # Both are 0 where the signal is used without limits.
            lowest = highest = None
        return SignalDeclaration(name, kind, start, lowest, highest)
    width = 1
    if kind in (SignalKind.GI, SignalKind.GO):
        bits = instance.get("devicemap") or instance.get("unitmap")
        size = len(mapped_bits(bits)) if bits else _number(instance.get("size"))
        width = int(size or GROUP_WIDTH)
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
    return kept, tuple(f"EIO.cfg: `{name}` depends on itself: left out" for name in left_out)


def _number(text: str | None) -> float | None:
    try:
        return None if text is None else float(text)
    except ValueError:
        return None
