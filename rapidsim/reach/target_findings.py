"""Findings about the ends of known moves: reach, limits, configurations, margins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.controller.moves.configuration_choice import (
    by_stored,
    conf_text,
    is_switch,
    not_as_stored,
    past_limit,
    replacement_finding,
)
from rapidsim.controller.moves.motion_findings import (
    WRIST_TURNS_FAR,
    switched,
    wrist_turning_far,
)
from rapidsim.controller.moves.target_checks import frame_orientations
from rapidsim.controller.moves.target_labels import named_target
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.findings.reach_and_motion_data import (
    JointOutOfRange,
    UnreachableTarget,
)
from rapidsim.findings.reachability import (
    ConfigurationQuarterOff,
    JointWindUp,
    LowJointMargin,
    Overload,
)
from rapidsim.frames.quaternion import norm
from rapidsim.frames.transform import Array
from rapidsim.language.data import Orient, RobTarget
from rapidsim.language.moves import Interpolation
from rapidsim.language.target_violations import QuaternionNotUnit
from rapidsim.motion.configurations.compliance import Match
from rapidsim.motion.configurations.confdata import confdata_of, configuration, has_branches
from rapidsim.motion.configurations.reach_suggestions import reason_with_lengths
from rapidsim.motion.configurations.reachability import (
    external_excess,
    programmed_excess,
    unreachable_reason,
)
from rapidsim.motion.configurations.targets import is_no_orientation
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.robot.external_axes import ExternalAxis, amount_text
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.arm_configurations import (
    EndConfigurations,
    EndSolutions,
    is_free,
    is_monitored,
    stored_confdata,
)
from rapidsim.reach.dataflow.known_moves import KnownMove
from rapidsim.reach.suggestions import ReachSuggestions
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.reach.wording import (
    argument,
    confdata_fix,
    data_of,
    declared,
    target_span,
    target_text,
    tool_span,
)
from rapidsim.repeated_rows import Index

LOW_MARGIN = np.radians(5.0)


def unreachable_findings(
    program: Program,
    posed: PosedMoves,
    ends: EndSolutions,
    robot: Robot,
    suggestions: ReachSuggestions | None,
) -> Iterator[Diagnostic]:
    """K601 and K602: ends that no configuration reaches, and axis positions past limits.

    Without suggestions if the arm is the default one: the right arm may not need them.
    """
    for row in np.flatnonzero(ends.looked_at & ~ends.reachable).tolist():
        known = posed.moves[row]
        name, span = target_text(program, known), target_span(program, known)
        past = _external_over(robot, posed.external[row])
        if posed.to_axes[row] or past:
            is_of_joints = bool(posed.to_axes[row])
            arm = (_over(robot, posed.axes[row]),) if is_of_joints else ()
            why = ", ".join(part for part in (*arm, past) if part)
            found = JointOutOfRange(name, robot.title, why, is_of_joints=is_of_joints)
            yield Diagnostic(found, span, routine=known.routine)
            continue
        pose = posed.base_from_flange[row]
        reason = unreachable_reason(robot, pose)
        if reason is None:
            continue
        why = reason_with_lengths(robot, pose, reason)
        wobj = data_of(program, known, "wobj")
        related = declared(wobj, "`{name}`, the work object, is declared here")
        cure = None if suggestions is None else suggestions.of(row)
        unreachable = UnreachableTarget(name, robot.title, why, cure, suggestions is None)
        yield Diagnostic(unreachable, span, related, routine=known.routine)


def configuration_findings(
    program: Program,
    posed: PosedMoves,
    ends: EndSolutions,
    stances: EndConfigurations,
    robot: Robot,
) -> Iterator[Diagnostic]:
    """K603: stored configurations that are monitored but do not work, with those that do."""
    stale = ends.looked_at & ends.reachable & ~ends.on_stored_branch & ~posed.to_axes
    stale &= posed.moves.each(lambda known: is_monitored(known, robot))
    rows = np.flatnonzero(stale).tolist()
    flanges = posed.base_from_flange[np.array(rows, dtype=np.int64)]
    stored = [stored_confdata(posed.moves, row) for row in rows]
    names = [target_text(program, posed.moves[row]) for row in rows]
    for row, found in zip(rows, not_as_stored(robot, flanges, stored, names), strict=True):
        if found.working:
            yield _on_target(program, posed.moves[row], found, found.working[0])
    yield from _turned_findings(program, posed, ends, stances, robot)
    yield from _quarter_off_findings(program, posed, ends, robot)


def _turned_findings(
    program: Program,
    posed: PosedMoves,
    ends: EndSolutions,
    stances: EndConfigurations,
    robot: Robot,
) -> Iterator[Diagnostic]:
    """K603: joint moves that end in another turn of the stored branch."""
    turned = ends.looked_at & ends.on_stored_branch & ~ends.stored_works & stances.sure
    turned &= posed.moves.each(
        lambda known: not known.move.interpolation.leads_tcp and is_monitored(known, robot)
    )
    for row in np.flatnonzero(turned).tolist():
        known = posed.moves[row]
        stored, flange = stored_confdata(posed.moves, row), posed.base_from_flange[row : row + 1]
        taken = configuration(robot.kinematics, stances.joints[row])
        (working,) = by_stored(robot, flange, [stored])
        found = replacement_finding(target_text(program, known), stored, taken, working)
        yield _on_target(program, known, found, found.assumed)


def _quarter_off_findings(
    program: Program, posed: PosedMoves, ends: EndSolutions, robot: Robot
) -> Iterator[Diagnostic]:
    """K622: targets whose stored configuration is a quarter turn off, if a fix is known."""
    off = ends.looked_at & ends.stored_works & ~posed.to_axes & (ends.match == Match.COMPLIANT)
    off &= posed.moves.each(lambda known: is_monitored(known, robot))
    for row in np.flatnonzero(off).tolist():
        known = posed.moves[row]
        reached = conf_text(confdata_of(robot.kinematics, ends.stored[row]).tolist())
        stored = conf_text(stored_confdata(posed.moves, row))
        found = ConfigurationQuarterOff(target_text(program, known), stored, reached)
        diagnostic = _on_target(program, known, found, reached)
        # Without a fix the program does not store it: the point was taught elsewhere.
        if diagnostic.fix is not None:
            yield diagnostic


def _on_target(
    program: Program, known_move: KnownMove, violation: Violation, working: str
) -> Diagnostic:
    """Return a finding about a target, with the edit that stores a working configuration."""
    fix = confdata_fix(program, known_move, working)
    return Diagnostic(
        violation, target_span(program, known_move), fix=fix, routine=known_move.routine
    )


def switch_findings(
    program: Program, posed: PosedMoves, stances: EndConfigurations, robot: Robot
) -> Iterator[Diagnostic]:
    """K619: joint moves without monitoring that have to switch the main axes."""
    if not has_branches(robot.kinematics):
        return
    free = posed.moves.each(lambda known: is_free(known) and not known.move.interpolation.leads_tcp)
    for row in _follow_sure(posed, stances, free & ~posed.to_axes).tolist():
        known, before = posed.moves[row], posed.moves.previous[row]
        start, end = (configuration(robot.kinematics, stances.joints[k]) for k in (before, row))
        if is_switch(start, end):
            name, flange = target_text(program, known), posed.base_from_flange[row]
            found = switched(name, robot, flange, start, end)
            yield Diagnostic(found, target_span(program, known), routine=known.routine)


def far_turn_findings(
    program: Program,
    posed: PosedMoves,
    stances: EndConfigurations,
    robot: Robot,
    broken: AbstractSet[int],
) -> Iterator[Diagnostic]:
    """K620: lines or arcs under ConfL on which a wrist axis turns far, except broken ones."""
    previous = posed.moves.previous
    led = posed.moves.each(
        lambda known: known.move.interpolation.leads_tcp and is_monitored(known, robot)
    )
    rows = _follow_sure(posed, stances, led)
    turns = np.abs(stances.joints[rows] - stances.joints[previous[rows]]).max(axis=-1)
    for row in rows[turns > WRIST_TURNS_FAR].tolist():
        if row in broken:
            continue
        known = posed.moves[row]
        joints = (stances.joints[k] for k in (previous[row], row))
        found = wrist_turning_far(target_text(program, known), *joints)
        if found is not None:
            yield Diagnostic(found, target_span(program, known), routine=known.routine)


def _follow_sure(posed: PosedMoves, stances: EndConfigurations, which: Mask) -> Index:
    """Return those of some rows whose joints are known at both ends."""
    previous = posed.moves.previous
    rows = np.flatnonzero(which & stances.sure & (previous >= 0))
    return rows[stances.sure[previous[rows]]]


def orientation_findings(
    program: Program, posed: PosedMoves, external: Sequence[ExternalAxis]
) -> Iterator[Diagnostic]:
    """M501: frames or targets with an invalid orientation, at the moves that use them."""
    for row in sorted(posed.left_out):
        known = posed.moves[row]
        if known.move.interpolation is Interpolation.EXTERNAL_AXES:
            continue
        for name, rotation in _orientations(program, known, external):
            if is_no_orientation(rotation):
                found = QuaternionNotUnit(name, norm(rotation), refused=True)
                yield Diagnostic(found, target_span(program, known), routine=known.routine)
                break


def _orientations(
    program: Program, known_move: KnownMove, external: Sequence[ExternalAxis]
) -> Iterator[tuple[str, Orient]]:
    """Yield the orientations that determine the end of a move, in the order of a run's checks."""
    move = known_move.move
    yield from frame_orientations(move.tool, move.wobj, external)
    if isinstance(move.to, RobTarget):
        yield target_text(program, known_move), move.to.rot
    if move.circle_point is not None:
        circle_point = argument(program, known_move, "cirpoint")
        place = known_move.span if circle_point is None else known_move.module.span(circle_point)
        yield named_target(place.text), move.circle_point.rot


def margin_findings(
    program: Program,
    posed: PosedMoves,
    ends: EndSolutions,
    stances: EndConfigurations,
    robot: Robot,
) -> Iterator[Diagnostic]:
    """K607, K621: axes near their limits at the end of a move, or past them by a rounding error."""
    joints = stances.joints
    near = (joints < robot.lower + LOW_MARGIN) | (joints > robot.upper - LOW_MARGIN)
    low = ends.looked_at & ends.reachable & stances.sure & near.any(axis=-1)
    for row in np.flatnonzero(low).tolist():
        name, span = target_text(program, posed.moves[row]), target_span(program, posed.moves[row])
        past = None if posed.to_axes[row] else past_limit(robot, name, joints[row])
        if past is not None:
            yield Diagnostic(past, span, routine=posed.moves[row].routine)
            continue
        below, above = joints[row] - robot.lower, robot.upper - joints[row]
        margin = np.minimum(below, above)
        axis = int(margin.argmin())
        limit = robot.lower[axis] if below[axis] < above[axis] else robot.upper[axis]
        found = LowJointMargin(
            name,
            axis + 1,
            float(np.degrees(joints[row, axis])),
            max(0.0, float(np.degrees(margin[axis]))),
            round(float(np.degrees(limit)), 6),
            robot.joints[axis].measure,
        )
        yield Diagnostic(found, span, routine=posed.moves[row].routine)


def overload_findings(program: Program, posed: PosedMoves, robot: Robot) -> Iterator[Diagnostic]:
    """M524: a tool and its load that exceed the rated payload; once per load."""
    rated_kg, told = robot.payload_kg, set[tuple[float, float]]()
    if rated_kg is None:
        return
    for known in posed.moves.of_tree:
        held_kg = 0.0 if "grip_load" in known.uncertain else known.settings.grip_load_kg
        mass_kg = known.move.tool.tload.mass + held_kg
        if mass_kg > rated_kg and (mass_kg, held_kg) not in told:
            told.add((mass_kg, held_kg))
            what = f"the tool and what it holds ({held_kg:.4g} kg) weigh"
            what = what if held_kg else "the tool weighs"
            found = Overload(what, mass_kg, robot.title, rated_kg)
            yield Diagnostic(found, tool_span(program, known), routine=known.routine)


def wind_up_findings(
    program: Program, posed: PosedMoves, stances: EndConfigurations, robot: Robot
) -> Iterator[Diagnostic]:
    """K608: repeated moves to the same target that arrive with an axis whole turns further."""
    first_of: dict[object, int] = {}
    rows = np.flatnonzero(stances.sure & ~posed.to_axes)
    instruction = posed.moves.instruction[rows]
    for row in rows[np.bincount(instruction)[instruction] > 1].tolist():
        known = posed.moves[row]
        first = first_of.setdefault((posed.moves.instruction[row], known.move), row)
        step = stances.joints[row] - stances.joints[first]
        turns = np.round(step / robot.kinematics.turns)
        axis = int(np.abs(turns).argmax())
        if not turns[axis] or not is_free(known):
            continue
        limit = robot.upper[axis] if step[axis] > 0.0 else robot.lower[axis]
        degrees = np.degrees([step[axis], *stances.joints[[first, row], axis], limit])
        found = JointWindUp(target_text(program, known), axis + 1, *map(float, degrees))
        yield Diagnostic(found, target_span(program, known), routine=known.routine)


def _external_over(robot: Robot, external: Array) -> str:
    """External axes (e,) [m or rad] past their limits, as text; empty if none is."""
    excess, first = np.abs(external_excess(robot, external)), len(robot.joints)
    return ", ".join(
        f"{robot.axes.name(first + i)} at {robot.axes.text(first + i, external[i])}, "
        f"{robot.axes.text(first + i, excess[i])} past its limit"
        for i in map(int, np.flatnonzero(excess))
    )


def _over(robot: Robot, joints: Array) -> str:
    excess = programmed_excess(robot, joints)
    return ", ".join(
        f"axis {axis + 1} at {np.degrees(joints[axis]):.1f} {robot.joints[axis].measure}, "
        f"{amount_text(float(np.degrees(abs(excess[axis]))))} {robot.joints[axis].measure} "
        "past its limit"
        for axis in np.flatnonzero(excess)
    )
