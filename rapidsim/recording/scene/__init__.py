"""What stands and moves in the cell."""
