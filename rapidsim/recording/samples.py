"""A run looked at often enough to be drawn, one robot at a time."""

from __future__ import annotations

from dataclasses import dataclass

from rapidsim.controller.journal.events import ExecutedLine
from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.targets import world_from_base_at
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import Limits, limits_of
from rapidsim.motion.trajectory.trajectory import Samples
from rapidsim.recording.timelines import Clock, clock_of
from rapidsim.recording.transforms import BASE, FOOT
from rapidsim.simulation.results.relative_motion import is_on_track
from rapidsim.simulation.results.sampling import motion_samples, rates_between
from rapidsim.simulation.results.simulation import RobotRun, Simulation

DEFAULT_DT = 0.012
"""[s]; the beat at which a controller itself computes its path."""
MOST_SAMPLES = 120_000
"""A longer run is sampled more coarsely unless the user asks otherwise; this is some 80 MB."""
MOST_SAMPLES_ASKED = 20_000_000


@dataclass(frozen=True, slots=True, eq=False)
class SampledRun:
    """What one robot did, and the samples it is drawn from."""

    simulation: Simulation
    """The whole run."""
    name: str
    """Goes before the names of its entities and frames; empty where there is one robot."""
    robot: Robot
    limits: Limits
    world_from_base: Transform
    """With all external axes at zero."""
    moves: tuple[ExecutedMove, ...]
    lines: tuple[ExecutedLine, ...]
    failed_moves: tuple[FailedMove, ...]
    clock: Clock
    dt: float
    """Time [s] between samples; starts and ends of moves have samples of their own."""
    samples: Samples
    joint_speed: Array
    """Shape (k, n) [rad/s]."""
    joint_acceleration: Array
    """Shape (k, n) [rad/s2]."""

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
        batch = Transform(end.rotation[None], end.translation[None])
        return self.still_from(batch, move.external[None])[0]

    def still_from(self, base_from_a: Transform, external: Array) -> Transform:
        """Poses (k,) in base with external axes (k, e) [m or rad], in the still frame."""
        if not self.on_track:
            return base_from_a
        world_from_base = world_from_base_at(self.robot.external, self.world_from_base, external)
        return self.world_from_base.inverse() @ world_from_base @ base_from_a

    @property
    def remarks(self) -> tuple[str, ...]:
        """What sampling leaves out that a user would expect, a line each."""
        if self.dt <= DEFAULT_DT:
            return ()
        shown, usual = 1000.0 * self.dt, 1000.0 * DEFAULT_DT
        return (f"the motion is shown every {shown:.0f} ms, not {usual:.0f}",)

    @property
    def end_s(self) -> float:
        """The last instant [s]."""
        return float(self.samples.times[-1])


def sample(simulation: Simulation, dt: float | None) -> tuple[SampledRun, ...]:
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
    return tuple(_sampled(simulation, robot, clock, end_s, step) for robot in robots)


def _sampled(
    simulation: Simulation, one: RobotRun, clock: Clock, end_s: float, step: float
) -> SampledRun:
    samples = motion_samples(one.trajectory, one.moves, end_s, step)
    speed, acceleration = rates_between(samples)
    return SampledRun(
        simulation=simulation,
        name=one.task if len(simulation.robots) > 1 else "",
        robot=one.robot,
        limits=limits_of(one.robot, simulation.model),
        world_from_base=one.world_from_base,
        moves=one.moves,
        lines=one.lines,
        failed_moves=one.failed_moves,
        clock=clock,
        dt=step,
        samples=samples,
        joint_speed=speed,
        joint_acceleration=acceleration,
    )
