"""Stick figure of an arm from foot to TCP, in space and from the sides, to show its posture."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.mplot3d.axes3d import Axes3D

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import Robot

MM = 1000.0
_WIDTH = 4.2
"""[points]"""


def stick(robot: Robot, joints: Array, flange_from_tcp: Transform) -> Array:
    """Return the corners (m, 3) [mm] of an arm's stick at joints (n,) [rad]: foot, axes, TCP."""
    links = robot.kinematics.link_frames(joints).translation
    flange = robot.forward(joints)
    corners = np.concatenate(
        [
            np.zeros((1, 3)),
            links,
            flange.translation[None],
            (flange @ flange_from_tcp).translation[None],
        ]
    )
    return MM * corners


def draw_stick(
    axes: Axes, corners: Array, colour: str, theme: Colours, view: tuple[int, ...], label: str
) -> None:
    """Draw a stick (m, 3) [mm] in a view that shows some of its three coordinates."""
    of_arm, tool = corners[:-1, view], corners[-2:, view]
    for bar, width, words in ((of_arm, _WIDTH, label), (tool, 0.5 * _WIDTH, None)):
        axes.plot(
            *bar.T,
            linewidth=width,
            color=colour,
            alpha=0.8,
            solid_joinstyle="round",
            solid_capstyle="round",
            label=words,
        )
    axes.plot(
        *of_arm.T,
        linestyle="none",
        marker="o",
        markersize=5.2,
        markerfacecolor=theme.panel,
        markeredgecolor=colour,
        markeredgewidth=1.2,
    )


def draw_triads(
    axes: Axes, base_from_frames: Transform, size_mm: float, theme: Colours, view: tuple[int, ...]
) -> None:
    """Draw the axes x, y, z of frames (k,) in red, green and blue."""
    origins = MM * base_from_frames.translation
    for axis in range(3):
        tips = origins + size_mm * base_from_frames.rotation[..., axis]
        for origin, tip in zip(origins, tips, strict=True):
            ends = np.stack([origin, tip])[:, view]
            axes.plot(*ends.T, color=theme.joints[axis], linewidth=1.3, zorder=4)


def draw_floor(
    axes: Axes3D, size_mm: float, theme: Colours, world_from_base: Transform | None = None
) -> None:
    """Draw a ring around the foot that indicates the floor."""
    angle = np.linspace(0.0, 2.0 * np.pi, 61)
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    placed = (world_from_base or Transform.identity()).apply(size_mm / MM * ring)
    axes.plot(*(MM * placed).T, color=theme.programmed, linewidth=1.0)


def as_cube(axes: Axes3D, points: Array, zoom: float = 1.05) -> None:
    """Set equal scales and lengths of the three axes around points (k, 3) [mm]."""
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    half = 0.5 * max(float(np.ptp(points, axis=0).max()), 1.0)
    for set_ends, centre in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), middle, strict=True):
        set_ends(centre - half, centre + half)
    axes.set_box_aspect((1.0, 1.0, 1.0), zoom=zoom)
