"""A robot's moves and how far they are decided: alone, or in step with other robots."""
