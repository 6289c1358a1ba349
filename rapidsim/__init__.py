"""RAPID interpreter and command-line simulator for ABB robots."""

__version__ = "0.1.0"
