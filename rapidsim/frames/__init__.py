"""Rotations and rigid transforms, single in plain floats and in batches; moving frames."""
