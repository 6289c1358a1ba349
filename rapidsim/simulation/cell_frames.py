"""Frames of a cell at single instants of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set

import numpy as np

from rapidsim.collisions.scene import WORLD, Arm, Belt, SceneFrame, arm_frames
from rapidsim.frames.transform import Transform
from rapidsim.simulation.results.simulation import RobotRun


class CellFrames:
    """Frames of arms, positioners and belts in the world, and the TCPs."""

    def __init__(
        self,
        arms: Sequence[Arm],
        runs: Sequence[RobotRun],
        belts: Sequence[Belt],
        used: Set[SceneFrame],
    ) -> None:
        """Take the frames of links, and those of positioners that are used."""
        self._arms, self._runs, self._belts, self._used = arms, runs, belts, used
        self._frames: dict[float, Mapping[SceneFrame, Transform]] = {}
        self._tcps: dict[float, Sequence[Transform]] = {}

    def prefetch(self, times: Sequence[float]) -> None:
        """Compute the frames at some instants [s] at once."""
        new = sorted({*times} - self._frames.keys())
        at = np.array(new)
        still = Transform(np.tile(np.eye(3), (len(new), 1, 1)), np.zeros((len(new), 3)))
        frames, tcps = {WORLD: still}, []
        for number, (arm, run) in enumerate(zip(self._arms, self._runs, strict=True)):
            frames.update(arm_frames(number, arm, arm.at(at), self._used))
            tcps.append(frames[SceneFrame(number, 0)] @ run.sample(at).base_from_tcp)
        frames.update(
            (SceneFrame(belt=number), belt.frames(at)) for number, belt in enumerate(self._belts)
        )
        for row, time_s in enumerate(new):
            self._frames[time_s] = {frame: poses[row] for frame, poses in frames.items()}
            self._tcps[time_s] = [tcp[row] for tcp in tcps]

    def at(self, time_s: float) -> Mapping[SceneFrame, Transform]:
        """Return world from each frame at an instant [s]."""
        if time_s not in self._frames:
            self.prefetch([time_s])
        return self._frames[time_s]

    def tcp(self, robot: int, time_s: float) -> Transform:
        """Return world from the TCP of a robot at an instant [s]."""
        self.at(time_s)
        return self._tcps[time_s][robot]
