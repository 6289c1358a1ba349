"""Equipment of one task: its mechanical units, and the devices of the cell for all tasks."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import field

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.independent_axes import IndependentAxisState
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.other_tasks import TaskCoordination
from rapidsim.language.equipment import Conveyor, MechanicalUnitFacts, robot_name
from rapidsim.motion.robot.external_axes import LETTERS
from rapidsim.values import value_class

_SPEEDS_UP_IN_S = 0.16
_UNKNOWN_SPEED = math.pi
"""Maximum speed [rad/s] of an independent arm axis if the robot's description has none."""


@value_class(frozen=True, slots=True)
class TaskEquipment:
    """Implements `language.equipment.Equipment`."""

    clock: TaskClock
    cell: Cell
    resolver: Resolver
    coordination: TaskCoordination
    _independent: dict[tuple[str, int], IndependentAxisState] = field(default_factory=dict)

    def mechanical_units(self) -> tuple[MechanicalUnitFacts, ...]:
        """The robot, and the units of external axes in the order of their letters."""
        return _units_of(self.coordination)

    def system_units(self) -> tuple[MechanicalUnitFacts, ...]:
        """The robots of all tasks in the order of the station, then their external axes."""
        self.clock.synchronise()
        moving = [one for one in self.coordination.all_tasks().values() if one.has_robot]
        units = [unit for one in moving for unit in _units_of(one)]
        return tuple(sorted(units, key=lambda unit: not unit.is_robot))

    def conveyor(self, unit: str) -> Conveyor | None:
        """A conveyor of the cell."""
        self.clock.synchronise()
        return self.cell.conveyors.get(unit.lower())

    def independent_axis(self, unit: MechanicalUnitFacts, axis: int) -> IndependentAxisState:
        """An axis of a mechanical unit, counted from 1."""
        key = (unit.name.lower(), axis)
        if key not in self._independent:
            self._independent[key] = self._axis(unit, unit.axes[axis - 1])
        return self._independent[key]

    def _axis(self, unit: MechanicalUnitFacts, at: int) -> IndependentAxisState:
        robot = self.resolver.robot
        if unit.is_robot:
            joint = robot.joints[at]
            fastest = math.degrees(joint.max_speed or _UNKNOWN_SPEED) / _SPEEDS_UP_IN_S
            return IndependentAxisState(fastest, turns=not joint.slides)
        external = next(one for one in robot.external if LETTERS.index(one.letter) == at)
        return IndependentAxisState(
            external.max_acceleration * external.scale, turns=not external.linear
        )

    def instances(self, domain: str, of: str) -> Sequence[Mapping[str, str]] | None:
        """Current instances of a type; None if there is no such type."""
        self.clock.synchronise()
        return self.cell.parameters.instances(domain, of)

    def configure(self, domain: str, of: str, number: int, attribute: str, value: str) -> None:
        """Change an attribute, for later reads."""
        self.clock.synchronise()
        self.cell.parameters.change(domain, of, number, attribute, value)
        self.clock.notify_tasks()

    def is_enabled(self, device: str) -> bool:
        """Whether an I/O device is enabled."""
        self.clock.synchronise()
        return device.lower() not in self.cell.disabled_devices

    def has_contact(self, device: str) -> bool:
        """Whether an I/O device has contact."""
        self.clock.synchronise()
        return device.lower() not in self.cell.lost_devices

    def enable(self, device: str, *, enabled: bool) -> None:
        """Enable or disable an I/O device."""
        self.clock.synchronise()
        if enabled:
            self.cell.disabled_devices.discard(device.lower())
        else:
            self.cell.disabled_devices.add(device.lower())
        self.clock.notify_tasks()


def _units_of(task: TaskCoordination) -> tuple[MechanicalUnitFacts, ...]:
    """The units that a task moves: its robot, if it has one, and its external axes."""
    robot, moves_with = task.resolver.robot, task.robot_number
    axes: dict[str, list[int]] = {}
    for axis in robot.external:
        axes.setdefault(axis.unit, []).append(LETTERS.index(axis.letter))
    found = [(name, False, tuple(letters)) for name, letters in axes.items()]
    if moves_with:
        found.insert(0, (robot_name(moves_with), True, tuple(range(len(robot.joints)))))
    inactive = task.state.settings.inactive_units
    return tuple(
        MechanicalUnitFacts(
            name, is_robot, places, task.task_number, moves_with, name.lower() not in inactive
        )
        for name, is_robot, places in found
    )
