"""Surprising zones, targets, tools and first moves."""
