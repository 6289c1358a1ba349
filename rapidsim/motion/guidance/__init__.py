"""A robot that a sensor guides: from goals that come every few milliseconds to joints."""
