"""Rotations and rigid transforms, singly in plain floats and in batches; poses that move."""
