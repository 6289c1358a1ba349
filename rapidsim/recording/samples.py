"""A run looked at often enough to be drawn, one robot at a time."""

from __future__ import annotations

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.targets import world_from_base_at
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.trajectory import Samples
from rapidsim.recording.timelines import Clock, clock_of
from rapidsim.recording.transforms import BASE, FOOT
from rapidsim.simulation.results.relative_motion import is_on_track
from rapidsim.simulation.results.sampling import SampledRun, sampled
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

DEFAULT_DT = 0.012
"""[s]; the beat at which a controller itself computes its path."""
MOST_SAMPLES = 120_000
"""A longer run is sampled more coarsely unless the user asks otherwise; this is some 80 MB."""
MOST_SAMPLES_ASKED = 20_000_000
_MOST_EDGED = MOST_SAMPLES // 2
"""Of more moves starts and ends have no samples of their own: a recording's size is that of its
samples, not of its program."""


@value_class(frozen=True, slots=True, eq=False)
class RecordedRobot:
    """A sampled run of one robot, and how it is named and timed in the recording."""

    sampled: SampledRun
    name: str
    """Goes before the names of its entities and frames; empty where there is one robot."""
    clock: Clock
    dt: float
    """Time [s] between samples; those of starts and ends of moves are not counted."""

    @property
    def robot_run(self) -> RobotRun:
        """What the robot did."""
        return self.sampled.robot_run

    @property
    def robot(self) -> Robot:
        """The arm."""
        return self.robot_run.robot

    @property
    def samples(self) -> Samples:
        """Its motion."""
        return self.sampled.samples

    def entity(self, path: str) -> str:
        """Where in the recording something of this robot is logged."""
        return f"{self.name}/{path}" if self.name else path

    def frame(self, name: str) -> str:
        """The name of a frame of this robot, which every robot has: `tool0`, `base`."""
        return f"{self.name}/{name}" if self.name else name

    @property
    def on_track(self) -> bool:
        """Whether external axes move the robot's base."""
        return is_on_track(self.robot)

    @property
    def still_frame(self) -> str:
        """The frame that paths and targets are in: the base, or where it is without its track."""
        return self.frame(FOOT if self.on_track else BASE)

    @property
    def places(self) -> Array:
        """Where the TCP is at each sample (k, 3) [m], in the still frame."""
        return self.still_from(self.samples.base_from_tcp, self.samples.external).translation

    def still_from_end(self, move: ExecutedMove) -> Transform:
        """The programmed end of a move in the still frame."""
        end = move.base_from_tcp
        if not self.on_track:
            return end
        batch = Transform(end.rotation[None], end.translation[None])
        return self.still_from(batch, move.external[None])[0]

    def still_from(self, base_from_a: Transform, external: Array) -> Transform:
        """Poses (k,) in base with external axes (k, e) [m or rad], in the still frame."""
        if not self.on_track:
            return base_from_a
        world_from_base = world_from_base_at(
            self.robot.external, self.robot_run.world_from_base, external
        )
        return self.robot_run.world_from_base.inverse() @ world_from_base @ base_from_a

    @property
    def remarks(self) -> tuple[str, ...]:
        """What sampling leaves out that a user would expect, a line each."""
        if self.dt <= DEFAULT_DT:
            return ()
        shown, usual = 1000.0 * self.dt, 1000.0 * DEFAULT_DT
        return (f"the motion is shown every {shown:.0f} ms, not {usual:.0f}",)


def sample(simulation: Simulation, dt: float | None) -> tuple[RecordedRobot, ...]:
    """Sample a run.

    Args:
        simulation: The run.
        dt: Time [s] between samples; None takes `DEFAULT_DT`, or more for a run of hours.

    Returns:
        What each robot did.

    Raises:
        InputError: When `dt` is not positive or gives too many samples.
    """
    robots = simulation.robots
    end_s = simulation.motion_end_s
    if dt is not None and not dt > 0.0:
        raise InputError(f"the time between samples must be greater than 0, not {dt:g} s")
    if dt is not None and end_s / dt > MOST_SAMPLES_ASKED:
        raise InputError(
            f"a recording of {end_s:.1f} s every {dt:g} s has over {MOST_SAMPLES_ASKED} samples",
            "take a larger `--record-dt`",
        )
    step = dt if dt is not None else max(DEFAULT_DT, len(robots) * end_s / MOST_SAMPLES)
    clock = clock_of(move for robot in robots for move in robot.moves)
    several = len(robots) > 1
    return tuple(
        RecordedRobot(
            sampled(simulation, one, step, most_moves=_MOST_EDGED),
            one.task if several else "",
            clock,
            step,
        )
        for one in robots
    )
