"""What the pictures are drawn from: a run, its samples, and words for its moves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array
from rapidsim.language.moves import Interpolation
from rapidsim.motion.timing.axis_limits import Limits, limits_of
from rapidsim.motion.trajectory.trajectory import Samples
from rapidsim.simulation.results.relative_motion import is_on_track, shown_end, shown_from_base
from rapidsim.simulation.results.sampling import in_corner, motion_samples, rates_between
from rapidsim.simulation.results.simulation import RobotRun, Simulation

MM = 1000.0
_DT = 0.004
"""[s]; fine enough that a corner looks round on paper."""
_MOST_SAMPLES = 20_000
_MOST_EDGES = 20_000
_NAME_LETTERS = 20


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """What one robot did, and its samples."""

    simulation: Simulation
    """The whole run."""
    one: RobotRun
    samples: Samples
    joint_speed: Array
    """Shape (k, n) [rad/s]."""
    limits: Limits
    in_corner: npt.NDArray[np.bool_]
    """Shape (k,): the TCP is in a zone."""

    @property
    def title(self) -> str:
        """The program's name and the robot's."""
        names = [Path(name).name for name in self.simulation.program]
        whose = f"{self.one.task}, " if len(self.simulation.robots) > 1 else ""
        return f"{' '.join(names[:2])} on {whose}{self.one.robot.title}"

    @property
    def end_s(self) -> float:
        """The last instant [s]."""
        return max(float(self.samples.times[-1]), 1e-3)

    @property
    def places_mm(self) -> Array:
        """Where the TCP is at each sample (k, 3), in the frame `frame` names."""
        in_world = is_on_track(self.one.robot)
        shown = shown_from_base(self.one, self.samples.external, in_world=in_world)
        return MM * shown.apply(self.samples.base_from_tcp.translation)

    @property
    def frame(self) -> str:
        """The frame of the pictures: each robot has its own."""
        return "world" if is_on_track(self.one.robot) else "base frame"

    def end_mm(self, move: ExecutedMove) -> Array:
        """The programmed end (3,) of a move in that frame."""
        in_world = is_on_track(self.one.robot)
        return MM * shown_end(self.one, move, in_world=in_world).translation

    def interpolations(self) -> tuple[Interpolation, ...]:
        """The ways of moving that occur, in order of first use."""
        return tuple(dict.fromkeys(move.move.interpolation for move in self.one.moves))


def drawn(simulation: Simulation, one: RobotRun) -> Drawn:
    """Sample what one robot did in a run for its pictures."""
    end_s = max(simulation.time_s, one.trajectory.duration)
    step_s = max(_DT, end_s / _MOST_SAMPLES)
    edges = one.moves if len(one.moves) <= _MOST_EDGES else ()
    samples = motion_samples(one.trajectory, edges, end_s, step_s)
    speed, _ = rates_between(samples)
    return Drawn(
        simulation=simulation,
        one=one,
        samples=samples,
        joint_speed=speed,
        limits=limits_of(one.robot, simulation.model),
        in_corner=in_corner(samples, one.moves),
    )


def target_name(move: ExecutedMove) -> str:
    """What the program calls the end of a move, shortened; `*` where it is written out."""
    arguments = move.place.arguments
    words = arguments.get("topoint") or arguments.get("tojointpos") or "*"
    words = " ".join(words.split())
    if words.startswith("["):
        return "*"
    return words if len(words) <= _NAME_LETTERS else f"{words[: _NAME_LETTERS - 1]}…"


def pieces(mask: npt.NDArray[np.bool_]) -> list[slice]:
    """The unbroken stretches of a mask (k,), each one sample longer so that lines join."""
    padded = np.concatenate([[False], mask, [False]])
    bounds = np.flatnonzero(padded[1:] != padded[:-1])
    return [
        slice(int(begin), min(int(end) + 1, len(mask)))
        for begin, end in zip(bounds[::2], bounds[1::2], strict=True)
    ]
