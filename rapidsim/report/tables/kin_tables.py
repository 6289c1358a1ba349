"""What `rapidsim kin` finds as tables for people."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

import numpy as np
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.pose_solutions import PoseSolutions
from rapidsim.motion.configurations.singularities import Differential, joint_speeds
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.tables.kin_json import Searched
from rapidsim.report.uncut_table import WholeTable

_ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")
_USUAL_JOINTS = 6


def forward_page(robot: Robot, joints: Array, flange_from_tcp: Transform) -> RenderableType:
    """Pose of the TCP, configuration, links."""
    tcp = robot.forward(joints) @ flange_from_tcp
    links = robot.kinematics.link_frames(joints)
    table = _table("frame", "x", "y", "z", "q1", "q2", "q3", "q4")
    for number in range(1, len(links) + 1):
        table.add_row(f"link_{number}", *_pose(links[number - 1]))
    table.add_row("TCP", *_pose(tcp), style="bold")
    conf = ",".join(map(str, confdata_of(robot.kinematics, joints).tolist()))
    facts = Text.assemble(("joints ", "cyan"), _list(np.degrees(joints)), " deg")
    return Group(
        _title(robot), facts, Text.assemble(("conf   ", "cyan"), f"[{conf}]"), Text(), table
    )


def inverse_page(
    robot: Robot, solver: str, found: PoseSolutions, searched: Searched | None
) -> RenderableType:
    """One row a solution, and why there is none."""
    parts: list[RenderableType] = [_title(robot)]
    if found.why is not None:
        parts.append(Text.assemble(("unreachable: ", "red"), found.why))
    if found.solutions:
        names = [f"j{number}" for number in range(1, len(robot.joints) + 1)]
        table = _table("conf", *names, "limits", padding=1 if len(names) > _USUAL_JOINTS else 2)
        for solution in found.solutions:
            table.add_row(
                "[" + ",".join(map(str, solution.confdata)) + "]",
                *(_number(angle, 2) for angle in np.degrees(solution.joints).tolist()),
                "within" if solution.within_limits else "outside",
                style="" if solution.within_limits else "dim",
            )
        parts += [Text(), table]
    said = f"solver {solver}"
    if searched:
        said += (
            f": {searched.starts} starts, {searched.iterations} iterations, "
            f"tolerance {searched.tolerance * 1000.0:g} mm and "
            f"{degrees(searched.tolerance):.1g} deg, {searched.seconds:.3f} s"
        )
    if found.solutions:
        distance = max(solution.distance for solution in found.solutions) * 1000.0
        angle = degrees(max(solution.angle for solution in found.solutions))
        said += f"; largest residual {distance:.0e} mm, {angle:.0e} deg"
    parts += [Text(), Text(said, "dim")]
    return Group(*parts)


def jacobian_page(robot: Robot, found: Differential, twist: Array | None) -> RenderableType:
    """The matrix, its singular values, how near singularities are, joint speeds."""
    names = [f"j{number}" for number in range(1, len(robot.joints) + 1)]
    matrix = _table("", *names)
    for row, numbers in zip(_ROWS, found.jacobian.tolist(), strict=True):
        matrix.add_row(row, *(_number(number, 4) for number in numbers))
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    facts.add_row("singular values", ", ".join(f"{v:.4g}" for v in found.singular_values.tolist()))
    facts.add_row("manipulability", f"{found.manipulability:.4g}")
    facts.add_row("rank", f"{found.rank} of {min(found.jacobian.shape)}")
    for singularity in found.singularities:
        said = f"distance {singularity.distance:.4f}"
        if singularity.near:
            said = f"near, {said}: at 0 {singularity.reason}"
        facts.add_row(singularity.name, Text(said, "yellow" if singularity.near else ""))
    parts: list[RenderableType] = [_title(robot), Text("base frame, m/rad and rad/rad", "dim")]
    parts += [Text(), matrix, Text(), facts]
    if twist is not None:
        speeds, missed = joint_speeds(found.jacobian, twist)
        table = _table("joint", "speed", "limit")
        for joint, speed in zip(robot.joints, np.degrees(speeds).tolist(), strict=True):
            limit = "?" if joint.max_speed is None else f"{degrees(joint.max_speed):g} deg/s"
            over = joint.max_speed is not None and abs(speed) > degrees(joint.max_speed)
            table.add_row(
                joint.name, f"{_number(speed, 2)} deg/s", limit, style="red" if over else ""
            )
        short = f"missed: {_list(missed[:3] * 1000.0)} mm/s, {_list(np.degrees(missed[3:]))} deg/s"
        parts += [Text(), table, Text(short, "dim")]
    return Group(*parts)


def _title(robot: Robot) -> Text:
    return Text(robot.title, "bold")


def _table(first: str, *others: str, padding: int = 2) -> Table:
    table = WholeTable(box=None, padding=(0, padding, 0, 0), pad_edge=False, header_style="cyan")
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
