"""The tables [motion] and [dynamics]: parameters of the motion model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum
from typing import Annotated

from rapidsim.json_records.declarations import AboveZero, Key, NotNegative, Valid
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
from rapidsim.station.declared_tables import values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class


class ConfigurationRule(StrEnum):
    """Values of `configuration`; see docs/configurations.md."""

    COMPLIANT = "compliant"
    EXACT = "exact"
    NEAREST = "nearest"

    @classmethod
    def _missing_(cls, value: object) -> ConfigurationRule | None:
        """Return the rule of a name of version 0.1."""
        return cls.EXACT if value == "stop" else None


def _above_zero(numbers: Sequence[float]) -> bool:
    return min(numbers) > 0.0


@value_class(frozen=True, slots=True)
class MotionTable:
    """The table [motion]. Fields have the names of `MotionModel`, which describes them."""

    version: Annotated[Version | None, Key("model")] = None
    controller: Controller | None = None
    acceleration_time: AboveZero | None = None
    acceleration: Annotated[
        tuple[float, ...] | None, Valid(_above_zero, "accelerations must be above 0")
    ] = None
    """Known axis accelerations [deg/s2], which replace `acceleration_time`."""
    payload_acceleration: AboveZero | None = None
    max_speed: Annotated[
        tuple[float, ...] | None,
        Key("axis_speed"),
        Valid(_above_zero, "axis speeds must be above 0"),
    ] = None
    """Axis speeds [deg/s] that replace the robot's, for arms without published values."""
    filter_time: NotNegative | None = None
    smoothing: Smoothing | None = None
    fine_dwell: NotNegative | None = None
    corner: BlendShape | None = None
    parabola_acceleration: AboveZero | None = None
    orientation_zone: OrientationZone | None = None
    accelerations_kept_by: Keeper | None = None
    configuration: ConfigurationRule = ConfigurationRule.COMPLIANT
    """Tolerance of a stored configuration, and the effect of a violation."""
    zone_share: Annotated[
        AboveZero | None, Valid(lambda share: share <= 1.0, "a share is at most 1")
    ] = None


@value_class(frozen=True, slots=True)
class DynamicsTable:
    """The table [dynamics]: factors on the assumed dynamics of the arm."""

    torque: Annotated[
        tuple[float, float, float] | None, Valid(_above_zero, "factors must be above 0")
    ] = None
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
