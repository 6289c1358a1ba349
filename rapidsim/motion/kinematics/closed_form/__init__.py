"""Arms whose inverse kinematics is a formula."""
