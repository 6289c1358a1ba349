"""What stands beside the cell: plots, lanes, program, log."""
