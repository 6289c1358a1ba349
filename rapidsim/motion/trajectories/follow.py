"""Moved to `rapidsim.motion.waypoints.follow`; this alias goes in the next release."""

from rapidsim.motion.waypoints.follow import follow as follow
