"""What a controller backup says of its robots: `SYSPAR/MOC.cfg`.

The type of an arm is a name such as `ROB1_1200_0.9_5_TypeB`: type, reach in metres, payload in kg.
Its base frame stands in metres.
"""

from __future__ import annotations

import re
from pathlib import Path

from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.catalogue import robot_names
from rapidsim.station.backup.cfg_file import Instance, read_configuration, text_in
from rapidsim.station.robot import StationRobot

_TYPE = re.compile(r"ROB\d_(\w+?)_(\d+\.\d+)_(\d+(?:\.\d+)?)(?:_Type\w+)?", re.IGNORECASE)
_NAME = re.compile(r"irb(\w+)-([\d.]+)-([\d.]+)")


def backup_robots(root: Path) -> tuple[tuple[StationRobot, ...], tuple[str, ...]]:
    """The robots of a backup in its order.

    Args:
        root: The folder of the backup.

    Returns:
        The robots, without a name where the catalogue does not have the arm; and the types of
        those.
    """
    instances = read_configuration(text_in(root, "SYSPAR", "MOC.cfg")).get("ROBOT", ())
    arms = [one for one in instances if one.get("use_robot_type")]
    robots = [
        StationRobot(_catalogue_name(one["use_robot_type"]), None, _base(one), one.get("name"))
        for one in arms
    ]
    unknown = [
        one["use_robot_type"] for one, robot in zip(arms, robots, strict=True) if robot.name is None
    ]
    return tuple(robots), tuple(unknown)


def _catalogue_name(type_name: str) -> str | None:
    """The arm of the catalogue with this type, reach and payload; None if there is none."""
    match = _TYPE.fullmatch(type_name)
    if match is None:
        return None
    wanted = (match[1].lower(), float(match[2]), float(match[3]))
    for name in robot_names():
        parts = _NAME.fullmatch(name)
        if parts and (parts[1], float(parts[3]), float(parts[2])) == wanted:
            return name
    return None


def _base(instance: Instance) -> Transform:
    """world_from_base; where the arm stands in the origin if the file does not say."""
    position = [_value(instance, f"base_frame_pos_{axis}", 0.0) for axis in "xyz"]
    quaternion = [
        _value(instance, f"base_frame_orient_u{n}", 1.0 if n == 0 else 0.0) for n in range(4)
    ]
    if not any(quaternion):
        return Transform.identity()
    return Transform.from_quaternion(quaternion, position)


def _value(instance: Instance, attribute: str, default: float) -> float:
    try:
        return float(instance.get(attribute, default))
    except ValueError:
        return default
