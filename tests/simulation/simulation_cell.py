"""A virtual controller driven by hand: what the interpreter would call, without a program."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rapidsim.controller.cell import cell as shared
from rapidsim.controller.controller import virtual_controller
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.member import member_at_rest
from rapidsim.diagnostics import Source, Span
from rapidsim.frames.transform import Transform
from rapidsim.language.data import (
    FINE,
    NO_EXTERNAL_AXES,
    TOOL0,
    WOBJ0,
    ConfData,
    Orient,
    Pos,
    RobTarget,
    SpeedData,
    ZoneData,
)
from rapidsim.language.moves import Interpolation, Move, Place
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions

Z10 = ZoneData(False, 10.0, 15.0, 15.0, 1.5, 15.0, 1.5)
DOWN = Orient(0.0, 0.0, 1.0, 0.0)
_START = np.array([0.0, 0.0, 0.0, 0.0, 0.5, 0.0])
_SOURCE = Source("hand.mod", "MoveL")


def place(name: str = "p") -> Place:
    return Place(Span(_SOURCE, 0, 5), "main", {"topoint": name})


@dataclass
class Cell:
    """An IRB 1600 whose controller is called by the test."""

    options: RunOptions = field(default_factory=RunOptions)

    def __post_init__(self) -> None:
        self.robot = load_robot("irb1600")
        self.journal = Journal("T_ROB1")
        start = Waypoint(_START, self.robot.forward(_START))
        self.unit = MechanicalUnit(member_at_rest(self.robot, self.options.model, start))
        self.trajectory = self.unit.trajectory
        # The programs of these tests store the configuration 0 everywhere.
        resolver = Resolver(
            self.robot, self.journal, Transform.identity(), nearest_configuration=True
        )
        self.shared = shared.Cell(self.options.cell, self.journal)
        self.controller = virtual_controller(
            self.shared,
            self.unit,
            resolver,
            self.journal,
            place(),
        )

    def move(
        self,
        x: float,
        y: float,
        z: float,
        *,
        zone: ZoneData = Z10,
        speed: float = 200.0,
        kind: Interpolation = Interpolation.LINE,
        name: str = "p",
    ) -> None:
        """Send the TCP somewhere [mm], pointing down."""
        target = RobTarget(Pos(x, y, z), DOWN, ConfData(0, 0, 0, 0), NO_EXTERNAL_AXES)
        self.controller.clock.place = place(name)
        self.controller.motion.move(
            Move(
                "MoveL" if kind is Interpolation.LINE else "MoveJ",
                kind,
                target,
                SpeedData(speed, 500.0, 5000.0, 1000.0),
                zone,
                TOOL0,
                WOBJ0,
            )
        )

    def approach(self) -> None:
        """Go to the first point by joints and stop."""
        self.move(800.0, 0.0, 600.0, zone=FINE, kind=Interpolation.JOINT, speed=1000.0)

    def moves(self) -> Sequence[ExecutedMove]:
        return self.unit.member.executed("T_ROB1")
