"""Moved to `rapidsim.motion.waypoints.plan`; this alias goes in the next release."""

from rapidsim.motion.waypoints.plan import Plan as Plan
from rapidsim.motion.waypoints.plan import Refused as Refused
from rapidsim.motion.waypoints.plan import Way as Way
