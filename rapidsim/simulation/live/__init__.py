"""A controller that stays on: programs start and stop, and somebody outside acts meanwhile."""
