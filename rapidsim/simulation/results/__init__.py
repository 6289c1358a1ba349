"""What a run leaves, and what can be read off it."""
