"""Station file: the robot, its motion model, and its surroundings."""
