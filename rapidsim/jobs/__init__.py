"""Conversion of a user's request to a check or a run, common to API and command line."""
