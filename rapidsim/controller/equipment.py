"""What is installed around one task: its mechanical units, and what the cell has for all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.language.equipment import Conveyor, MechanicalUnitFacts, robot_name
from rapidsim.language.tasks import TaskService
from rapidsim.motion.robot.external_axes import LETTERS
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class TaskEquipment:
    """Implements `language.equipment.Equipment`."""

    clock: TaskClock
    cell: Cell
    resolver: Resolver
    others: TaskService

    def mechanical_units(self) -> tuple[MechanicalUnitFacts, ...]:
        """The robot, and the units of external axes in the order of their letters."""
        robot = self.resolver.robot
        axes: dict[str, list[int]] = {}
        for axis in robot.external:
            axes.setdefault(axis.unit, []).append(LETTERS.index(axis.letter))
        units = [MechanicalUnitFacts(name, False, tuple(found)) for name, found in axes.items()]
        number = self.others.robot_number
        if number:
            own = tuple(range(len(robot.joints)))
            units.insert(0, MechanicalUnitFacts(robot_name(number), True, own))
        return tuple(units)

    def conveyor(self, unit: str) -> Conveyor | None:
        """A conveyor of the cell."""
        self.clock.come_up()
        return self.cell.conveyors.get(unit.lower())

    def instances(self, domain: str, of: str) -> Sequence[Mapping[str, str]] | None:
        """The instances of a type, as they are now."""
        self.clock.come_up()
        return self.cell.parameters.instances(domain, of)

    def configure(self, domain: str, of: str, number: int, attribute: str, value: str) -> None:
        """Change an attribute for whoever reads it after."""
        self.clock.come_up()
        self.cell.parameters.change(domain, of, number, attribute, value)
        self.clock.tell()

    def is_enabled(self, device: str) -> bool:
        """Whether an I/O device takes part."""
        self.clock.come_up()
        return device.lower() not in self.cell.disabled_devices

    def enable(self, device: str, *, enabled: bool) -> None:
        """Let an I/O device take part, or not."""
        self.clock.come_up()
        if enabled:
            self.cell.disabled_devices.discard(device.lower())
        else:
            self.cell.disabled_devices.add(device.lower())
        self.clock.tell()
