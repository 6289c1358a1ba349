"""Bytes, numbers, layout and style."""
