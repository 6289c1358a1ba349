"""A run as files other tools read: trace tables, event lines."""
