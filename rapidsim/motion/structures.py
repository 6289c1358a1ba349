"""What kinds of arms the catalogue knows: from `structure` in a `robot.toml` to lengths in SI."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import radians
from types import MappingProxyType
from typing import Any

from rapidsim.motion import five_axis, opw_geometry, palletizer
from rapidsim.motion.five_axis import FiveAxisGeometry
from rapidsim.motion.opw_geometry import OpwGeometry
from rapidsim.motion.palletizer import PalletizerGeometry

Geometry = OpwGeometry | FiveAxisGeometry | PalletizerGeometry


def geometry_from_table(table: Mapping[str, Any]) -> Geometry:
    """The geometry that a `robot.toml` describes.

    Raises:
        KeyError: If something is missing.
        ValueError: If the structure is not known, or there are more or fewer joints than it has.
        TypeError: If a length has a name that the structure does not have.
    """
    structure = table["structure"]
    if structure not in _STRUCTURES:
        known = ", ".join(f"`{name}`" for name in _STRUCTURES)
        raise ValueError(f"structure `{structure}` is not known, only {known}")
    read, joint_count = _STRUCTURES[structure]
    if len(table["joint"]) != joint_count:
        raise ValueError(f"the arm needs {joint_count} joints")
    lengths = {name: millimetres / 1000.0 for name, millimetres in table["geometry_mm"].items()}
    return read(lengths, table)


def _ortho_parallel(lengths: Mapping[str, float], table: Mapping[str, Any]) -> OpwGeometry:
    zero = table["zero"]
    if not len(zero["offsets_deg"]) == len(zero["signs"]) == opw_geometry.JOINT_COUNT:
        raise ValueError(f"the arm needs {opw_geometry.JOINT_COUNT} offsets and signs")
    return OpwGeometry(
        **lengths,
        offsets=tuple(radians(degrees) for degrees in zero["offsets_deg"]),
        signs=tuple(zero["signs"]),
        coupling=zero["coupling_3_2"],
    )


def _five_axis(lengths: Mapping[str, float], _: Mapping[str, Any]) -> FiveAxisGeometry:
    return FiveAxisGeometry(**lengths)


def _palletizer(lengths: Mapping[str, float], _: Mapping[str, Any]) -> PalletizerGeometry:
    return PalletizerGeometry(**lengths)


_Read = Callable[[Mapping[str, float], Mapping[str, Any]], Geometry]
_STRUCTURES: Mapping[str, tuple[_Read, int]] = MappingProxyType(
    {
        "ortho-parallel": (_ortho_parallel, opw_geometry.JOINT_COUNT),
        "five-axis": (_five_axis, five_axis.JOINT_COUNT),
        "palletizer": (_palletizer, palletizer.JOINT_COUNT),
    }
)
"""How each structure is read, and how many joints it has."""
