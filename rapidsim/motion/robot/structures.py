"""Kinds of arms in the catalogue: from `structure` in a `robot.toml` to lengths in SI units."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import radians
from types import MappingProxyType
from typing import Any

from rapidsim.motion.kinematics.closed_form import five_axis, opw_geometry, palletizer, scara
from rapidsim.motion.kinematics.closed_form.five_axis import FiveAxisGeometry
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.kinematics.closed_form.palletizer import PalletizerGeometry
from rapidsim.motion.kinematics.closed_form.scara import ScaraGeometry
from rapidsim.motion.kinematics.numerical.revolute_chain import AxisRowGeometry, Vector

Geometry = OpwGeometry | FiveAxisGeometry | PalletizerGeometry | ScaraGeometry | AxisRowGeometry


def geometry_from_table(table: Mapping[str, Any]) -> Geometry:
    """Return the geometry that a `robot.toml` describes.

    Raises:
        KeyError: If something is missing.
        ValueError: If the structure is not known, or the number of joints does not match it.
        TypeError: If a length has a name that the structure does not have.
    """
    structure = table["structure"]
    if structure not in _STRUCTURES:
        known = ", ".join(f"`{name}`" for name in _STRUCTURES)
        raise ValueError(f"structure `{structure}` is not known, only {known}")
    read, joint_count = _STRUCTURES[structure]
    if joint_count is not None and len(table["joint"]) != joint_count:
        raise ValueError(f"the arm needs {joint_count} joints")
    return read(table)


def _ortho_parallel(table: Mapping[str, Any]) -> OpwGeometry:
    zero = table["zero"]
    if not len(zero["offsets_deg"]) == len(zero["signs"]) == opw_geometry.JOINT_COUNT:
        raise ValueError(f"the arm needs {opw_geometry.JOINT_COUNT} offsets and signs")
    return OpwGeometry(
        **_lengths(table),
        offsets=tuple(radians(degrees) for degrees in zero["offsets_deg"]),
        signs=tuple(zero["signs"]),
        coupling=zero["coupling_3_2"],
    )


def _five_axis(table: Mapping[str, Any]) -> FiveAxisGeometry:
    return FiveAxisGeometry(**_lengths(table))


def _palletizer(table: Mapping[str, Any]) -> PalletizerGeometry:
    return PalletizerGeometry(**_lengths(table))


def _scara(table: Mapping[str, Any]) -> ScaraGeometry:
    for number, joint in enumerate(table["joint"]):
        if ("limits_mm" in joint) is not (number == scara.SLIDING):
            raise ValueError(f"only joint {scara.SLIDING + 1}, which slides, must have `limits_mm`")
    return ScaraGeometry(**_lengths(table))


def _axis_row(table: Mapping[str, Any]) -> AxisRowGeometry:
    joints, flange = table["joint"], table["flange"]
    q1, q2, q3, q4 = flange["quaternion"]
    return AxisRowGeometry(
        points=tuple(_point(joint["point_mm"]) for joint in joints),
        directions=tuple(_vector(joint["axis"]) for joint in joints),
        flange_point=_point(flange["point_mm"]),
        flange_quaternion=(q1, q2, q3, q4),
    )


def _lengths(table: Mapping[str, Any]) -> dict[str, float]:
    return {name: millimetres / 1000.0 for name, millimetres in table["geometry_mm"].items()}


def _point(millimetres: Sequence[float]) -> Vector:
    x, y, z = millimetres
    return x / 1000.0, y / 1000.0, z / 1000.0


def _vector(components: Sequence[float]) -> Vector:
    x, y, z = components
    return x, y, z


_Read = Callable[[Mapping[str, Any]], Geometry]
_STRUCTURES: Mapping[str, tuple[_Read, int | None]] = MappingProxyType(
    {
        "ortho-parallel": (_ortho_parallel, opw_geometry.JOINT_COUNT),
        "five-axis": (_five_axis, five_axis.JOINT_COUNT),
        "palletizer": (_palletizer, palletizer.JOINT_COUNT),
        "scara": (_scara, scara.JOINT_COUNT),
        "axis-row": (_axis_row, None),
    }
)
"""Reader and number of joints of each structure; None if any number is accepted."""
