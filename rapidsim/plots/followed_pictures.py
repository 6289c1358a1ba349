"""Pictures of a trajectory without a program: path, position, joints, deviation, attitude."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.axes3d import Axes3D

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array, unbroken
from rapidsim.motion.waypoints.attitudes import AttitudeRates, attitude_rates
from rapidsim.motion.waypoints.follow import FollowedTrajectory
from rapidsim.plots.arm_picture import arm_at_both_ends
from rapidsim.plots.stick_arm import MM, as_cube
from rapidsim.plots.theme import mark_start, new_figure, time_axis, write_name
from rapidsim.plots.time_pictures import draw_joint, draw_quaternions
from rapidsim.plots.write import write_pictures

_AXES = ("x [mm]", "y [mm]", "z [mm]")
_SIDES: tuple[tuple[str, tuple[int, ...]], ...] = (
    ("from above", (0, 1)),
    ("from the side", (0, 2)),
    ("from the front", (1, 2)),
)
_MOST_NAMES = 40
_LEAST_OFF_MM = 0.01
"""Minimum range [mm] of axes of deviations, so that rounding does not look like a motion."""
_COLUMNS = 2


def write_followed_plots(
    followed: FollowedTrajectory, title: str, folder: Path
) -> tuple[Path, ...]:
    """Write the pictures of a trajectory, light and dark.

    Args:
        followed: The trajectory.
        title: Title of the trajectory.
        folder: Target folder, which is created if its parent exists.

    Raises:
        InputError: If the files cannot be written.
    """
    name = f"{title} on {followed.robot.title}"
    pictures = {
        "way": lambda theme: path_picture(followed, name, theme),
        "arm": lambda theme: _arm_picture(followed, name, theme),
        "position": lambda theme: position_picture(followed, name, theme),
        "joints": lambda theme: joints_picture(followed, name, theme),
        "deviation": lambda theme: deviation_picture(followed, name, theme),
        "orientation": lambda theme: orientation_picture(followed, name, theme),
    }
    return write_pictures(pictures, folder)


def path_picture(followed: FollowedTrajectory, name: str, theme: Colours) -> Figure:
    """Draw the points with their numbers, the lines between them, and the path of the TCP."""
    figure = new_figure(f"Way of the TCP: {name}", width=11.0, height=8.4)
    grid = figure.add_gridspec(2, 2)
    space: Axes3D = figure.add_subplot(grid[0, 0], projection="3d")
    views: list[tuple[Axes, tuple[int, ...], str]] = [(space, (0, 1, 2), "in space, base frame")]
    for place, (side, shown) in zip((grid[0, 1], grid[1, 0], grid[1, 1]), _SIDES, strict=True):
        views.append((figure.add_subplot(place), shown, side))
    points = MM * followed.points.positions
    way = MM * followed.samples.base_from_tcp.translation
    for axes, shown, title in views:
        axes.set_title(title)
        axes.plot(*points[:, shown].T, color=theme.programmed, linewidth=0.9, label="straight")
        axes.plot(*way[:, shown].T, color=theme.tcp, label="TCP")
        axes.plot(*points[:, shown].T, "o", color=theme.ink, markersize=3.0, label="points")
        mark_start(axes, way[0, shown], theme)
        axes.set_xlabel(_AXES[shown[0]])
        axes.set_ylabel(_AXES[shown[1]])
        if axes is not space:
            _number_points(axes, followed, points[:, shown], theme)
            axes.set_aspect("equal", adjustable="datalim")
    space.set_zlabel(_AXES[2])
    as_cube(space, np.concatenate([points, way]))
    space.view_init(elev=26.0, azim=-50.0)
    for pane in (space.xaxis, space.yaxis, space.zaxis):
        pane.set_pane_color((0.0, 0.0, 0.0, 0.0))
        pane.set_major_locator(MaxNLocator(5))
    handles, labels = space.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper right", ncols=len(labels))
    return figure


def position_picture(followed: FollowedTrajectory, name: str, theme: Colours) -> Figure:
    """Draw the coordinates x, y, z of the TCP over time, and its speed."""
    figure = new_figure(f"Position of the TCP: {name}", width=11.0, height=7.6)
    samples = followed.samples
    rows = figure.subplots(4, 1, sharex=True)
    for axis, axes in enumerate(rows[:3]):
        axes.plot(
            samples.times, MM * samples.base_from_tcp.translation[:, axis],
            color=theme.joints[axis],
        )  # fmt: skip
        axes.set_ylabel(_AXES[axis])
    _mark_points(rows, followed, theme)
    rows[0].set_title("base frame; the points are passed at the dotted lines")
    rows[3].plot(samples.times, MM * samples.tcp_speed, color=theme.tcp)
    rows[3].set_ylabel("speed [mm/s]")
    rows[3].set_ylim(bottom=0.0)
    time_axis(rows[3], followed.duration)
    return figure


def joints_picture(followed: FollowedTrajectory, name: str, theme: Colours) -> Figure:
    """Draw each joint's angle between its limits, with the share of its speed that it needs."""
    robot, samples = followed.robot, followed.samples
    count = len(robot.joints)
    rows = -(-count // _COLUMNS)
    figure = new_figure(f"Joints: {name}", width=11.0, height=1.0 + 2.1 * rows)
    for k, axes in enumerate(np.ravel(figure.subplots(rows, _COLUMNS, sharex=True))):
        if k >= count:
            axes.set_visible(False)
            continue
        draw_joint(axes, robot, k, samples.times, samples.joints, theme)
        ratio = followed.speed_ratios[k]
        if ratio is not None:
            said = f"{axes.get_title(loc='left')}, up to {100.0 * ratio:.0f} % of its speed"
            axes.set_title(said)
        if k >= count - _COLUMNS:
            time_axis(axes, followed.duration)
    return figure


def deviation_picture(followed: FollowedTrajectory, name: str, theme: Colours) -> Figure:
    """Draw the distance of the TCP from the request, by forward kinematics of the joints."""
    figure = new_figure(f"Deviation: {name}", width=11.0, height=3.8)
    axes = figure.subplots()
    off = MM * followed.deviation
    axes.plot(followed.samples.times, off, color=theme.error)
    of_what = "the path asked for" if followed.plan.kind.of_tcp else "the straight lines"
    axes.set_title(
        f"from {of_what}: at most {_length(followed.deviation_max)}, "
        f"rms {_length(followed.deviation_rms)}"
    )
    axes.set_ylabel("distance [mm]")
    most = max(float(off.max()), _LEAST_OFF_MM)
    # Slightly below 0, because the frame would hide a curve of zeros.
    axes.set_ylim(-0.05 * most, 1.1 * most)
    _mark_points([axes], followed, theme)
    time_axis(axes, followed.duration)
    return figure


def orientation_picture(followed: FollowedTrajectory, name: str, theme: Colours) -> Figure:
    """Draw the attitude as a quaternion with its norm, and the uniformity of its rotation.

    Compares slerp with linear quaternion interpolation, which is an equal rotation that is faster
    in its middle.
    """
    figure = new_figure(f"Orientation of the TCP: {name}", width=11.0, height=8.4)
    upper, middle, lower = figure.subplots(3, 1, sharex=True)
    times = followed.samples.times
    quaternions = unbroken(followed.samples.base_from_tcp.quaternion)
    draw_quaternions(upper, times, quaternions, theme)
    figure.legend(loc="upper right", ncols=5)
    rates = attitude_rates(followed)
    _draw_rates(middle, lower, times, rates, theme)
    _mark_points([upper, middle, lower], followed, theme)
    time_axis(lower, followed.duration)
    return figure


def _draw_rates(
    angle: Axes, rate: Axes, times: Array, rates: AttitudeRates, theme: Colours
) -> None:
    angle.set_title("turned since the point before")
    rate.set_title("how fast it turns")
    angle.set_ylabel("angle [°]")
    rate.set_ylabel("rate [°/s]")
    rows = [(rates.angle, rates.rate, theme.tcp, "-", "as driven")]
    if rates.linear_angle is not None and rates.linear_rate is not None:
        look = (theme.error, "--", "quaternions interpolated linearly")
        rows.append((rates.linear_angle, rates.linear_rate, *look))
    for turned, speed, colour, line, label in rows:
        angle.plot(times, np.degrees(turned), color=colour, linestyle=line, label=label)
        rate.plot(times, np.degrees(speed), color=colour, linestyle=line)
    angle.set_ylim(0.0, max(1.08 * float(np.degrees(rates.angle).max()), 0.01))
    top = max(float(np.degrees(speed).max()) for _, speed, *_ in rows)
    rate.set_ylim(0.0, max(1.08 * top, 0.01))
    if len(rows) > 1:
        angle.legend(loc="upper left")


def _arm_picture(followed: FollowedTrajectory, name: str, theme: Colours) -> Figure:
    tools = (followed.flange_from_tcp, followed.flange_from_tcp)
    way = MM * followed.samples.base_from_tcp.translation
    return arm_at_both_ends(followed.robot, followed.samples.joints, tools, way, name, theme)


def _mark_points(rows: list[Axes], followed: FollowedTrajectory, theme: Colours) -> None:
    """Draw vertical lines at the times of the points."""
    begins = np.flatnonzero(np.diff(followed.samples.move)) + 1
    if len(begins) <= _MOST_NAMES:
        for axes in rows:
            for time in followed.samples.times[begins].tolist():
                axes.axvline(time, color=theme.soft, linewidth=0.8, linestyle=":", zorder=0.9)


def _number_points(axes: Axes, followed: FollowedTrajectory, places: Array, theme: Colours) -> None:
    if len(places) > _MOST_NAMES:
        return
    for row, place in enumerate(places):
        write_name(axes, str(followed.points.number(row)), place, theme)


def _length(metres: float) -> str:
    mm = MM * metres
    return f"{mm:.3f} mm" if mm >= 1e-3 else f"{mm:.0e} mm"
