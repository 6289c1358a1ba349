"""The arm: link shapes in named frames, moved by the joints.

The link frames form a chain, base to flange, under names with the robot's prefix, so that RAPID's
names (`tool0`, `wobj1`) remain free. Edges result from the robot's own kinematics, not from the
description's joints: a coupled axis moves as in the run, and a joint beyond its limit is shown
beyond its limit.
"""

from __future__ import annotations

import re
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Protocol

import numpy as np
import rerun as rr
from rerun.urdf import UrdfTree

from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.files import input_text
from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.robot.urdf_text import plain_urdf
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.recording import palette
from rapidsim.recording.scene.link_shapes import log_shapes
from rapidsim.recording.scene.stick_figure import log_bar
from rapidsim.recording.scene.surface import surface
from rapidsim.recording.timelines import Clock
from rapidsim.recording.transforms import BASE, moving_frame, static_frame
from rapidsim.values import value_class

_AT_ONCE = 1 << 14
"""Instants whose frames are computed at once, which bounds the memory."""

ENTITY = "robot"
FLANGE = "tool0"
"""RAPID's name of the flange."""


class MovingArm(Protocol):
    """Data for drawing an arm: of a run, or of a trajectory without a program."""

    @property
    def name(self) -> str:
        """Prefix of its entities and frames; empty if there is only one robot."""
        ...

    @property
    def robot(self) -> Robot:
        """The arm."""
        ...

    @property
    def samples(self) -> Samples:
        """Motion of the arm."""
        ...

    @property
    def clock(self) -> Clock:
        """Clock of the recording."""
        ...

    def entity(self, path: str) -> str:
        """Return the entity path of something of this robot in the recording."""
        ...

    def frame(self, name: str) -> str:
        """Return the full name of a frame that every robot has, such as `tool0` or `base`."""
        ...


@value_class(frozen=True, slots=True)
class Chain:
    """Frames of an arm from base to flange."""

    joint_names: tuple[str, ...]
    link_frames: tuple[str, ...]
    """Frame that each joint moves."""


@value_class(frozen=True, slots=True)
class LoggedArm:
    """An arm in a recording."""

    chain: Chain
    """Frames for logging further motion."""
    remarks: tuple[str, ...] = ()
    """Remarks on content that the viewer cannot show correctly, one per line."""


def log_arm(stream: rr.RecordingStream, run: MovingArm) -> LoggedArm:
    """Log the arm and its motion."""
    robot = run.robot
    prefix = run.frame(f"{robot.name}/")
    if robot.meshes is not None:
        return LoggedArm(_log_meshes(stream, run, prefix))
    tree = None if robot.urdf is None else _description(robot.urdf, _shapes(run), prefix)
    chain = _chain(robot, tree, prefix)
    log_motion(stream, run, chain)
    if tree is None:
        _log_skeleton(stream, run, chain, frozenset((run.frame(BASE), *chain.link_frames)))
        why = "has no description with link shapes" if robot.urdf is None else "cannot be drawn"
        return LoggedArm(chain, (f"{robot.name} {why}: links are drawn as bars",))
    _log_other_frames(stream, run, tree, prefix, chain)
    shapes = log_shapes(stream, tree)
    if not shapes.logged:
        _log_skeleton(stream, run, chain, frozenset((run.frame(BASE), *chain.link_frames)))
        why = f"{robot.name}: the description draws no link: links are drawn as bars"
        return LoggedArm(chain, (why,))
    if shapes.missing:
        bare = shapes.missing - shapes.logged
        root = prefix + tree.root_link().name
        base = frozenset({run.frame(BASE)}) if root in bare else frozenset[str]()
        _log_skeleton(stream, run, chain, bare | base)
        names = ", ".join(sorted(frame.removeprefix(prefix) for frame in shapes.missing))
        return LoggedArm(chain, (f"{robot.name}: cannot read the shape of {names}: drawn as bars",))
    return LoggedArm(chain)


def _log_meshes(stream: rr.RecordingStream, run: MovingArm, prefix: str) -> Chain:
    """Log the arm with the user's shapes; return the frames of its links."""
    chain = _chain(run.robot, None, prefix)
    log_motion(stream, run, chain)
    frames = (run.frame(BASE), *chain.link_frames)
    for link in link_shapes(run.robot).links:
        entity = _entity(run, "links", str(link.number))
        stream.log(entity, rr.CoordinateFrame(frames[link.number]), static=True)
        stream.log(entity, surface(link.shape, palette.LINK), static=True)
    return chain


def _description(file: Path, entity: str, prefix: str) -> UrdfTree | None:
    """Return the description as read by rerun, without non-URDF content; None if unreadable."""
    try:
        return UrdfTree.from_file_path(file, entity_path_prefix=entity, frame_prefix=prefix)
    except RuntimeError:
        text, _ = plain_urdf(file, input_text(file))
    with TemporaryDirectory() as folder:
        plain = Path(folder) / file.name
        plain.write_text(_with_whole_paths(text, file.parent.absolute()), encoding="utf-8")
        try:
            return UrdfTree.from_file_path(plain, entity_path_prefix=entity, frame_prefix=prefix)
        except RuntimeError:
            return None


def _with_whole_paths(text: str, folder: Path) -> str:
    """Return a description with absolute paths of shapes."""

    def whole(match: re.Match[str]) -> str:
        return match[0] if "://" in match[1] else f'filename="{folder / match[1]}"'

    return re.sub(r'filename="([^"]*)"', whole, text)


def _entity(run: MovingArm, *parts: str) -> str:
    path = rr.new_entity_path([ENTITY, *parts])
    return run.entity(path.removeprefix("/"))


def _shapes(run: MovingArm) -> str:
    """Return the entity of the link shapes: one word, as rerun's reader accepts no path."""
    return f"{run.name}_{ENTITY}" if run.name else ENTITY


def _chain(robot: Robot, tree: UrdfTree | None, prefix: str) -> Chain:
    """Return the moved frames: of the description's links, else link_1, link_2, ..."""
    names = tuple(joint.name for joint in robot.joints)
    links = {joint.name: joint.child_link for joint in tree.joints()} if tree else {}
    frames = tuple(
        prefix + links.get(name, f"link_{number}") for number, name in enumerate(names, start=1)
    )
    return Chain(names, frames)


def log_motion(stream: rr.RecordingStream, run: MovingArm, chain: Chain) -> None:
    """Log one edge per joint, from the previous link."""
    samples = run.samples
    for first in range(0, len(samples.times), _AT_ONCE):
        at = slice(first, first + _AT_ONCE)
        base_from_link = run.robot.kinematics.link_frames(samples.joints[at])
        index = run.clock.columns(samples.times[at])
        parent, base_from_parent = run.frame(BASE), Transform.identity()
        for k, frame in enumerate(chain.link_frames):
            parent_from_link = base_from_parent.inverse() @ base_from_link[:, k]
            stream.send_columns(
                _entity(run, "joints", chain.joint_names[k]),
                indexes=index,
                columns=moving_frame(parent, frame, parent_from_link),
            )
            parent, base_from_parent = frame, base_from_link[:, k]
    stream.log(
        _entity(run, "flange"),
        static_frame(chain.link_frames[-1], run.frame(FLANGE), last_link_from_flange(run.robot)),
        static=True,
    )


def last_link_from_flange(robot: Robot) -> Transform:
    """Return the pose of the flange on the last link, which is constant."""
    zero = np.zeros(len(robot.joints))
    base_from_links = robot.kinematics.link_frames(zero)
    return base_from_links[-1].inverse() @ robot.kinematics.forward(zero)


def _log_other_frames(
    stream: rr.RecordingStream, run: MovingArm, tree: UrdfTree, prefix: str, chain: Chain
) -> None:
    """Log the frames of the description that no joint of the run moves.

    Joints that mimic a joint of the run follow it; a gripper's joints stay at 0.
    """
    stream.log(
        _entity(run, "base"),
        static_frame(run.frame(BASE), prefix + tree.root_link().name, Transform.identity()),
        static=True,
    )
    samples = run.samples
    for joint in tree.joints():
        if joint.name in chain.joint_names:
            continue
        if joint.mimic is not None and joint.mimic.joint in chain.joint_names:
            leader = samples.joints[:, chain.joint_names.index(joint.mimic.joint)]
            angles = (joint.mimic.multiplier or 1.0) * leader + (joint.mimic.offset or 0.0)
            stream.send_columns(
                _entity(run, "joints", joint.name),
                indexes=run.clock.columns(samples.times),
                columns=joint.compute_transform_columns(angles.tolist(), clamp=False),
            )
        else:
            stream.log(
                _entity(run, "fixed", joint.name),
                joint.compute_transform(0.0),
                static=True,
            )


def _log_skeleton(
    stream: rr.RecordingStream, run: MovingArm, chain: Chain, frames: frozenset[str]
) -> None:
    """Log bars from joint to joint, for links without a shape."""
    robot = run.robot
    zero = np.zeros(len(robot.joints))
    origins = robot.kinematics.link_frames(zero)
    flange = robot.kinematics.forward(zero)
    size = robot.reach_m or float(np.linalg.norm(flange.translation))
    parent_from_base = Transform.identity()
    for k, frame in enumerate((run.frame(BASE), *chain.link_frames)):
        base_from_next = origins[k] if k < len(chain.link_frames) else flange
        end = parent_from_base.apply(base_from_next.translation)
        if frame in frames:
            # Thick at the foot, slender at the wrist.
            radius = size * (0.055 - 0.005 * min(k, 6))
            log_bar(stream, _entity(run, "bars", str(k)), frame, end, radius)
        parent_from_base = base_from_next.inverse()
