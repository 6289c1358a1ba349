"""A run as a rerun recording; the only package that imports rerun."""
