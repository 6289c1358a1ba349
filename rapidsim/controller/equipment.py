"""The equipment of one task: its mechanical units, and what the cell has for all tasks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.other_tasks import TaskOthers
from rapidsim.language.equipment import Conveyor, MechanicalUnitFacts, robot_name
from rapidsim.motion.robot.external_axes import LETTERS
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class TaskEquipment:
    """Implements `language.equipment.Equipment`."""

    clock: TaskClock
    cell: Cell
    resolver: Resolver
    others: TaskOthers

    def mechanical_units(self) -> tuple[MechanicalUnitFacts, ...]:
        """The robot, and the units of external axes in the order of their letters."""
        return _units_of(self.others)

    def system_units(self) -> tuple[MechanicalUnitFacts, ...]:
        """The robots of all tasks in the order of the station, then their external axes."""
        self.clock.come_up()
        moving = [one for one in self.others.all_tasks().values() if one.has_robot]
        units = [unit for one in moving for unit in _units_of(one)]
        return tuple(sorted(units, key=lambda unit: not unit.is_robot))

    def conveyor(self, unit: str) -> Conveyor | None:
        """A conveyor of the cell."""
        self.clock.come_up()
        return self.cell.conveyors.get(unit.lower())

    def instances(self, domain: str, of: str) -> Sequence[Mapping[str, str]] | None:
        """The instances of a type, as they are now."""
        self.clock.come_up()
        return self.cell.parameters.instances(domain, of)

    def configure(self, domain: str, of: str, number: int, attribute: str, value: str) -> None:
        """Change an attribute, for whoever reads it later."""
        self.clock.come_up()
        self.cell.parameters.change(domain, of, number, attribute, value)
        self.clock.tell()

    def is_enabled(self, device: str) -> bool:
        """Whether an I/O device is enabled."""
        self.clock.come_up()
        return device.lower() not in self.cell.disabled_devices

    def enable(self, device: str, *, enabled: bool) -> None:
        """Enable or disable an I/O device."""
        self.clock.come_up()
        if enabled:
            self.cell.disabled_devices.discard(device.lower())
        else:
            self.cell.disabled_devices.add(device.lower())
        self.clock.tell()


def _units_of(task: TaskOthers) -> tuple[MechanicalUnitFacts, ...]:
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
