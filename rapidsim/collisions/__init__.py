"""Collision detection for the bodies of a cell: shapes, distances, contacts along a motion."""
