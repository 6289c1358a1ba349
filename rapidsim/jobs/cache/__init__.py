"""Cached results of checks, by fingerprints of all their inputs; parallel processes."""
