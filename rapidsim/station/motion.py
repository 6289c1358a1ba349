"""The tables [motion] and [dynamics]: parameters of the motion model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum
from typing import TypeVar, get_args

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
from rapidsim.station.toml_reader import Reader, Table

_KEYS = (
    "model",
    "controller",
    "acceleration_time",
    "acceleration",
    "payload_acceleration",
    "axis_speed",
    "filter_time",
    "smoothing",
    "fine_dwell",
    "corner",
    "parabola_acceleration",
    "orientation_zone",
    "accelerations_kept_by",
    "configuration",
    "zone_share",
)
_EXACT_BEFORE = "stop"
"""Name of the rule `exact` in version 0.1."""
_OF_DYNAMICS = ("torque", "wrist")
_MAIN_AXES = 3
_Word = TypeVar("_Word", bound=str)


class ConfigurationRule(StrEnum):
    """Values of `configuration`; see docs/configurations.md."""

    COMPLIANT = "compliant"
    EXACT = "exact"
    NEAREST = "nearest"


def read_motion(
    reader: Reader, motion: Table, dynamics: Table
) -> tuple[MotionModel, tuple[str, ...]]:
    """Read both tables; errors are collected in the reader, missing values keep their defaults.

    Returns:
        The model, and remarks on settings that no longer have an effect.
    """
    reader.note_unknown_keys("motion", motion, _KEYS)
    reader.note_unknown_keys("dynamics", dynamics, _OF_DYNAMICS)

    def word(key: str, fallback: object, default: _Word) -> _Word:
        """Return the value of a key, which must be one of the words of a `Literal`."""
        words: tuple[_Word, ...] = get_args(fallback)
        found = reader.text(motion, "motion", key)
        if found is None:
            return default
        for one in words:
            if found == one:
                return one
        reader.wrong(f"motion.{key}", f"`{found}` is {_neither(words)}")
        return default

    default = MODELS[word("model", Version, MotionModel().version)]
    acceleration = _above_zero(reader, motion, "acceleration", "accelerations")
    axis_speed = _above_zero(reader, motion, "axis_speed", "axis speeds")
    acceleration_time = reader.positive(motion, "motion", "acceleration_time")
    filter_time = reader.not_negative(motion, "motion", "filter_time")
    fine_dwell = reader.not_negative(motion, "motion", "fine_dwell")
    payload = reader.positive(motion, "motion", "payload_acceleration")
    parabola = reader.positive(motion, "motion", "parabola_acceleration")
    zone = word("orientation_zone", OrientationZone, default.orientation_zone)
    remarks: tuple[str, ...] = ()
    if default.version != "1" and zone != default.orientation_zone:
        zone = default.orientation_zone
        remarks = (
            'motion.orientation_zone has an effect only with `model = "1"`: the orientation '
            "turns within its own zone, as measured; the key will be removed in the next release",
        )
    zone_share = reader.positive(motion, "motion", "zone_share")
    if zone_share is not None and zone_share > 1.0:
        reader.wrong("motion.zone_share", "a share is at most 1")
    torque = _factors(reader, dynamics)
    wrist = reader.positive(dynamics, "dynamics", "wrist")
    model = replace(
        default,
        controller=word("controller", Controller, default.controller),
        acceleration_time=acceleration_time or default.acceleration_time,
        own_accelerations=acceleration_time is None,
        acceleration=_radians(acceleration),
        torque=torque or default.torque,
        wrist=wrist or default.wrist,
        payload_acceleration=payload or default.payload_acceleration,
        max_speed=_radians(axis_speed),
        filter_time=default.filter_time if filter_time is None else filter_time,
        smoothing=word("smoothing", Smoothing, default.smoothing),
        fine_dwell=default.fine_dwell if fine_dwell is None else fine_dwell,
        corner=word("corner", BlendShape, default.corner),
        parabola_acceleration=parabola or default.parabola_acceleration,
        orientation_zone=zone,
        zone_share=zone_share or default.zone_share,
        accelerations_kept_by=word("accelerations_kept_by", Keeper, default.accelerations_kept_by),
    )
    return model, remarks


def read_configuration_rule(reader: Reader, motion: Table) -> ConfigurationRule:
    """Read `configuration`: the tolerance of a stored one, and the effect of a violation."""
    written = reader.text(motion, "motion", "configuration") or ConfigurationRule.COMPLIANT
    if written == _EXACT_BEFORE:
        return ConfigurationRule.EXACT
    if written not in list(ConfigurationRule):
        words = _neither([str(rule) for rule in ConfigurationRule])
        reader.wrong("motion.configuration", f"`{written}` is {words}")
        return ConfigurationRule.COMPLIANT
    return ConfigurationRule(written)


def _neither(words: Sequence[str]) -> str:
    if len(words) == 2:
        return f"neither `{words[0]}` nor `{words[1]}`"
    return f"none of {', '.join(f'`{one}`' for one in words)}"


def _above_zero(reader: Reader, motion: Table, key: str, subject: str) -> tuple[float, ...] | None:
    numbers = reader.numbers(motion, "motion", key, None)
    if numbers and min(numbers) <= 0.0:
        reader.wrong(f"motion.{key}", f"{subject} must be above 0")
    return numbers


def _factors(reader: Reader, dynamics: Table) -> tuple[float, float, float] | None:
    """Return the factors on the torques of the main axes."""
    numbers = reader.numbers(dynamics, "dynamics", "torque", _MAIN_AXES)
    if numbers is None:
        return None
    if min(numbers) <= 0.0:
        reader.wrong("dynamics.torque", "factors must be above 0")
        return None
    first, second, third = numbers
    return first, second, third


def _radians(degrees: tuple[float, ...] | None) -> tuple[float, ...] | None:
    return tuple(math.radians(one) for one in degrees) if degrees else None
