"""Time-optimal scaling of a path within its limits."""
