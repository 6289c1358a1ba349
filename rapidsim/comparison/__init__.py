"""What changed between two programs, and between their runs."""
