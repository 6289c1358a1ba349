"""What the bodies of a cell touch: shapes, distances, contacts along a motion."""
