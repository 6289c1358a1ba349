"""Predefined RAPID routines, one module per chapter of the manual, and predefined data."""
