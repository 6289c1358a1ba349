"""Rotations and rigid transforms: one at a time in plain Python, batches in NumPy."""
