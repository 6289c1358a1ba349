"""Reach of targets on belts: somewhere between the switch and the end of tracking, or nowhere."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.reach_and_motion_data import UnreachableTarget
from rapidsim.frames.transform import Transform
from rapidsim.language.data import RobTarget
from rapidsim.motion.configurations.confdata import configurations
from rapidsim.motion.configurations.targets import (
    MM,
    BeltMotion,
    NotSimulatedFrame,
    is_no_orientation,
    placement,
    transform,
)
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.known_moves import KnownMove, KnownMoves
from rapidsim.reach.wording import target_span, target_text

_MOST_PLACES = 60
_LONGEST_MM = 20.0


def belt_findings(
    program: Program,
    moves: KnownMoves,
    robot: Robot,
    base_from_world: Transform,
    conveyors: Sequence[ConveyorScript],
) -> Iterator[Diagnostic]:
    """K601: targets on belts that the arm reaches nowhere between the switch and `maximum`."""
    scripts = {one.unit.lower(): one for one in conveyors if np.isfinite(one.most_mm)}
    on_belts = moves.each(lambda known: known.move.wobj.ufmec.lower() in scripts)
    for row in np.flatnonzero(on_belts).tolist():
        known = moves[row]
        move, wobj = known.move, known.move.wobj
        script = None if wobj.ufprog or wobj.robhold else scripts.get(wobj.ufmec.lower())
        if script is None or not isinstance(move.to, RobTarget) or robot.external:
            continue
        frames = (move.tool.tframe.rot, wobj.uframe.rot, wobj.oframe.rot, move.to.rot)
        if any(map(is_no_orientation, frames)):
            continue
        if not _is_reached(known, move.to, robot, base_from_world, script):
            reason = f"`{script.unit}` carries it out of reach all along {script.most_mm:g} mm"
            found = UnreachableTarget(target_text(program, known), robot.title, reason)
            yield Diagnostic(found, target_span(program, known), routine=known.routine)


def _is_reached(
    statement: KnownMove,
    target: RobTarget,
    robot: Robot,
    base_from_world: Transform,
    script: ConveyorScript,
) -> bool:
    """Whether a target is within reach at some of the places that the belt takes it to."""
    switch = transform(statement.move.wobj.uframe)
    if script.has_place:
        switch = Transform.from_quaternion(script.quaternion, np.array(script.position) * MM)
    along = switch.rotation[:, 0]
    belt = BeltMotion(switch, along, 0.0, 0.0)
    placed = placement(statement.move.tool, statement.move.wobj, base_from_world, belt=belt)
    if isinstance(placed, NotSimulatedFrame):
        return True
    base_from_flange = placed.curve_from_tcp(target) @ placed.tcp_from_flange
    count = min(int(script.most_mm / _LONGEST_MM) + 2, _MOST_PLACES)
    step = base_from_world.rotation @ along
    for travel in np.linspace(0.0, script.most_mm * MM, count).tolist():
        place = base_from_flange.translation + travel * step
        if configurations(robot, Transform(base_from_flange.rotation, place)):
            return True
    return False
