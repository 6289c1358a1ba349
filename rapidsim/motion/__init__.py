"""Targets to joint trajectories in SI units; knows no RAPID text."""
