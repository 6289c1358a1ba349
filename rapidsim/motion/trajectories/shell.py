"""Moved to `rapidsim.motion.waypoints.random_points`; this name goes with the next release."""

from rapidsim.motion.waypoints.random_points import shell_points as shell_points
