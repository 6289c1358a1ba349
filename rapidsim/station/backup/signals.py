"""What a controller backup says of its signals: `SYSPAR/EIO.cfg`.

Types, widths, start values and limits of signals, and the cross connections between them. Which
bus and device carries a signal is nothing that a run would need.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rapidsim.controller.cell.conditions import Condition, Term
from rapidsim.controller.cell.description import (
    GROUP_WIDTH,
    CellIo,
    CrossConnection,
    SignalDeclaration,
    SignalKind,
)
from rapidsim.station.backup.cfg_file import SWITCHED_ON, Configuration, Instance
from rapidsim.station.signals import follows_itself

_MOST_ACTORS = 5


def backup_io(types: Configuration) -> tuple[CellIo, tuple[str, ...]]:
    """The signals of an I/O configuration and how they are wired.

    Returns:
        Signals and cross connections, and a remark for each connection that is left out.
    """
    signals = (_signal(one) for one in types.get("EIO_SIGNAL", ()))
    crosses, remarks = _crosses(types.get("EIO_CROSS", ()))
    return CellIo(tuple(one for one in signals if one is not None), crosses), remarks


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
        width = _width(bits) if bits else int(_number(instance.get("size")) or GROUP_WIDTH)
    return SignalDeclaration(name, kind, start, 0.0, 2.0**width - 1.0)


def _width(bits: str) -> int:
    """How many bits `0-3,8` are; as many as a group can have where it cannot be read."""
    count = 0
    for part in bits.replace(" ", "").split(","):
        first, _, last = part.partition("-")
        if first.isdecimal() and (last or first).isdecimal():
            count += abs(int(last or first) - int(first)) + 1
    return min(count, GROUP_WIDTH) or GROUP_WIDTH


def _crosses(
    instances: Iterable[Instance],
) -> tuple[tuple[CrossConnection, ...], tuple[str, ...]]:
    crosses: list[CrossConnection] = []
    remarks: list[str] = []
    for instance in instances:
        result = instance.get("res", "")
        actors = [n for n in range(1, _MOST_ACTORS + 1) if instance.get(f"act{n}")]
        if not result or not actors:
            continue
        joints = {instance.get(f"oper{n}", "and").lower() for n in actors[:-1]}
        if len(joints) > 1:
            remarks.append(f"EIO.cfg: what `{result}` follows joins with AND and OR: left out")
            continue
        terms = tuple(_term(instance, n) for n in actors)
        text = f" {''.join(joints)} ".join(("not " if t.negated else "") + t.signal for t in terms)
        crosses.append(CrossConnection(result, Condition(text, terms, joints == {"or"})))
    return _without_rings(crosses, remarks)


def _term(instance: Instance, number: int) -> Term:
    negated = instance.get(f"act{number}_invert", "").lower() == SWITCHED_ON
    return Term(instance[f"act{number}"], "<>", 0.0, negated=negated)


def _without_rings(
    crosses: Sequence[CrossConnection], remarks: list[str]
) -> tuple[tuple[CrossConnection, ...], tuple[str, ...]]:
    kept = tuple(one for one in crosses if not follows_itself(one, crosses))
    left_out = dict.fromkeys(one.result for one in crosses if one not in kept)
    remarks += [f"EIO.cfg: `{name}` follows itself: left out" for name in left_out]
    return kept, tuple(remarks)


def _number(text: str | None) -> float | None:
    try:
        return None if text is None else float(text)
    except ValueError:
        return None
