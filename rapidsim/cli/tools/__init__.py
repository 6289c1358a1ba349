"""Debugger, profiler, viewer, fixes: what commands do beside their job."""
