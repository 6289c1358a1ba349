"""Moves of one task that follow the belts of conveyors.

Source: Application manual Conveyor tracking: a move in the work object of a conveyor follows the
object that WaitWObj has connected; a move in a fixed work object ends that. How the arm gets onto
the belt and off it again is our own, as ABB publishes no law.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.conveyors import ConveyorState
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.moves.followed_belt import FollowedBelt
from rapidsim.controller.moves.queued_move import nominal_s
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.moves.work_object_holders import Holder
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.frames.transform import Transform
from rapidsim.language.data import JointTarget, WobjData
from rapidsim.language.error_numbers import ERR_CNV_DROPPED, ERR_CNV_NOT_ACT, rapid_error
from rapidsim.language.errors import NotAllowed, NotConnected
from rapidsim.language.moves import Move, SensorInfluence
from rapidsim.motion.configurations.targets import (
    MM,
    BeltMotion,
    NotSimulatedFrame,
    placement,
    transform,
)
from rapidsim.motion.geometry.belts import BeltRide

_SLOWEST_M_S = 1e-3
_STARTS_IN_S = 0.1
"""Time [s] that a move from rest takes longer than at its programmed speed, at a guess."""


@dataclass(slots=True, eq=False)
class BeltTracking:
    """Finds the belts that the moves of a task follow."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver

    def followed_by(self, move: Move, inactive: frozenset[str]) -> FollowedBelt | None:
        """The belts that the next move of the robot follows, or leaves; None if there are none.

        Args:
            move: The move.
            inactive: Folded names of the units that DeactUnit has switched off.

        Raises:
            RapidError: ERR_CNV_NOT_ACT or ERR_CNV_DROPPED.
            NotConnected: When no object is connected.
        """
        conveyor = None if isinstance(move.to, JointTarget) else self.conveyor_of(move.wobj)
        before, travel = self._riding()
        if conveyor is None:
            leaving = tuple(replace(one, end=0.0) for one in before)
            return FollowedBelt(leaving, travel, self._zone_before()) if leaving else None
        unit = conveyor.script.unit
        if unit.lower() in inactive:
            raise rapid_error(ERR_CNV_NOT_ACT, f"the conveyor {unit} is not active")
        if self.unit.team is not None:
            raise NotAllowed("robots that move together cannot follow a conveyor")
        if move.sensed is not SensorInfluence.NEVER:
            raise NotAllowed("a sensor cannot correct a move that follows a conveyor")
        if conveyor.passed_m is None:
            raise NotConnected(unit)
        starts_s = self._starts_s()
        if starts_s > conveyor.leaves_s():
            conveyor.drop(self.clock.resolve_time())
            most = conveyor.script.most_mm
            reason = f"the object of {unit} is more than {most:g} mm behind the switch"
            raise rapid_error(ERR_CNV_DROPPED, reason)
        return self._on(conveyor, move, before, travel, starts_s)

    def conveyor_of(self, wobj: WobjData) -> ConveyorState | None:
        """The conveyor that carries a work object; None if none does."""
        if not self.cell.conveyors or wobj.ufprog or wobj.robhold:
            return None
        return self.cell.conveyors.get(wobj.ufmec.lower())

    def holder(self, wobj: WobjData, time_s: float | None) -> Holder | None:
        """The conveyor that carries a work object at a time [s], or now; None if none does.

        Without a connected object the work object is at the switch.
        """
        conveyor = self.conveyor_of(wobj)
        if conveyor is None:
            return None
        travel = 0.0
        if conveyor.passed_m is not None:
            now_s = self.clock.synchronise() if time_s is None else time_s
            travel = float(conveyor.course.at(np.array([now_s]))[0]) - conveyor.passed_m
        return Holder(conveyor.script.unit, False, _switch(conveyor, wobj) @ _along(travel))

    def _on(
        self,
        conveyor: ConveyorState,
        move: Move,
        before: tuple[BeltRide, ...],
        travel: float,
        starts_s: float,
    ) -> FollowedBelt:
        """The belts of a move that follows the connected object of a conveyor."""
        assert conveyor.passed_m is not None
        course, switch = conveyor.course, _switch(conveyor, move.wobj)
        base_from_world = self.resolver.base_from_world
        along = base_from_world.rotation @ switch.rotation[:, 0]
        ride = next((one for one in before if one.course is course and one.is_along(along)), None)
        if ride is not None:
            before = tuple(one for one in before if one is not ride)
            ride = replace(ride, end=1.0)
        else:
            here = float(course.at(np.array([starts_s]))[0])
            ride = BeltRide(course, along, here - travel, 0.0, 1.0)
        leaving = tuple(replace(one, end=0.0) for one in before)
        user = switch @ _along(ride.zero - conveyor.passed_m)
        stands = BeltMotion(user, switch.rotation[:, 0], travel, travel)
        lasts_s = self._distance_m(move, stands) / max(move.speed.v_tcp * MM, _SLOWEST_M_S)
        if not self.unit.queue.is_open:
            lasts_s += _STARTS_IN_S
        # A belt that is left is the one that the axis stands for.
        end = travel if leaving else travel + course.speed * lasts_s
        if leaving:
            zero = course.belt_at(starts_s) + course.speed * lasts_s - travel
            ride = replace(ride, zero=zero)
            user = switch @ _along(zero - conveyor.passed_m)
        motion = replace(stands, world_from_user=user, end=end)
        return FollowedBelt((*leaving, ride), travel, self._zone_before(), motion)

    def _distance_m(self, move: Move, belt: BeltMotion) -> float:
        """About how far [m] the TCP moves on the belt."""
        robot, end = self.resolver.robot, self.unit.end
        world = self.resolver.base_from_world
        placed = placement(move.tool, move.wobj, world, robot.external, belt=belt)
        if isinstance(placed, NotSimulatedFrame) or isinstance(move.to, JointTarget):
            return 0.0
        here = placed.standing_at(robot.kinematics, end.joints, end.external, at_start=True)
        there = placed.curve_from_object.apply(np.array(move.to.trans) * MM)
        return float(np.linalg.norm(there - here.translation))

    def _riding(self) -> tuple[tuple[BeltRide, ...], float]:
        """The belts that the robot follows at the end of its last move, and the axis there [m]."""
        if not self.unit.queue.is_open:
            return self.unit.trajectory.riding()
        segment = self.unit.moves[-1].segment
        if segment.carrier_axes is None:
            return (), 0.0
        riding = tuple(replace(one, begin=1.0) for one in segment.rides if one.end == 1.0)
        return riding, float(segment.carrier_axes[1][-1])

    def _zone_before(self) -> float:
        zone = self.unit.moves[-1].segment.zone if self.unit.queue.is_open else None
        return 0.0 if zone is None else zone.position

    def _starts_s(self) -> float:
        """About when the robot starts the next move [s]."""
        queue = self.unit.queue
        if queue.is_open:
            return queue.nominal_last_start() + nominal_s(self.unit.moves[-1].segment)
        return max(self.clock.moment().earliest_s, queue.ready_s)


def _switch(conveyor: ConveyorState, wobj: WobjData) -> Transform:
    """Frame of the switch of a conveyor in the world; without a place, the user frame says it."""
    script = conveyor.script
    if script.has_place:
        return Transform.from_quaternion(script.quaternion, np.array(script.position) * MM)
    return transform(wobj.uframe)


def _along(travel: float) -> Transform:
    return Transform(np.eye(3), np.array([travel, 0.0, 0.0]))
