"""Name resolution, and what a task declares."""
