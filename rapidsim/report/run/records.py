"""Moves and waits of a run as records in mm, degrees and seconds: of the JSON, and of Python.

Field by field they are what `rapidsim run --format json` prints; there numbers are rounded, and
infinite ones null.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated

import numpy as np

from rapidsim.controller.journal.events import Wait
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.json_records.declarations import Key, OrAbsent, Rounded
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.simulation.results.active_limits import limits_of_moves
from rapidsim.simulation.results.curve_deviations import CurveDeviation, all_curve_deviations
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.time_shares import argument, instruction_of
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class PoseRecord:
    """A pose."""

    position_mm: tuple[Rounded, ...]
    quaternion: tuple[Rounded, ...]
    """Scalar first."""
    frame: str
    """Frame of the pose; `base` is the base frame of the robot."""


@value_class(frozen=True, slots=True)
class DeviationRecord:
    """Greatest path deviation of the TCP from a line or arc between its zones."""

    max_mm: Rounded
    rms_mm: Rounded


@value_class(frozen=True, slots=True, repr=False)
class MoveRecord:
    """A move as it was made; target, joints and configuration are the programmed end."""

    index: int
    task: str
    instruction: str
    file: str
    line: int
    routine: str
    to: str | None
    """The target as the program writes it."""
    tool: str | None
    wobj: str
    speed_mm_s: Rounded
    zone_mm: Rounded
    """That was used; 0 for a stop."""
    start_s: Rounded
    end_s: Rounded
    length_mm: Rounded
    """Along the programmed path, before corners are cut."""
    deviation: DeviationRecord | None
    """None for joint moves."""
    corner: Annotated[str, CornerKind]
    """`fly-by`, `stop` or `stop(corner path failure)`."""
    corner_reason: str
    """Why the zone is not the programmed one, or why the arm stops; empty where it is."""
    limit: str
    """Limit that is active for most of its time, such as `torque of axis 2`; empty if none is."""
    target: PoseRecord
    joints_deg: tuple[Rounded, ...]
    conf: tuple[int, ...]
    """cf1, cf4, cf6, cfx."""
    external: OrAbsent[Mapping[str, Rounded]] = None
    """External axes by component [mm or degrees]; None if there are no external axes."""
    conveyor: OrAbsent[str] = None
    """Conveyor whose object the arm follows at the end of the move; absent if it follows none."""

    def __repr__(self) -> str:
        """One line."""
        return _short(f"{self.instruction} {self.to}, line {self.line}", self.start_s, self.end_s)


@value_class(frozen=True, slots=True, repr=False)
class WaitRecord:
    """A statement that let time pass."""

    task: str
    file: str
    line: int
    routine: str
    instruction: str
    awaited: Annotated[str, Key("for")]
    """Condition of the wait as the program writes it; `for` in the JSON."""
    start_s: Rounded
    end_s: Rounded
    ended_by: str
    """Why it ended, and what caused that."""

    def __repr__(self) -> str:
        """One line."""
        what = f"{self.instruction} for {self.awaited}, line {self.line}"
        return _short(what, self.start_s, self.end_s)


def move_records(simulation: Simulation) -> tuple[MoveRecord, ...]:
    """The moves of all robots, robot after robot, numbered through."""
    deviations, limits = all_curve_deviations(simulation), limits_of_moves(simulation)
    return tuple(
        _move(
            move,
            simulation.robot_of(move.task).robot.external,
            deviations.get(move.index),
            limits.get(move.index, ""),
        )
        for move in simulation.moves
    )


def wait_records(simulation: Simulation) -> tuple[WaitRecord, ...]:
    """The waits of all tasks in order of their starts."""
    return tuple(map(_wait, simulation.waits))


def _move(
    move: ExecutedMove,
    axes: Sequence[ExternalAxis],
    deviation: CurveDeviation | None,
    limit: str,
) -> MoveRecord:
    external = {
        axis.component: float(value * axis.scale)
        for axis, value in zip(axes, move.external, strict=bool(axes))
    }
    return MoveRecord(
        index=move.index,
        task=move.task,
        instruction=move.move.instruction,
        file=move.place.span.file,
        line=move.place.span.line,
        routine=move.place.routine,
        to=argument(move.place, "topoint", "tojointpos"),
        tool=argument(move.place, "tool"),
        wobj=argument(move.place, "wobj") or "wobj0",
        speed_mm_s=float(move.move.speed.v_tcp),
        zone_mm=move.zone_m * 1000.0,
        start_s=move.start_s,
        end_s=move.end_s,
        length_mm=move.length_m * 1000.0,
        deviation=None if deviation is None else _deviation(deviation),
        corner=move.corner.value,
        corner_reason=move.corner_reason,
        limit=limit,
        target=PoseRecord(
            tuple(float(x * 1000.0) for x in move.base_from_tcp.translation),
            tuple(map(float, move.base_from_tcp.quaternion)),
            "base",
        ),
        joints_deg=tuple(map(float, np.degrees(move.joints))),
        conf=tuple(map(int, move.conf)),
        external=external or None,
        conveyor=move.conveyor,
    )


def _deviation(deviation: CurveDeviation) -> DeviationRecord:
    return DeviationRecord(1000.0 * deviation.largest, 1000.0 * deviation.rms)


def _wait(wait: Wait) -> WaitRecord:
    span = wait.place.span
    return WaitRecord(
        task=wait.task,
        file=span.file,
        line=span.line,
        routine=wait.place.routine,
        instruction=instruction_of(wait),
        awaited=wait.awaited,
        start_s=wait.start_s,
        end_s=wait.end_s,
        ended_by=wait.ended_by,
    )


def _short(subject: str, start_s: float, end_s: float) -> str:
    shown = subject if len(subject) <= 80 else f"{subject[:77]}..."
    return f"<{shown}, {start_s:.3f} to {end_s:.3f} s>"
