"""A robot guided by a sensor: from goals that come every few milliseconds to joints."""
