"""Turns checked programs into Python functions and runs them."""
