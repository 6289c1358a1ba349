"""Answers to the page that jogs an arm: functions of the joints that it sends, as JSON values.

Joints and sizes are in degrees and mm, as RAPID has them. Answers have no effect: the page keeps
where the arm is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Final, TypeVar

import numpy as np

from rapidsim.applications.jog.jog_cell import JogCell
from rapidsim.applications.jog.posture_contacts import Nearness
from rapidsim.colours import LIGHT
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData, Orient, Pos, RobTarget, ToolData, WobjData
from rapidsim.language.single_precision import single
from rapidsim.library.predefined import TYPES
from rapidsim.library.text import source_text
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.jog_steps import JogArm, JogFrame
from rapidsim.motion.configurations.pose_solutions import solve_pose
from rapidsim.motion.configurations.singularities import differential
from rapidsim.report.html.arm_shapes import arm_data, connected_bodies, outermost

_MM: Final = 1e3
_NEAR_M: Final = 0.1
"""Distance [m] of bodies up to which it is shown."""
_PLACES: Final = 13
"""Places of a step at which contacts are looked for."""
_PLAIN: Final = "#96a0ae"
"""Colour of other arms."""
_SAME_RAD: Final = 1e-4
"""Difference of joints [rad] below which a solution is the posture itself."""
T = TypeVar("T")
Fields = Mapping[str, str]


class JogAnswers:
    """Answers about one cell."""

    def __init__(self, cell: JogCell) -> None:
        """Answer about a cell."""
        self.cell = cell

    def start(self, fields: Fields) -> dict[str, object]:
        """Return what does not change: the arm, its picture, the objects and frames of its cell."""
        del fields
        cell = self.cell
        scene = cell.contacts.scene
        return {
            "title": cell.robot.title,
            "arm": self._drawn_arm or self._undrawn_arm(),
            "joints": _degrees(cell.start),
            "limits": [_degrees(row) for row in _sliders(cell)],
            "measures": [joint.measure for joint in cell.robot.joints],
            "tools": [*cell.tools],
            "wobjs": [*cell.wobjs],
            "modules": [one.name for one in cell.files],
            "remarks": [*cell.remarks],
            "objects": [
                {
                    "name": scene.bodies[at].label.name.strip("`"),
                    "colour": self._colour(at),
                    "parts": [
                        outermost(part)
                        for part in connected_bodies(
                            scene.bodies[at].shape.vertices, scene.bodies[at].shape.faces
                        )
                    ],
                }
                for at in self._drawn_bodies
            ],
        }

    def standing(self, fields: Fields) -> dict[str, object]:
        """Return all about one posture: pose, limits, singularities, contacts, its robtarget.

        Raises:
            InputError: As all answers do, if a field is missing or wrong.
        """
        arm, tool, wobj = self._arm(fields)
        near = self.cell.contacts.near(arm.joints[None], _NEAR_M)
        there = differential(arm.robot.kinematics, arm.joints, targets.transform(tool.tframe))
        target = self.target(arm, wobj)
        return {
            **arm.standing(),
            "trans": [round(one, 4) for one in target.trans],
            "rot": [round(one, 8) for one in target.rot],
            "tip": (_MM * arm.base_from_tcp.translation).round(2).tolist(),
            "manipulability": float(f"{there.manipulability:.4g}"),
            "singularMeasures": [
                {
                    "name": one.name,
                    "distance": round(one.distance, 4),
                    "near": one.near,
                    "reason": one.reason,
                }
                for one in there.singularities
            ],
            "contacts": [*map(_nearness, near)],
            "objects": self._places(arm.joints),
            "robtarget": source_text(target, TYPES["robtarget"]),
        }

    def steps(self, fields: Fields) -> dict[str, object]:
        """Return which steps along a frame are possible, as the panel of the page shows them."""
        arm, _, wobj = self._arm(fields)
        frame = self._frame(arm, wobj, _word(fields, "frame", JogFrame))
        steps = arm.steps(frame, _word(fields, "length", float), _word(fields, "angle", float))
        if isinstance(steps, str):
            raise InputError(steps)
        return {"reason": None, "steps": steps, "stands": arm.standing()}

    def move(self, fields: Fields) -> dict[str, object]:
        """Return the joints after a step, with the bodies that touch on its course."""
        arm, _, wobj = self._arm(fields)
        frame = self._frame(arm, wobj, _word(fields, "frame", JogFrame))
        step = arm.step(frame, _word(fields, "axis", int) - 1, _word(fields, "by", float))
        moved = step if isinstance(step, str) else arm.along(step, np.linspace(0.0, 1.0, _PLACES))
        if isinstance(moved, str):
            raise InputError(moved)
        touched = self.cell.contacts.near(moved, 0.0)
        return {"joints": _degrees(moved[-1]), "contacts": [*map(_nearness, touched)]}

    def branches(self, fields: Fields) -> dict[str, object]:
        """Return all solutions of the pose of a posture, one for each branch and turn."""
        arm, _, _ = self._arm(fields)
        found = solve_pose(arm.robot, arm.robot.forward(arm.joints), everything=True)
        return {
            "branches": [
                {
                    "confdata": [*one.confdata],
                    "joints": _degrees(one.joints),
                    "within": one.within_limits,
                    "here": bool(np.abs(one.joints - arm.joints).max() < _SAME_RAD),
                }
                for one in found.solutions
            ]
        }

    def target(self, arm: JogArm, wobj: WobjData) -> RobTarget:
        """Return the robtarget of a posture in a work object, to 0.0001 mm, in single precision."""
        base_from_object = targets.base_from_object(wobj, self.cell.base_from_world)
        pose = targets.pose(base_from_object.inverse() @ arm.base_from_tcp)
        trans = Pos(*(single(round(one, 4) + 0.0) for one in pose.trans))
        rot = Orient(*(single(round(one, 8) + 0.0) for one in pose.rot))
        conf = ConfData(*map(float, confdata_of(arm.robot.kinematics, arm.joints).tolist()))
        external = targets.ext_joint(self.cell.external, arm.robot.external)
        return RobTarget(trans, rot, conf, external)

    def taught(self, fields: Fields) -> RobTarget:
        """Return the robtarget of a posture of the page."""
        arm, _, wobj = self._arm(fields)
        return self.target(arm, wobj)

    def _arm(self, fields: Fields) -> tuple[JogArm, ToolData, WobjData]:
        """Return arm, tool and work object of a query."""
        count = len(self.cell.robot.joints)
        joints = np.radians(_word(fields, "joints", _numbers))
        if len(joints) != count or not np.isfinite(joints).all():
            raise InputError(f"`joints` has {count} numbers")
        tool = _word(fields, "tool", self.cell.tools.__getitem__)
        wobj = _word(fields, "wobj", self.cell.wobjs.__getitem__)
        return JogArm(self.cell.robot, targets.tcp_from_flange(tool), joints), tool, wobj

    def _frame(self, arm: JogArm, wobj: WobjData, frame: JogFrame) -> Transform | None:
        base_from_world = self.cell.base_from_world
        return arm.base_from_frame(
            frame, base_from_world, lambda: targets.base_from_object(wobj, base_from_world)
        )

    @cached_property
    def _drawn_arm(self) -> dict[str, object] | None:
        return arm_data(self.cell.robot)

    def _undrawn_arm(self) -> dict[str, object]:
        """Return the size [mm] of an arm whose links are drawn as the other bodies are."""
        reach = self.cell.robot.reach_m or float(
            np.linalg.norm(self.cell.robot.forward(self.cell.start).translation)
        )
        return {"links": [], "bodies": [], "limits": [], "reach": _MM * reach}

    @cached_property
    def _drawn_bodies(self) -> tuple[int, ...]:
        """Indices of the bodies that do not come with the picture of the arm."""
        scene = self.cell.contacts.scene
        return tuple(
            at
            for at, body in enumerate(scene.bodies)
            if body.exists(0.0) and (self._drawn_arm is None or not self._is_own(at))
        )

    def _is_own(self, at: int) -> bool:
        """Whether a body is a link of the arm."""
        body = self.cell.contacts.scene.bodies[at]
        return body.label.robot == 0 and at not in self.cell.colours

    def _colour(self, at: int) -> str:
        return self.cell.colours.get(at, LIGHT.arm if self._is_own(at) else _PLAIN)

    def _places(self, joints: Array) -> list[dict[str, object]]:
        """Return where the drawn bodies stand in the base of the arm [mm]."""
        poses = self.cell.contacts.poses(joints[None])
        stands = [self.cell.base_from_world @ poses.of(at)[0] for at in self._drawn_bodies]
        return [
            {
                "turn": one.rotation.ravel().round(6).tolist(),
                "place": (_MM * one.translation).round(2).tolist(),
            }
            for one in stands
        ]


def _sliders(cell: JogCell) -> Array:
    """Return the ends (n, 2) [rad] of the sliders: limits, or a turn to both sides."""
    ends = np.stack([cell.robot.lower, cell.robot.upper], axis=-1)
    whole = 2.0 * np.pi * np.array([-1.0, 1.0])
    limits: Array = np.where(np.isfinite(ends), ends, whole)
    return limits


def _nearness(pair: Nearness) -> dict[str, object]:
    return {"first": pair.first, "second": pair.second, "distance": round(_MM * pair.distance_m, 2)}


def _degrees(joints: Array) -> list[float]:
    return [round(one, 4) + 0.0 for one in np.degrees(joints).tolist()]


def _numbers(text: str) -> Array:
    return np.array([float(one) for one in text.split(",")])


def _word(fields: Fields, name: str, read: Callable[[str], T]) -> T:
    """Return a required value.

    Raises:
        InputError: If it is missing or wrong.
    """
    try:
        return read(fields[name])
    except (KeyError, ValueError):
        raise InputError(f"`{name}` cannot be `{fields.get(name, '')}`") from None
