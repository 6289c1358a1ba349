"""The fastest time scaling of a path within its limits."""
