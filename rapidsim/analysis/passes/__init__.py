"""The passes over a task, in order."""
