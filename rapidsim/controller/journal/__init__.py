"""What happened when, while the times themselves may still be unknown."""
