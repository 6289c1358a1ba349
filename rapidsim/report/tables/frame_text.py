"""A frame tree as text with guides, and as a record of JSON."""

from __future__ import annotations

import math
from typing import Annotated

from rich.text import Text
from rich.tree import Tree

from rapidsim.frames.quaternion import normalised
from rapidsim.json_records.declarations import ValueForm
from rapidsim.language.data import IDENTITY_POSE, Orient, Pose
from rapidsim.report.tables.frame_tree import FrameNode
from rapidsim.values import value_class

_STYLES = {"tool": "green", "user": "yellow", "object": "yellow", "target": "cyan"}
_SHOWN_TARGETS = 40
_GIMBAL = 1e-7


@value_class(frozen=True, slots=True)
class FramePose:
    """A pose in mm and a unit quaternion."""

    position_mm: tuple[float, ...]
    quaternion: tuple[float, ...]
    """Scalar first."""


@value_class(frozen=True, slots=True)
class FrameRecord:
    """A frame or a target, with the frames fixed to it."""

    name: str
    kind: str
    """`world`, `base`, `flange`, `tool`, `user`, `object` or `target`."""
    note: str | None
    pose: Annotated[FramePose, ValueForm.INLINE]
    """Pose in the frame to which it is fixed."""
    world: FramePose | None
    """Pose in the world; null if it depends on the posture of the arm."""
    children: tuple[FrameRecord, ...]


def frame_text(frame: FrameNode) -> Tree:
    """The tree with position [mm] and EulerZYX angles [deg] of each frame in its parent."""
    shown = Tree(_label(frame), guide_style="dim")
    _add(shown, frame)
    return shown


def frame_record(frame: FrameNode) -> FrameRecord:
    """The tree as a record."""
    return FrameRecord(
        name=frame.name,
        kind=frame.kind,
        note=frame.note or None,
        pose=_pose_record(frame.parent_from_frame),
        world=_pose_record(frame.world_from_frame) if frame.world_from_frame else None,
        children=tuple(map(frame_record, frame.children)),
    )


def euler_zyx_deg(rotation: Orient) -> tuple[float, float, float]:
    """Angles about z, y, x [deg] as RAPID's OrientZYX takes them; about x is 0 where y is 90."""
    w, x, y, z = normalised(rotation)
    along_x = 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z)
    across = math.hypot(*along_x)
    about_y = math.degrees(math.atan2(2.0 * (w * y - z * x), across))
    if across < _GIMBAL:
        # Axes z and x are one there, so z takes the whole turn.
        return math.degrees(2.0 * math.atan2(z, w)), about_y, 0.0
    about_z = math.atan2(along_x[1], along_x[0])
    about_x = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    return math.degrees(about_z), about_y, math.degrees(about_x)


def _add(tree: Tree, frame: FrameNode) -> None:
    targets = 0
    for child in frame.children:
        targets += child.kind == "target"
        if targets <= _SHOWN_TARGETS or child.kind != "target":
            _add(tree.add(_label(child)), child)
    if targets > _SHOWN_TARGETS:
        tree.add(Text(f"and {targets - _SHOWN_TARGETS} more targets", "dim"))


def _label(frame: FrameNode) -> Text:
    label = Text(frame.name, f"bold {_STYLES.get(frame.kind, '')}".strip())
    if frame.parent_from_frame != IDENTITY_POSE:
        label.append(f"  {_pose_text(frame.parent_from_frame)}")
    if frame.note:
        label.append(f"  {frame.note}", "dim")
    return label


def _pose_text(pose: Pose) -> str:
    position = ", ".join(_rounded(x, 1) for x in pose.trans)
    angles = euler_zyx_deg(pose.rot)
    if all(abs(angle) < 5e-4 for angle in angles):
        return f"[{position}] mm"
    z, y, x = (_rounded(angle, 2) for angle in angles)
    return f"[{position}] mm  z {z}°  y {y}°  x {x}°"


def _rounded(value: float, digits: int) -> str:
    """Fixed digits, and never a negative zero."""
    return f"{round(value, digits) + 0.0:.{digits}f}"


def _pose_record(pose: Pose) -> FramePose:
    return FramePose(pose.trans, pose.rot)
