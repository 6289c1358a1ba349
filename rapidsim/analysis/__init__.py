"""Turns a syntax tree into a Program or findings: the passes, their shared state, their results."""
