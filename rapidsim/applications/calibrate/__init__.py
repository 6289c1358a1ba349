"""`rapidsim calibrate`: fit of the motion model to logs of a real controller."""
