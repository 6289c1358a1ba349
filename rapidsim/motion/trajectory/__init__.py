"""The motion of a whole run as a function of time, smoothed as the controller does it."""
