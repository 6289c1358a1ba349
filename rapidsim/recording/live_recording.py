"""Recording of a running controller, which grows with its events.

The layout for a whole run does not apply, as the run has not ended: this one has the cell with its
arms, axes, states of tasks, and a log of requests, texts and entries of the event log.
"""

from __future__ import annotations

import subprocess
import sys
import uuid
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import field
from pathlib import Path
from socket import create_connection
from time import monotonic, sleep
from typing import Final

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.recording.layout.blueprint import laid_out
from rapidsim.recording.scene.arm import Chain, log_arm, log_motion
from rapidsim.recording.stream import recording_file
from rapidsim.recording.timelines import SIM_TIME, Clock
from rapidsim.recording.transforms import BASE, WORLD, static_frame
from rapidsim.values import value_class

LOG: Final = "log"
STATES: Final = "states"
TARGETS: Final = "sensor"
_CLOCK: Final = Clock(np.zeros(0))


@value_class(frozen=True, slots=True, eq=False)
class LiveArm:
    """One arm of the controller; implements `scene.arm.MovingArm`."""

    name: str
    """Prefix of its entity names; empty if there is only one robot."""
    robot: Robot
    samples: Samples
    clock: Clock = _CLOCK

    def entity(self, path: str) -> str:
        """Return the entity path with the prefix of this arm; see `MovingArm`."""
        return f"{self.name}/{path}" if self.name else path

    def frame(self, name: str) -> str:
        """Return the frame name with the prefix of this arm; see `MovingArm`."""
        return f"{self.name}/{name}" if self.name else name


_VIEWER: Final = ("127.0.0.1", 9876)
"""Default address at which a viewer listens."""
_OPENS_S: Final = 10.0
"""Time limit [s] for a viewer to open."""


def _open_viewer() -> None:
    """Open a viewer and wait until it listens; earlier data would be lost in the file too.

    Raises:
        InputError: If no viewer opens in time.
    """
    # The module, not the script: it exists for any PATH.
    command = [sys.executable, "-P", "-m", "rerun", "--port", str(_VIEWER[1])]
    quiet = subprocess.DEVNULL
    subprocess.Popen(command, stdin=quiet, stdout=quiet, stderr=quiet, start_new_session=True)
    until_s = monotonic() + _OPENS_S
    while True:
        try:
            create_connection(_VIEWER, 1.0).close()
        except OSError:
            if monotonic() > until_s:
                raise InputError("--view: no viewer has opened", "leave out --view") from None
            sleep(0.1)
        else:
            return


@value_class(slots=True, eq=False)
class LiveRecording:
    """Recording that can only be extended, in order of time; the file appears at `close`."""

    path: Path
    view: bool
    """Whether to open a viewer that receives all data immediately."""
    _open: ExitStack = field(default_factory=ExitStack)
    _stream: rr.RecordingStream | None = None
    _states: dict[str, str] = field(default_factory=dict)
    _chains: dict[str, Chain] = field(default_factory=dict)

    def begin(self, arms: Sequence[tuple[LiveArm, Transform]]) -> None:
        """Begin with the current positions of arms, each with world_from_base.

        Raises:
            InputError: If the file cannot be written, or no viewer opens.
        """
        if self.view:
            _open_viewer()
        layout = _layout([arm for arm, _ in arms])
        # Two sessions are never equal, as requests come when they come.
        file = recording_file(self.path, uuid.uuid4(), layout, view=self.view)
        stream = self._stream = self._open.enter_context(file)
        stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, rr.CoordinateFrame(WORLD), static=True)
        for arm, world_from_base in arms:
            where = static_frame(WORLD, arm.frame(BASE), world_from_base)
            stream.log(arm.entity("base"), where, static=True)
            logged = log_arm(stream, arm)
            self._chains[arm.name] = logged.chain
            for remark in logged.remarks:
                self.log_text(0.0, "recording", remark, "WARN")
            for number, joint in enumerate(arm.robot.joints, start=1):
                line = rr.SeriesLines(names=[f"{number} {joint.name}"])
                stream.log(arm.entity(f"axes/{number}"), line, static=True)

    def moved(self, arm: LiveArm) -> None:
        """Log the motion of an arm in its samples."""
        assert self._stream is not None
        log_motion(self._stream, arm, self._chains[arm.name])
        index = _CLOCK.columns(arm.samples.times)
        for number, values in enumerate(np.degrees(arm.samples.joints).T, start=1):
            columns = rr.Scalars.columns(scalars=values)
            self._stream.send_columns(arm.entity(f"axes/{number}"), indexes=index, columns=columns)

    def log_text(self, time_s: float, source: str, text: str, level: str = "INFO") -> None:
        """Log a text at a time [s]."""
        self._log(time_s, f"{LOG}/{source}", rr.TextLog(text, level=level))

    def state(self, time_s: float, name: str, state: str) -> None:
        """Log a state from a time [s] on; nothing is written if it has not changed."""
        if self._states.get(name) != state:
            self._states[name] = state
            self._log(time_s, f"{STATES}/{name}", rr.StateChange(state=state))

    def wanted(self, time_s: float, name: str, values: Array) -> None:
        """Log the goal of a sensor: joints [deg], a position or a correction [mm]."""
        self._log(time_s, f"{TARGETS}/{name}", rr.Scalars(values))

    def close(self) -> None:
        """Complete the file.

        Raises:
            InputError: If its end could not be written.
        """
        if self._stream is not None:
            self._stream = None
            self._open.close()

    def _log(self, time_s: float, entity: str, components: rr.AsComponents) -> None:
        assert self._stream is not None
        self._stream.set_time(SIM_TIME, duration=np.timedelta64(round(time_s * 1e9), "ns"))
        self._stream.log(entity, components)


def _layout(arms: Sequence[LiveArm]) -> rrb.Blueprint:
    axes = [
        rrb.TimeSeriesView(
            origin=f"/{arm.entity('axes')}", name=f"{arm.name} axes [{arm.robot.units()}]".strip()
        )
        for arm in arms
    ]
    return laid_out(
        rrb.Vertical(
            rrb.Horizontal(
                rrb.Spatial3DView(
                    origin="/",
                    name="Cell",
                    spatial_information=rrb.SpatialInformation(target_frame=WORLD, show_axes=False),
                ),
                rrb.TextLogView(origin=f"/{LOG}", name="Requests, texts, events"),
                column_shares=[3, 2],
            ),
            rrb.Horizontal(
                *axes,
                rrb.TimeSeriesView(origin=f"/{TARGETS}", name="What sensors want"),
                rrb.StateTimelineView(origin=f"/{STATES}", name="Tasks"),
            ),
            row_shares=[3, 2],
        )
    )
