"""Compares two programs, and their runs."""
