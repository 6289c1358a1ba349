"""Whole RAPID programs out of thin air, sent through every command; see `benchmarks/fuzz.py`."""
