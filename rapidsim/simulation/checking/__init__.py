"""Can the robot make the moves that stand in the text? Answered before anything runs."""
