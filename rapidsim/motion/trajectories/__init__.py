"""Aliases of the modules of `rapidsim.motion.waypoints`; removed in the next release."""
