"""Pictures of postures of an arm: the arm with its frames, and matrices as heat maps."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.axes3d import Axes3D

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Interpolation
from rapidsim.motion.configurations.postures import Postures
from rapidsim.motion.robot.external_axes import with_unit
from rapidsim.motion.robot.robot import Robot
from rapidsim.plots.stick_arm import MM, as_cube, draw_floor, draw_stick, draw_triads, stick
from rapidsim.plots.theme import new_figure
from rapidsim.plots.write import write_pictures
from rapidsim.simulation.results.move_kinds import MOVE_KINDS

_AXES = ("x [mm]", "y [mm]", "z [mm]")
_COLUMNS = 4
_TRIAD = 0.11
"""Length of the axes of a frame relative to the size of the arm."""
_FLOOR = 0.16
_ZOOM = 0.93
"""Zoom of 3D views, so that their labels do not overlap the next view."""
_ARROW = 0.35
_TWIST = ("vx", "vy", "vz", "wx", "wy", "wz")


def write_posture_plots(postures: Postures, folder: Path) -> tuple[Path, ...]:
    """Write the pictures of postures, light and dark.

    Raises:
        InputError: If the files cannot be written.
    """
    pictures: dict[str, Callable[[Colours], Figure | None]] = {
        "pose": partial(pose_picture, postures),
        "matrix": partial(matrix_picture, postures),
        "jacobian": partial(jacobian_picture, postures),
    }
    return write_pictures(pictures, folder)


def pose_picture(postures: Postures, theme: Colours) -> Figure:
    """Draw one posture from three sides, or several side by side in space."""
    if len(postures.rows) == 1:
        return _single(postures, theme)
    count = len(postures.rows)
    columns = min(count, _COLUMNS)
    rows = -(-count // columns)
    figure = new_figure(postures.title, width=3.6 * columns + 0.4, height=3.9 * rows + 0.7)
    everything = np.concatenate([_stick(postures, row) for row in range(count)])
    for number, posture in enumerate(postures.rows):
        axes: Axes3D = figure.add_subplot(rows, columns, number + 1, projection="3d")
        angles = joints_text(postures.robot, posture.joints)
        beyond = "" if posture.within_limits else "\noutside the limits"
        axes.set_title(f"{posture.name}\n{angles}{beyond}", fontsize=8.5)
        colour = theme.accent if posture.within_limits else theme.error
        _draw(axes, postures, number, colour, theme, (0, 1, 2))
        _dress(axes, postures, theme, everything)
    return figure


def joints_text(robot: Robot, joints: Array) -> str:
    """Format joints (n,) [rad], rounded to degrees, with the unit after the last."""
    values = [f"{round(value) + 0}" for value in np.degrees(joints).tolist()]
    if not robot.kinematics.slides.any():
        return f"{', '.join(values)}°"
    pairs = zip(values, robot.joints, strict=True)
    return ", ".join(with_unit(value, joint.measure) for value, joint in pairs)


def matrix_picture(postures: Postures, theme: Colours) -> Figure:
    """Draw the 4 x 4 matrix of the TCP: rotation as a heat map, and translation in mm."""
    figure = new_figure("Matrix of the TCP", width=6.6, height=5.2)
    axes = figure.subplots()
    matrix = postures.world_from_tcp.matrix
    heat = matrix.copy()
    # Lengths have another unit: colour them by their share of the longest.
    longest = max(float(np.abs(matrix[:3, 3]).max()), 1e-12)
    heat[:3, 3] /= longest
    words = [[f"{round(value, 6) + 0.0:.6f}" for value in row] for row in matrix.tolist()]
    for row in range(3):
        words[row][3] = f"{MM * matrix[row, 3]:.3f}\nmm"
    words[3] = ["0", "0", "0", "1"]
    _heat_map(axes, heat, words, theme)
    axes.set_xticks(range(4), ["x axis", "y axis", "z axis", "position"])
    axes.set_yticks(range(4), ["x", "y", "z", ""])
    determinant = float(np.linalg.det(matrix[:3, :3]))
    off = float(np.abs(matrix[:3, :3] @ matrix[:3, :3].T - np.eye(3)).max())
    within = max(abs(determinant - 1.0), off, np.finfo(np.float64).eps)
    axes.set_title(f"{postures.title}\ndeterminant and R R' are 1 within {within:.0e}")
    return figure


def jacobian_picture(postures: Postures, theme: Colours) -> Figure | None:
    """Draw the Jacobian as a heat map, and its singular values; None without a Jacobian."""
    if postures.differential is None:
        return None
    jacobian = postures.differential.jacobian
    count = jacobian.shape[1]
    figure = new_figure(f"Jacobian: {postures.title}", width=9.6, height=4.8)
    heat, bars = figure.subplots(1, 2, width_ratios=[1.7, 1.0])
    words = [[f"{round(value, 3) + 0.0:.3f}" for value in row] for row in jacobian.tolist()]
    _heat_map(heat, jacobian / max(float(np.abs(jacobian).max()), 1e-12), words, theme)
    heat.set_xticks(range(count), [f"J{k + 1}" for k in range(count)])
    heat.set_yticks(range(6), _TWIST)
    heat.set_title("base frame, m/rad and rad/rad")
    values = postures.differential.singular_values
    places = np.arange(len(values))
    bars.bar(places, values, color=theme.accent, width=0.6)
    for place, value in zip(places.tolist(), values.tolist(), strict=True):
        bars.annotate(
            f"{value:.3g}", (place, value), xytext=(0, 3), textcoords="offset points", ha="center",
            fontsize=8.0, color=theme.soft,
        )  # fmt: skip
    bars.set_xticks(places, [str(place + 1) for place in places])
    bars.grid(visible=False, axis="x")
    bars.set_title("singular values; 0 is singular")
    bars.margins(y=0.15)
    return figure


def _single(postures: Postures, theme: Colours) -> Figure:
    figure = new_figure(postures.title, width=11.0, height=5.0)
    grid = figure.add_gridspec(1, 3, width_ratios=(1.35, 1.0, 1.0))
    space: Axes3D = figure.add_subplot(grid[0, 0], projection="3d")
    _draw(space, postures, 0, theme.accent, theme, (0, 1, 2))
    in_world = not np.allclose(postures.world_from_base.matrix, np.eye(4))
    space.set_title(f"in space, {'world' if in_world else 'base frame'}")
    views: Sequence[tuple[Axes, tuple[int, ...], str]] = (
        (figure.add_subplot(grid[0, 1]), (0, 2), "from the side"),
        (figure.add_subplot(grid[0, 2]), (0, 1), "from above"),
    )
    for axes, sides, title in views:
        _draw(axes, postures, 0, theme.accent, theme, sides)
        axes.set_title(title)
        axes.set_xlabel(_AXES[sides[0]])
        axes.set_ylabel(_AXES[sides[1]])
        axes.set_aspect("equal", adjustable="datalim")
    _dress(space, postures, theme, _stick(postures, 0))
    handles, labels = space.get_legend_handles_labels()
    if labels:
        figure.legend(handles, labels, loc="upper right", ncols=len(labels))
    return figure


def _draw(
    axes: Axes, postures: Postures, row: int, colour: str, theme: Colours, sides: tuple[int, ...]
) -> None:
    draw_stick(axes, _stick(postures, row), colour, theme, sides, "arm")
    size = MM * postures.size
    draw_triads(axes, postures.frames(row), _TRIAD * size, theme, sides)
    weakest = postures.weakest
    if weakest is None or row:
        return
    direction, label = weakest
    start = MM * postures.world_from_tcp.translation
    tip = start + _ARROW * size * direction
    ends = np.stack([start - (tip - start), tip])[:, sides]
    axes.plot(*ends.T, color=theme.error, linewidth=2.0, linestyle="--", label=label, zorder=5)


def _stick(postures: Postures, row: int) -> Array:
    base = stick(postures.robot, postures.rows[row].joints, postures.flange_from_tcp)
    world: Transform = postures.world_from_base
    return MM * world.apply(base / MM)


def _dress(axes: Axes3D, postures: Postures, theme: Colours, points: Array) -> None:
    axes.set_xlabel(_AXES[0])
    axes.set_ylabel(_AXES[1])
    axes.set_zlabel(_AXES[2])
    draw_floor(axes, _FLOOR * MM * postures.size, theme, postures.world_from_base)
    as_cube(axes, points, zoom=_ZOOM)
    axes.view_init(elev=22.0, azim=-55.0)
    for pane in (axes.xaxis, axes.yaxis, axes.zaxis):
        pane.set_pane_color((0.0, 0.0, 0.0, 0.0))
        pane.set_major_locator(MaxNLocator(4))


def _heat_map(axes: Axes, values: Array, words: list[list[str]], theme: Colours) -> None:
    """Draw numbers from -1 to 1 as coloured cells, with texts on them."""
    ends = (theme.error, theme.panel, theme.moves[MOVE_KINDS[Interpolation.JOINT]])
    colours = LinearSegmentedColormap.from_list("signed", ends)
    axes.imshow(values, cmap=colours, vmin=-1.4, vmax=1.4, aspect="auto")
    for row, texts in enumerate(words):
        for column, text in enumerate(texts):
            axes.text(column, row, text, ha="center", va="center", fontsize=8.5, color=theme.ink)
    axes.grid(visible=False)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
