"""A robot whose path a sensor corrects: EGMMoveL and EGMMoveC.

At each sample the sensor receives the robot's position, and its answer determines the motion up to
the next sample. The planned path is unchanged: the correction is an offset from it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from rapidsim.controller.cell.sensors import GuidanceSensor
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.sensor_identities import SensorIdentity
from rapidsim.controller.sensor_streams import SPEED_STEP_S, feedback_at, feedback_of
from rapidsim.frames.transform import Array
from rapidsim.language.moves import SensorInfluence
from rapidsim.motion.guidance.feedback import Frames, Guided
from rapidsim.motion.guidance.guided_execution import EndReason
from rapidsim.motion.guidance.joint_law import CYCLE_S
from rapidsim.motion.guidance.path_correction import PathCorrection
from rapidsim.motion.trajectory.corrected_section import CorrectedSection
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.motion.trajectory.samples import Samples

_TOLD_AHEAD: Final = 3
"""Number of samples sent at once to a sensor with look-ahead."""
_ROUNDING: Final = 1e-6


@dataclass(slots=True, eq=False)
class ActivePathCorrection:
    """Implements `member.CorrectedMotion`."""

    identity: SensorIdentity
    """Identity of the sensor."""
    unit: MechanicalUnit
    resolver: Resolver
    sensor: GuidanceSensor
    law: PathCorrection
    section: CorrectedSection
    """The resulting offsets of the path."""
    sample_s: float
    silence_s: float
    bring_to_rest: Callable[[], None]
    """Brings the robot to the end of its path."""
    frames: Frames
    """Frames in which the sensor receives the pose of the TCP."""
    next_s: float = 0.0
    """Time [s] of the next sample."""
    runs: bool = False
    """Whether the robot is on a path that is corrected."""
    silent_s: float = 0.0
    """Time [s] since the last answer of the sensor."""
    ended: EndReason | None = None
    """Reason why the correction ended; None while it runs."""

    def begin(self, now_s: float) -> None:
        """Begin a corrected path."""
        self.runs, self.silent_s = True, 0.0
        self.next_s = math.ceil(now_s / CYCLE_S - _ROUNDING) * CYCLE_S
        self.sensor.correct(self.next_s, self.sample_s)

    def sample(self, passed_s: float) -> EndReason | None:
        """Exchange a sample with the sensor; return the reason to end the correction, None if none.

        Args:
            passed_s: Time [s] before which no further event happens.
        """
        self._advance_to(passed_s)
        now_s, self.next_s = self.next_s, self.next_s + self.sample_s
        words = _TOLD_AHEAD if self.sensor.has_lookahead else 1
        told = now_s + self.sample_s * np.arange(words, dtype=np.float64)
        start_s = max(now_s, self.section.end_s)
        cycles = max(0, round((self.next_s - start_s) / CYCLE_S))
        ahead = start_s + CYCLE_S * np.arange(1, cycles + 1, dtype=np.float64)
        path = self.unit.preview()
        samples = path.at(np.concatenate([told, told + SPEED_STEP_S, ahead]))
        stream = feedback_of(self.unit, self.resolver, self.frames, samples, words, Guided.RUNNING)
        if self.sensor.has_lookahead:
            self.sensor.stream(stream)
        answer = self.sensor.exchange(stream[0])
        if answer is not None and self.law.accept(answer):
            self.silent_s = 0.0
        else:
            self.silent_s += self.sample_s
            if self.silent_s > self.silence_s:
                return EndReason.SILENT
        is_there = self._decide(start_s, samples, 2 * words, path.directions(ahead))
        return None if is_there else EndReason.OUT_OF_REACH

    @property
    def told_s(self) -> float:
        """Time [s] of the last sample."""
        return self.next_s - self.sample_s

    def rest(self) -> float:
        """End the correction of a robot at the end of its path; return the time [s] it is at rest.

        The offset remains, and a later corrected path continues with it.
        """
        self.runs = False
        self.section.extend(self.section.end_s, CYCLE_S, self.law.rest())
        return self.section.end_s

    def last_word(self, guided: Guided) -> None:
        """Notify the sensor that its correction has ended."""
        end_s = self.section.end_s
        told = feedback_at(
            self.unit, self.resolver, lambda _: self.frames, np.array([end_s]), guided
        )
        self.sensor.end(told[0])

    def end(self) -> None:
        """See `CorrectedMotion`."""
        self.bring_to_rest()
        self.settle()

    def settle(self) -> None:
        """See `CorrectedMotion`."""
        member = self.unit.member
        self.rest()
        member.corrected = None
        if not self.section.end.any():
            return
        trajectory = member.trajectory
        end_s, stands = trajectory.duration, member.standing()
        tool, robot = self.frames.tcp_from_flange, self.resolver.robot
        trajectory.guide(
            GuidedSection(end_s, CYCLE_S, robot.forward, tool, stands.external, stands.joints)
        )
        self.section.until_s = end_s
        self.unit.queue.begin_again(end_s)
        member.end = stands

    def _advance_to(self, now_s: float) -> None:
        late = math.ceil((now_s - self.next_s) / self.sample_s - _ROUNDING)
        self.next_s += max(0, late) * self.sample_s

    def _decide(self, start_s: float, samples: Samples, first: int, directions: Array) -> bool:
        """Determine the offset up to the next sample; return whether the arm can reach it.

        Args:
            start_s: Time [s] at which it begins.
            samples: Positions of the robot, one a cycle from `first` on.
            first: Index of the first relevant sample.
            directions: Directions of the path at these samples (k, 3).
        """
        moves, stretch = self.unit.moves, self.section
        sensed = [moves[k].move.sensed is SensorInfluence.CORRECTED for k in samples.move[first:]]
        tool_z = samples.base_from_tcp.rotation[first:, :, 2]
        before = stretch.end
        led = self.law.follow(directions, tool_z, np.array(sensed, dtype=np.bool_))
        stretch.extend(start_s, CYCLE_S, led)
        ways = stretch.offsets_at(samples.times[first:]) - before if sensed else np.zeros((0, 3))
        joints = stretch.joints(samples.joints[first:], ways)
        robot = self.resolver.robot
        return bool(((robot.lower <= joints) & (joints <= robot.upper)).all())
