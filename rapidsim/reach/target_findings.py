"""Findings about the ends of known moves: reach, limits, configurations, margins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.reach_and_motion_data import (
    ConfigurationNotReachable,
    JointOutOfRange,
    UnreachableTarget,
)
from rapidsim.findings.reachability import JointWindUp, LowJointMargin
from rapidsim.frames.transform import Array
from rapidsim.motion.configurations.confdata import confdata_of, select, told_apart
from rapidsim.motion.configurations.reach_cures import reason_with_lengths
from rapidsim.motion.configurations.reachability import (
    limit_excess,
    turns_within_limits,
    why_unreachable,
)
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.arm_configurations import Ends, Stances, is_free, is_monitored, stored_confdata
from rapidsim.reach.cures import Cures
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.reach.wording import confdata_fix, data_of, declared, target_span, target_text

LOW_MARGIN = np.radians(5.0)

Confdata = tuple[int, int, int, int]


def unreachable_findings(
    program: Program, posed: PosedMoves, ends: Ends, robot: Robot, cures: Cures
) -> Iterator[Diagnostic]:
    """K601 and K602: ends that no configuration reaches, and axis positions past their limits."""
    for row in np.flatnonzero(ends.looked_at & ~ends.reachable).tolist():
        known = posed.moves[row]
        name, span = target_text(program, known), target_span(program, known)
        if posed.to_axes[row]:
            why = _over(robot, posed.axes[row])
            found = JointOutOfRange(name, robot.title, why)
            yield Diagnostic(found, span, routine=known.routine)
            continue
        pose = posed.base_from_flange[row]
        reason = why_unreachable(robot, pose)
        if reason is None:
            continue
        why = reason_with_lengths(robot, pose, reason)
        wobj = data_of(program, known, "wobj")
        related = declared(wobj, "`{name}`, the work object, is declared here")
        unreachable = UnreachableTarget(name, robot.title, why, cures.of(row))
        yield Diagnostic(unreachable, span, related, routine=known.routine)


def configuration_findings(
    program: Program, posed: PosedMoves, ends: Ends, robot: Robot
) -> Iterator[Diagnostic]:
    """K603: the stored configuration does not work where it is monitored, and which ones do."""
    stale = ends.looked_at & ends.reachable & ~ends.stored_works & ~posed.to_axes
    rows = [row for row in np.flatnonzero(stale).tolist() if is_monitored(posed.moves[row], robot)]
    working = _working(posed, robot, rows)
    for row, choices in zip(rows, working, strict=True):
        if not choices:
            continue
        known = posed.moves[row]
        found = ConfigurationNotReachable(
            target_text(program, known),
            conf_text(stored_confdata(known)),
            conf_text(choices[0]),
            tuple(map(conf_text, choices)),
        )
        yield Diagnostic(
            found,
            target_span(program, known),
            fix=confdata_fix(program, known, choices[0]),
            routine=known.routine,
        )


def margin_findings(
    program: Program, posed: PosedMoves, ends: Ends, stances: Stances, robot: Robot
) -> Iterator[Diagnostic]:
    """K607: an axis near its limit at the end of a move."""
    below, above = stances.joints - robot.lower, robot.upper - stances.joints
    margin = np.minimum(below, above)
    low = ends.looked_at & ends.reachable & stances.sure & (margin < LOW_MARGIN).any(axis=-1)
    for row in np.flatnonzero(low).tolist():
        axis = int(margin[row].argmin())
        limit = robot.lower[axis] if below[row, axis] < above[row, axis] else robot.upper[axis]
        known = posed.moves[row]
        found = LowJointMargin(
            target_text(program, known),
            axis + 1,
            float(np.degrees(stances.joints[row, axis])),
            max(0.0, float(np.degrees(margin[row, axis]))),
            round(float(np.degrees(limit)), 6),
        )
        yield Diagnostic(found, target_span(program, known), routine=known.routine)


def wind_up_findings(
    program: Program, posed: PosedMoves, stances: Stances, robot: Robot
) -> Iterator[Diagnostic]:
    """K608: the same move of the same place arrives with an axis whole turns further."""
    first_of: dict[object, int] = {}
    for row in np.flatnonzero(stances.sure & ~posed.to_axes).tolist():
        known = posed.moves[row]
        first = first_of.setdefault((known.call, known.move), row)
        step = stances.joints[row] - stances.joints[first]
        turns = np.round(step / (2.0 * np.pi))
        axis = int(np.abs(turns).argmax())
        if not turns[axis] or not is_free(known):
            continue
        limit = robot.upper[axis] if step[axis] > 0.0 else robot.lower[axis]
        degrees = np.degrees([step[axis], *stances.joints[[first, row], axis], limit])
        found = JointWindUp(target_text(program, known), axis + 1, *map(float, degrees))
        yield Diagnostic(found, target_span(program, known), routine=known.routine)


def conf_text(conf: Sequence[int]) -> str:
    """Confdata as RAPID writes it."""
    return f"[{','.join(map(str, conf))}]"


def _over(robot: Robot, joints: Array) -> str:
    excess = limit_excess(robot, joints)
    return ", ".join(
        f"axis {axis + 1} at {np.degrees(joints[axis]):.1f} deg, "
        f"{np.degrees(abs(excess[axis])):.1f} deg past its limit"
        for axis in np.flatnonzero(excess)
    )


def _working(posed: PosedMoves, robot: Robot, rows: list[int]) -> list[list[Confdata]]:
    """The configurations that reach the ends of moves, those like the stored one first."""
    if not rows or not told_apart(robot.kinematics):
        return [[] for _ in rows]
    stored = np.array([stored_confdata(posed.moves[row]) for row in rows])
    near = turns_within_limits(robot, np.zeros(len(robot.joints)))
    found: list[list[Confdata]] = [[] for _ in rows]
    for branch in range(robot.kinematics.branch_count):
        wanted = stored.copy()
        wanted[:, 3] = branch
        selected = select(robot, posed.base_from_flange[np.array(rows)], wanted, near)
        # The turns nearest to those stored, else those in the middle of the range.
        for joints in (selected.joints, turns_within_limits(robot, selected.joints)):
            within = selected.exists & ~limit_excess(robot, joints).any(axis=-1)
            named = confdata_of(robot.kinematics, joints)
            for at in np.flatnonzero(within).tolist():
                cf1, cf4, cf6, cfx = named[at].tolist()
                if (cf1, cf4, cf6, cfx) not in found[at]:
                    found[at].append((cf1, cf4, cf6, cfx))
    for choices, meant in zip(found, stored.tolist(), strict=True):
        choices.sort(
            key=lambda conf: (
                conf[3] != meant[3],
                sum(abs(a - b) for a, b in zip(conf[:3], meant[:3], strict=True)),
                conf,
            )
        )
    return found
