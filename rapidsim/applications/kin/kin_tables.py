"""Results of `rapidsim kin` as tables."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

import numpy as np
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.applications.kin.kin_json import SearchCost
from rapidsim.frames.euler import Convention, euler_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.pose_solutions import PoseSolutions
from rapidsim.motion.configurations.postures import Postures
from rapidsim.motion.configurations.singularities import Differential, joint_speeds, rapid_speeds
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.tables.axis_tables import (
    axis_tables_page,
    decimal_text,
    is_identity,
    matrix_table,
    plain_table,
)

_ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")
_USUAL_JOINTS = 6


def forward_page(postures: Postures, convention: Convention, *, tables: bool) -> RenderableType:
    """Pose of the TCP as matrix, quaternion and Euler angles, configuration, links.

    Args:
        postures: One posture.
        convention: Of the Euler angles.
        tables: Also the matrix of each link, in the link before it too, and the screws and the DH
            table of the arm.
    """
    robot, joints = postures.robot, postures.rows[0].joints
    tcp = postures.world_from_tcp
    links = postures.world_from_base @ robot.kinematics.link_frames(joints)
    table = plain_table("frame", "x [mm]", "y [mm]", "z [mm]", "q1", "q2", "q3", "q4")
    for number in range(1, len(links) + 1):
        table.add_row(f"link_{number}", *_pose(links[number - 1]))
    table.add_row("TCP", *_pose(tcp), style="bold")
    conf = ",".join(map(str, confdata_of(robot.kinematics, joints).tolist()))
    angles = np.degrees(euler_from_rotation(tcp.rotation, convention))
    named = ", ".join(
        f"{name} {decimal_text(angle, 3)}"
        for name, angle in zip(convention.names, angles.tolist(), strict=True)
    )
    parts: list[RenderableType] = [
        _title(robot),
        Text.assemble(("joints ", "cyan"), _list(np.degrees(joints)), f" {robot.units()}"),
        Text.assemble(("conf   ", "cyan"), f"[{conf}]"),
        Text.assemble(("euler  ", "cyan"), f"{convention.value}: {named} deg"),
        Text.assemble(
            ("frame  ", "cyan"), "base" if is_identity(postures.world_from_base) else "world"
        ),
        Text(),
        table,
        Text(),
        matrix_table("TCP", tcp),
    ]
    if tables:
        for number in range(1, len(links) + 1):
            parts += [Text(), matrix_table(f"link_{number}", links[number - 1])]
        for name, frame in postures.relative_frames:
            parts += [Text(), matrix_table(name, frame)]
        parts += [Text(), axis_tables_page(robot)]
    return Group(*parts)


def posture_markdown(postures: Postures) -> str:
    """Joints, pose and matrix as Markdown, for the recording."""
    rows = [
        f"| {posture.name} | {', '.join(decimal_text(a, 2) for a in np.degrees(posture.joints))} |"
        for posture in postures.rows
    ]
    matrix = postures.world_from_tcp.matrix
    matrix[:3, 3] *= 1000.0
    lines = [
        [*(decimal_text(value, 5) for value in row[:3]), decimal_text(row[3], 3)]
        for row in matrix.tolist()
    ]
    cells = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    place = ", ".join(decimal_text(value, 3) for value in matrix[:3, 3].tolist())
    quaternion = ", ".join(decimal_text(q, 6) for q in postures.world_from_tcp.quaternion.tolist())
    text = (
        f"| posture | joints [{postures.robot.units()}] |\n|---|---|\n" + "\n".join(rows)
        + f"\n\nTCP at ({place}) mm, [{quaternion}]\n\n"
        + "| x | y | z | position [mm] |\n|---|---|---|---|\n" + cells
    )  # fmt: skip
    if postures.differential is not None:
        values = ", ".join(f"{value:.4g}" for value in postures.differential.singular_values)
        near = ", ".join(postures.differential.near) or "none"
        text += f"\n\nsingular values {values}\n\nnear: {near}"
    return text


def inverse_page(
    robot: Robot,
    solver: str,
    target: Transform,
    solutions: PoseSolutions,
    searched: SearchCost | None,
) -> RenderableType:
    """The requested pose, a row per solution, or the reason why it is unreachable."""
    parts: list[RenderableType] = [_title(robot), Text(), matrix_table("TCP", target)]
    if solutions.reason is not None:
        parts.append(Text.assemble(("unreachable: ", "red"), solutions.reason))
    if solutions.solutions:
        names = [f"j{number}" for number in range(1, len(robot.joints) + 1)]
        table = plain_table(
            "conf", *names, "limits", padding=1 if len(names) > _USUAL_JOINTS else 2
        )
        for solution in solutions.solutions:
            table.add_row(
                "[" + ",".join(map(str, solution.confdata)) + "]",
                *(decimal_text(angle, 2) for angle in np.degrees(solution.joints).tolist()),
                "within" if solution.within_limits else "outside",
                style="" if solution.within_limits else "dim",
            )
        parts += [Text(), Text(f"joints in {robot.units()}", "dim"), table]
    said = f"solver {solver}"
    if searched:
        said += (
            f": {searched.starts} starts, {searched.iterations} iterations, "
            f"tolerance {searched.tolerance_mm:g} mm and "
            f"{searched.tolerance_deg:.1g} deg, {searched.time_s:.3f} s"
        )
    if solutions.solutions:
        distance = max(solution.distance for solution in solutions.solutions) * 1000.0
        angle = degrees(max(solution.angle for solution in solutions.solutions))
        said += f"; largest residual {distance:.0e} mm, {angle:.0e} deg"
    parts += [Text(), Text(said, "dim")]
    return Group(*parts)


def jacobian_page(robot: Robot, differential: Differential, twist: Array | None) -> RenderableType:
    """The matrix, its singular values, how near singularities are, joint speeds."""
    names = [f"j{number}" for number in range(1, len(robot.joints) + 1)]
    matrix = plain_table("", *names)
    for row, numbers in zip(_ROWS, differential.jacobian.tolist(), strict=True):
        matrix.add_row(row, *(decimal_text(number, 4) for number in numbers))
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    facts.add_row(
        "singular values", ", ".join(f"{v:.4g}" for v in differential.singular_values.tolist())
    )
    facts.add_row("manipulability", f"{differential.manipulability:.4g}")
    facts.add_row("rank", f"{differential.rank} of {min(differential.jacobian.shape)}")
    for singularity in differential.singularities:
        said = f"distance {singularity.distance:.4f}"
        if singularity.near:
            said = f"near, {said}: at 0 {singularity.reason}"
        facts.add_row(singularity.name, Text(said, "yellow" if singularity.near else ""))
    units = "base frame, m/rad and rad/rad"
    units += "".join(f"; j{n} in m/m" for n, joint in enumerate(robot.joints, 1) if joint.slides)
    parts: list[RenderableType] = [_title(robot), Text(units, "dim")]
    parts += [Text(), matrix, Text(), facts]
    if twist is not None:
        speeds, missed = joint_speeds(differential.jacobian, twist)
        table = plain_table("joint", "speed", "limit")
        told = rapid_speeds(robot.kinematics, speeds).tolist()
        for joint, speed in zip(robot.joints, told, strict=True):
            unit = f"{joint.measure}/s"
            limit = "?" if joint.max_speed is None else f"{degrees(joint.max_speed):g} {unit}"
            over = joint.max_speed is not None and abs(speed) > degrees(joint.max_speed)
            table.add_row(
                joint.name, f"{decimal_text(speed, 2)} {unit}", limit, style="red" if over else ""
            )
        short = f"missed: {_list(missed[:3] * 1000.0)} mm/s, {_list(np.degrees(missed[3:]))} deg/s"
        parts += [Text(), table, Text(short, "dim")]
    return Group(*parts)


def _title(robot: Robot) -> Text:
    return Text(robot.title, "bold")


def _pose(base_from_frame: Transform) -> Sequence[str]:
    place = [decimal_text(value, 3) for value in (base_from_frame.translation * 1000.0).tolist()]
    return [*place, *(decimal_text(value, 6) for value in base_from_frame.quaternion.tolist())]


def _list(values: Array) -> str:
    return "[" + ", ".join(decimal_text(value, 3) for value in values.tolist()) + "]"
