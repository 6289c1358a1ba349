"""The table [motion]: the parameters of the motion model."""

from __future__ import annotations

import math

from rapidsim.motion.model import BlendShape, Keeper, MotionModel, OrientationZone, Smoothing
from rapidsim.station.toml_reader import Reader, Table

_KEYS = (
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
)


def read_motion(reader: Reader, motion: Table) -> MotionModel:
    """Read the table; what is wrong is noted, what is missing stays as it is by default."""
    reader.known("motion", motion, _KEYS)
    default = MotionModel()
    acceleration = reader.numbers(motion, "motion", "acceleration", None)
    if acceleration and min(acceleration) <= 0.0:
        reader.wrong("motion.acceleration", "accelerations are above 0")
    axis_speed = reader.numbers(motion, "motion", "axis_speed", None)
    if axis_speed and min(axis_speed) <= 0.0:
        reader.wrong("motion.axis_speed", "axis speeds are above 0")
    acceleration_time = reader.positive(motion, "motion", "acceleration_time")
    filter_time = reader.not_negative(motion, "motion", "filter_time")
    fine_dwell = reader.not_negative(motion, "motion", "fine_dwell")
    payload = reader.positive(motion, "motion", "payload_acceleration")
    parabola = reader.positive(motion, "motion", "parabola_acceleration")
    return MotionModel(
        acceleration_time=acceleration_time or default.acceleration_time,
        own_accelerations=acceleration_time is None,
        acceleration=_radians(acceleration),
        payload_acceleration=payload or default.payload_acceleration,
        max_speed=_radians(axis_speed),
        filter_time=default.filter_time if filter_time is None else filter_time,
        smoothing=_smoothing(reader, motion, default.smoothing),
        fine_dwell=default.fine_dwell if fine_dwell is None else fine_dwell,
        corner=_corner(reader, motion, default.corner),
        parabola_acceleration=parabola or default.parabola_acceleration,
        orientation_zone=_orientation_zone(reader, motion, default.orientation_zone),
        accelerations_kept_by=_keeper(reader, motion, default.accelerations_kept_by),
    )


def reads_nearest_configuration(reader: Reader, motion: Table) -> bool:
    """`configuration`: whether a stored one that cannot be had gives way to the nearest."""
    match reader.text(motion, "motion", "configuration") or "stop":
        case "stop":
            return False
        case "nearest":
            return True
        case other:
            reader.wrong("motion.configuration", f"`{other}` is neither `stop` nor `nearest`")
            return False


def _smoothing(reader: Reader, motion: Table, default: Smoothing) -> Smoothing:
    match reader.text(motion, "motion", "smoothing") or default:
        case "path" | "axes" as known:
            return known
        case other:
            reader.wrong("motion.smoothing", f"`{other}` is neither `path` nor `axes`")
            return default


def _corner(reader: Reader, motion: Table, default: BlendShape) -> BlendShape:
    match reader.text(motion, "motion", "corner") or default:
        case "c2" | "parabola" as known:
            return known
        case other:
            reader.wrong("motion.corner", f"`{other}` is neither `c2` nor `parabola`")
            return default


def _orientation_zone(reader: Reader, motion: Table, default: OrientationZone) -> OrientationZone:
    match reader.text(motion, "motion", "orientation_zone") or default:
        case "position" | "programmed" as known:
            return known
        case other:
            reader.wrong(
                "motion.orientation_zone", f"`{other}` is neither `position` nor `programmed`"
            )
            return default


def _keeper(reader: Reader, motion: Table, default: Keeper) -> Keeper:
    match reader.text(motion, "motion", "accelerations_kept_by") or default:
        case "command" | "motion" as known:
            return known
        case other:
            reader.wrong(
                "motion.accelerations_kept_by", f"`{other}` is neither `command` nor `motion`"
            )
            return default


def _radians(degrees: tuple[float, ...] | None) -> tuple[float, ...] | None:
    return tuple(math.radians(one) for one in degrees) if degrees else None
