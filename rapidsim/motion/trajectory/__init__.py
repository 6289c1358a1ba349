"""Motion of a whole run as a function of time, smoothed as by the controller."""
