"""Bytes, numbers, layout and house style."""
