"""The tables [motion] and [dynamics]: parameters of the motion model."""

from __future__ import annotations

import math
from dataclasses import replace
from enum import StrEnum
from typing import Annotated

from rapidsim.json_records.declarations import AboveZero, Key, NotNegative, Share
from rapidsim.motion.model import (
    MODELS,
    BlendShape,
    Controller,
    Keeper,
    MotionModel,
    OrientationZone,
    Smoothing,
    Version,
)
from rapidsim.station.declared_tables import AllAboveZero, ReadBy, none_of, values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

_EXACT_BEFORE = "stop"
"""Name of the rule `exact` in version 0.1."""


class ConfigurationRule(StrEnum):
    """Values of `configuration`; see docs/configurations.md."""

    COMPLIANT = "compliant"
    EXACT = "exact"
    NEAREST = "nearest"


def _rule(reader: Reader, motion: Table, path: str, key: str) -> ConfigurationRule | None:
    written = reader.text(motion, path, key)
    if written == _EXACT_BEFORE:
        return ConfigurationRule.EXACT
    if written is None or written in list(ConfigurationRule):
        return ConfigurationRule(written) if written else None
    words = none_of([str(rule) for rule in ConfigurationRule])
    reader.wrong(f"{path}.{key}", f"`{written}` is {words}")
    return None


@value_class(frozen=True, slots=True)
class MotionTable:
    """The table [motion]. Fields have the names of `MotionModel`, which describes them."""

    version: Annotated[Version | None, Key("model")] = None
    controller: Controller | None = None
    acceleration_time: AboveZero | None = None
    acceleration: Annotated[tuple[float, ...] | None, AllAboveZero("accelerations")] = None
    """[deg/s2]."""
    payload_acceleration: AboveZero | None = None
    max_speed: Annotated[
        tuple[float, ...] | None, Key("axis_speed"), AllAboveZero("axis speeds")
    ] = None
    """[deg/s]."""
    filter_time: NotNegative | None = None
    smoothing: Smoothing | None = None
    fine_dwell: NotNegative | None = None
    corner: BlendShape | None = None
    parabola_acceleration: AboveZero | None = None
    orientation_zone: OrientationZone | None = None
    accelerations_kept_by: Keeper | None = None
    configuration: Annotated[ConfigurationRule, ReadBy(_rule)] = ConfigurationRule.COMPLIANT
    """Tolerance of a stored configuration, and the effect of a violation."""
    zone_share: Share | None = None


@value_class(frozen=True, slots=True)
class DynamicsTable:
    """The table [dynamics]: factors on the assumed dynamics of the arm."""

    torque: Annotated[tuple[float, float, float] | None, AllAboveZero("factors")] = None
    wrist: AboveZero | None = None


def read_motion(
    reader: Reader, motion: Table, dynamics: Table
) -> tuple[MotionModel, ConfigurationRule, tuple[str, ...]]:
    """Read both tables; errors are collected in the reader, missing values keep their defaults.

    Returns:
        The model, the rule of configurations, and remarks on settings that no longer have an
        effect.
    """
    found = values_of(reader, MotionTable, motion, "motion")
    found |= values_of(reader, DynamicsTable, dynamics, "dynamics")
    default = MODELS[found.pop("version", MotionModel().version)]
    rule = found.pop("configuration", ConfigurationRule.COMPLIANT)
    remarks: tuple[str, ...] = ()
    zone = default.orientation_zone
    if default.version != "1" and found.pop("orientation_zone", zone) != zone:
        remarks = (
            'motion.orientation_zone has an effect only with `model = "1"`: the orientation '
            "turns within its own zone, as measured; the key will be removed in the next release",
        )
    for name in found.keys() & {"acceleration", "max_speed"}:
        found[name] = tuple(math.radians(one) for one in found[name])
    has_own = "acceleration_time" not in found
    return replace(default, own_accelerations=has_own, **found), rule, remarks
