"""Moved to `rapidsim.motion.waypoints.spline`; this alias goes in the next release."""

from rapidsim.motion.waypoints.spline import spline as spline
