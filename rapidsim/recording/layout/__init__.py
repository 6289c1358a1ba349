"""Layouts of the viewer, and the writers of whole recordings."""
