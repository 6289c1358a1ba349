"""Moved to `rapidsim.motion.waypoints.reachability`; this name goes with the next release."""

from rapidsim.motion.waypoints.reachability import reach as reach
