"""Colours and tables that all reports share."""
