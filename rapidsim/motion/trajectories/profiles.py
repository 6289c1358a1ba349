"""Moved to `rapidsim.motion.waypoints.velocity_profiles`; this alias goes in the next release."""

from rapidsim.motion.waypoints.velocity_profiles import law as law
