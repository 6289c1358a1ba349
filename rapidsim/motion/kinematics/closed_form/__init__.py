"""Arms with closed-form inverse kinematics."""
