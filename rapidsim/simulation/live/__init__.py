"""A controller that stays on: programs start and stop while clients act on it from outside."""
