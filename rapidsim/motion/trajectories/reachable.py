"""Moved to `rapidsim.motion.waypoints.reachability`; this alias goes in the next release."""

from rapidsim.motion.waypoints.reachability import reach as reach
