"""A run as a rerun recording: opening it, its clocks, its samples."""
