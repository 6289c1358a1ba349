"""The workspace of an arm: a section through axis 1 and the view from above."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Wedge

from rapidsim.frames.transform import Transform
from rapidsim.language.moves import Interpolation
from rapidsim.motion.waypoints.workspace import Workspace
from rapidsim.plots.look import Theme, new_figure
from rapidsim.plots.stick_arm import MM, draw_stick, stick
from rapidsim.plots.write import write_pictures


def write_workspace_plots(found: Workspace, folder: Path) -> tuple[Path, ...]:
    """Write the picture, light and dark.

    Raises:
        InputError: When nothing can be written there.
    """
    return write_pictures({"workspace": partial(workspace_picture, found)}, folder)


def workspace_picture(found: Workspace, theme: Theme) -> Figure:
    """Both views, with the arm as it stands before a run."""
    robot = found.robot
    title = f"Workspace of the flange: {robot.title}, {found.volume:.2f} m³"
    figure = new_figure(title, width=11.0, height=5.6)
    section, above = figure.subplots(1, 2)
    near, far, low, high = (MM * value for value in found.extent)
    cells = np.ma.masked_where(~found.section, found.section.astype(float))
    colour = ListedColormap([theme.moves[Interpolation.LINE]])
    rows, columns = found.section.shape
    section.imshow(
        cells,
        origin="lower",
        extent=(
            0.0,
            MM * found.cell * columns,
            MM * found.lowest,
            MM * (found.lowest + found.cell * rows),
        ),
        cmap=colour,
        alpha=0.35,
        aspect="equal",
        interpolation="nearest",
    )
    corners = stick(robot, robot.start, Transform.identity())
    in_section = np.column_stack(
        [np.hypot(corners[:, 0], corners[:, 1]), np.zeros(len(corners)), corners[:, 2]]
    )
    draw_stick(section, in_section, theme.bar, theme, (0, 2), "")
    section.set_title(
        f"section through axis 1: {near:.0f} to {far:.0f} mm from it, {low:.0f} to {high:.0f} high"
    )
    section.set_xlabel("from axis 1 [mm]")
    section.set_ylabel("z [mm]")
    section.set_aspect("equal", adjustable="datalim")
    first, last = (float(np.degrees(value)) for value in found.turn)
    if last - first >= 360.0:
        first, last = 0.0, 360.0
    green = theme.moves[Interpolation.LINE]
    ring = Wedge((0.0, 0.0), far, first, last, width=far - near, color=green, alpha=0.35)
    above.add_patch(ring)
    draw_stick(above, corners, theme.bar, theme, (0, 1), "")
    above.set_xlim(-1.08 * far, 1.08 * far)
    above.set_ylim(-1.08 * far, 1.08 * far)
    above.set_aspect("equal", adjustable="box")
    above.set_title(f"from above: axis 1 turns by {np.degrees(found.swept):.0f}°")
    above.set_xlabel("x [mm]")
    above.set_ylabel("y [mm]")
    return figure
