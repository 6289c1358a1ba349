"""A tree becomes a Program or findings: the passes, what they share, what they leave."""
