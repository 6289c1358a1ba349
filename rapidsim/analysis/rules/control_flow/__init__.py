"""Constant decisions, handlers that do not handle, settings not restored."""
