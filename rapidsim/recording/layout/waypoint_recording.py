"""Trajectory through points as one `.rrd` file: the arm, the points, the path, its figures."""

from __future__ import annotations

import hashlib
import uuid
from math import degrees
from pathlib import Path

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from rapidsim.frames.transform import Array, Transform, unbroken
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.waypoints.attitudes import attitude_rates
from rapidsim.motion.waypoints.follow import FollowedTrajectory
from rapidsim.motion.waypoints.plan import Way
from rapidsim.recording import palette
from rapidsim.recording.layout.blueprint import laid_out, space
from rapidsim.recording.layout.camera import looking_at
from rapidsim.recording.panels.legend import emptiest_corner
from rapidsim.recording.scene.arm import FLANGE, log_arm
from rapidsim.recording.scene.tool import BODY_ENTITY, FRAME_ENTITY, TCP, tool_body
from rapidsim.recording.stream import recording_file
from rapidsim.recording.timelines import Clock
from rapidsim.recording.transforms import BASE, BASE_FROM_WORLD, WORLD, static_frame
from rapidsim.values import value_class

POINTS = "points"
PATH = "path/travelled"
STRAIGHT = "path/straight"
ANGLES = "joints/angle"
SPEEDS = "joints/speed"
TCP_SPEED = "tcp/speed"
DEVIATION = "tcp/deviation"
POSITION = "tcp/position"
QUATERNION = "tcp/quaternion"
TURNED = "tcp/turned"
TURN_RATE = "tcp/turn_rate"
FIGURES = "figures"

_SIDE_RAD = np.radians(48.0)
"""Angle of the camera from the line base to work, so that the arm hides nothing."""
_HEIGHT_RAD = np.radians(24.0)
_NEAR_HEIGHT_RAD = np.radians(18.0)
_POSES = 60
"""Number of poses that represent the sweep of the arm."""
_LEAST_DEVIATION_MM = 0.01
"""Minimum range [mm] of the axis of deviations, so that rounding does not look like a motion."""
_MOST_NAMES = 40
"""Number of points above which they are shown without numbers."""


@value_class(frozen=True, slots=True, eq=False)
class FollowedArm:
    """Arm of a trajectory; implements `scene.arm.MovingArm`."""

    robot: Robot
    samples: Samples
    clock: Clock
    name: str = ""

    def entity(self, path: str) -> str:
        """Return the path unchanged: with one robot, entities contain no name."""
        return path

    def frame(self, name: str) -> str:
        """Return the name unchanged: with one robot, frames contain no robot name."""
        return name


def record_followed(
    followed: FollowedTrajectory, title: str, path: Path, world_from_base: Transform | None = None
) -> Path:
    """Write a recording of a trajectory.

    Args:
        followed: The trajectory.
        title: Title in the viewer.
        path: Target file, which appears only when it is complete.
        world_from_base: Base frame of the robot; None for upright in the origin.

    Returns:
        The path written.

    Raises:
        InputError: If the file cannot be written.
    """
    samples, stands = followed.samples, world_from_base or BASE_FROM_WORLD.inverse()
    _, first = np.unique(samples.move, return_index=True)
    arm = FollowedArm(followed.robot, samples, Clock(samples.times[np.sort(first)]))
    with recording_file(path, _content_id(followed), _blueprint(followed, stands)) as stream:
        stream.send_recording_name(title)
        stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, rr.CoordinateFrame(WORLD), static=True)
        stream.log("base", static_frame(WORLD, BASE, stands), static=True)
        remarks = log_arm(stream, arm).remarks
        _log_tool(stream, followed)
        _log_path(stream, followed)
        _log_plots(stream, followed, arm.clock)
        figures = rr.TextDocument(_figures(followed, title, remarks), media_type="text/markdown")
        stream.log(FIGURES, figures, static=True)
    return path


def _log_tool(stream: rr.RecordingStream, followed: FollowedTrajectory) -> None:
    tool = followed.flange_from_tcp
    size = 0.2 * float(np.ptp(_cell_points(followed), axis=0).max())
    stream.log(FRAME_ENTITY, static_frame(FLANGE, TCP, tool), static=True)
    axes = rr.TransformAxes3D(0.3 * size)
    stream.log(f"{FRAME_ENTITY}/axes", rr.CoordinateFrame(TCP), axes, static=True)
    body = tool_body(tool.translation)
    stream.log(BODY_ENTITY, rr.CoordinateFrame(FLANGE), body, static=True)


def _log_path(stream: rr.RecordingStream, followed: FollowedTrajectory) -> None:
    """Log the points with their numbers, the lines between them, and the path of the TCP."""
    points = followed.points.positions
    names = [str(followed.points.number(row)) for row in range(len(points))]
    frame = rr.CoordinateFrame(BASE)
    stream.log(
        POINTS,
        frame,
        rr.Points3D(
            points,
            radii=rr.Radius.ui_points(4.0),
            colors=palette.rgba(palette.TARGET),
            labels=names,
            show_labels=len(points) <= _MOST_NAMES,
        ),
        static=True,
    )
    for entity, strip, radius, colour in (
        (STRAIGHT, points, 0.8, palette.rgba(palette.PROGRAMMED, 150)),
        (
            PATH,
            followed.samples.base_from_tcp.translation,
            2.2,
            palette.rgba(palette.TCP_SPEED),
        ),
    ):
        line = rr.LineStrips3D([strip], radii=rr.Radius.ui_points(radius), colors=colour)
        stream.log(entity, frame, line, static=True)


def _log_plots(stream: rr.RecordingStream, followed: FollowedTrajectory, clock: Clock) -> None:
    samples = followed.samples
    count = len(followed.robot.joints)
    joints = [f"J{number}" for number in range(1, count + 1)]
    of_joints = [palette.JOINTS[k % len(palette.JOINTS)] for k in range(count)]
    tcp, quaternions = samples.base_from_tcp, unbroken(samples.base_from_tcp.quaternion)
    norm = np.linalg.norm(quaternions, axis=1)
    rates = attitude_rates(followed)
    turned, turn_rate, words = [rates.angle], [rates.rate], ["as driven"]
    if rates.linear_angle is not None and rates.linear_rate is not None:
        turned.append(rates.linear_angle)
        turn_rate.append(rates.linear_rate)
        words.append("quaternions blended linearly")
    two = [palette.TCP_SPEED, palette.LIMIT]
    for entity, names, colours, values in (
        (ANGLES, joints, of_joints, np.degrees(samples.joints)),
        (SPEEDS, joints, of_joints, np.degrees(_rates(samples))),
        (TCP_SPEED, ["TCP"], two, samples.tcp_speed[:, None] * 1000.0),
        (DEVIATION, ["deviation"], [palette.LIMIT], followed.deviation[:, None] * 1000.0),
        (POSITION, ["x", "y", "z"], [*palette.AXES], tcp.translation * 1000.0),
        (
            QUATERNION,
            ["q1", "q2", "q3", "q4", "norm"],
            [*palette.JOINTS[:4], palette.PROGRAMMED],
            np.column_stack([quaternions, norm]),
        ),
        (TURNED, words, two, np.degrees(np.column_stack(turned))),
        (TURN_RATE, words, two, np.degrees(np.column_stack(turn_rate))),
    ):
        look = rr.SeriesLines(
            names=names,
            colors=np.array([palette.rgba(colours[k]) for k in range(len(names))], dtype=np.uint32),
            widths=np.full(len(names), 1.6),
        )
        stream.log(entity, look, static=True)
        stream.send_columns(
            entity,
            indexes=clock.columns(samples.times),
            columns=rr.Scalars.columns(scalars=values.reshape(-1)).partition(
                [len(names)] * len(samples.times)
            ),
        )


def _rates(samples: Samples) -> Array:
    """Return joint speeds (k, n) [rad/s]: the mean since the previous sample."""
    speeds: Array = np.zeros_like(samples.joints)
    speeds[1:] = np.diff(samples.joints, axis=0) / np.diff(samples.times)[:, None]
    return speeds


def _figures(followed: FollowedTrajectory, title: str, remarks: tuple[str, ...]) -> str:
    plan = followed.plan
    off = "path" if plan.kind.of_tcp else "straight lines"
    profile = "" if plan.kind is Way.JOINT_QUINTIC else f", {plan.profile.value}"
    rows = [
        ("robot", followed.robot.title),
        ("path", plan.kind.value + profile),
        ("points", str(len(followed.points))),
        ("duration", f"{followed.duration:.3f} s"),
        ("way", f"{followed.path_length * 1000.0:.1f} mm"),
        ("peak speed", f"{followed.peak_speed * 1000.0:.1f} mm/s"),
        (f"off the {off}, rms", f"{followed.deviation_rms * 1000.0:.3g} mm"),
        (f"off the {off}, at most", f"{followed.deviation_max * 1000.0:.3g} mm"),
    ]
    for joint, peak in zip(followed.robot.joints, followed.joint_peaks.tolist(), strict=True):
        limit = "?" if joint.max_speed is None else f"{degrees(joint.max_speed):g}"
        rows.append((joint.name, f"{degrees(peak):.1f} of {limit} {joint.measure}/s"))
    table = "\n".join(f"| {name} | {value} |" for name, value in rows)
    said = "".join(f"\n\n{remark}" for remark in remarks)
    return f"### {title}\n\n| | |\n|---|---|\n{table}{said}\n"


def _blueprint(followed: FollowedTrajectory, world_from_base: Transform) -> rrb.Blueprint:
    time = rrb.TimeAxis(link="LinkToGlobal")
    samples, mm = followed.samples, followed.deviation_max * 1000.0
    tcp = world_from_base.apply(samples.base_from_tcp.translation)
    x, y, _ = tcp.mean(axis=0) - world_from_base.translation
    azimuth = float(np.arctan2(y, x))
    seen = world_from_base.apply(_cell_points(followed))
    cell = looking_at(seen, azimuth - _SIDE_RAD, _HEIGHT_RAD, air=1.25)
    # Towards the robot, slightly to the side: the arm is not in this view, and y points to the
    # right.
    near = looking_at(
        np.concatenate([tcp, world_from_base.apply(followed.points.positions)]),
        azimuth - 0.3 * _SIDE_RAD,
        _NEAR_HEIGHT_RAD,
        air=1.15,
    )
    views = [
        space("Cell", cell, 0.1, ["+ /**"]),
        space("Path, seen towards the robot", near, 0.1, [f"+ /{POINTS}", "+ /path/**"]),
    ]
    legend = emptiest_corner(samples.times, samples.joints, 0.14, 0.5)
    top = rrb.Corner2D.RightTop
    tcp_top, off_top = 1300.0 * followed.peak_speed, 1.3 * max(mm, _LEAST_DEVIATION_MM)

    def plot(
        entity: str, name: str, corner: rrb.Corner2D = top, end: float | None = None
    ) -> rrb.View:
        axis = None if end is None else rrb.ScalarAxis(range=(0.0, end))
        return rrb.TimeSeriesView(
            origin=f"/{entity}", name=name, axis_x=time, axis_y=axis, plot_legend=corner
        )

    plots: list[rrb.View | rrb.Container] = [
        plot(ANGLES, f"Joint angles [{followed.robot.units()}]", legend),
        plot(SPEEDS, f"Joint speeds [{followed.robot.units('/s')}]"),
        rrb.Tabs(
            plot(TCP_SPEED, "TCP speed [mm/s]", top, tcp_top),
            plot(POSITION, "Position [mm]"),
            active_tab=0,
        ),
        rrb.Tabs(
            plot(DEVIATION, "Deviation [mm]", top, off_top),
            plot(QUATERNION, "Quaternion"),
            plot(TURNED, "Turned [deg]"),
            plot(TURN_RATE, "Turn rate [deg/s]"),
            active_tab=0,
        ),
    ]
    return laid_out(
        rrb.Vertical(
            rrb.Horizontal(
                *views,
                rrb.TextDocumentView(origin=f"/{FIGURES}", name="Figures"),
                column_shares=[10, 8, 5],
            ),
            rrb.Horizontal(*plots),
            row_shares=[8, 4],
        ),
    )


def _cell_points(followed: FollowedTrajectory) -> Array:
    """Return points (k, 3) [m] that a picture of arm and work must contain."""
    samples = followed.samples
    rows = np.linspace(0, len(samples.times) - 1, _POSES).astype(np.int64)
    links = followed.robot.kinematics.link_frames(samples.joints[rows])
    parts = (links.translation.reshape(-1, 3), samples.base_from_tcp.translation)
    return np.concatenate([np.zeros((1, 3)), *parts, followed.points.positions])


def _content_id(followed: FollowedTrajectory) -> uuid.UUID:
    """Return an id that depends only on the content: the viewer merges equal recordings."""
    digest = hashlib.sha256(followed.robot.name.encode())
    for array in (followed.samples.times, followed.samples.joints, followed.points.positions):
        digest.update(np.ascontiguousarray(array).tobytes())
    return uuid.UUID(bytes=digest.digest()[:16])
