"""Moved to `rapidsim.motion.waypoints.points_file`; this alias goes in the next release."""

from rapidsim.motion.waypoints.points_file import points_from_text as points_from_text
