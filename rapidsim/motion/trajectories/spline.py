"""Moved to `rapidsim.motion.waypoints.spline`; this name goes with the next release."""

from rapidsim.motion.waypoints.spline import spline as spline
