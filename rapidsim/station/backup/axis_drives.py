"""Limits of one external axis of a backup, which are in several types of `SYSPAR/MOC.cfg`.

JOINT has the position of the axis in `extjoint` and refers to the rest: bounds in ARM, acceleration
in ACC_DATA, transmission, motor speed.

Source: Technical reference manual System parameters, topic Motion.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.external_axes import LETTERS, Carried, ExternalAxis
from rapidsim.station.backup.cfg_file import Configuration, Instance
from rapidsim.station.backup.robots import bounds, number
from rapidsim.values import value_class

Named: TypeAlias = Mapping[str, Mapping[str, Instance]]
"""Instances of each type, by their names."""

_FIRST_AXIS = 7


@value_class(frozen=True, slots=True)
class AxisDrive:
    """Range and limits of an external axis [m or rad, s]."""

    letter: str
    """Component of `extjoint`: `a` to `f`."""
    lower: float
    upper: float
    max_speed: float
    max_acceleration: float

    def axis(
        self,
        unit: str,
        carries: Carried | None,
        direction: Array,
        world_from_user: Transform | None = None,
        *,
        linear: bool,
    ) -> ExternalAxis:
        """Return the axis of a unit, which starts at zero, or at the nearest place in its range.

        Args:
            unit: Name of the mechanical unit.
            carries: Object that it moves.
            direction: Shape (3,): its direction in the world, with all axes at zero.
            world_from_user: User frame that it carries then; None for the world.
            linear: Whether it slides.
        """
        return ExternalAxis(
            unit=unit,
            letter=self.letter,
            linear=linear,
            lower=self.lower,
            upper=self.upper,
            max_speed=self.max_speed,
            max_acceleration=self.max_acceleration,
            start=min(max(0.0, self.lower), self.upper),
            carries=carries,
            direction=tuple(direction.tolist()),
            world_from_user=world_from_user or Transform.identity(),
        )


def by_name(motion: Configuration) -> Named:
    """Return the instances of each type by their names."""
    return {kind: _by_name(instances) for kind, instances in motion.items()}


def instance_of(named: Named, kind: str, name: str | None) -> Instance:
    """Return an instance of a type; an empty one if the file has none of that name."""
    return named.get(kind, {}).get(name or "", {})


def axis_drive(named: Named, joint: Instance) -> AxisDrive | None:
    """Return the drive of a joint; None if the configuration does not describe it fully."""
    arm = instance_of(named, "ARM", joint.get("use_arm"))
    place = number(joint, "logical_axis")
    limits = bounds(arm)
    gear = number(instance_of(named, "TRANSMISSION", joint.get("use_transmission")), "transm_joint")
    cycle = joint.get("use_stress_duty_cycle") or joint.get("name")
    motor_speed = number(instance_of(named, "STRESS_DUTY_CYCLE", cycle), "speed_absolute_max")
    acceleration = instance_of(named, "ACC_DATA", arm.get("use_acc_data"))
    most = number(acceleration, "wc_acc") or number(acceleration, "nom_acc")
    if not (place and limits and gear and motor_speed and most):
        return None
    letter = int(place) - _FIRST_AXIS
    if not 0 <= letter < len(LETTERS):
        return None
    return AxisDrive(LETTERS[letter], *limits, motor_speed / math.fabs(gear), most)


def _by_name(instances: Sequence[Instance]) -> Mapping[str, Instance]:
    return {one.get("name", ""): one for one in instances}
