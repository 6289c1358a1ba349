"""Write the URDF and the link shapes of the robots of the catalogue.

Usage: `python scripts/build_robots.py [NAME ...]`, without a name for all of them. Everything
follows from `robots/<name>/robot.toml`: a few arms are drawn by hand from their lengths, the others
by `shape_serial.py`; nothing is edited afterwards. The shapes are our own likenesses, not the
maker's drawings.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import shape_axis_row
import shape_five_axis
import shape_irb120
import shape_irb1600
import shape_irb6640
import shape_palletizer
import shape_scara
import shape_serial
from shape_palletizer import Follower
from solids import Body, glb

from rapidsim.frames.transform import Transform
from rapidsim.motion.kinematics.arm import METRES_PER_UNIT, Kinematics
from rapidsim.motion.kinematics.closed_form.five_axis import FiveAxisGeometry
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.kinematics.closed_form.palletizer import Palletizer, PalletizerGeometry
from rapidsim.motion.kinematics.closed_form.scara import ScaraGeometry
from rapidsim.motion.kinematics.numerical.revolute_chain import AxisRowGeometry
from rapidsim.motion.robot.catalogue import (
    CatalogueEntry,
    find_entry,
    kinematics_of,
    robot_names,
    robots_folder,
)

DRAWN_BY_HAND: dict[str, Callable[[OpwGeometry], dict[str, list[Body]]]] = {
    "irb120-3-0.58": shape_irb120.links,
    "irb1600-6-1.2": shape_irb1600.links,
    "irb1600-10-1.2": shape_irb1600.links,
    "irb1600-8-1.45": shape_irb1600.links,
    "irb6640-180-2.55": shape_irb6640.links,
}
ROD_LINK = "link_2_level"
"""Stands on axis 3 and keeps the direction of link 1 where a rod moves axis 3."""
ROD_JOINT = "joint_3_rod"
EFFORT = 1000.0
"""URDF demands a torque limit; no source gives one, and nothing here uses it."""


def main() -> None:
    """Build the robots named on the command line."""
    for name in sys.argv[1:] or robot_names():
        entry = find_entry(name)
        meshes = robots_folder() / entry.name / "meshes"
        meshes.mkdir(exist_ok=True)
        total = 0
        for link, bodies in links(entry).items():
            shape = glb(bodies)
            (meshes / f"{link}.glb").write_bytes(shape)
            total += len(shape)
        urdf = robots_folder() / entry.name / f"{entry.name}.urdf"
        urdf.write_text(urdf_text(entry), encoding="utf-8", newline="\n")
        print(f"{entry.name}: {total / 1000:.0f} kB")
    share_meshes(robots_folder())


def share_meshes(folder: Path) -> None:
    """Keep equal meshes of a type's variants once, where the first arm has it; others name that."""
    kept: dict[bytes, Path] = {}
    for mesh in sorted(folder.glob("*/meshes/*.glb")):
        first = kept.setdefault(mesh.read_bytes(), mesh)
        if first == mesh:
            continue
        arm = mesh.parent.parent
        urdf = arm / f"{arm.name}.urdf"
        text = urdf.read_text(encoding="utf-8")
        own = f'"{mesh.relative_to(arm).as_posix()}"'
        shared = f'"../{first.relative_to(folder).as_posix()}"'
        urdf.write_text(text.replace(own, shared), encoding="utf-8", newline="\n")
        mesh.unlink()


def links(entry: CatalogueEntry) -> dict[str, list[Body]]:
    """The bodies of each link of an arm, in its frame."""
    match entry.geometry:
        case OpwGeometry() as geometry if entry.name in DRAWN_BY_HAND:
            return DRAWN_BY_HAND[entry.name](geometry)
        case OpwGeometry() as geometry:
            return shape_serial.links(entry, geometry)
        case FiveAxisGeometry() as geometry:
            return shape_five_axis.links(geometry)
        case PalletizerGeometry() as geometry:
            return shape_palletizer.links(geometry)
        case ScaraGeometry() as geometry:
            return shape_scara.links(geometry, entry.limits)
        case AxisRowGeometry() as geometry:
            return shape_axis_row.links(geometry, entry.reach_m or 1.0)


def followers(entry: CatalogueEntry) -> tuple[Follower, ...]:
    """The links that rods turn: without shape between links 2 and 3, or all that palletizers have.

    The first keeps the direction of link 1 where a rod moves axis 3.
    """
    match entry.geometry:
        case OpwGeometry() as g if g.coupling:
            return (
                Follower(
                    ROD_LINK, "link_2", (0.0, 0.0, g.c2), "joint_2", g.coupling,
                    carries="joint_3", drawn=False, pivot=ROD_JOINT,
                ),
            )  # fmt: skip
        case PalletizerGeometry() as g:
            return shape_palletizer.followers(g)
    return ()


def urdf_text(entry: CatalogueEntry) -> str:
    """The URDF of an arm: joints from its kinematics, one mesh a link, tool0 at the flange.

    What rods turn is a link whose joint mimics one of the arm's. URDF demands a speed; one that is
    not known is written as 0, as exporters of drawing programs do, and a comment says so.
    """
    arm = kinematics_of(entry)
    count = arm.joint_count
    home = arm.link_frames(np.zeros(count))  # parallel to the base
    origins = np.diff(home.translation, axis=0, prepend=np.zeros((1, 3)))
    rods = followers(entry)
    names = ["base_link", *(f"link_{number}" for number in range(1, count + 1))]
    lines = ['<?xml version="1.0" encoding="utf-8"?>']
    lines.append(f"<!-- {entry.title}. Generated by scripts/build_robots.py from robot.toml. -->")
    if None in entry.max_speeds:
        lines.append('<!-- velocity="0": no source gives the speed of this axis. -->')
    lines.append(f'<robot name="{entry.name}">')
    for link in (*names, *(rod.link for rod in rods if rod.drawn)):
        lines.append(f'  <link name="{link}">')
        lines.append(
            f'    <visual><geometry><mesh filename="meshes/{link}.glb"/></geometry></visual>'
        )
        lines.append("  </link>")
    lines += ['  <link name="flange"/>', '  <link name="tool0"/>']
    axes = _axes(arm)
    for index, name in enumerate(entry.joint_names):
        parent, origin = names[index], origins[index]
        for rod in rods:
            if rod.carries == name:
                lines += _follower(entry, rod)
                parent, origin = rod.link, origin - np.array(rod.origin)
        place = _numbers(origin), _numbers(axes[index])
        said = parent, names[index + 1], *place, _limit_of(entry, index, slides=arm.slides[index])
        lines += _joint("prismatic" if arm.slides[index] else "revolute", name, *said)
    for rod in rods:
        if not rod.carries:
            lines += _follower(entry, rod)
    lines += _fixed(f"{names[-1]}-flange", names[-1], "flange", "0 0 0")
    last_link_from_tool0 = home[-1].inverse() @ arm.forward(np.zeros(count))
    lines += _fixed("flange-tool0", "flange", "tool0", _roll_pitch_yaw(last_link_from_tool0))
    lines.append("</robot>")
    return "\n".join(lines) + "\n"


def _axes(arm: Kinematics) -> np.ndarray:
    """The axis (n, 3) that each joint's own link turns about or slides along, rods aside, at 0."""
    if isinstance(arm, Palletizer):
        directions: np.ndarray = arm.chain.axes.directions[list(arm.chain.links)]
        return directions
    moving, turning = np.split(arm.jacobian(np.zeros(arm.joint_count)).T, 2, axis=1)
    axes: np.ndarray = np.where(arm.slides[:, None], moving / METRES_PER_UNIT, turning)
    if isinstance(arm, OrthoParallel):
        axes[1] -= arm.geometry.coupling * axes[2]
    return axes


def _follower(entry: CatalogueEntry, rod: Follower) -> list[str]:
    leader = entry.joint_names.index(rod.joint)
    lower, upper = sorted(rod.turns * angle for angle in entry.limits[leader])
    limits = (
        _limit(lower, upper, entry.max_speeds[leader]),
        f'<mimic joint="{rod.joint}" multiplier="{rod.turns}"/>',
    )
    bare = [] if rod.drawn else [f'  <link name="{rod.link}"/>']
    place = _numbers(np.array(rod.origin)), "0 1 0"
    pivot = rod.pivot or f"{rod.link}_joint"
    return bare + _joint("revolute", pivot, rod.parent, rod.link, *place, *limits)


def _limit_of(entry: CatalogueEntry, index: int, *, slides: bool) -> str:
    """The limits of a joint of the arm [rad], [m] of one that slides."""
    values = *entry.limits[index], entry.max_speeds[index]
    if not slides:
        return _limit(*values)
    lower, upper, speed = (round((one or 0.0) * METRES_PER_UNIT, 12) for one in values)
    return _limit(lower, upper, speed)


def _limit(lower: float, upper: float, speed: float | None) -> str:
    return (
        f'<limit lower="{lower!r}" upper="{upper!r}" velocity="{speed or 0.0!r}" '
        f'effort="{EFFORT:g}"/>'
    )


def _joint(
    kind: str, name: str, parent: str, child: str, origin: str, axis: str, *limits: str
) -> list[str]:
    return [
        f'  <joint name="{name}" type="{kind}">',
        f'    <parent link="{parent}"/>',
        f'    <child link="{child}"/>',
        f'    <origin xyz="{origin}" rpy="0 0 0"/>',
        f'    <axis xyz="{axis}"/>',
        *(f"    {limit}" for limit in limits),
        "  </joint>",
    ]


def _fixed(name: str, parent: str, child: str, rpy: str) -> list[str]:
    return [
        f'  <joint name="{name}" type="fixed">',
        f'    <parent link="{parent}"/>',
        f'    <child link="{child}"/>',
        f'    <origin xyz="0 0 0" rpy="{rpy}"/>',
        "  </joint>",
    ]


def _roll_pitch_yaw(turn: Transform) -> str:
    """URDF's angles [rad] of a rotation; no roll where roll and yaw turn about one axis."""
    rotation = np.round(turn.rotation, 12)
    level = float(np.hypot(rotation[0, 0], rotation[1, 0]))
    pitch = float(np.arctan2(-rotation[2, 0], level))
    if level > 1e-9:
        roll = float(np.arctan2(rotation[2, 1], rotation[2, 2]))
        yaw = float(np.arctan2(rotation[1, 0], rotation[0, 0]))
    else:
        roll, yaw = 0.0, float(np.arctan2(-rotation[0, 1], rotation[1, 1]))
    return " ".join(repr(angle + 0.0) for angle in (roll, pitch, yaw))


def _numbers(values: np.ndarray) -> str:
    """Coordinates without the dust of computing them."""
    return " ".join(f"{round(float(value), 12) + 0.0:.12g}" for value in values)


if __name__ == "__main__":
    main()
