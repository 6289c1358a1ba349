"""Curves over time: joints with their limits, TCP speed with corners, orientation."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array, unbroken
from rapidsim.motion.robot.external_axes import with_unit
from rapidsim.motion.robot.robot import Robot
from rapidsim.plots.sampled_run import MM, title_of
from rapidsim.plots.theme import new_figure, time_axis
from rapidsim.simulation.results.move_kinds import CORNER
from rapidsim.simulation.results.sampling import SampledRun

_COLUMNS = 2
_CAPPED = 2.0
"""Multiple of the highest speed above which a programmed speed may exceed the picture."""


def joints_picture(run: SampledRun, theme: Colours) -> Figure:
    """Draw each joint's angle between its limits, with its speed as a share of the maximum."""
    robot, samples = run.robot_run.robot, run.samples
    count = len(robot.joints)
    rows = -(-count // _COLUMNS)
    figure = new_figure(f"Joints: {title_of(run)}", width=11.0, height=1.0 + 2.1 * rows)
    for k, axes in enumerate(np.ravel(figure.subplots(rows, _COLUMNS, sharex=True))):
        if k >= count:
            axes.set_visible(False)
            continue
        share = np.abs(run.speed_shares[:, k]).max()
        draw_joint(axes, robot, k, samples.times, samples.joints, theme)
        axes.set_title(f"{axes.get_title(loc='left')}, up to {share:.0f} % of its speed")
        if k >= count - _COLUMNS:
            time_axis(axes, run.end_s)
    return figure


def draw_joint(
    axes: Axes, robot: Robot, k: int, times: Array, joints: Array, theme: Colours
) -> None:
    """Draw joint k, from 0, with its limits: joints (n, joints) [rad] over times (n,) [s]."""
    angle = np.degrees(joints[:, k])
    lower, upper = np.degrees(robot.lower[k]), np.degrees(robot.upper[k])
    axes.plot(times, angle, color=theme.joints[k % len(theme.joints)])
    joint = robot.joints[k]
    axes.set_ylabel("way [mm]" if joint.slides else "angle [°]")
    if not np.isfinite([lower, upper]).all():
        axes.set_title(f"joint {k + 1}: turns without end")
        return
    for limit in (lower, upper):
        axes.axhline(limit, color=theme.error, linestyle="--", linewidth=0.9)
    margin = min(float((angle - lower).min()), float((upper - angle).min()))
    axes.set_title(f"joint {k + 1}: {with_unit(f'{margin:.1f}', joint.measure)} from a limit")
    air = 0.08 * (upper - lower)
    axes.set_ylim(min(lower, angle.min()) - air, max(upper, angle.max()) + air)


def speed_picture(run: SampledRun, theme: Colours) -> Figure:
    """Draw the TCP's speed against the programmed one, with shaded corners."""
    figure = new_figure(f"TCP speed: {title_of(run)}", width=11.0, height=4.2)
    axes = figure.subplots()
    times, speed = run.samples.times, MM * run.samples.tcp_speed
    _shade_corners(axes, run, theme)
    step_times, steps = _programmed(run)
    axes.step(step_times, steps, where="post", color=theme.programmed, label="programmed")
    axes.plot(times, speed, color=theme.tcp, linewidth=1.7, label="TCP")
    top = max(float(speed.max()), 1.0)
    axes.set_ylim(0.0, 1.08 * max(top, min(float(steps.max(initial=0.0)), _CAPPED * top)))
    axes.set_ylabel("speed [mm/s]")
    time_axis(axes, run.end_s)
    figure.legend(loc="upper right", ncols=3)
    return figure


def orientation_picture(run: SampledRun, theme: Colours) -> Figure:
    """Draw the orientation of the TCP as a quaternion, and its rotation within each move."""
    figure = new_figure(f"Orientation of the TCP: {title_of(run)}", width=11.0, height=6.4)
    upper, lower = figure.subplots(2, 1, sharex=True)
    times = run.samples.times
    quaternions = unbroken(run.samples.base_from_tcp.quaternion)
    draw_quaternions(upper, times, quaternions, theme)
    figure.legend(loc="upper right", ncols=5)
    _shade_corners(lower, run, theme)
    lower.plot(times, _turned_deg(run, quaternions), color=theme.tcp)
    lower.set_title("turned since the start of the move; on lines evenly with the way (SLERP)")
    lower.set_ylabel("angle [°]")
    lower.set_ylim(bottom=0.0)
    time_axis(lower, run.end_s)
    return figure


def draw_quaternions(axes: Axes, times: Array, quaternions: Array, theme: Colours) -> None:
    """Draw quaternions (k, 4) at instants (k,) [s], with their norm."""
    for k in range(4):
        axes.plot(times, quaternions[:, k], color=theme.joints[k], label=f"q{k + 1}")
    norm = np.linalg.norm(quaternions, axis=1)
    axes.plot(times, norm, color=theme.programmed, linestyle="--", label="norm")
    off = np.abs(norm - 1.0).max()
    within = f" within {off:.0e}" if off else ""
    axes.set_title(f"quaternion, base frame, scalar first; its norm is 1{within}")
    axes.set_ylim(-1.08, 1.12)


def _shade_corners(axes: Axes, run: SampledRun, theme: Colours) -> None:
    """Draw bands over the whole height, as one patch: a long path has thousands of corners."""
    if run.in_corner.any():
        axes.fill_between(
            run.samples.times,
            0.0,
            1.0,
            where=run.in_corner,
            transform=axes.get_xaxis_transform(),
            color=theme.moves[CORNER],
            alpha=0.18,
            linewidth=0,
            label="corner",
        )


def _programmed(run: SampledRun) -> tuple[Array, Array]:
    """Return instants [s] and the programmed speed [mm/s] from each on; 0 without motion."""
    steps: dict[float, float] = {0.0: 0.0}
    for move in run.robot_run.moves:
        steps[move.end_s] = 0.0
        steps[move.start_s] = move.move.speed.v_tcp
    steps.setdefault(run.end_s, 0.0)
    times = sorted(steps)
    return np.array(times), np.array([steps[time] for time in times])


def _turned_deg(run: SampledRun, quaternions: Array) -> Array:
    """Return the angle [deg] (k,) from the orientation at the start of the active move."""
    changes = np.flatnonzero(np.diff(run.samples.move, prepend=-1) != 0)
    first = changes[np.searchsorted(changes, np.arange(len(quaternions)), side="right") - 1]
    product = np.abs(np.sum(quaternions * quaternions[first], axis=1))
    angle: Array = np.degrees(2.0 * np.arccos(np.clip(product, 0.0, 1.0)))
    return angle
