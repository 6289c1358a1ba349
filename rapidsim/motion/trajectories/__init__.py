"""Names of `rapidsim.motion.waypoints` as they were; they go with the next release."""
