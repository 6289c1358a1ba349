"""The station file: which robot, how it moves, what is around it."""
