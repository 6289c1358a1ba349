"""Findings of checks of motion and of runs: one small class per rule."""
