"""Moved to `rapidsim.motion.waypoints.random_points`; this alias goes in the next release."""

from rapidsim.motion.waypoints.random_points import shell_points as shell_points
