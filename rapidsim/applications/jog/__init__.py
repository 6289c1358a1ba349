"""Jogging an arm by hand on a local page, without a program that runs."""
