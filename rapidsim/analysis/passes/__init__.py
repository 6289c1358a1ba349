"""The passes over a task, in their order."""
