"""Checks of jobs: programs of all tasks, their moves, the trial run."""
