"""Belts of conveyors that a move follows, for the resolver of moves."""

from __future__ import annotations

from dataclasses import replace

from rapidsim.motion.configurations.targets import BeltMotion
from rapidsim.motion.geometry.belts import BeltRide
from rapidsim.motion.geometry.segments import Segment, with_belt_axis
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class FollowedBelt:
    """The belts that a move begins to follow, follows, or leaves."""

    rides: tuple[BeltRide, ...]
    travel: float
    """Position [m] of the axis that stands for the belt, at the start of the move."""
    zone_before: float
    """Radius [m] of the zone before the move; 0 if it begins at a stop point."""
    motion: BeltMotion | None = None
    """Motion of its work object; None for a move that leaves the belt."""

    def put_on(self, segment: Segment) -> Segment:
        """Return the segment of the move with the axis of the belt."""
        own = segment.carrier_axes
        end = self.travel if own is None else float(own[1][-1])
        zones = self.zone_before, segment.zone.position if segment.zone else 0.0
        rides = tuple(replace(one, zones=zones) for one in self.rides)
        return with_belt_axis(segment, self.travel, end, rides)
