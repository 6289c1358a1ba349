"""Paths in joint space, over one path parameter s."""
