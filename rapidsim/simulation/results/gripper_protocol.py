"""Check that a program operates grippers correctly.

A gripper takes time to act, and it holds the part between its fingers when they close. So the arm
must be at rest before it closes, and remain so until the feedback confirms it; the controller must
know the mass of the part while it is carried; and a part that was picked up must be put down. No
violation stops a program: the part is missing, or falls, or the arm vibrates.

The states follow from the signals of a run and from its moves, so they span routines, traps and
tasks. Each fault is reported once for each statement that commits it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from rapidsim.controller.cell.conditions import Condition
from rapidsim.controller.cell.description import Gripper
from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.executed_moves import MoveColumns
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.findings.gripper import (
    GripLoadMissing,
    GripperActsInMotion,
    GripperActsTooSoon,
    GripperNeverOpens,
    GripperNotAwaited,
    GripperOpensEmpty,
)
from rapidsim.language.moves import Place
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.simulation.results.simulation import End, RobotRun, Simulation
from rapidsim.values import value_class

_REST_RAD = 1e-5
"""A joint that turns by less than this until the arm is at rest does not move."""
_SAME_TIME_S = 1e-9
_APPROACH_MM = 5.0
"""Least travel [mm] along the tool after a switch that shows that the gripper acted too early."""
_STRAIGHT = 0.9
"""Share of a move that is along the tool if it approaches a part."""
_NOTHING_KG = 0.01
"""RAPID's load0 has a mass, of 1 g."""
_ROUTINE_END = re.compile(r"\bEND(PROC|FUNC|TRAP)\b", re.IGNORECASE)


@value_class(frozen=True, slots=True)
class _Switch:
    """The start of closing or opening of a gripper."""

    time_s: float
    closes: bool
    place: Place | None
    """The statement that sets the signal; None if no statement does."""
    moves_before: int | None
    """Number of moves of the robot before it; None if another task sets the signal."""

    def precedes(self, moves: MoveColumns) -> Mask:
        """Which moves (k,) follow in the program, or in time if the program order is unknown."""
        if self.moves_before is not None:
            return moves.index >= self.moves_before
        return moves.start_s >= self.time_s - _SAME_TIME_S


@value_class(frozen=True, slots=True)
class _Fault:
    violation: Violation
    place: Place


def gripper_findings(simulation: Simulation, grippers: Sequence[Gripper]) -> tuple[Diagnostic, ...]:
    """Return the gripper faults of a run, one for each statement and kind."""
    found: dict[tuple[type[Violation], str, int], list[_Fault]] = {}
    for gripper in grippers:
        robot = _robot_of(gripper, simulation)
        if robot is None:
            continue
        for fault in _faults(gripper, robot, simulation):
            span = fault.place.span
            key = (type(fault.violation), str(span.file), span.start)
            found.setdefault(key, []).append(fault)
    return tuple(_merged(faults) for faults in found.values())


def _robot_of(gripper: Gripper, simulation: Simulation) -> RobotRun | None:
    if gripper.task is None:
        return simulation.robots[0]
    wanted = gripper.task.lower()
    return next((one for one in simulation.robots if one.task.lower() == wanted), None)


def _merged(faults: Sequence[_Fault]) -> Diagnostic:
    first, *others = faults
    violation = first.violation
    if others and "times" in violation.facts:
        facts = {name: getattr(violation, name) for name in violation.facts}
        facts["times"] = f" (the first of {len(faults)} times)"
        violation = type(violation)(**facts)
    return Diagnostic(violation, first.place.span, routine=first.place.routine)


def _faults(gripper: Gripper, robot: RobotRun, simulation: Simulation) -> Iterator[_Fault]:
    switches = list(_switches(gripper.close, robot.task, simulation))
    columns = robot.moves.columns
    for number, switch in enumerate(switches):
        following = switches[number + 1 :]
        until_s = following[0].time_s if following else simulation.time_s
        follows = switch.precedes(columns)
        made = (columns.start_s < until_s) & (columns.end_s > columns.start_s)
        moves = [robot.moves[at] for at in np.flatnonzero(follows & made).tolist()]
        if switch.place is not None and gripper.at == "stand":
            early = [*_in_motion(gripper, robot, switch)]
            may_hold = switch.closes or number > 0
            yield from early or (_too_soon(gripper, robot, switch, moves) if may_hold else ())
        if switch.closes:
            yield from _while_closed(gripper, robot, simulation, switch, moves)
            is_over = simulation.end in (End.ENDED, End.CYCLE_LIMIT) and not following
            if is_over and switch.place is not None:
                yield _Fault(GripperNeverOpens(gripper.name, "the end of main"), switch.place)
        else:
            has_moved = not follows[:1].all()
            if number == 0 and switch.place is not None and has_moved:
                yield _Fault(GripperOpensEmpty(gripper.name), switch.place)
            yield from _loaded_when_open(gripper, moves)


def _switches(close: Condition, task: str, simulation: Simulation) -> Iterator[_Switch]:
    """Yield the changes of the condition of a gripper after its value at the start."""
    for holds, event in _changes(close, simulation):
        if event is not None:
            before = event.moves_given if event.task == task and event.place else None
            yield _Switch(event.time_s, holds, event.place, before)


def _changes(condition: Condition, simulation: Simulation) -> Iterator[tuple[bool, Event | None]]:
    """Yield the value of a condition at the start, with no event, and at each change."""
    names = {name.lower() for name in condition.signals()}
    values = {name.lower(): value for name, value in simulation.signal_starts.items()}

    def holds_now() -> bool:
        return condition.holds(lambda name: values.get(name.lower(), 0.0))

    holds = holds_now()
    yield holds, None
    for event in simulation.events:
        signal = str(event.details.get("signal", "")).lower()
        if (
            event.kind is not EventKind.SIGNAL
            or signal not in names
            or "value" not in event.details
        ):
            continue
        values[signal] = _number(event.details["value"])
        if holds_now() is not holds:
            holds = not holds
            yield holds, event


def _number(value: object) -> float:
    return float(value) if isinstance(value, int | float) else 0.0


def _in_motion(gripper: Gripper, robot: RobotRun, switch: _Switch) -> Iterator[_Fault]:
    """Yield a fault if a gripper acts before the active move has ended."""
    columns = robot.moves.columns
    lasts = columns.end_s > switch.time_s + _SAME_TIME_S
    under_way = np.flatnonzero(lasts & ~switch.precedes(columns))
    if not len(under_way) or switch.place is None:
        return
    rest_s = float(columns.end_s[under_way[-1]])
    samples = robot.sample(np.array([switch.time_s, rest_s]))
    turned = float(np.max(np.abs(samples.joints[1] - samples.joints[0])))
    if turned < _REST_RAD:
        return
    here, there = samples.base_from_tcp.translation
    distance_mm = 1000.0 * float(np.linalg.norm(there - here))
    action = "closes" if switch.closes else "opens"
    violation = GripperActsInMotion(gripper.name, action, rest_s - switch.time_s, distance_mm)
    yield _Fault(violation, switch.place)


def _too_soon(
    gripper: Gripper, robot: RobotRun, switch: _Switch, moves: Sequence[ExecutedMove]
) -> Iterator[_Fault]:
    """Yield a fault if a gripper acts during the approach: the next move continues along the tool.

    After picking up or putting down a part, a robot retracts against the tool direction.
    """
    if not moves or switch.place is None:
        return
    first = moves[0]
    tcp = robot.sample(switch.time_s).base_from_tcp
    way_mm = 1000.0 * (first.base_from_tcp.translation - tcp.translation[0])
    along_mm = float(way_mm @ tcp.rotation[0][:, 2])
    if along_mm < _APPROACH_MM or along_mm < _STRAIGHT * float(np.linalg.norm(way_mm)):
        return
    target = first.place.arguments.get("topoint", "its target")
    action = "closes" if switch.closes else "opens"
    yield _Fault(GripperActsTooSoon(gripper.name, action, along_mm, target), switch.place)


def _while_closed(
    gripper: Gripper,
    robot: RobotRun,
    simulation: Simulation,
    switch: _Switch,
    moves: Sequence[ExecutedMove],
) -> Iterator[_Fault]:
    """Yield the faults with a part in the gripper, from the first move on."""
    if not moves:
        return
    place = switch.place or moves[0].place
    closed = gripper.closed
    if closed is not None:
        confirmed_s = _true_from(closed, simulation, switch.time_s)
        moves_s = moves[0].start_s
        if confirmed_s is None or confirmed_s > moves_s + _SAME_TIME_S:
            later = "" if confirmed_s is None else f" for another {confirmed_s - moves_s:.3f} s"
            yield _Fault(GripperNotAwaited(gripper.name, closed.text, f"not true{later}"), place)
        elif not _reads(closed, robot, simulation, switch, moves[0]):
            state = "true by then, but nothing reads it"
            yield _Fault(GripperNotAwaited(gripper.name, closed.text, state), place)
    if gripper.load_kg > 0.0 and not any(map(_is_loaded, moves)):
        problem = f"holds {gripper.load_kg:g} kg, but GripLoad is not set for {_counted(moves)}"
        yield _Fault(GripLoadMissing(gripper.name, problem), place)


def _loaded_when_open(gripper: Gripper, moves: Sequence[ExecutedMove]) -> Iterator[_Fault]:
    loaded = [move for move in moves if _is_loaded(move)]
    if loaded:
        carried = f"{loaded[0].grip_load_kg:g} kg"
        problem = f"is open, but GripLoad is still {carried} for {_counted(loaded)}"
        yield _Fault(GripLoadMissing(gripper.name, problem), loaded[0].place)


def _is_loaded(move: ExecutedMove) -> bool:
    return move.grip_load_kg > _NOTHING_KG


def _counted(moves: Sequence[ExecutedMove]) -> str:
    return "a move" if len(moves) == 1 else f"{len(moves)} moves"


def _true_from(condition: Condition, simulation: Simulation, start_s: float) -> float | None:
    """First time [s] from a start on at which a condition holds; None if it never does."""
    held = False
    for holds, event in _changes(condition, simulation):
        if event is not None and event.time_s > start_s + _SAME_TIME_S:
            return start_s if held else event.time_s
        held = holds
    return start_s if held else None


def _reads(
    condition: Condition,
    robot: RobotRun,
    simulation: Simulation,
    switch: _Switch,
    move: ExecutedMove,
) -> bool:
    """Whether the program reads a signal of a condition between a switch and a move.

    Waits are known one by one; of other statements only the text of the routines is.
    """
    texts = [
        line.place.span.text
        for line in robot.lines
        if switch.time_s - _SAME_TIME_S <= line.time_s <= move.start_s + _SAME_TIME_S
    ]
    texts += [
        wait.awaited
        for wait in simulation.waits
        if wait.end_s >= switch.time_s and wait.start_s <= move.start_s + _SAME_TIME_S
    ]
    if switch.place is not None:
        texts += _texts_between(switch.place, move.place)
    names = "|".join(map(re.escape, condition.signals()))
    return any(re.search(rf"\b(?:{names})\b", text, re.IGNORECASE) for text in texts)


def _texts_between(first: Place, last: Place) -> Iterator[str]:
    """Yield the text between two statements, across routines to the end and from the start."""
    text, start = first.span.source.text, first.span.start
    end = _ROUTINE_END.search(text, start)
    is_same = first.span.file == last.span.file and first.routine == last.routine
    if is_same and start <= last.span.start:
        yield text[start : last.span.start]
        return
    yield text[start : len(text) if end is None else end.start()]
    before = last.span.source.text[: last.span.start]
    begins = [match.end() for match in _ROUTINE_END.finditer(before)]
    yield before[begins[-1] if begins else 0 :]


def with_gripper_findings(simulation: Simulation, grippers: Sequence[Gripper]) -> Simulation:
    """Return the run with its gripper faults among the findings."""
    if not grippers:
        return simulation
    found = gripper_findings(simulation, grippers)
    return replace(simulation, diagnostics=(*simulation.diagnostics, *found))
