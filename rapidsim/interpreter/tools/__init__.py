"""Support for coverage, debugger and assertions."""
