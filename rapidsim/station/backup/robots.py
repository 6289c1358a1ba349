"""Robots of a controller backup: `SYSPAR/MOC.cfg`.

The type of an arm is a name such as `ROB1_1200_0.9_5_TypeB`: type, reach in metres, payload in kg.
Its base frame is in metres, the bounds of its axes (ARM) in radians or metres.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.catalogue import robot_names
from rapidsim.station.backup.cfg_file import Configuration, Instance
from rapidsim.station.robot import StationRobot

_PREFIX = re.compile(r"ROB\d*_(?:(?P<side>[LR])_)?(?:IRB|CRB)?_?", re.IGNORECASE)
_TYPE_LETTER = re.compile(r"_Type\w+$", re.IGNORECASE)
_NAME = re.compile(r"([ic]rb)(\w+)-([\d.]+)-([\d.]+)(?:-(left|right|lid))?")
_SIDES = {"l": "left", "r": "right"}
_WITH_DRESSING = "lid"
"""End of the names and types of arms whose cables run inside."""
_JOINTS = 7


def backup_robots(motion: Configuration) -> tuple[StationRobot, ...]:
    """Return the robots of a backup in its order; nameless if the catalogue lacks the arm."""
    arms = {one.get("name", ""): one for one in motion.get("ARM", ())}
    return tuple(_robot(one, arms) for one in arm_instances(motion))


def arm_instances(motion: Configuration) -> list[Instance]:
    """Return the instances of ROBOT that are arms: all with a type, except for gantries."""
    carriers = carrier_instances(motion)
    robots = (one for one in motion.get("ROBOT", ()) if one.get("use_robot_type"))
    return [one for one in robots if one not in carriers]


def carrier_instances(motion: Configuration) -> list[Instance]:
    """Return the instances of ROBOT whose kinematics the file has itself, and that carry others."""
    kinds = {one.get("name"): one.get("type", "") for one in motion.get("ROBOT_TYPE", ())}
    robots = motion.get("ROBOT", ())
    carried_by = {one.get("base_frame_coordinated") for one in robots}
    own = (one for one in robots if kinds.get(one.get("use_robot_type"), "").upper() == "GEN_KIN")
    return [one for one in own if one.get("name") in carried_by]


def _robot(instance: Instance, arms: Mapping[str, Instance]) -> StationRobot:
    type_name = instance["use_robot_type"]
    name = catalogue_name(type_name)
    joints = [joint for n in range(_JOINTS) if (joint := instance.get(f"use_joint_{n}"))]
    return StationRobot(
        name=name,
        world_from_base=base_frame(instance),
        label=instance.get("name"),
        unknown=type_name if name is None else None,
        axis_count=len(joints) or None,
        bounds=_bounds([arms.get(joint) for joint in joints]),
        carried_by=instance.get("base_frame_coordinated") or None,
    )


def catalogue_name(type_name: str) -> str | None:
    """Return the catalogue's arm with this type, reach and payload; None if it has no such arm."""
    prefix = _PREFIX.match(type_name)
    if prefix is None:
        return None
    model, *figures = _TYPE_LETTER.sub("", type_name[prefix.end() :]).lower().split("_")
    variant = _SIDES.get((prefix["side"] or "").lower())
    if figures[-1:] == [_WITH_DRESSING]:
        variant = figures.pop()
    if len(figures) not in (1, 2):
        return None
    # Palletizers with a single reach, such as ROB1_660_180, are named without it.
    wanted = [_figure(word) for word in figures]
    found: dict[str, str] = {}
    for name in robot_names():
        parts = _NAME.fullmatch(name)
        # ROB1_1300F_1.4_7 stands on the floor.
        if parts is None or model.removesuffix("f") != parts[2] or parts[5] != variant:
            continue
        payload, reach = float(parts[3]), float(parts[4])
        # Some types have the payload before the reach, as the arms' names do.
        if wanted in ([reach, payload][-len(wanted) :], [payload, reach]):
            if len(wanted) == 1 and parts[1] in found:
                return None
            found[parts[1]] = name
    # IRB and CRB 1300 have equal numbers; a type that names neither is that of the IRB.
    families = ("crb",) if "crb" in prefix[0].lower() else ("irb", "crb")
    return next((found[family] for family in families if family in found), None)


def arm_type(name: str) -> str:
    """Return a type that means an arm of the catalogue; the name itself if none does."""
    parts = _NAME.fullmatch(name)
    if parts is None:
        return name
    family, model, payload, reach, variant = parts.groups()
    side = next((letter.upper() for letter, one in _SIDES.items() if one == variant), "")
    dressing = _WITH_DRESSING.upper() if variant == _WITH_DRESSING else ""
    words = ("ROB1", side, "CRB" if family == "crb" else "", model, reach, payload, dressing)
    found = "_".join(word for word in words if word)
    return found if catalogue_name(found) == name else name


def _figure(word: str) -> float | None:
    """Return a number of a type; `05` is 0.5."""
    if re.fullmatch(r"0\d+", word):
        word = f"0.{word[1:]}"
    try:
        return float(word)
    except ValueError:
        return None


def _bounds(arms: Sequence[Instance | None]) -> tuple[tuple[float, float] | None, ...]:
    """Bounds of each axis in order; empty for seven axes, which RAPID orders differently."""
    if len(arms) >= _JOINTS:
        return ()
    return tuple(None if arm is None else bounds(arm) for arm in arms)


def bounds(arm: Instance) -> tuple[float, float] | None:
    """Return the range of an axis [rad or m]; None if the file does not define it."""
    lower, upper = number(arm, "lower_joint_bound"), number(arm, "upper_joint_bound")
    return None if lower is None or upper is None or lower >= upper else (lower, upper)


def base_frame(instance: Instance) -> Transform:
    """Return world_from_base; the identity if the file does not define it."""
    return frame_of(instance, "base_frame_pos", "base_frame_orient")


def frame_of(instance: Instance, place: str, turn: str) -> Transform:
    """Return a frame by the beginnings of its attributes; the identity without any."""
    position = [number(instance, f"{place}_{axis}") or 0.0 for axis in "xyz"]
    turned = [number(instance, f"{turn}_u{n}") for n in range(4)]
    quaternion = [1.0 if n == 0 and u is None else u or 0.0 for n, u in enumerate(turned)]
    if not any(quaternion):
        return Transform.identity()
    return Transform.from_quaternion(quaternion, position)


def number(instance: Instance, attribute: str) -> float | None:
    """Return the value of an attribute; None if it is missing or not a number."""
    try:
        return float(instance[attribute])
    except (KeyError, ValueError):
        return None
