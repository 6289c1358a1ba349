"""Panels next to the cell: plots, lanes, program, log."""
