"""Motion queue of a robot, alone or in a team: its moves and the fixed part of its motion."""
