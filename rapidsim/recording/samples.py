"""Sampled run of each robot, dense enough for drawing."""

from __future__ import annotations

from rapidsim.controller.moves.executed_moves import MoveRow
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.targets import world_from_base_at
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.recording.timelines import Clock, clock_of
from rapidsim.recording.transforms import BASE, FOOT
from rapidsim.simulation.results.relative_motion import is_on_track
from rapidsim.simulation.results.sampling import SampledRun, sampled
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

DEFAULT_DT = 0.012
"""[s]; interval at which a controller computes its path."""
MOST_SAMPLES = 120_000
"""Number of samples, about 80 MB, above which a run is sampled more coarsely by default."""
MOST_SAMPLES_ASKED = 20_000_000
_MOST_EDGED = MOST_SAMPLES // 2
"""Number of moves above which starts and ends have no samples of their own: the size of a recording
depends on its samples, not on its program."""


@value_class(frozen=True, slots=True, eq=False)
class RecordedRobot:
    """Sampled run of one robot, with its name and clock in the recording."""

    sampled: SampledRun
    name: str
    """Prefix of its entities and frames; empty if there is only one robot."""
    clock: Clock
    dt: float
    """Time [s] between samples, without the extra samples at starts and ends of moves."""

    @property
    def robot_run(self) -> RobotRun:
        """Run of the robot."""
        return self.sampled.robot_run

    @property
    def robot(self) -> Robot:
        """The arm."""
        return self.robot_run.robot

    @property
    def samples(self) -> Samples:
        """Motion of the arm."""
        return self.sampled.samples

    def entity(self, path: str) -> str:
        """Return the entity path of something of this robot in the recording."""
        return f"{self.name}/{path}" if self.name else path

    def frame(self, name: str) -> str:
        """Return the full name of a frame that every robot has, such as `tool0` or `base`."""
        return f"{self.name}/{name}" if self.name else name

    @property
    def on_track(self) -> bool:
        """Whether external axes move the robot's base."""
        return is_on_track(self.robot)

    @property
    def still_frame(self) -> str:
        """Frame of paths and targets: the base, or its position with the track at zero."""
        return self.frame(FOOT if self.on_track else BASE)

    @property
    def places(self) -> Array:
        """Positions of the TCP at all samples (k, 3) [m], in the still frame."""
        return self.still_from(self.samples.base_from_tcp, self.samples.external).translation

    def still_from_end(self, move: MoveRow) -> Transform:
        """Return the programmed end of a move in the still frame."""
        end = move.base_from_tcp
        if not self.on_track:
            return end
        batch = Transform(end.rotation[None], end.translation[None])
        return self.still_from(batch, move.external[None])[0]

    def still_from(self, base_from_a: Transform, external: Array) -> Transform:
        """Return poses (k,) in base with external axes (k, e) [m or rad], in the still frame."""
        if not self.on_track:
            return base_from_a
        world_from_base = world_from_base_at(
            self.robot.external, self.robot_run.world_from_base, external
        )
        return self.robot_run.world_from_base.inverse() @ world_from_base @ base_from_a

    @property
    def remarks(self) -> tuple[str, ...]:
        """Remarks on reduced sampling, one per line."""
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
        Sampled run of each robot.

    Raises:
        InputError: If `dt` is not positive or results in too many samples.
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
    clock = clock_of(simulation.moves)
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
