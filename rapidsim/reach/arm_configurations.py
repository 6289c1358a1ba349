"""Joints of the arm at the end of each known move, in the stored configuration if possible.

Lines and arcs whose configuration is not monitored, or not reachable, arrive in the configuration
that their path leads to. If even that is unknown, the next path is not checked. Behind a target out
of reach the arm is where it would be without that move.
"""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet

import numpy as np

from rapidsim.controller.moves.configuration_choice import nearest_without_switch
from rapidsim.controller.moves.first_start import first_configuration
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.compliance import Match, hold
from rapidsim.motion.configurations.confdata import (
    Integers,
    configuration,
    configurations,
    has_branches,
)
from rapidsim.motion.configurations.reachability import (
    external_excess,
    pose_excess,
    programmed_excess,
    turns_within_limits,
)
from rapidsim.motion.geometry.curves import circle_fault
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.wrist_circle import wrist_circle_error
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.circle_modes import is_wrist_driven, may_be_wrist_driven
from rapidsim.reach.dataflow.known_moves import KnownMove, KnownMoves
from rapidsim.reach.move_segments import segment_of_row
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.repeated_rows import Index
from rapidsim.syntax.tree.bulk_statements import ROBCONF
from rapidsim.values import value_class

MOST_SEARCHED = 40
"""Largest number of targets that are solved iteratively; the others need a run."""
_BATCH = 4096
_MOST = 9999.0


@value_class(frozen=True, slots=True, eq=False)
class EndSolutions:
    """Solutions of the arm for the end of each move, independent of the moves before."""

    looked_at: Mask
    reachable: Mask
    """Whether some configuration within the limits reaches the end."""
    stored_works: Mask
    """Whether the arm meets the stored configuration."""
    on_stored_branch: Mask
    """Whether a run continues: configuration met, or an axis two quarters off on its branch."""
    match: Integers
    """Shape (k,): the `Match` of the joints; OTHER for moves to axis positions."""
    stored: Array
    """Shape (k, n) [rad]: joints in the stored configuration, if the arm can hold it; else 0."""


@value_class(frozen=True, slots=True, eq=False)
class EndConfigurations:
    """Joints of the arm at the end of each move."""

    joints: Array
    """Shape (k, n) [rad]; 0 if unknown."""
    sure: Mask


@value_class(frozen=True, slots=True, eq=False)
class Beginning:
    """Start of a run of main."""

    joints: Array
    """Shape (n,) [rad]."""
    is_free: bool
    """Whether it begins in the configuration of the first target instead."""


def ends_of(posed: PosedMoves, robot: Robot, *, exact: bool = False) -> EndSolutions:
    """Solve the ends of all moves; `exact` tolerates no quarter turn."""
    count = len(posed.moves)
    looked_at = posed.is_placed.copy()
    past = external_excess(robot, posed.external).any(axis=-1)
    reachable, works, held = (np.zeros(count, dtype=bool) for _ in range(3))
    matches = np.full(count, Match.OTHER, dtype=np.int64)
    stored = np.zeros((count, len(robot.joints)))
    to_axes = np.flatnonzero(looked_at & posed.to_axes)
    stored[to_axes] = posed.axes[to_axes]
    works[to_axes] = ~programmed_excess(robot, posed.axes[to_axes]).any(axis=-1)
    reachable[to_axes] = held[to_axes] = works[to_axes]
    led = posed.moves.each(lambda known: is_wrist_driven(known, robot))
    # Feasibility follows from the path; the target pose itself is not reached.
    reachable[looked_at & led] = True
    rows = np.flatnonzero(looked_at & ~posed.to_axes & ~led)
    if not has_branches(robot.kinematics):
        looked_at[rows[MOST_SEARCHED:]] = False
        rows = rows[:MOST_SEARCHED]
    for first in range(0, len(rows), _BATCH):
        at = rows[first : first + _BATCH]
        confdata = confdata_columns(posed.moves, at)
        solved = solved_ends(robot, posed.base_from_flange[at], confdata, exact=exact)
        reachable[at], works[at], held[at] = (
            solved.reachable,
            solved.stored_works,
            solved.on_stored_branch,
        )
        matches[at], stored[at] = solved.match, solved.stored
    reachable[past], works[past], held[past] = False, False, False
    return EndSolutions(looked_at, reachable, works, held, matches, stored)


@value_class(frozen=True, slots=True, eq=False)
class SolvedEnds:
    """Solutions of the arm for poses (k,); see `EndSolutions`."""

    reachable: Mask
    stored_works: Mask
    on_stored_branch: Mask
    match: Integers
    stored: Array


def solved_ends(
    robot: Robot, base_from_flange: Transform, confdata: Array, *, exact: bool = False
) -> SolvedEnds:
    """Solve poses (k,) whose targets store configurations (k, 4)."""
    near = turns_within_limits(robot, np.zeros(len(robot.joints)))
    branches = robot.inverse(base_from_flange)
    turned = turns_within_limits(robot, branches.joints)
    within: Mask = branches.exists & ~pose_excess(robot, turned).any(axis=-1)
    best = hold(robot, base_from_flange, confdata, near)
    met = best.possible & (best.match <= (Match.EXACT if exact else Match.COMPLIANT))
    stored = np.where(best.possible[:, None], best.joints, 0.0)
    held = met if exact else best.possible
    return SolvedEnds(np.asarray(within.any(axis=-1)), met, held, best.match, stored)


def stances_of(
    posed: PosedMoves,
    ends: EndSolutions,
    robot: Robot,
    model: MotionModel,
    arrivals: Mapping[int, Array],
    lost: AbstractSet[int] = frozenset(),
    beginning: Beginning | None = None,
) -> EndConfigurations:
    """Return the joints of the arm at the end of each move.

    Args:
        posed: The moves.
        ends: Solutions for their ends.
        robot: The arm.
        model: Its motion model.
        arrivals: Joints (n,) [rad] of rows known not to arrive in the stored configuration.
        lost: Rows whose path fails; without a stored configuration, their end is unknown.
        beginning: Start of a run of main; None if unknown.
    """
    count, moves = len(posed.moves), posed.moves
    joints = np.zeros((count, len(robot.joints)))
    sure = np.zeros(count, dtype=bool)
    may_be_led = moves.each(lambda known: may_be_wrist_driven(known, robot))
    as_stored = ends.stored_works & moves.each(lambda known: is_monitored(known, robot))
    in_line = moves.each(lambda known: known.move.interpolation.leads_tcp) & ~may_be_led
    in_line &= ends.reachable & ~as_stored
    in_line &= moves.previous == np.arange(-1, count - 1)
    settled = np.zeros(count, dtype=bool)
    settled[[*arrivals, *lost]] = True
    in_line &= ~settled
    ahead = (posed.to_axes | as_stored) & ~may_be_led
    joints[ahead], sure[ahead] = ends.stored[ahead], ends.stored_works[ahead]
    for row, arrival in arrivals.items():
        joints[row], sure[row], ahead[row] = arrival, True, True
    # What follows a target out of reach is checked as if that move were left out.
    out_of_reach = ends.looked_at & ~ends.reachable
    # The row after the last of consecutive lines that end in the branch of their start.
    stops = np.append(np.flatnonzero(~in_line), count)
    stop = 0
    for row in np.flatnonzero(~ahead).tolist():
        if row < stop:
            continue
        known, before = moves.like(row), int(moves.previous[row])
        while before >= 0 and out_of_reach[before]:
            before = int(moves.previous[before])
        if may_be_led[row]:
            led = _wrist_circle_end(posed, ends, robot, model, row, joints, sure)
            if led is not None:
                joints[row], sure[row] = led, True
        elif moves.begins[row] and beginning is not None and ends.reachable[row]:
            first = _first_end(posed, ends, robot, beginning, row)
            if first is not None:
                joints[row], sure[row] = first, True
        elif before >= 0 and sure[before] and ends.reachable[row]:
            start = joints[before]
            if _continues_turned(known, ends, row, robot):
                flange, stored = posed.base_from_flange[row : row + 1], confdata_columns(moves, row)
                joints[row], sure[row] = hold(robot, flange, stored, start).joints[0], True
            elif known.move.interpolation.leads_tcp:
                stop = int(stops[stops.searchsorted(row, "right")])
                if row not in lost:
                    _follow(posed, robot, range(row, stop), start, joints, sure)
            elif is_free(known):
                found = configurations(robot, posed.base_from_flange[row])
                if found:
                    at_start = configuration(robot.kinematics, start)
                    joints[row] = nearest_without_switch(found, at_start).joints
                    sure[row] = True
    return EndConfigurations(joints, sure)


def _first_end(
    posed: PosedMoves, ends: EndSolutions, robot: Robot, beginning: Beginning, row: int
) -> Array | None:
    """Joints (n,) [rad] at the end of the first move of a run; None if unknown."""
    known, flange = posed.moves[row], posed.base_from_flange[row]
    monitored = is_monitored(known, robot)
    if not has_branches(robot.kinematics) or not (monitored or is_free(known)):
        return None
    if monitored and not ends.on_stored_branch[row]:
        return None
    if beginning.is_free:
        stored = stored_confdata(posed.moves, row)
        start = beginning.joints
        first = first_configuration(robot, flange, stored, start, monitored=monitored)
    elif known.move.interpolation.leads_tcp or monitored:
        return None
    else:
        working = configurations(robot, flange)
        before = configuration(robot.kinematics, beginning.joints)
        first = nearest_without_switch(working, before) if working else None
    return None if first is None else first.joints


def _continues_turned(known_move: KnownMove, ends: EndSolutions, row: int, robot: Robot) -> bool:
    """Whether a joint move ends in another turn than the stored one, and a run continues."""
    to_pose = not known_move.move.interpolation.leads_tcp
    return to_pose and bool(ends.on_stored_branch[row]) and is_monitored(known_move, robot)


def is_monitored(known_move: KnownMove, robot: Robot) -> bool:
    """Whether the controller certainly enforces the stored configuration at the end of a move."""
    monitored = _monitoring(known_move) is True
    return monitored and has_branches(robot.kinematics) and not is_wrist_driven(known_move, robot)


def is_free(known_move: KnownMove) -> bool:
    """Whether the configuration is certainly not monitored: ConfJ or ConfL is off."""
    return _monitoring(known_move) is False


def _monitoring(known_move: KnownMove) -> bool | None:
    """Whether ConfJ or ConfL, as applies to a move, is on; None if undetermined."""
    name = "conf_l" if known_move.move.interpolation.leads_tcp else "conf_j"
    return None if name in known_move.uncertain else bool(getattr(known_move.settings, name))


def stored_confdata(moves: KnownMoves, row: int) -> tuple[int, int, int, int]:
    """Return cf1, cf4, cf6 and cfx of a move to a pose; absurdly large numbers are clamped."""
    cf1, cf4, cf6, cfx = map(round, confdata_columns(moves, row)[0].tolist())
    return cf1, cf4, cf6, cfx


def confdata_columns(moves: KnownMoves, rows: Index | int) -> Array:
    """Return the stored cf1, cf4, cf6 and cfx of the targets of moves to poses, shape (k, 4)."""
    written = moves.numbers(np.atleast_1d(rows))[:, ROBCONF]
    return np.rint(np.clip(written, -_MOST, _MOST))


def _wrist_circle_end(
    posed: PosedMoves,
    ends: EndSolutions,
    robot: Robot,
    model: MotionModel,
    row: int,
    joints: Array,
    sure: Mask,
) -> Array | None:
    """Joints (n,) [rad] at the end of an arc that two wrist axes orient; None if unknown."""
    known = posed.moves[row]
    before = known.previous
    starts = before is not None and sure[before] and ends.looked_at[row]
    if not starts or not is_wrist_driven(known, robot):
        return None
    segment = segment_of_row(posed, joints, robot, model, row)
    if circle_fault(segment) is not None:
        return None
    led = wrist_circle_error(robot.kinematics, segment)
    if led is None or pose_excess(robot, led.arrival).any():
        return None
    return led.arrival


def _follow(
    posed: PosedMoves, robot: Robot, rows: range, start: Array, joints: Array, sure: Mask
) -> None:
    """Follow a chain of lines from its start joints (n,), as far as the branch is feasible."""
    branch = int(robot.kinematics.branch_of(start))
    for first in rows[::_BATCH]:
        at = slice(first, min(first + _BATCH, rows.stop))
        followed = robot.kinematics.inverse_on_branch(posed.base_from_flange[at], branch, start)
        good = followed.exists & ~pose_excess(robot, followed.joints).any(axis=-1)
        sure[at] = good = np.logical_and.accumulate(good)
        joints[at] = np.where(good[:, None], followed.joints, 0.0)
        if not good[-1]:
            break
        start = followed.joints[-1]
