"""Controller that stays on: clients start and stop programs, and change signals and data."""
