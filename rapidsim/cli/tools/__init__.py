"""Debugger, profiler, viewer, fixes: additional services of commands."""
