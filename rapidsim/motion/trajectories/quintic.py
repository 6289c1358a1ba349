"""Moved to `rapidsim.motion.waypoints.quintic`; this alias goes in the next release."""

from rapidsim.motion.waypoints.quintic import overshoot as overshoot
from rapidsim.motion.waypoints.quintic import quintics as quintics
