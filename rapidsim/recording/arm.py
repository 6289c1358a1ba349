"""The arm: link shapes in named frames, moved by the joints.

The link frames hang on one another, base to flange, under names that carry the robot's so that
RAPID's own names (`tool0`, `wobj1`) stay free. Edges come from the robot's own kinematics, not from
the description's joints: a coupled axis moves as it does in the run, and a joint beyond its limit
is shown beyond its limit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import rerun as rr
from rerun.urdf import UrdfTree

from rapidsim.frames.transform import Transform
from rapidsim.motion.robot import Robot
from rapidsim.recording.sampled import SampledRun
from rapidsim.recording.shapes import log_shapes
from rapidsim.recording.skeleton import log_bar
from rapidsim.recording.timelines import indexes
from rapidsim.recording.transforms import BASE, moving_frame, static_frame

ENTITY = "robot"
FLANGE = "tool0"
"""RAPID's name of the flange."""


@dataclass(frozen=True, slots=True)
class Chain:
    """The frames of an arm from base to flange."""

    joint_names: tuple[str, ...]
    link_frames: tuple[str, ...]
    """The frame that each joint moves."""


def log_arm(stream: rr.RecordingStream, run: SampledRun) -> tuple[str, ...]:
    """Log the arm and its motion.

    Returns:
        What the viewer will not show as it should, a line each.
    """
    robot = run.simulation.robot
    prefix = f"{robot.name}/"
    tree = (
        UrdfTree.from_file_path(robot.urdf, entity_path_prefix=ENTITY, frame_prefix=prefix)
        if robot.urdf is not None
        else None
    )
    chain = _chain(robot, tree, prefix)
    _log_motion(stream, run, chain)
    if tree is None:
        _log_skeleton(stream, robot, chain, frozenset((BASE, *chain.link_frames)))
        return (f"{robot.name} has no description with link shapes: links are drawn as bars",)
    _log_other_frames(stream, run, tree, prefix, chain)
    shapes = log_shapes(stream, tree)
    if not shapes.drawn:
        _log_skeleton(stream, robot, chain, frozenset((BASE, *chain.link_frames)))
        return (f"{robot.name}: the description draws no link: links are drawn as bars",)
    if shapes.missing:
        bare = shapes.missing - shapes.drawn
        base = frozenset({BASE}) if prefix + tree.root_link().name in bare else frozenset[str]()
        _log_skeleton(stream, robot, chain, bare | base)
        names = ", ".join(sorted(frame.removeprefix(prefix) for frame in shapes.missing))
        return (f"{robot.name}: cannot read the shape of {names}: drawn as bars",)
    return ()


def _chain(robot: Robot, tree: UrdfTree | None, prefix: str) -> Chain:
    """Names of the moved frames: the description's links, or link_1, link_2, ... without one."""
    names = tuple(joint.name for joint in robot.joints)
    links = {joint.name: joint.child_link for joint in tree.joints()} if tree else {}
    frames = tuple(
        prefix + links.get(name, f"link_{number}") for number, name in enumerate(names, start=1)
    )
    return Chain(names, frames)


def _log_motion(stream: rr.RecordingStream, run: SampledRun, chain: Chain) -> None:
    """One edge a joint, from the link before it."""
    samples = run.samples
    base_from_link = run.simulation.robot.kinematics.link_frames(samples.joints)
    index = indexes(samples.times, samples.move)
    parent, base_from_parent = BASE, Transform.identity()
    for k, frame in enumerate(chain.link_frames):
        parent_from_link = base_from_parent.inverse() @ base_from_link[:, k]
        stream.send_columns(
            rr.new_entity_path([ENTITY, "joints", chain.joint_names[k]]),
            indexes=index,
            columns=moving_frame(parent, frame, parent_from_link),
        )
        parent, base_from_parent = frame, base_from_link[:, k]
    stream.log(
        f"{ENTITY}/flange",
        static_frame(chain.link_frames[-1], FLANGE, last_link_from_flange(run.simulation.robot)),
        static=True,
    )


def last_link_from_flange(robot: Robot) -> Transform:
    """Where the flange sits on the last link; the same in every pose."""
    zero = np.zeros(len(robot.joints))
    base_from_links = robot.kinematics.link_frames(zero)
    return base_from_links[-1].inverse() @ robot.kinematics.forward(zero)


def _log_other_frames(
    stream: rr.RecordingStream, run: SampledRun, tree: UrdfTree, prefix: str, chain: Chain
) -> None:
    """The frames of the description that no joint of the run moves.

    Joints that mimic one of the run follow it; a gripper's joints stay at 0.
    """
    stream.log(
        f"{ENTITY}/base",
        static_frame(BASE, prefix + tree.root_link().name, Transform.identity()),
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
                rr.new_entity_path([ENTITY, "joints", joint.name]),
                indexes=indexes(samples.times, samples.move),
                columns=joint.compute_transform_columns(angles.tolist(), clamp=False),
            )
        else:
            stream.log(
                rr.new_entity_path([ENTITY, "fixed", joint.name]),
                joint.compute_transform(0.0),
                static=True,
            )


def _log_skeleton(
    stream: rr.RecordingStream, robot: Robot, chain: Chain, frames: frozenset[str]
) -> None:
    """Bars from joint to joint, for the links that have no shape of their own."""
    zero = np.zeros(len(robot.joints))
    origins = robot.kinematics.link_frames(zero)
    flange = robot.kinematics.forward(zero)
    size = robot.reach_m or float(np.linalg.norm(flange.translation))
    parent_from_base = Transform.identity()
    for k, frame in enumerate((BASE, *chain.link_frames)):
        base_from_next = origins[k] if k < len(chain.link_frames) else flange
        end = parent_from_base.apply(base_from_next.translation)
        if frame in frames:
            # Thick at the foot, slender at the wrist.
            log_bar(stream, f"{ENTITY}/bars/{k}", frame, end, size * (0.055 - 0.005 * min(k, 6)))
        parent_from_base = base_from_next.inverse()
