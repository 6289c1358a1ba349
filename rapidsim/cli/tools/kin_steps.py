"""Steps of `rapidsim kin` on a posture: show, record, draw."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from rapidsim.cli.open_command import open_command
from rapidsim.cli.options.outputs import new_plots, new_recording
from rapidsim.cli.terminal import current_terminal, echo
from rapidsim.cli.tools.opened_viewer import open_viewer
from rapidsim.cli.viewer import require_screen
from rapidsim.extras import require
from rapidsim.frames.transform import Array
from rapidsim.motion.configurations.confdata import distinct
from rapidsim.motion.configurations.pose_solutions import PoseSolutions
from rapidsim.motion.configurations.postures import Posture, Postures
from rapidsim.report.run.summary import OutputFile, files_text
from rapidsim.report.tables.kin_tables import posture_markdown
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
