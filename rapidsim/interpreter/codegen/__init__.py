"""Translates a checked routine into Python syntax."""
