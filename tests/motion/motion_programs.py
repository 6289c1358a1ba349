"""Rows of segments for tests of paths, timing and trajectories, on a catalogue arm."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from hypothesis import strategies as st
from plain_segments import plain_segment

from rapidsim.frames.rotation_vectors import rotation_from_vector, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.segments import Geometry, Segment, Speed, Waypoint, Zone
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.joined_paths import joined_paths
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.timing.axis_limits import Limits

ROBOT: Robot = load_robot("irb1600-6-1.2")
HOME = np.radians([0.0, -10.0, 20.0, 10.0, 60.0, 20.0])
TOOL = Transform(rotation_from_vector(np.array([0.0, 0.3, 0.0])), np.array([0.05, 0.0, 0.2]))
LIMITS = Limits(
    max_speed=np.array([joint.max_speed or 1.0 for joint in ROBOT.joints]),
    max_acceleration=np.array([(joint.max_speed or 1.0) / 0.16 for joint in ROBOT.joints]),
    zone_share=np.full(len(ROBOT.joints), 0.64),
)
MODEL = MotionModel(filter_time=0.0)
V500 = Speed(0.5, np.radians(500.0))


def zone(millimetres: float) -> Zone:
    """A zone with the proportions of z10."""
    metres = millimetres * 1e-3
    return Zone(metres, 1.5 * metres, np.radians(0.15 * millimetres))


class Programmer:
    """Writes segments one after the other from where the arm stands."""

    def __init__(
        self,
        *,
        joints: Array = HOME,
        tool: Transform = TOOL,
        speed: Speed = V500,
        branch: int = 0,
        robot: Robot = ROBOT,
    ) -> None:
        self.robot = robot
        self.joints = joints
        self.tool = tool
        self.speed = speed
        self.branch = branch
        self.segments: list[Segment] = []

    def __repr__(self) -> str:
        moves = []
        for s in self.segments:
            start, end = s.start.base_from_tcp, s.end.base_from_tcp
            turn = vector_from_rotation(end.rotation @ start.rotation.T)
            step = np.concatenate([end.translation - start.translation, turn])
            if s.geometry is Geometry.JOINT:
                step = s.end.joints - s.start.joints
            radius = s.zone.position if s.zone else None
            moves.append(f"{s.geometry.value} {step.tolist()} zone {radius}")
        return "Programmer(\n  " + "\n  ".join(moves) + "\n)"

    @property
    def pose(self) -> Transform:
        """base_from_tcp where the arm stands."""
        return self.robot.kinematics.forward(self.joints) @ self.tool

    def line(
        self,
        offset: Sequence[float] = (0.0, 0.0, 0.0),
        turn: Sequence[float] = (0.0, 0.0, 0.0),
        z: Zone | None = None,
        *,
        speed: Speed | None = None,
        via: Sequence[float] | None = None,
        **options: object,
    ) -> Programmer:
        """A line (or an arc through `via`) by an offset [m] and a turn [rad], both in base."""
        start = self.pose
        rotation = rotation_from_vector(np.array(turn)) @ start.rotation
        end = Transform(rotation, start.translation + np.array(offset))
        joints = self._joints_along(start, end)
        self._add(
            Geometry.LINE if via is None else Geometry.ARC,
            Waypoint(joints, end),
            z,
            speed,
            None if via is None else Transform(start.rotation, start.translation + np.array(via)),
            options,
        )
        return self

    def move(
        self,
        offset: Sequence[float],
        z: Zone | None = None,
        *,
        speed: Speed | None = None,
        **options: object,
    ) -> Programmer:
        """A joint move by an offset [rad] of the joints."""
        joints = self.joints + np.array(offset)
        end = Waypoint(joints, self.robot.kinematics.forward(joints) @ self.tool)
        self._add(Geometry.JOINT, end, z, speed, None, options)
        return self

    def _joints_along(self, start: Transform, end: Transform) -> Array:
        from_tcp = self.tool.inverse()
        share = np.linspace(0.0, 1.0, 50)[:, None]
        axis = vector_from_rotation(end.rotation @ start.rotation.T)
        poses = Transform(
            rotation_from_vector(share * axis) @ start.rotation,
            start.translation + share * (end.translation - start.translation),
        )
        near = self.joints
        followed = self.robot.kinematics.inverse_on_branch(poses @ from_tcp, self.branch, near)
        joints: Array = followed.joints[-1]
        return joints

    def _add(
        self,
        geometry: Geometry,
        end: Waypoint,
        z: Zone | None,
        speed: Speed | None,
        via: Transform | None,
        options: dict[str, object],
    ) -> None:
        segment = plain_segment(
            geometry=geometry,
            start=Waypoint(self.joints, self.pose),
            end=end,
            tcp_from_flange=self.tool.inverse(),
            branch=self.branch,
            speed=speed or self.speed,
            zone=z,
            via=via,
            **options,
        )
        self.segments.append(segment)
        self.joints = end.joints


def path_of(program: Programmer | Sequence[Segment], model: MotionModel = MODEL) -> Path:
    """The path of a program that the arm can follow."""
    path = path_or_fault(program, model)
    assert isinstance(path, Path), path
    return path


def path_or_fault(
    program: Programmer | Sequence[Segment], model: MotionModel = MODEL
) -> Path | PathFault:
    """What `build_path` says about a program."""
    if isinstance(program, Programmer):
        return build_path(program.robot, program.segments, model)
    return build_path(ROBOT, program, model)


def require_same_when_joined(paths: Sequence[Path]) -> None:
    """Joined paths have the joints, poses, segments, speeds and travel of each, ends included."""
    joined = joined_paths(paths)
    for number, path in enumerate(paths):
        on, start = joined.paths[joined.on[number]], joined.starts[number]
        s = np.linspace(0.0, path.length, 23)
        alone, together = path.evaluate(s), on.evaluate(s + start)
        assert np.allclose(together.joints, alone.joints, rtol=0.0, atol=1e-9)
        there, here = together.base_from_tcp, alone.base_from_tcp
        assert np.allclose(there.translation, here.translation, rtol=0.0, atol=1e-9)
        assert np.allclose(there.rotation, here.rotation, rtol=0.0, atol=1e-9)
        driven = (on.segments[each] for each in together.segment)
        assert all(a is path.segments[b] for a, b in zip(driven, alone.segment, strict=True))
        # At breakpoints a rate jumps, and the rounding of the place says which side it is of.
        inner = ~np.isin(s, path.breakpoints)
        assert np.allclose(together.tcp_rate[inner], alone.tcp_rate[inner], rtol=0.0, atol=1e-6)
        travel = on.travelled(s + start) - on.travelled(np.array([start]))
        assert np.allclose(travel, path.travelled(s), rtol=0.0, atol=1e-9)


offsets = st.floats(-0.12, 0.12)
steps = st.tuples(offsets, offsets, offsets).filter(lambda step: math.hypot(*step) > 0.01)
turns = st.tuples(*[st.floats(-0.15, 0.15)] * 3)
zones = st.sampled_from([None, 0.3, 1.0, 5.0, 10.0, 50.0])


@st.composite
def programs(draw: st.DrawFn) -> Programmer:
    """Two to six moves of any kind with any zones."""
    program = Programmer()
    for _ in range(draw(st.integers(2, 6))):
        radius = draw(zones)
        z = zone(radius) if radius is not None else None
        if draw(st.booleans()):
            program.line(draw(steps), draw(turns), z)
        else:
            program.move(draw(st.tuples(*[st.floats(-0.15, 0.15)] * 6)), z)
    return program
