"""Results of `rapidsim kin` as tables."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

import numpy as np
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.frames.euler import Convention, euler_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.pose_solutions import PoseSolutions
from rapidsim.motion.configurations.postures import Postures
from rapidsim.motion.configurations.singularities import Differential, joint_speeds, rapid_speeds
from rapidsim.motion.kinematics.axis_tables import dh_table_of, screws_of
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.tables.kin_json import SearchCost
from rapidsim.report.untruncated_table import UntruncatedTable

_ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")
_USUAL_JOINTS = 6
_SMALL = 1e-9


def forward_page(postures: Postures, convention: Convention, *, tables: bool) -> RenderableType:
    """Pose of the TCP as matrix, quaternion and Euler angles, configuration, links.

    Args:
        postures: One posture.
        convention: Of the Euler angles.
        tables: Also the matrix of each link, and the screws and the DH table of the arm.
    """
    robot, joints = postures.robot, postures.rows[0].joints
    tcp = postures.world_from_tcp
    links = postures.world_from_base @ robot.kinematics.link_frames(joints)
    table = _table("frame", "x [mm]", "y [mm]", "z [mm]", "q1", "q2", "q3", "q4")
    for number in range(1, len(links) + 1):
        table.add_row(f"link_{number}", *_pose(links[number - 1]))
    table.add_row("TCP", *_pose(tcp), style="bold")
    conf = ",".join(map(str, confdata_of(robot.kinematics, joints).tolist()))
    angles = np.degrees(euler_from_rotation(tcp.rotation, convention))
    named = ", ".join(
        f"{name} {_number(angle, 3)}"
        for name, angle in zip(convention.names, angles.tolist(), strict=True)
    )
    parts: list[RenderableType] = [
        _title(robot),
        Text.assemble(("joints ", "cyan"), _list(np.degrees(joints)), f" {robot.units()}"),
        Text.assemble(("conf   ", "cyan"), f"[{conf}]"),
        Text.assemble(("euler  ", "cyan"), f"{convention.value}: {named} deg"),
        Text.assemble(
            ("frame  ", "cyan"), "base" if _is_unit(postures.world_from_base) else "world"
        ),
        Text(),
        table,
        Text(),
        _matrix("TCP", tcp),
    ]
    if tables:
        for number in range(1, len(links) + 1):
            parts += [Text(), _matrix(f"link_{number}", links[number - 1])]
        parts += [Text(), axis_tables_page(robot)]
    return Group(*parts)


def axis_tables_page(robot: Robot) -> RenderableType:
    """The DH table and the screws of an arm."""
    dh, screws = dh_table_of(robot.kinematics), screws_of(robot.kinematics)
    if dh is None or screws is None:
        return Text(
            f"{robot.title} has no DH table and no screw axes: rods carry its links, so that a "
            "joint turns more than one axis",
            "dim",
        )
    table = _table("joint", "theta [deg]", "d [mm]", "a [mm]", "alpha [deg]")
    for number, row in enumerate(zip(dh.theta, dh.d, dh.a, dh.alpha, strict=True), start=1):
        theta, d, a, alpha = (float(value) for value in row)
        turn, way = f"q{number}{_added(degrees(theta))}", _number(1000.0 * d, 3)
        if dh.slides[number - 1]:
            turn, way = _number(degrees(theta), 3), f"q{number}{_added(1000.0 * d)}"
        table.add_row(str(number), turn, way, _number(1000.0 * a, 3), _number(degrees(alpha), 3))
    parts: list[RenderableType] = [Text("DH, standard form", "bold"), table]
    for name, frame in (("base, before row 1", dh.base), ("flange, after the last row", dh.flange)):
        if not _is_unit(frame):
            parts += [Text(), _matrix(name, frame)]
    poe = _table("joint", "wx", "wy", "wz", "vx [mm]", "vy [mm]", "vz [mm]")
    for number, (turn, moment) in enumerate(
        zip(screws.turns.tolist(), screws.moments_mm.tolist(), strict=True), start=1
    ):
        poe.add_row(str(number), *(_number(w, 6) for w in turn), *(_number(v, 3) for v in moment))
    parts += [
        Text(),
        Text("screw axes of the product of exponentials, in the base frame", "bold"),
        poe,
        Text(),
        _matrix("M, joints at 0", screws.base_from_flange),
    ]
    return Group(*parts)


def _added(offset: float) -> str:
    """Offset of a joint, such as ` + 90`; empty for 0."""
    if abs(offset) < _SMALL:
        return ""
    return f" {'-' if offset < 0.0 else '+'} {abs(offset):g}"


def posture_markdown(postures: Postures) -> str:
    """Joints, pose and matrix as Markdown, for the recording."""
    rows = [
        f"| {posture.name} | {', '.join(_number(a, 2) for a in np.degrees(posture.joints))} |"
        for posture in postures.rows
    ]
    matrix = postures.world_from_tcp.matrix
    matrix[:3, 3] *= 1000.0
    lines = [
        [*(_number(value, 5) for value in row[:3]), _number(row[3], 3)] for row in matrix.tolist()
    ]
    cells = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    place = ", ".join(_number(value, 3) for value in matrix[:3, 3].tolist())
    quaternion = ", ".join(_number(q, 6) for q in postures.world_from_tcp.quaternion.tolist())
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
    parts: list[RenderableType] = [_title(robot), Text(), _matrix("TCP", target)]
    if solutions.reason is not None:
        parts.append(Text.assemble(("unreachable: ", "red"), solutions.reason))
    if solutions.solutions:
        names = [f"j{number}" for number in range(1, len(robot.joints) + 1)]
        table = _table("conf", *names, "limits", padding=1 if len(names) > _USUAL_JOINTS else 2)
        for solution in solutions.solutions:
            table.add_row(
                "[" + ",".join(map(str, solution.confdata)) + "]",
                *(_number(angle, 2) for angle in np.degrees(solution.joints).tolist()),
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
    matrix = _table("", *names)
    for row, numbers in zip(_ROWS, differential.jacobian.tolist(), strict=True):
        matrix.add_row(row, *(_number(number, 4) for number in numbers))
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
        table = _table("joint", "speed", "limit")
        told = rapid_speeds(robot.kinematics, speeds).tolist()
        for joint, speed in zip(robot.joints, told, strict=True):
            unit = f"{joint.measure}/s"
            limit = "?" if joint.max_speed is None else f"{degrees(joint.max_speed):g} {unit}"
            over = joint.max_speed is not None and abs(speed) > degrees(joint.max_speed)
            table.add_row(
                joint.name, f"{_number(speed, 2)} {unit}", limit, style="red" if over else ""
            )
        short = f"missed: {_list(missed[:3] * 1000.0)} mm/s, {_list(np.degrees(missed[3:]))} deg/s"
        parts += [Text(), table, Text(short, "dim")]
    return Group(*parts)


def _is_unit(frame: Transform) -> bool:
    return bool(np.abs(frame.matrix - np.eye(4)).max() <= _SMALL)


def _matrix(name: str, frame: Transform) -> Table:
    """A 4 x 4 matrix, lengths in mm."""
    table = _table(name, "x", "y", "z", "position [mm]")
    matrix = frame.matrix
    matrix[:3, 3] *= 1000.0
    for words, row in zip(("", "", "", ""), matrix.tolist(), strict=True):
        table.add_row(words, *(_number(value, 6) for value in row[:3]), _number(row[3], 3))
    return table


def _title(robot: Robot) -> Text:
    return Text(robot.title, "bold")


def _table(first: str, *others: str, padding: int = 2) -> Table:
    table = UntruncatedTable.without_lines(padding)
    table.add_column(first, no_wrap=True)
    for name in others:
        table.add_column(name, justify="right", no_wrap=True)
    return table


def _pose(base_from_frame: Transform) -> Sequence[str]:
    place = [_number(value, 3) for value in (base_from_frame.translation * 1000.0).tolist()]
    return [*place, *(_number(value, 6) for value in base_from_frame.quaternion.tolist())]


def _list(values: Array) -> str:
    return "[" + ", ".join(_number(value, 3) for value in values.tolist()) + "]"


def _number(value: float, digits: int) -> str:
    """Rounded, without a negative zero."""
    return f"{round(value, digits) + 0.0:.{digits}f}"
