"""Comparison of two programs, and of their runs."""
