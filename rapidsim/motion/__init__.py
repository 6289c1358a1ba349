"""Kinematics, paths, timing and trajectories, and the parameters of the motion model."""
