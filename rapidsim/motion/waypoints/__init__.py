"""Trajectories through taught points, without a program."""
