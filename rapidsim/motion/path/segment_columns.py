"""Limits of a path's segments as columns: looked up once, used at every point."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Segment
from rapidsim.repeated_rows import shared_row
from rapidsim.values import value_class

_WIDTHS = 4
"""Number of widths that represent the smoothing window while it widens."""


@value_class(frozen=True, slots=True, eq=False)
class SegmentLimits:
    """Limits of segments (m,); infinite for no limit."""

    tcp: Array
    """Shape (m,): TCP speed [m/s]."""
    reorientation: Array
    """Shape (m,): [rad/s]."""
    external: Array
    """Shape (m, e): speed of each external axis [m/s or rad/s]."""
    acceleration_share: Array
    """Shape (m,): AccSet."""
    tcp_acceleration: Array
    """Shape (m,): PathAccLim [m/s2], the smaller of speeding up and braking."""
    world_acceleration: Array
    """Shape (m,): WorldAccLim [m/s2]."""
    load: Array
    """Shape (m,): load at the wrist, as a share of the rated payload."""

    def __len__(self) -> int:
        """Return the number of segments."""
        return len(self.tcp)


def programmed_of(segments: Sequence[Segment]) -> SegmentLimits:
    """Return the limits of one or more segments."""
    columns = np.array(
        [
            (
                segment.speed.tcp,
                segment.speed.reorientation,
                segment.acceleration_share,
                min(segment.tcp_acceleration, segment.tcp_deceleration),
                segment.world_acceleration,
                segment.load,
            )
            for segment in segments
        ]
    )
    tcp, reorientation, share, along, world, load = map(shared_row, np.ascontiguousarray(columns.T))
    external = np.array([segment.external_speeds for segment in segments], dtype=np.float64)
    return SegmentLimits(tcp, reorientation, external, share, along, world, load)


def widths_of(segments: Sequence[Segment], filter_time: float) -> tuple[float, ...]:
    """Widths [s] of the smoothing window, ascending: one, or a few while a ramp widens it."""
    ramps = {one.ramp for one in segments} | {one.stop_ramp for one in segments if not one.zone}
    lowest, highest = min(ramps), segments[0].ramp
    if lowest == highest:
        return (filter_time / lowest,)
    between = np.linspace(1.0 / highest, 1.0 / lowest, _WIDTHS)
    return tuple((filter_time * between).tolist())


def ramp_window(ramp: float, filter_time: float) -> float:
    """Width [s] of the window over which a ramp (0 to 1) averages the speed along the path."""
    return filter_time * (1.0 / ramp - 1.0)
