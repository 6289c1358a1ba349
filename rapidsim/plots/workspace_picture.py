"""Workspace of an arm: a section through axis 1 and the view from above."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Interpolation
from rapidsim.motion.workspace import ArmWorkspace
from rapidsim.plots.stick_arm import MM, draw_stick, stick
from rapidsim.plots.theme import new_figure
from rapidsim.plots.write import write_pictures
from rapidsim.simulation.results.move_kinds import MOVE_KINDS

_PIXELS = 600
"""Number of pixels across the view from above."""
_FILLED = 0.35
"""Opacity of filled areas."""


def write_workspace_plots(workspace: ArmWorkspace, folder: Path) -> tuple[Path, ...]:
    """Write the picture, light and dark.

    Raises:
        InputError: If the files cannot be written.
    """
    return write_pictures({"workspace": partial(workspace_picture, workspace)}, folder)


def workspace_picture(workspace: ArmWorkspace, theme: Colours) -> Figure:
    """Draw both views, with the arm at its position before a run."""
    title = f"Workspace of the flange: {workspace.robot.title}, {workspace.volume:.2f} m³"
    figure = new_figure(title, width=11.0, height=5.6)
    section, above = figure.subplots(1, 2)
    corners = stick(workspace.robot, workspace.robot.start, Transform.identity())
    _draw_section(section, workspace, corners, theme)
    _draw_from_above(above, workspace, corners, theme)
    return figure


def _draw_section(axes: Axes, workspace: ArmWorkspace, corners: Array, theme: Colours) -> None:
    """Draw the half plane through axis 1 with the reached cells."""
    near, far, low, high = (MM * value for value in workspace.extent)
    rows, columns = workspace.section.shape
    axes.imshow(
        np.ma.masked_where(~workspace.section, workspace.section.astype(float)),
        origin="lower",
        extent=(
            0.0,
            MM * workspace.cell * columns,
            MM * workspace.lowest,
            MM * (workspace.lowest + workspace.cell * rows),
        ),
        cmap=ListedColormap([theme.moves[MOVE_KINDS[Interpolation.LINE]]]),
        alpha=_FILLED,
        aspect="equal",
        interpolation="nearest",
    )
    in_section = np.column_stack(
        [np.hypot(corners[:, 0], corners[:, 1]), np.zeros(len(corners)), corners[:, 2]]
    )
    draw_stick(axes, in_section, theme.accent, theme, (0, 2), "")
    axes.set_title(
        f"section through axis 1: {near:.0f} to {far:.0f} mm from it, {low:.0f} to {high:.0f} high"
    )
    axes.set_xlabel("from axis 1 [mm]")
    axes.set_ylabel("z [mm]")
    axes.set_aspect("equal", adjustable="datalim")


def _draw_from_above(axes: Axes, workspace: ArmWorkspace, corners: Array, theme: Colours) -> None:
    """Draw what is reached at any height."""
    far = MM * workspace.extent[1]
    columns, directions = workspace.above.shape
    side = np.linspace(-far, far, _PIXELS)
    x, y = np.meshgrid(side, side)
    column = (np.hypot(x, y) / (MM * workspace.cell)).astype(np.int64)
    turn = np.round(np.arctan2(y, x) * directions / (2.0 * np.pi)).astype(np.int64) % directions
    is_reached = (column < columns) & workspace.above[np.minimum(column, columns - 1), turn]
    axes.imshow(
        np.ma.masked_where(~is_reached, is_reached.astype(float)),
        origin="lower",
        extent=(-far, far, -far, far),
        cmap=ListedColormap([theme.moves[MOVE_KINDS[Interpolation.LINE]]]),
        alpha=_FILLED,
        interpolation="nearest",
    )
    draw_stick(axes, corners, theme.accent, theme, (0, 1), "")
    axes.set_xlim(-1.08 * far, 1.08 * far)
    axes.set_ylim(-1.08 * far, 1.08 * far)
    axes.set_aspect("equal", adjustable="box")
    axes.set_title(f"from above: {np.degrees(workspace.swept):.0f}° around axis 1")
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("y [mm]")
