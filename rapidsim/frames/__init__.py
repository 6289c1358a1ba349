"""Rotations and rigid transforms: scalar quaternions in plain Python, batches in NumPy."""
