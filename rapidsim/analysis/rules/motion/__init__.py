"""Zones, targets, tools and first moves that will surprise."""
