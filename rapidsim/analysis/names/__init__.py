"""Name resolution, and the declarations of a task."""
