"""The Python API: a cell that is loaded once and checked, run and called."""
