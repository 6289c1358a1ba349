"""Trajectories through a row of points, as they are taught: lines, splines, joint polynomials."""
