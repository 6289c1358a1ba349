"""A run as text and JSON."""
