"""Dated record of a run, while the times themselves may still be unknown."""
