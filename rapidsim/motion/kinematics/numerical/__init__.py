"""Arms whose inverse kinematics is a search."""
