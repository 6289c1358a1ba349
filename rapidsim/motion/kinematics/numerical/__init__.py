"""Arms whose inverse kinematics is a numerical search."""
