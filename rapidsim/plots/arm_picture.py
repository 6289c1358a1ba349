"""Still picture of the arm at the start and end of its motion, with the path between."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.axes3d import Axes3D

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.plots.sampled_run import title_of
from rapidsim.plots.stick_arm import MM, as_cube, draw_floor, draw_stick, stick
from rapidsim.plots.theme import new_figure
from rapidsim.simulation.results.sampling import SampledRun

_AXES = ("x [mm]", "y [mm]", "z [mm]")
_FLOOR = 0.14
"""Radius of the ground relative to the size of the picture."""
_ZOOM = 0.93
"""Zoom of the 3D view, so that its labels do not overlap the next view."""


def arm_picture(run: SampledRun, theme: Colours) -> Figure:
    """Draw the robot of a run, in its base frame."""
    first, last = run.robot_run.moves[0], run.robot_run.moves[-1]
    return arm_at_both_ends(
        run.robot_run.robot,
        run.samples.joints,
        (first.tcp_from_flange.inverse(), last.tcp_from_flange.inverse()),
        MM * run.samples.base_from_tcp.translation,
        title_of(run),
        theme,
    )


def arm_at_both_ends(
    robot: Robot,
    joints: Array,
    tools: tuple[Transform, Transform],
    path: Array,
    title: str,
    theme: Colours,
) -> Figure:
    """Draw both postures from three sides.

    Args:
        robot: The arm.
        joints: Joints along the motion (k, n) [rad].
        tools: flange_from_tcp at the start and at the end.
        path: Path of the TCP (p, 3) [mm] in base.
        title: Title of the picture.
        theme: Light or dark.
    """
    figure = new_figure(f"Start and end: {title}", width=11.0, height=5.0)
    grid = figure.add_gridspec(1, 3, width_ratios=(1.35, 1.0, 1.0))
    sticks = [stick(robot, joints[row], tool) for row, tool in zip((0, -1), tools, strict=True)]
    points = np.concatenate([*sticks, path])
    space: Axes3D = figure.add_subplot(grid[0, 0], projection="3d")
    views: list[tuple[Axes, tuple[int, ...], str]] = [(space, (0, 1, 2), "in space, base frame")]
    views += [
        (figure.add_subplot(grid[0, 1]), (0, 2), "from the side"),
        (figure.add_subplot(grid[0, 2]), (0, 1), "from above"),
    ]
    for axes, shown, name in views:
        axes.set_title(name)
        axes.plot(*path[:, shown].T, color=theme.tcp, linewidth=1.2, label="path of the TCP")
        for corners, colour, label in zip(
            sticks, (theme.programmed, theme.accent), ("start", "end"), strict=True
        ):
            draw_stick(axes, corners, colour, theme, shown, label)
        axes.set_xlabel(_AXES[shown[0]])
        axes.set_ylabel(_AXES[shown[1]])
        if axes is not space:
            axes.set_aspect("equal", adjustable="datalim")
    space.set_zlabel(_AXES[2])
    draw_floor(space, _FLOOR * float(np.ptp(points, axis=0).max()), theme)
    as_cube(space, points, zoom=_ZOOM)
    space.view_init(elev=22.0, azim=-55.0)
    for pane in (space.xaxis, space.yaxis, space.zaxis):
        pane.set_pane_color((0.0, 0.0, 0.0, 0.0))
        pane.set_major_locator(MaxNLocator(4))
    handles, labels = space.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper right", ncols=len(labels))
    return figure
