"""A robot's queue of moves and how much of its motion is fixed, alone or in step with others."""
