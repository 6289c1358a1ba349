"""Findings and runs as text and JSON."""
