"""Moved to `rapidsim.motion.waypoints.velocity_profiles`; this name goes with the next release."""

from rapidsim.motion.waypoints.velocity_profiles import law as law
