"""Decisions that are none, handlers that do not handle, settings left behind."""
