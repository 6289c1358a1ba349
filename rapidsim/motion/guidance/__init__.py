"""Motion of a robot guided by a sensor: from goals every few milliseconds to joints."""
