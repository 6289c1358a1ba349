"""Steps of `rapidsim kin` on a posture: show, record, draw."""

from __future__ import annotations

import os
from math import radians
from pathlib import Path

import numpy as np

from rapidsim.applications.kin.kin_tables import posture_markdown
from rapidsim.cli.open_command import open_command
from rapidsim.cli.options import poses
from rapidsim.cli.options.new_files import new_plots, new_recording
from rapidsim.cli.terminal import current_terminal, echo
from rapidsim.cli.tools.opened_viewer import open_viewer
from rapidsim.cli.viewer import require_screen
from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.frames.euler import Convention, rotation_from_euler
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import distinct
from rapidsim.motion.configurations.pose_solutions import PoseSolutions
from rapidsim.motion.configurations.postures import Posture, Postures
from rapidsim.motion.waypoints.points import posed
from rapidsim.report.run.summary import OutputFile, files_text
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class PostureOutputs:
    """Files to write of a posture; None is not written."""

    recording: Path | None
    plots: Path | None
    view: bool


def outputs(record: str | None, plots: str | None, view: bool, default: str) -> PostureOutputs:
    """The places to write to, refused before anything is computed.

    Raises:
        InputError: If a file cannot be written or there is no screen for the viewer.
    """
    if view:
        require("rerun", "--view")
        require_screen()
        record = record or default
    return PostureOutputs(
        new_recording(record) if record else None, new_plots(plots) if plots else None, view
    )


def write(postures: Postures, asked: PostureOutputs, *, quiet: bool) -> tuple[OutputFile, ...]:
    """Write the requested files, open the viewer, and list the files unless `quiet`."""
    files = []
    if asked.recording:
        # rerun would repeat our messages on stderr in other words.
        os.environ.setdefault("RUST_LOG", "off")
        from rapidsim.recording.layout.posture_recording import record_postures

        record_postures(postures, posture_markdown(postures), asked.recording)
        files.append(OutputFile(asked.recording, "recording", open_command(asked.recording)))
    if asked.plots:
        from rapidsim.plots.posture_pictures import write_posture_plots

        write_posture_plots(postures, asked.plots)
        files.append(OutputFile(asked.plots, "plots"))
    if files and not quiet and not current_terminal().quiet:
        echo("")
        current_terminal().show(files_text(files))
    if asked.view and asked.recording:
        open_viewer(asked.recording)
    return tuple(files)


def solved_postures(solutions: PoseSolutions, turns: Array) -> tuple[Posture, ...]:
    """The solutions of a pose to draw side by side; those a whole turn (n,) apart coincide."""
    postures = []
    for looks in distinct(np.array([solution.joints for solution in solutions.solutions]), turns):
        alike = [
            one
            for one in solutions.solutions
            if len(distinct(np.array([looks, one.joints]), turns)) == 1
        ]
        shown = min(alike, key=lambda one: float(np.abs(one.joints).sum()))
        name = f"[{','.join(map(str, shown.confdata))}]"
        postures.append(Posture(shown.joints, name, shown.within_limits))
    return tuple(postures)


def requested_pose(
    position: tuple[float, ...],
    quaternion: tuple[float, ...] | None,
    euler: tuple[float, ...] | None,
    convention: str,
    pitch: float | None,
    roll: float,
) -> Transform:
    """Pose of the TCP in the options of `kin ik`, in the base or the world.

    Raises:
        InputError: If they name none, or several.
    """
    given = [name for name, value in (("--quaternion", quaternion), ("--euler", euler),
                                      ("--pitch", pitch)) if value is not None]  # fmt: skip
    if len(given) != 1:
        named = " and ".join(given) or "none"
        raise InputError(
            f"give the orientation by one of --quaternion, --euler and --pitch, not by {named}"
        )
    place = np.array([value / 1000.0 for value in position])
    if quaternion is not None:
        return poses.pose(position, quaternion, "--quaternion")
    if euler is not None:
        angles = np.radians(np.array(euler))
        return Transform(rotation_from_euler(angles, Convention(convention)), place)
    assert pitch is not None
    about_tool = rotation_from_euler(np.array([radians(roll), 0.0, 0.0]), Convention.ZYX)
    upright = posed(place[None], np.array([[radians(pitch)]]))[0]
    return upright @ Transform(about_tool, np.zeros(3))
