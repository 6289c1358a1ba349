"""Moved to `rapidsim.motion.waypoints.follow`; this name goes with the next release."""

from rapidsim.motion.waypoints.follow import follow as follow
