"""Exports of a run to files for other tools: trace tables, event lines."""
