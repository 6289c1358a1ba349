"""Modules become functions that know each other, and come and go while the program runs."""
